#include "assets/instrument/dental_mirror.h"

#include <cmath>

#include "assets/mesh/closed_sweep.h"
#include "calibration/geometry/units.h"

namespace assets {
namespace {

using calibration::kPi;
using glm::dvec3;

constexpr double kGlassRadius_mm = kMirrorGlassRadius_mm, kGlassThickness_mm = 0.8;
constexpr double kRimHeight_mm = 0.25;  ///< of the casing over the glass
constexpr double kCasingDepth_mm = 2.2, kEdge_mm = 0.4;
constexpr double kStemThinnest_mm = 0.95, kStemThickest_mm = 1.15;
constexpr double kBend_mm = 8.0;          ///< radius of the stem's middle line
constexpr double kStemStraight_mm = 5.0;  ///< from the casing to the bend
constexpr double kHandleFrom_mm = 48.0, kHandleTo_mm = 155.0, kHandleRadius_mm = 3.5;
constexpr std::size_t kAroundHead = 96, kAroundStem = 24, kAroundHandle = 40;

const Material kSteel{{0.60f, 0.61f, 0.63f, 1.0f}, 0.30f, 1.0f};
const Material kSilvered{{0.93f, 0.94f, 0.95f, 1.0f}, 0.05f, 1.0f};

dvec3 glassNormal() { return mirrorGlassNormal(); }
/// From the centre of the glass.
dvec3 towardsStem() { return dvec3(0.0, std::sqrt(0.5), std::sqrt(0.5)); }

struct OutlinePoint {
  double along_mm, radius_mm;
};

/// Quarter of an ellipse from the last point of the outline to the next, in `steps` points.
void roundTo(std::vector<OutlinePoint>& outline, const OutlinePoint& to, bool along_first, int steps = 6) {
  const OutlinePoint from = outline.back();
  for (int n = 1; n <= steps; ++n) {
    const double turn = 0.5 * kPi * n / steps;
    const double early = std::sin(turn), late = 1.0 - std::cos(turn);
    outline.push_back({from.along_mm + (to.along_mm - from.along_mm) * (along_first ? early : late),
                       from.radius_mm + (to.radius_mm - from.radius_mm) * (along_first ? late : early)});
  }
}

MeshPart revolved(const std::vector<OutlinePoint>& outline, const dvec3& origin_mm, const dvec3& along,
                  std::size_t around) {
  std::vector<Ring> rings;
  for (const OutlinePoint& t : outline)
    rings.push_back(circle(origin_mm + t.along_mm * along, along, t.radius_mm, around));
  return closedSweep(rings);
}

MeshPart named(MeshPart part, const char* name, const Material& material) {
  part.name = name;
  part.material = material;
  return part;
}

MeshPart glass() {
  // Flat up to the edge, which the rim covers.
  std::vector<OutlinePoint> outline{{-kGlassThickness_mm, 0.5 * kGlassRadius_mm},
                                    {-kGlassThickness_mm, kGlassRadius_mm - kEdge_mm}};
  roundTo(outline, {-kGlassThickness_mm + kEdge_mm, kGlassRadius_mm}, false);
  outline.push_back({-0.05, kGlassRadius_mm});
  outline.push_back({0.0, kGlassRadius_mm - 0.05});
  outline.push_back({0.0, 0.97 * kGlassRadius_mm});
  outline.push_back({0.0, 0.5 * kGlassRadius_mm});
  return revolved(outline, dvec3(0.0), glassNormal(), kAroundHead);
}

MeshPart casing() {
  const double R = kMirrorCasingRadius_mm, back = kRimHeight_mm - kCasingDepth_mm;
  std::vector<OutlinePoint> outline{{back, 0.5 * R}, {back, R - 1.2}};
  roundTo(outline, {back + 1.2, R}, false, 10);
  outline.push_back({kRimHeight_mm - kEdge_mm, R});
  roundTo(outline, {kRimHeight_mm, R - kEdge_mm}, true);
  // Over the rim, down below the glass.
  outline.push_back({kRimHeight_mm, kGlassRadius_mm - 0.1 + kEdge_mm});
  roundTo(outline, {kRimHeight_mm - kEdge_mm, kGlassRadius_mm - 0.1}, false);
  roundTo(outline, {-0.5 * kGlassThickness_mm, kGlassRadius_mm - 0.5}, true);
  outline.push_back({-0.5 * kGlassThickness_mm, 0.5 * R});
  return revolved(outline, dvec3(0.0), glassNormal(), kAroundHead);
}

/// From the casing's edge through the bend, then along z into the handle.
MeshPart stem() {
  std::vector<Ring> rings;
  const dvec3 level = (kRimHeight_mm - 0.5 * kCasingDepth_mm) * glassNormal();
  const double leaves_mm = kMirrorCasingRadius_mm + kStemStraight_mm;
  const auto add = [&](const dvec3& centre_mm, const dvec3& along, double radius_mm) {
    rings.push_back(circle(centre_mm, along, radius_mm, kAroundStem));
  };
  add(level + (kMirrorCasingRadius_mm - 0.7) * towardsStem(), towardsStem(), kStemThinnest_mm);

  const dvec3 begins = level + leaves_mm * towardsStem(), inwards = glassNormal();
  const dvec3 pivot = begins + kBend_mm * inwards;
  dvec3 ends = begins;
  for (int n = 0; n <= 16; ++n) {
    const double turn = 0.25 * kPi * n / 16;
    ends = pivot + kBend_mm * (std::sin(turn) * towardsStem() - std::cos(turn) * inwards);
    add(ends, glm::normalize(std::cos(turn) * towardsStem() + std::sin(turn) * inwards), kStemThinnest_mm);
  }
  // Thicker towards its thread.
  for (const double share : {0.25, 0.5, 0.75, 1.0})
    add({0.0, ends.y, ends.z + share * (kHandleFrom_mm + 4.0 - ends.z)}, {0.0, 0.0, 1.0},
        glm::mix(kStemThinnest_mm, kStemThickest_mm, share));
  return closedSweep(rings);
}

/// y of the handle's axis.
double handle_y_mm() {
  const double level_mm = kRimHeight_mm - 0.5 * kCasingDepth_mm;
  const dvec3 ends = level_mm * glassNormal() + (kMirrorCasingRadius_mm + kStemStraight_mm) * towardsStem() +
                     kBend_mm * glassNormal() +
                     kBend_mm * (std::sqrt(0.5) * towardsStem() - std::sqrt(0.5) * glassNormal());
  return ends.y;
}

MeshPart handle() {
  const double R = kHandleRadius_mm;
  std::vector<OutlinePoint> outline{{kHandleFrom_mm, 0.5 * kStemThickest_mm}, {kHandleFrom_mm, 1.5}};
  roundTo(outline, {kHandleFrom_mm + 0.5, 2.0}, false);
  outline.push_back({kHandleFrom_mm + 5.0, 2.4});
  outline.push_back({kHandleFrom_mm + 9.0, R - 0.2});
  // Rings for the fingers, then smooth.
  for (double z = kHandleFrom_mm + 10.0; z < kHandleFrom_mm + 46.0; z += 0.25)
    outline.push_back({z, R - 0.25 * std::pow(std::sin(kPi * (z - kHandleFrom_mm - 10.0) / 2.0), 4.0)});
  outline.push_back({kHandleFrom_mm + 47.0, R});
  for (double z = kHandleFrom_mm + 55.0; z < kHandleTo_mm - 2.0; z += 8.0) outline.push_back({z, R});
  outline.push_back({kHandleTo_mm - 1.5, R});
  roundTo(outline, {kHandleTo_mm, R - 1.5}, true);
  return revolved(outline, {0.0, handle_y_mm(), 0.0}, {0.0, 0.0, 1.0}, kAroundHandle);
}

}  // namespace

glm::dvec3 mirrorGlassNormal() { return {0.0, -std::sqrt(0.5), std::sqrt(0.5)}; }

MeshModel dentalMirror() {
  return {{named(glass(), "Glass", kSilvered), named(casing(), "Casing", kSteel), named(stem(), "Stem", kSteel),
           named(handle(), "Handle", kSteel)}};
}

}  // namespace assets
