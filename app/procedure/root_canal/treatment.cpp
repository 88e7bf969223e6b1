#include "app/procedure/root_canal/treatment.h"

#include <algorithm>
#include <functional>

#include <fmt/core.h>

#include "app/procedure/root_canal/canal_tip.h"
#include "app/procedure/root_canal/treatment_meter.h"

namespace app {
namespace {

constexpr double kEmptied = 0.5;  ///< share of the flutes

}  // namespace

std::string_view nameOf(haptics::WearLaw law) {
  switch (law) {
    case haptics::WearLaw::counters:
      return "counters";
    case haptics::WearLaw::counters_helical:
      return "counters-helical";
    case haptics::WearLaw::wear:
      break;
  }
  return "rate";
}

FileUse::FileUse(const assets::ToothCanals& tooth) : tooth_(tooth) {
  for (const assets::ToothCanal& canal : tooth_.canals) canals_.push_back({TipTrack(canal.length_mm())});
}

void FileUse::moveOn(const haptics::Tick& tick, int size) {
  const glm::dvec3& handle_P_mm = tick.proxy_P.mm;
  in_mm_ += glm::dot(handle_P_mm - last_handle_P_mm_, tick.heldRotation() * glm::dvec3(0.0, 0.0, -1.0));
  last_handle_P_mm_ = handle_P_mm;
  if (tick.file.stay != haptics::FileStay::wall || size == 0 || size != in_hand_)
    motion_.lift();
  else
    motion_.add(tick.dt_s, tick.file.roll_rad, in_mm_);
}

void FileUse::add(const haptics::Tick& tick, int size) {
  using haptics::FileStay;
  const haptics::FileWork& file = tick.file;
  moveOn(tick, size);
  fragments_ = file.fragments;
  debris_mm3_ = file.debris_mm3;
  if (size == 0) return;
  // Told once a filling: water lets a little more in at once.
  is_full_ = file.flutes_full >= (is_full_ ? kEmptied : kFlutesFull);
  if (file.stay == FileStay::none || file.stay == FileStay::through) return;
  torque_share_ = std::max(torque_share_, file.torque_share);
  filed_mm3_ = file.removed_total_mm3;
  if (file.stay == FileStay::wall) filing_s_ += tick.dt_s;
  if (file.stay == FileStay::wall && is_full_) full_s_ += tick.dt_s;
  if (file.broken_from_tip_mm > 0.0) ++broken_;
  if (size != in_hand_) is_bent_ = false;
  in_hand_ = size;
  if (file.keeps_bend && !is_bent_) ++bent_;
  is_bent_ = is_bent_ || file.keeps_bend;
  const auto place = canalTip(tooth_, file.tip_P_mm);
  if (!place) return;
  Canal& canal = canals_[place->canal];
  canal.tip.add(tick.t_s, place->along_mm);
  constexpr double kAtLength_mm = 1.0;
  if (canal.tip.error().at_rest_mm > -kAtLength_mm) canal.size = std::max(canal.size, size);
}

bool Treatment::isForamenMoved() const {
  return std::ranges::any_of(canals,
                             [](const TreatedCanal& one) { return one.outcomes.foramen_moved_mm > kForamenMoved_mm; });
}

std::string motionWords(const Treatment& treatment) {
  std::array<std::size_t, kFileMotions> longest{0, 1, 2, 3};
  std::ranges::stable_sort(longest, std::greater{}, [&](std::size_t n) { return treatment.motion_s[n]; });
  std::string words;
  for (const std::size_t n : longest) {
    const double percent = treatment.filing_s > 0.0 ? 100.0 * treatment.motion_s[n] / treatment.filing_s : 0.0;
    if (percent < 0.5) continue;
    words += fmt::format("{}{} {:.0f} %", words.empty() ? "" : ", ", nameOf(FileMotion{n}), percent);
  }
  return words;
}

void Treatment::setFiles(const FileUse& files) {
  broken_files = files.broken(), bent_files = files.bent();
  fragments_left = files.fragments(), fragments = files.lying();
  torque_share = files.torque_share(), filed_mm3 = files.filed_mm3(), filing_s = files.filing_s();
  debris_left_mm3 = files.debris_mm3(), full_s = files.full_s();
  for (std::size_t n = 0; n < kFileMotions; ++n) motion_s[n] = files.motion().seconds(FileMotion{n});
}

Treatment treatmentOf(const assets::ToothCanals& tooth, const ToothBlocks& before, const FineSolid& after,
                      const FileUse& files, const FineSolid* laid) {
  TreatmentMeter meter(tooth, before);
  for (const glm::ivec3& block : changedBlocks(before, after)) {
    ToothNow::Bytes bytes;
    const FineSolid::Block is = after.block(block);
    for (std::size_t v = 0; v < bytes.size(); ++v) bytes[v] = is.at(v);
    meter.change(block, bytes);
  }
  if (laid != nullptr)
    assets::forVoxels(glm::ivec3(0), laid->grid().size / FineSolid::kEdge, [&](glm::ivec3 block) {
      const FineSolid::Block is = laid->block(block);
      if (is.bytes == nullptr && is.same == 0) return;
      LaidBlocks::Bytes bytes;
      for (std::size_t v = 0; v < bytes.size(); ++v) bytes[v] = is.at(v);
      meter.lay(block, bytes);
    });
  return meter.measure(files);
}

}  // namespace app
