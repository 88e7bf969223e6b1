#include "app/procedure/preparation/jaw_closing.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "app/procedure/preparation/resting_plane.h"

namespace app {
namespace {

constexpr int kRasterSide = OcclusalRaster::kSide;
/// What touches: less than the raster's last digit.
constexpr double kMeets_mm = 5e-5;
constexpr double kMostOpen_rad = 0.2, kMostTipped = 0.18;  ///< of 10 degrees

OcclusalRaster gapBetween(const OcclusalRaster& over, const OcclusalRaster& heights) {
  OcclusalRaster gap_mm;
  for (int y = 0; y < kRasterSide; ++y)
    for (int x = 0; x < kRasterSide; ++x) gap_mm.at(x, y) = over.at(x, y) - heights.at(x, y);
  return gap_mm;
}

JawMotion turnedAbout(const glm::dmat3& turn, const glm::dvec3& place_mm) { return {turn, place_mm - turn * place_mm}; }
/// First one, then another.
JawMotion after(const JawMotion& first, const JawMotion& next) {
  return {next.turn * first.turn, next.turn * first.shift_mm + next.shift_mm};
}

ClosedJaws movedBy(const OcclusalRaster& heights, const Antagonist& antagonist, const JawMotion& motion) {
  ClosedJaws jaws;
  jaws.motion = motion;
  jaws.gap_mm = gapBetween(movedOver(heights, antagonist.height_mm, motion), heights);
  jaws.narrowest = narrowestGap(jaws.gap_mm);
  return jaws;
}

/// Lifted along the axis until the narrowest place touches.
void lift(ClosedJaws& jaws, double by_mm) {
  for (int y = 0; y < kRasterSide; ++y)
    for (int x = 0; x < kRasterSide; ++x) jaws.gap_mm.at(x, y) += static_cast<float>(by_mm);
  jaws.narrowest.gap_mm += by_mm;
  jaws.motion.shift_mm.z += by_mm;
}

ClosedJaws openedByHinge(const OcclusalRaster& heights, const Antagonist& antagonist, const ClosedJaws& closed) {
  const auto open = [&](double rad) {
    const glm::dmat3 turn = glm::mat3_cast(glm::angleAxis(rad, antagonist.opens));
    return movedBy(heights, antagonist, turnedAbout(turn, antagonist.hinge_mm));
  };
  // The false position between an angle that is too small and one that is too large, the older end's gap halved.
  const glm::dvec3 arm(glm::dvec3(closed.narrowest.place_mm, 0.0) - antagonist.hinge_mm);
  double low_rad = 0.0, low_mm = closed.narrowest.gap_mm;
  double high_rad = -low_mm / std::max(10.0, glm::cross(antagonist.opens, arm).z);
  ClosedJaws jaws = open(high_rad);
  while (jaws.narrowest.gap_mm < 0.0 && high_rad < kMostOpen_rad) {
    low_rad = high_rad, low_mm = jaws.narrowest.gap_mm;
    jaws = open(high_rad *= 1.5);
  }
  double high_mm = jaws.narrowest.gap_mm;
  for (int n = 0; n < 30 && std::abs(jaws.narrowest.gap_mm) > kMeets_mm && high_mm > low_mm; ++n) {
    const double rad = low_rad - low_mm * (high_rad - low_rad) / (high_mm - low_mm);
    jaws = open(rad);
    if (jaws.narrowest.gap_mm < 0.0)
      low_rad = rad, low_mm = jaws.narrowest.gap_mm, high_mm *= 0.5;
    else
      high_rad = rad, high_mm = jaws.narrowest.gap_mm, low_mm *= 0.5;
  }
  jaws.first_mm = jaws.narrowest.place_mm;
  const double was_mm = static_cast<double>(closed.gap_mm.at(jaws.narrowest.place_mm));
  jaws.open_mm = std::isnan(was_mm) ? -closed.narrowest.gap_mm : std::max(0.0, -was_mm);
  return jaws;
}

/// What has to give way, and by how much.
std::vector<Support> supportsOf(const OcclusalRaster& gap_mm) {
  std::vector<Support> supports;
  for (int y = 0; y < kRasterSide; ++y)
    for (int x = 0; x < kRasterSide; ++x)
      if (gap_mm.has(x, y)) supports.push_back({OcclusalRaster::place_mm(x, y), -static_cast<double>(gap_mm.at(x, y))});
  return supports;
}

/// Turn after turn, each as if the surfaces only rose and sank, until nothing moves.
std::optional<ClosedJaws> balancedFrom(const OcclusalRaster& heights, const Antagonist& antagonist, ClosedJaws jaws) {
  constexpr double kStill_mm = 2e-5, kArm_mm = 5.0;
  for (int n = 0; n < 30; ++n) {
    const auto plane = restingPlane(supportsOf(jaws.gap_mm), antagonist.middle_mm);
    if (!plane) return {};
    const glm::dvec2 slopes(plane->slopes_and_height);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-slopes, 1.0));
    const double rise_mm = plane->at_mm(antagonist.middle_mm);
    // About the surface over the middle: nowhere else does tipping shift it less.
    const auto level_mm = static_cast<double>(heights.at(antagonist.middle_mm));
    const glm::dvec3 pivot(antagonist.middle_mm, std::isnan(level_mm) ? 0.0 : level_mm);
    JawMotion tip = turnedAbout(glm::mat3_cast(glm::dquat(glm::dvec3(0.0, 0.0, 1.0), normal)), pivot);
    tip.shift_mm.z += rise_mm;
    const JawMotion motion = after(jaws.motion, tip);
    if (std::hypot(motion.turn[2].x, motion.turn[2].y) > kMostTipped) return {};
    const double open_mm = jaws.open_mm;
    const glm::dvec2 first_mm = jaws.first_mm;
    jaws = movedBy(heights, antagonist, motion);
    jaws.open_mm = open_mm, jaws.first_mm = first_mm, jaws.is_balanced = true;
    if (std::abs(rise_mm) + kArm_mm * glm::length(slopes) < kStill_mm) break;
  }
  // Between places of the raster it may stand a digit too deep.
  if (jaws.narrowest.gap_mm < 0.0) lift(jaws, -jaws.narrowest.gap_mm);
  return jaws;
}

}  // namespace

