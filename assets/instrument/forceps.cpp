#include "assets/instrument/forceps.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assets/mesh/catmull_rom.h"
#include "assets/mesh/closed_sweep.h"
#include "calibration/geometry/units.h"

namespace assets {
namespace {

using calibration::kPi;
using glm::dvec3;

// Right half, nearly 6 mm open: middle line from the tip at +x through the joint to the end of the handle at -x.
struct Knot {
  dvec3 at_mm;
  double half_thickness_mm;  ///< in the plane of opening
  double half_width_mm;      ///< along the hinge
  double layer_mm;           ///< along the hinge, below the other half
  double hollow_mm;          ///< of the face inside the beak
  int steps;                 ///< to the next knot
  bool ridged = false;
};
constexpr double kLayer_mm = 2.15;  ///< from the middle of the joint to that of a plate
constexpr Knot kCourse[] = {
    // Beak: a blunt point, hollow inside, bowed around the crown.
    {{3.20, 0, -1.7}, 0.20, 0.35, 0, 0.00, 1},
    {{3.28, 0, -1.4}, 0.42, 0.80, 0, 0.10, 2},
    {{3.60, 0, 0.0}, 0.65, 1.80, 0, 0.35, 3},
    {{4.60, 0, 2.5}, 0.90, 1.95, 0, 0.65, 3},
    {{6.00, -0.1, 6.0}, 1.25, 2.40, 0, 1.00, 3},
    {{6.60, -0.6, 11.0}, 1.75, 2.90, 0, 1.10, 4},
    {{5.40, -1.6, 15.5}, 2.30, 2.90, 0, 0.30, 4},
    // Joint: each half half as thick, its plate round.
    {{3.10, -2.9, 19.5}, 3.60, 2.10, kLayer_mm, 0, 4},
    {{0.00, -4.9, 25.0}, 6.20, 2.10, kLayer_mm, 0, 4},
    {{-3.10, -6.9, 30.5}, 3.60, 2.10, kLayer_mm, 0, 4},
    // Handle.
    {{-6.20, -8.9, 36.0}, 2.50, 3.10, 0, 0, 3},
    {{-9.50, -12.9, 46.0}, 2.20, 3.50, 0, 0, 3},
    {{-13.0, -19.9, 62.0}, 2.15, 3.70, 0, 0, 13, true},
    {{-15.5, -27.6, 80.0}, 2.20, 3.90, 0, 0, 13, true},
    {{-16.2, -35.0, 100.0}, 2.20, 3.90, 0, 0, 13, true},
    {{-16.2, -41.0, 120.0}, 2.10, 3.80, 0, 0, 4},
    {{-17.4, -44.4, 135.0}, 2.00, 3.60, 0, 0, 1},
};
constexpr std::size_t kAround = 16;
constexpr double kRidge = 0.11;       ///< depth of a groove between ridges, of the half thickness
constexpr double kRoundEnd_mm = 2.0;  ///< of a handle
constexpr double kGrip_mm = 3.0;      ///< the tips are what lies before this z

// The hinge: square to the course at the joint.
const dvec3 kJoint_mm(0.0, -4.9, 25.0);
const dvec3 kHinge = glm::normalize(dvec3(0.0, 5.5, 2.0));
constexpr double kScrewHalf_mm = 4.2, kScrewHead_mm = 0.6, kScrewRadius_mm = 2.9;

const Material kSteel{{0.60f, 0.61f, 0.63f, 1.0f}, 0.34f, 1.0f};
const Material kShade{{0.04f, 0.04f, 0.04f, 1.0f}, 0.60f, 0.0f};

/// Rounded rectangle square to `along`: hollow or grooved on the side of the crown and of the palm, flat towards the
/// other half at the joint.
Ring section(const Knot& k, const dvec3& along, double groove) {
  const dvec3 across = glm::normalize(dvec3(0.0, along.z, -along.y)), out = glm::cross(across, along);
  const auto rounded = [](double x, double power) { return std::copysign(std::pow(std::abs(x), power), x); };
  Ring ring;
  for (std::size_t n = 0; n < kAround; ++n) {
    const double turn = 2.0 * kPi * static_cast<double>(n) / static_cast<double>(kAround);
    // A superellipse: the smaller the power, the squarer.
    const bool faces_other = std::sin(turn) * k.layer_mm > 0.0;
    const double power = glm::mix(0.67, faces_other ? 0.25 : 0.5, std::min(std::abs(k.layer_mm) / kLayer_mm, 1.0));
    const double wide = rounded(std::sin(turn), power);
    double thick_mm = k.half_thickness_mm * rounded(std::cos(turn), power);
    if (thick_mm < 0.0) thick_mm = (1.0 - groove) * thick_mm + k.hollow_mm * (1.0 - wide * wide);
    ring.push_back(k.at_mm + thick_mm * out + (k.half_width_mm * wide - k.layer_mm) * across);
  }
  return ring;
}

/// The right half, or, before it is mirrored, the left one, which lies above it at the joint.
std::vector<Ring> halfAsDesigned(bool above) {
  struct Station {
    Knot knot;
    double groove;
  };
  std::vector<Station> stations;
  for (std::size_t span = 0; span + 1 < std::size(kCourse); ++span)
    for (int n = span == 0 ? 0 : 1; n <= kCourse[span].steps; ++n) {
      const auto value = [&](auto field) {
        return catmullRomAt(kCourse, span, static_cast<double>(n) / kCourse[span].steps, field);
      };
      const bool grooved = kCourse[span].ridged && n < kCourse[span].steps && stations.size() % 2 == 0;
      stations.push_back(
          {{value(&Knot::at_mm), value(&Knot::half_thickness_mm), value(&Knot::half_width_mm),
            (above ? -1.0 : 1.0) * std::max(value(&Knot::layer_mm), 0.0), std::max(value(&Knot::hollow_mm), 0.0), 0},
           grooved ? kRidge : 0.0});
    }
  std::vector<Ring> rings;
  dvec3 along(0.0, 0.0, 1.0);
  for (std::size_t n = 0; n < stations.size(); ++n) {
    const std::size_t before = n == 0 ? 0 : n - 1, after = std::min(n + 1, stations.size() - 1);
    along = glm::normalize(stations[after].knot.at_mm - stations[before].knot.at_mm);
    rings.push_back(section(stations[n].knot, along, stations[n].groove));
  }
  // The end of the handle, round.
  for (const double share : {0.25, 0.5, 0.75, 0.95}) {
    Knot end = stations.back().knot;
    end.at_mm += kRoundEnd_mm * std::sin(0.5 * kPi * share) * along;
    end.half_thickness_mm *= std::cos(0.5 * kPi * share);
    end.half_width_mm *= std::cos(0.5 * kPi * share);
    rings.push_back(section(end, along, 0.0));
  }
  return rings;
}

/// About the hinge (Rodrigues).
dvec3 turned(const dvec3& p_mm, double turn_rad) {
  const dvec3 arm_mm = p_mm - kJoint_mm;
  return kJoint_mm + std::cos(turn_rad) * arm_mm + std::sin(turn_rad) * glm::cross(kHinge, arm_mm) +
         (1.0 - std::cos(turn_rad)) * glm::dot(kHinge, arm_mm) * kHinge;
}

/// How far the right half turns, so that its tip stays `half_opening_mm` from the middle plane: Newton's steps.
double turnFor(const std::vector<Ring>& half, double half_opening_mm) {
  double turn_rad = 0.0;
  for (int step = 0; step < 8; ++step) {
    double inside_mm = 1e9;
    for (const Ring& ring : half)
      for (const dvec3& p_mm : ring)
        if (p_mm.z < kGrip_mm) inside_mm = std::min(inside_mm, turned(p_mm, turn_rad).x);
    turn_rad -= (half_opening_mm - inside_mm) / kJoint_mm.z;
  }
  return turn_rad;
}

MeshPart halfAt(bool left, double opening_mm) {
  std::vector<Ring> rings = halfAsDesigned(left);
  const double turn_rad = turnFor(rings, 0.5 * opening_mm);
  for (Ring& ring : rings) {
    for (dvec3& p_mm : ring) {
      p_mm = turned(p_mm, turn_rad);
      if (left) p_mm.x = -p_mm.x;
    }
    if (left) std::ranges::reverse(ring);
  }
  MeshPart part = closedSweep(rings);
  part.name = left ? "Left half" : "Right half";
  part.material = kSteel;
  return part;
}

/// A low head on both sides.
MeshPart screw() {
  std::vector<Ring> rings;
  const auto add = [&](double along_mm, double radius_mm) {
    rings.push_back(circle(kJoint_mm + along_mm * kHinge, kHinge, radius_mm, kAround));
  };
  const double top_mm = kScrewHalf_mm + kScrewHead_mm, edge_mm = 0.3;
  for (const double side : {-1.0, 1.0}) {
    const auto from_top = [&](double depth_mm) { return side * (top_mm - depth_mm); };
    const std::pair<double, double> outline[] = {
        {0.0, kScrewRadius_mm - 2.0 * edge_mm}, {0.3 * edge_mm, kScrewRadius_mm - edge_mm}, {edge_mm, kScrewRadius_mm}};
    if (side < 0.0)
      for (const auto& [depth_mm, radius_mm] : outline) add(from_top(depth_mm), radius_mm);
    else
      for (std::size_t n = std::size(outline); n-- > 0;) add(from_top(outline[n].first), outline[n].second);
  }
  MeshPart part = closedSweep(rings);
  part.name = "Screw";
  part.material = kSteel;
  return part;
}

/// Dark, where the screw's head is slotted: it stands out by 0.02 mm instead of being cut.
MeshPart slot() {
  const dvec3 along(1.0, 0.0, 0.0), across = glm::cross(kHinge, along);
  std::vector<Ring> rings;
  for (const double x_mm : {-2.2, 2.2}) {
    const dvec3 middle_mm = kJoint_mm + (kScrewHalf_mm + kScrewHead_mm) * kHinge + x_mm * along;
    rings.push_back({middle_mm + 0.3 * across + 0.02 * kHinge, middle_mm - 0.3 * across + 0.02 * kHinge,
                     middle_mm - 0.3 * across - 0.2 * kHinge, middle_mm + 0.3 * across - 0.2 * kHinge});
  }
  MeshPart part = closedSweep(rings);
  part.name = "Slot";
  part.material = kShade;
  return part;
}

}  // namespace

MeshModel forceps(double opening_mm) {
  // Not a number: closed.
  const double open_mm = std::fmin(std::fmax(opening_mm, kLeastForcepsOpening_mm), kMostForcepsOpening_mm);
  return {{halfAt(false, open_mm), halfAt(true, open_mm), screw(), slot()}};
}

}  // namespace assets
