#include "assets/instrument/elevator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "assets/mesh/catmull_rom.h"
#include "assets/mesh/closed_sweep.h"
#include "calibration/geometry/units.h"

namespace assets {
namespace {

using calibration::kPi;
using glm::dvec3;

constexpr std::size_t kAround = 32;
constexpr double kShankRadius_mm = 1.6, kShank_mm = 35.0;
constexpr double kEdge_mm = 0.15, kCryerEdge_mm = 0.3;
constexpr double kHollow_mm = 0.12;  ///< of a straight blade's concave face

const Material kSteel{{0.60f, 0.61f, 0.63f, 1.0f}, 0.34f, 1.0f};

/// A rectangle with rounded edges, square to a sweep: `across` and `over` are unit, right-handed with it. The face on
/// the side of `over` is hollow.
Ring blunt(const dvec3& centre_mm, const dvec3& across, const dvec3& over, const glm::dvec2& half_mm, double edge_mm,
           double hollow_mm) {
  const double edge = std::min({edge_mm, half_mm.x, half_mm.y});
  Ring ring;
  for (std::size_t n = 0; n < kAround; ++n) {
    const double turn = 2.0 * kPi * (static_cast<double>(n) + 0.5) / static_cast<double>(kAround);
    // Faces and edges share the points.
    const glm::dvec2 out(std::cos(turn), std::sin(turn));
    glm::dvec2 at(std::clamp(1.6 * out.x, -1.0, 1.0) * (half_mm.x - edge), std::copysign(half_mm.y - edge, out.y));
    at += edge * out;
    const double share = at.x / half_mm.x;
    if (at.y > 0.0) at.y -= hollow_mm * std::max(0.0, 1.0 - share * share);
    ring.push_back(centre_mm + at.x * across + at.y * over);
  }
  return ring;
}

MeshPart part(std::span<const Ring> rings, const char* name) {
  MeshPart swept = closedSweep(rings);
  swept.name = name;
  swept.material = kSteel;
  return swept;
}

/// Its tip is as thick as 0.5 mm.
MeshPart straightBlade(double width_mm, double thickness_mm, double length_mm) {
  const dvec3 x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0);
  std::vector<Ring> rings;
  // The rounded edge of the tip.
  for (const double share : {0.1, 0.45, 0.8, 1.0}) {
    const double in = kEdge_mm * (1.0 - std::sin(0.5 * kPi * share));
    rings.push_back(blunt({0.0, 0.0, kEdge_mm * (1.0 - std::cos(0.5 * kPi * share))}, x, y,
                          {0.5 * width_mm - in, 0.25 - in}, kEdge_mm, 0.0));
  }
  constexpr int kSteps = 8;
  for (int n = 1; n <= kSteps; ++n) {
    const double share = n / static_cast<double>(kSteps);
    rings.push_back(blunt({0.0, 0.0, kEdge_mm + share * (length_mm - kEdge_mm)}, x, y,
                          {0.5 * width_mm, glm::mix(0.25, 0.5 * thickness_mm, share)}, kEdge_mm,
                          n == kSteps ? 0.0 : kHollow_mm * std::min(1.0, 3.0 * share)));
  }
  // Into the shank.
  for (const double share : {0.3, 0.7, 1.0})
    rings.push_back(blunt({0.0, 0.0, length_mm + 2.0 * share}, x, y,
                          {glm::mix(0.5 * width_mm, 0.7 * kShankRadius_mm, share),
                           glm::mix(0.5 * thickness_mm, 0.7 * kShankRadius_mm, share)},
                          glm::mix(kEdge_mm, 0.7 * kShankRadius_mm, share), 0.0));
  return part(rings, "Blade");
}

/// `side`: -1 left, 1 right; at 100 degrees to the shaft.
MeshPart cryerBlade(double side, double length_mm, double base_mm, double thickness_mm) {
  const double angle_rad = calibration::radFromDegrees(100.0);
  const dvec3 to_tip(side * std::sin(angle_rad), 0.0, std::cos(angle_rad));
  const dvec3 base_mm_T = dvec3(0.0, 0.0, -length_mm * std::cos(angle_rad));
  // From the tip to the base.
  const dvec3 over(0.0, 1.0, 0.0), across = glm::cross(over, -to_tip);
  std::vector<Ring> rings;
  for (const double share : {0.1, 0.45, 0.8}) {
    const double round = kCryerEdge_mm * std::sin(0.5 * kPi * share);
    const dvec3 at = base_mm_T + (length_mm - kCryerEdge_mm * (1.0 - std::cos(0.5 * kPi * share))) * to_tip;
    rings.push_back(blunt(at, across, over, {round, 0.5 * thickness_mm - kCryerEdge_mm + round}, kCryerEdge_mm, 0.0));
  }
  constexpr int kSteps = 8;
  for (int n = 0; n <= kSteps; ++n) {
    const double share = n / static_cast<double>(kSteps);
    rings.push_back(blunt(base_mm_T + (1.0 - share) * (length_mm - kCryerEdge_mm) * to_tip, across, over,
                          {glm::mix(kCryerEdge_mm, 0.5 * base_mm, share), 0.5 * thickness_mm}, kCryerEdge_mm, 0.0));
  }
  return part(rings, "Blade");
}

/// Round, about z: heights and radii.
MeshPart turnedPart(std::span<const glm::dvec2> outline_mm, const char* name) {
  std::vector<Ring> rings;
  for (const glm::dvec2& at : outline_mm) rings.push_back(circle({0.0, 0.0, at.x}, {0.0, 0.0, 1.0}, at.y, kAround));
  return part(rings, name);
}

MeshPart shank(double from_mm) {
  const double r = kShankRadius_mm, to_mm = from_mm + kShank_mm;
  const std::array<glm::dvec2, 6> outline{{{from_mm, 0.45 * r},
                                           {from_mm + 0.4 * r, 0.8 * r},
                                           {from_mm + r, r},
                                           {to_mm - 6.0, r},
                                           {to_mm - 2.0, 1.15 * r},
                                           {to_mm + 1.0, 1.4 * r}}};
  return turnedPart(outline, "Shank");
}

/// A pear with rings for the palm.
MeshPart handle(double from_mm) {
  struct Knot {
    double at_mm, radius_mm;
  };
  constexpr Knot kCourse[] = {{0.0, 2.4},  {3.0, 4.6},  {9.0, 5.4},  {22.0, 5.6}, {38.0, 6.2},
                              {54.0, 7.2}, {66.0, 7.5}, {74.0, 6.9}, {78.5, 5.0}, {80.0, 2.0}};
  std::vector<glm::dvec2> outline;
  for (std::size_t span = 0; span + 1 < std::size(kCourse); ++span)
    for (int n = span == 0 ? 0 : 1; n <= 4; ++n) {
      const double t = n / 4.0, at_mm = catmullRomAt(kCourse, span, t, &Knot::at_mm);
      const bool grooved = at_mm > 10.0 && at_mm < 50.0 && outline.size() % 2 == 0;
      outline.emplace_back(from_mm + at_mm, catmullRomAt(kCourse, span, t, &Knot::radius_mm) - (grooved ? 0.25 : 0.0));
    }
  return turnedPart(outline, "Handle");
}

}  // namespace

MeshModel elevator(ElevatorForm form) {
  const bool wide = form == ElevatorForm::straight_34s;
  if (wide || form == ElevatorForm::straight_301) {
    const double length_mm = wide ? 9.0 : 8.0;
    return {{straightBlade(wide ? 4.0 : 3.0, wide ? 1.3 : 1.0, length_mm), shank(length_mm),
             handle(length_mm + kShank_mm)}};
  }
  constexpr double kLength_mm = 9.0;
  const double base_mm = -kLength_mm * std::cos(calibration::radFromDegrees(100.0));
  return {{cryerBlade(form == ElevatorForm::cryer_left ? -1.0 : 1.0, kLength_mm, 4.5, 1.2), shank(base_mm),
           handle(base_mm + kShank_mm)}};
}

}  // namespace assets
