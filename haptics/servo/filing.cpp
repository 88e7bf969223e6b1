#include "haptics/servo/filing.h"

#include <algorithm>
#include <array>
#include <utility>

#include "assets/tissue.h"

namespace haptics {
namespace {

/// Of the tissues: bone, and what bears no label of a tooth.
constexpr auto kIsFiled = [] {
  std::array<bool, assets::kTissueCount> is_filed{};
  for (std::size_t tissue = 0; tissue < is_filed.size(); ++tissue)
    is_filed[tissue] = !assets::isTooth(static_cast<std::uint8_t>(tissue));
  return is_filed;
}();

}  // namespace

CarveResult Filing::file(Bodies& bodies, StrokeHistory& strokes, const Engagement& engaged, bool allowed, double dt_s,
                         std::uint64_t tick) noexcept {
  const calibration::Point<calibration::Patient> here_P{engaged.X_PT.translation_mm};
  const double overlap_mm3 = engaged.contact.volume_mm3, length = glm::length(engaged.contact.normal_P.xyz);
  const bool is_on_bone = allowed && overlap_mm3 > 0.0 && length > 0.0;
  const bool was_on_bone = std::exchange(was_on_bone_, is_on_bone);
  const calibration::Point<calibration::Patient> before_P = std::exchange(last_P_, here_P);
  if (!is_on_bone || !was_on_bone) return {};

  const glm::dvec3 n = engaged.contact.normal_P.xyz / length, moved_mm = here_P.mm - before_P.mm;
  const double speed_mm_per_s = glm::length(moved_mm - glm::dot(moved_mm, n) * n) / dt_s;
  const double pressing_N = std::max(0.0, glm::dot(engaged.force_P_N.xyz, n));
  const double rate_mm3_per_s = kFiling_mm3_per_s * std::min(1.0, pressing_N / kFilingForce_N) *
                                std::min(1.0, speed_mm_per_s / kFilingSpeed_mm_per_s);
  ErosionStep step;
  const double loss = std::min(1.0, rate_mm3_per_s * dt_s / overlap_mm3);
  for (std::size_t tissue = 0; tissue < step.loss.size(); ++tissue)
    if (kIsFiled[tissue]) step.loss[tissue] = loss;
  if (step.isZero()) return {};
  return carveTool(bodies, engaged.head, engaged.X_PT, step, tick, 1, &strokes);
}

}  // namespace haptics
