#include "app/report/law_curves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assets/tissue.h"
#include "haptics/bone/carved_bone.h"
#include "haptics/contact/law.h"

namespace app {
namespace {

constexpr int kSteps = 96;
constexpr double kVoxelsPerRadius = 16.0, kFinest_mm = 0.03, kCoarsest_mm = 0.2;
/// Height of the face within its voxel layer: f (1 - f) = 1/6, the mean softness over all orientations.
constexpr double kFaceInLayer = 0.2113248654;

/// Solid below z = 0, deep enough for the head.
haptics::CarvedBone flatBone(const BurIndentation& bur) {
  const double s = std::clamp(bur.head.radius_mm / kVoxelsPerRadius, kFinest_mm, kCoarsest_mm);
  const double half_mm = bur.head.radius_mm + 3.0 * s, depth_mm = bur.deepest_mm + 4.0 * s;
  const int across = static_cast<int>(std::ceil(2.0 * half_mm / s)), down = static_cast<int>(std::ceil(depth_mm / s));
  const assets::VolumeGrid grid{
      {across, across, down + 2}, s, {-half_mm + 0.5 * s, -half_mm + 0.5 * s, (0.5 - kFaceInLayer - down) * s}};
  std::vector<std::uint8_t> solid(grid.voxelCount()),
      label(grid.voxelCount(), static_cast<std::uint8_t>(assets::Tissue::cortical));
  for (int k = 0; k < grid.size.z; ++k) {
    const double under = std::clamp(0.5 - grid.centre_P_mm({0, 0, k}).z / s, 0.0, 1.0);
    const auto value = static_cast<std::uint8_t>(std::lround(255.0 * under));
    const auto layer = static_cast<std::ptrdiff_t>(grid.index({0, 0, k}));
    std::fill_n(solid.begin() + layer, across * across, value);
  }
  return {grid, solid, label};
}

}  // namespace

LawCurve lawCurve(const haptics::LawSettings& law, const BurIndentation& bur) {
  const haptics::CarvedBone bone = flatBone(bur);
  LawCurve curve;
  curve.law = law.kind;
  haptics::ToolMotion motion;
  motion.velocity_P_mm_per_s = {{0.0, 0.0, -bur.feed_mm_per_s}};
  motion.spindle_rad_per_s = bur.spindle_rpm * 2.0 * std::numbers::pi / 60.0;
  const double first_touch_mm = haptics::reach_mm(bur.head, -1.0);
  for (int n = 0; n <= kSteps; ++n) {
    const double depth_mm = bur.deepest_mm * n / kSteps;
    const haptics::ToolInBone at{
        bone.field(), bur.head, {{1, 0, 0, 0}, {0.0, 0.0, first_touch_mm - depth_mm}}, law.tissue, motion};
    const haptics::Contact contact = haptics::contactOf(law, at);
    curve.force_N.emplace_back(depth_mm, contact.force_P_N.xyz.z);
  }
  // Slope of the force over a window of four steps.
  constexpr std::size_t kWindow = 2;
  for (std::size_t n = kWindow; n + kWindow < curve.force_N.size(); ++n) {
    const glm::dvec2 rise = curve.force_N[n + kWindow] - curve.force_N[n - kWindow];
    curve.stiffness_N_per_mm.emplace_back(curve.force_N[n].x, rise.y / rise.x);
  }
  return curve;
}

}  // namespace app
