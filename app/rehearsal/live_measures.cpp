#include "app/rehearsal/live_measures.h"

#include <algorithm>
#include <array>
#include <chrono>

#include <nlohmann/json.hpp>

namespace app {
namespace {

constexpr std::array<std::string_view, 6> kFollowed{"M1.on", "M1.drilling", "M3.rate", "PI", "PI.plunge", "S10.dry"};

}  // namespace

LiveMeasures::LiveMeasures(const assets::CtVolume& ct, bool waits) {
  coming_ = std::async(std::launch::async, [&ct] { return std::make_unique<OriginalSurface>(ct.grid, ct.solid); });
  if (waits) surface_ = coming_.get();
}

void LiveMeasures::follow(std::span<const haptics::Tick> ticks, const haptics::Command& command, std::uint64_t serial) {
  if (commands_.empty() || commands_.back().serial != serial) commands_.push_back({serial, command});
  for (const haptics::Tick& tick : ticks) {
    // The newest that this tick was made with.
    std::size_t in_force = commands_.size() - 1;
    while (in_force > 0 && commands_[in_force].serial > tick.command_serial) --in_force;
    waiting_.push_back({tick, in_force});
  }
  if (coming_.valid() && coming_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    surface_ = coming_.get();
  if (surface_) measure(kMostTicks);
}

void LiveMeasures::measure(std::size_t most) {
  for (; most > 0 && !waiting_.empty(); --most) {
    const Given& given = waiting_.front();
    work_.add(workSample(given.tick, commands_[given.command].command, surface_.get()));
    waiting_.pop_front();
  }
}

void LiveMeasures::finish() {
  if (coming_.valid()) surface_ = coming_.get();
  measure(waiting_.size());
  work_.finish();
}

std::vector<MeasureValue> LiveMeasures::values() const {
  std::vector<MeasureValue> followed;
  for (MeasureValue& value : work_.values())
    if (std::ranges::find(kFollowed, value.id) != kFollowed.end()) followed.push_back(std::move(value));
  return followed;
}

std::string LiveMeasures::text() const {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const MeasureValue& value : values())
    if (value.value) json[std::string(value.id)] = *value.value;
  return json.dump();
}

}  // namespace app
