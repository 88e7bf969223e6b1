#include "assets/segment/jaw_verdict.h"

#include <algorithm>

namespace assets {
namespace {

constexpr double kToothShare = 0.6;
constexpr std::size_t kMostTeeth = 18;
constexpr double kWidestJaw_mm = 150.0;
constexpr int kCrownsDown = -2;
/// Of jaws at least 0.94 are capped, all stand in the row and over bone, and 0.00 within the arch is hard; of scans
/// without one at most 0.5 are capped, none over bone, or 0.3 within the arch is.
constexpr double kSignShare = 0.5, kManyCaps = 4.0, kMostWithinArch = 0.2;

}  // namespace

JawRefusal toothlessJaw() { return {"J2", "no teeth found: the lower jaw seems toothless"}; }

JawRefusal upperArch() {
  return {"J1", "the crowns point down: this is an upper arch; the lower jaw is not in the scan"};
}

std::optional<JawRefusal> judgeJaw(const VolumeGrid& jaw_box, const std::vector<FoundTooth>& teeth) {
  const double width_mm = std::max(jaw_box.size.x, jaw_box.size.y) * jaw_box.spacing_mm;
  if (width_mm > kWidestJaw_mm) return JawRefusal{"J4", "the lower jaw could not be told from the skull"};
  if (teeth.empty()) return toothlessJaw();
  std::size_t tooth_sized = 0;
  int up = 0;
  for (const FoundTooth& tooth : teeth) {
    if (!hasToothSize(tooth)) continue;
    ++tooth_sized;
    if (tooth.crown_P_mm.z != 0.0) up += tooth.crown_P_mm.z > 0.0 ? 1 : -1;
  }
  const std::string count = std::to_string(teeth.size());
  if (static_cast<double>(tooth_sized) < kToothShare * static_cast<double>(teeth.size()))
    return JawRefusal{"J3", "the dense pieces have no tooth's size (" + std::to_string(tooth_sized) + " of " + count +
                                " have): metal or contrast"};
  if (up <= kCrownsDown) return upperArch();
  return std::nullopt;
}

std::optional<JawRefusal> judgeSigns(const JawSigns& signs, double hard_within_arch) {
  if (signs.in_row < kSignShare || hard_within_arch > kMostWithinArch)
    return JawRefusal{"J5", "the dense pieces stand in no row around a tongue: this is no lower jaw"};
  const bool is_capped = signs.capped >= kSignShare || signs.capped * signs.tooth_sized >= kManyCaps;
  if (!is_capped || signs.over_bone < kSignShare)
    return JawRefusal{
        "J5", "hardly a dense piece has a crown of enamel over a root in bone: this is no lower jaw with teeth"};
  return std::nullopt;
}

std::optional<JawRefusal> judgeCount(const std::vector<FoundTooth>& teeth) {
  if (teeth.size() <= kMostTeeth) return std::nullopt;
  return JawRefusal{"J3", "too many pieces for the teeth of one jaw (" + std::to_string(teeth.size()) +
                              "): metal, contrast or a coarse scan"};
}

}  // namespace assets
