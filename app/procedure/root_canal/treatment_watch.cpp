#include "app/procedure/root_canal/treatment_watch.h"

#include <time.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "app/procedure/root_canal/dense_tooth.h"
#include "app/procedure/root_canal/treatment_meter.h"

namespace app {
namespace {

constexpr double kLeast_mm3 = 0.005;

/// Of this thread: a busy machine makes it no longer.
double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

struct TreatmentWatch::Copy {
  assets::ToothCanals tooth;
  const assets::CtVolume& scan;
  std::span<const std::uint8_t> solid_before;
  std::optional<ToothBlocks> before;  ///< once begun, as all below
  std::optional<TreatmentMeter> meter;
  std::vector<std::pair<glm::ivec3, ToothNow::Bytes>> changes;  ///< since the last
  std::vector<std::pair<glm::ivec3, LaidBlocks::Bytes>> laid;   ///< the same

  /// The tooth before anything was cut, and what an earlier session has cut of it: what does not change is known then.
  Measured begin() {
    before.emplace(DenseTooth(scan.grid, solid_before, scan.label));
    meter.emplace(tooth, *before);
    if (scan.solid.data() != solid_before.data()) takeAll();
    for (const auto& [block, bytes] : std::exchange(laid, {})) meter->lay(block, bytes);
    meter->measure(FileUse(tooth));
    return {};
  }

  void takeAll() {
    const DenseTooth now(scan.grid, scan.solid, scan.label);
    ToothNow::Bytes bytes, labels;
    assets::forVoxels(glm::ivec3(0), now.grid().size / FineSolid::kEdge, [&](glm::ivec3 block) {
      now.block(block, bytes, labels);
      meter->change(block, bytes);
    });
  }

  /// Of an earlier session.
  void takeLaid(const std::vector<std::uint8_t>& bytes) {
    const DenseSolid before_it(scan.grid, bytes);
    assets::forVoxels(glm::ivec3(0), scan.grid.size / FineSolid::kEdge, [&](glm::ivec3 block) {
      LaidBlocks::Bytes to;
      for (std::size_t v = 0; v < to.size(); ++v) to[v] = before_it.block(block).at(v);
      if (to != LaidBlocks::Bytes{}) laid.emplace_back(block, to);
    });
  }

  /// Those bricks of the live tooth.
  void take(const haptics::Bodies& bodies, std::span<const glm::ivec3> bricks) {
    constexpr int kBlocks = assets::kBrickVoxels / FineSolid::kEdge;
    for (const glm::ivec3& brick : bricks) {
      std::array<std::uint8_t, 512> bytes{};
      bodies.jaw().copyBrick(brick, bytes);
      const auto share_out = [&](const std::array<std::uint8_t, 512>& from, auto& into) {
        assets::forVoxels(glm::ivec3(0), glm::ivec3(kBlocks), [&](glm::ivec3 part) {
          ToothNow::Bytes& to = into.emplace_back(kBlocks * brick + part, ToothNow::Bytes()).second;
          std::size_t v = 0;
          const glm::ivec3 low = FineSolid::kEdge * part;
          assets::forVoxels(low, low + FineSolid::kEdge, [&](glm::ivec3 within) {
            to[v++] = from[assets::indexIn(glm::ivec3(assets::kBrickVoxels), within)];
          });
        });
      };
      share_out(bytes, changes);
      if (bodies.filling() != nullptr) share_out(bodies.filling()->copyBrick(brick).laid, laid);
    }
  }

  Measured measure(const FileUse& files) {
    const double start_s = cpu_s();
    for (const auto& [block, bytes] : std::exchange(changes, {})) meter->change(block, bytes);
    for (const auto& [block, bytes] : std::exchange(laid, {})) meter->lay(block, bytes);
    Measured measured{meter->measure(files)};
    measured.took_s = cpu_s() - start_s;
    return measured;
  }
};

TreatmentWatch::TreatmentWatch(const assets::ToothCanals& tooth, const assets::CtVolume& scan,
                               std::span<const std::uint8_t> before, const haptics::Bodies& bodies)
    : copy_(new Copy{tooth, scan, before, {}, {}, {}, {}}), bodies_(bodies) {
  if (const haptics::Filling* const filling = bodies.filling(); filling != nullptr && !filling->isEmpty())
    copy_->takeLaid(filling->volumes().laid);
  measuring_ = std::async(std::launch::async, [copy = copy_.get()] { return copy->begin(); });
}

TreatmentWatch::~TreatmentWatch() {
  if (measuring_.valid()) measuring_.wait();
}

bool TreatmentWatch::follow(std::span<const glm::ivec3> bricks, const haptics::Tick& newest, const FileUse& files) {
  changed_.insert(changed_.end(), bricks.begin(), bricks.end());
  bool is_new = false;
  if (measuring_.valid()) {
    if (measuring_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    Measured measured = measuring_.get();
    if (measured.treatment) {
      newest_ = std::move(measured.treatment);
      longest_s_ = std::max(longest_s_, measured.took_s);
      ++times_;
      is_new = true;
    }
  }
  if (!pause_.isDue(newest, !changed_.empty())) return is_new;
  copy_->take(bodies_, std::exchange(changed_, {}));
  measuring_ = std::async(std::launch::async, [copy = copy_.get(), files] { return copy->measure(files); });
  return is_new;
}

std::string treatmentLine(const Treatment& treatment) {
  std::string line;
  const auto add = [&](const std::string& words) { line += (line.empty() ? "" : "; ") + words; };
  for (const Perforation& hole : treatment.perforations)
    add(fmt::format("perforation, {} {:.2f} mm²", nameOf(hole.kind), hole.area_mm2));
  for (const TreatedCanal& canal : treatment.canals)
    if (canal.filling) add(canal.name + " " + fillingWords(*canal.filling));
  for (const TreatedCanal& canal : treatment.canals) {
    const CanalOutcomes& of = canal.outcomes;
    if (of.removed_mm3 < kLeast_mm3 || canal.filling) continue;
    std::string words =
        fmt::format("{} {:.2f} mm³, {:.0f} % untouched", canal.name, of.removed_mm3, 100.0 * of.untouched);
    if (std::isfinite(of.least_wall_mm)) words += fmt::format(", wall {:.2f} mm", of.least_wall_mm);
    add(words);
  }
  if (treatment.lost.enamel_mm3 + treatment.lost.dentine_mm3 > kLeast_mm3 && treatment.filed_mm3 < kLeast_mm3) {
    add(fmt::format("{:.1f} mm³ of tooth lost, roof {:.0f} % open",
                    treatment.lost.enamel_mm3 + treatment.lost.dentine_mm3, 100.0 * treatment.roof.removed));
    if (treatment.lost.floor_mm3 > kLeast_mm3) add(fmt::format("floor gouged {:.2f} mm³", treatment.lost.floor_mm3));
  }
  return line;
}

}  // namespace app