OcclusalRaster movedOver(const OcclusalRaster& heights, const OcclusalRaster& surface, const JawMotion& motion) {
  constexpr int kTries = 8;
  constexpr double kThere_mm = 2e-6;  ///< heights are floats
  const glm::dmat3 back = glm::transpose(motion.turn);
  OcclusalRaster moved;
  for (int y = 0; y < kRasterSide; ++y)
    for (int x = 0; x < kRasterSide; ++x) {
      if (!heights.has(x, y)) continue;
      // Which of its places lies over this one now: that of the height here, corrected by what it misses.
      const glm::dvec2 wanted = OcclusalRaster::place_mm(x, y);
      glm::dvec2 from(back * (glm::dvec3(wanted, heights.at(x, y)) - motion.shift_mm));
      for (int n = 0; n < kTries; ++n) {
        const auto height_mm = static_cast<double>(surface.at(from));
        if (std::isnan(height_mm)) break;
        const glm::dvec3 p = motion.at({from, height_mm});
        const glm::dvec2 off = wanted - glm::dvec2(p);
        moved.at(x, y) = static_cast<float>(p.z);
        if (std::abs(off.x) + std::abs(off.y) < kThere_mm) break;
        moved.at(x, y) = OcclusalRaster::kNone;
        from += off;
      }
    }
  return moved;
}

ClosedJaws closedOn(const OcclusalRaster& heights, const Antagonist& antagonist) {
  ClosedJaws closed;
  closed.gap_mm = gapBetween(antagonist.height_mm, heights);
  closed.narrowest = narrowestGap(closed.gap_mm);
  closed.first_mm = closed.narrowest.place_mm;
  if (!(closed.narrowest.gap_mm < kMeets_mm)) return closed;
  if (antagonist.closing == assets::Closing::hinge && closed.narrowest.gap_mm < -kMeets_mm)
    return openedByHinge(heights, antagonist, closed);
  closed.open_mm = std::max(0.0, -closed.narrowest.gap_mm);
  if (closed.open_mm > 0.0) lift(closed, closed.open_mm);
  if (antagonist.closing != assets::Closing::balance) return closed;
  return balancedFrom(heights, antagonist, closed).value_or(closed);
}

}  // namespace app
