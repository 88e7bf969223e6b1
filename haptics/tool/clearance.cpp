#include "haptics/tool/clearance.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "calibration/geometry/units.h"

namespace haptics {
namespace {

using assets::StructureDistance;
using ToolPose = calibration::Pose<calibration::Patient, calibration::Tool>;

/// A place on the outline of a solid of revolution: height and distance from the axis.
using OutlinePoint = glm::dvec2;

/// A part of the outline that is turned about the axis: a straight line, or an arc about a place on the axis.
struct Outline {
  OutlinePoint from{0.0}, to{0.0};
  bool is_arc = false;
  double arc_height_mm = 0.0;

  OutlinePoint at(double u) const {
    const OutlinePoint straight = glm::mix(from, to, u);
    if (!is_arc) return straight;
    const OutlinePoint middle(arc_height_mm, 0.0);
    return middle + glm::length(from - middle) * glm::normalize(straight - middle);
  }
};

/// Angles are counted in steps, so that halves have their cosine and sine in a table.
constexpr std::size_t kSteps = 4096;
struct Direction {
  double cosine = 1.0, sine = 0.0;
};
const std::array<Direction, kSteps> kDirections = [] {
  std::array<Direction, kSteps> table;
  for (std::size_t n = 0; n < kSteps; ++n) {
    const double angle = 2.0 * calibration::kPi * static_cast<double>(n) / static_cast<double>(kSteps);
    table[n] = {std::cos(angle), std::sin(angle)};
  }
  return table;
}();
const Direction& directionOf(std::size_t step) { return kDirections[step % kSteps]; }

struct Patch {
  const Outline* outline = nullptr;
  double u_from = 0.0, u_to = 1.0;
  std::size_t first = 0, steps = kSteps;  ///< of the angle
  double middle_mm = 0.0, radius_mm = 0.0;

  double bound_mm() const { return middle_mm - radius_mm; }
};

/// The least distance over the surfaces that are added.
class LeastOver {
 public:
  /// `found_mm`: what is known to be as near.
  LeastOver(const StructureDistance& structure, const ToolPose& X_PT, double found_mm)
      : structure_(structure),
        turn_PT_(X_PT.rotation),
        origin_P_mm_(X_PT.translation_mm),
        voxel_mm_(structure.grid.spacing_mm),
        least_mm_(found_mm) {
    open_.reserve(128);
  }

  void add(const Outline& outline) {
    const double u_to = outline.from == outline.to ? 0.0 : 1.0;
    if (outline.from == outline.to && outline.from.y == 0.0) return push({&outline, 0.0, 0.0, 0, kSteps / kParts});
    // About its middle on the axis, which need not lie on it.
    const OutlinePoint middle(outline.is_arc ? outline.arc_height_mm : 0.5 * (outline.from.x + outline.to.x), 0.0);
    Patch whole{&outline, 0.0, u_to};
    whole.radius_mm = std::max(glm::distance(outline.from, middle), glm::distance(outline.to, middle));
    whole.middle_mm = at_mm({0.0, 0.0, middle.x});
    keep(whole);
  }

  double least_mm() {
    while (!open_.empty()) {
      std::ranges::pop_heap(open_, std::greater{}, &Patch::bound_mm);
      const Patch patch = open_.back();
      open_.pop_back();
      if (patch.bound_mm() >= least_mm_ - kTolerance_voxels * voxel_mm_) break;
      divide(patch);
    }
    return least_mm_;
  }

 private:
  static constexpr std::size_t kParts = 4;
  static constexpr double kTolerance_voxels = 0.15, kError_voxels = 0.15, kLeastRadius_voxels = 0.5;

  double at_mm(const glm::dvec3& p_T_mm) const { return structure_.near_mm(turn_PT_ * p_T_mm + origin_P_mm_); }

  /// Where the least lies within a patch, its middle is off by r^2 / 2 of the curvatures of the distance, 1 / E counted
  /// to the centres of voxels, and of the surface.
  bool isEnough(const Patch& patch) const {
    if (patch.radius_mm <= kLeastRadius_voxels * voxel_mm_) return true;
    const double centre_mm = least_mm_ + StructureDistance::kSurface_voxels * voxel_mm_;
    if (patch.steps > kSteps / kParts || centre_mm <= 0.0) return false;
    const Outline& outline = *patch.outline;
    const bool is_flat = outline.from.x == outline.to.x && outline.from != outline.to;
    const double across_mm = outline.at(0.5 * (patch.u_from + patch.u_to)).y;
    const double bend_per_mm = 1.0 / centre_mm + (is_flat ? 0.0 : 1.0 / std::max(across_mm, 1e-3));
    return patch.radius_mm * patch.radius_mm * bend_per_mm <= 2.0 * kError_voxels * voxel_mm_;
  }

  void keep(const Patch& patch) {
    if (patch.bound_mm() >= least_mm_ - kTolerance_voxels * voxel_mm_) return;
    open_.push_back(patch);
    std::ranges::push_heap(open_, std::greater{}, &Patch::bound_mm);
  }

  void push(Patch patch) {
    const OutlinePoint middle = patch.outline->at(0.5 * (patch.u_from + patch.u_to));
    const Direction way = directionOf(patch.first + patch.steps / 2);
    const double cosine = directionOf(patch.steps / 2).cosine;
    double square_mm2 = 0.0;
    for (const double u : {patch.u_from, patch.u_to}) {
      const OutlinePoint p = patch.outline->at(u);
      const double high_mm = p.x - middle.x;
      square_mm2 =
          std::max(square_mm2, high_mm * high_mm + p.y * p.y + middle.y * middle.y - 2.0 * p.y * middle.y * cosine);
    }
    patch.radius_mm = std::sqrt(std::max(square_mm2, 0.0));
    patch.middle_mm = at_mm({middle.y * way.cosine, middle.y * way.sine, middle.x});
    least_mm_ = std::min(least_mm_, patch.middle_mm);
    if (!isEnough(patch)) keep(patch);
  }

  void divide(const Patch& patch) {
    const bool is_whole = patch.steps == kSteps;
    const OutlinePoint from = patch.outline->at(patch.u_from), to = patch.outline->at(patch.u_to);
    const double along_mm = glm::distance(from, to), turn = 2.0 * calibration::kPi / static_cast<double>(kSteps);
    const double around_mm = std::max(from.y, to.y) * turn * static_cast<double>(patch.steps);
    if (is_whole && !patch.outline->is_arc && along_mm >= around_mm) return halveWhole(patch);
    // Nearly square patches.
    const std::size_t turns = is_whole ? kParts : patch.steps >= 4 && 2.0 * around_mm > along_mm ? 2 : 1;
    const std::size_t lengths = !is_whole && 2.0 * along_mm > around_mm && along_mm > 0.0 ? 2 : 1;
    if (turns * lengths == 1) return;  // as fine as the table
    const double step = (patch.u_to - patch.u_from) / static_cast<double>(lengths);
    for (std::size_t n = 0; n < turns * lengths; ++n) {
      const double u = patch.u_from + step * static_cast<double>(n / turns);
      push({patch.outline, u, u + step, patch.first + (n % turns) * patch.steps / turns, patch.steps / turns});
    }
  }

  /// Along the outline, about the axis.
  void halveWhole(const Patch& patch) {
    const double middle = 0.5 * (patch.u_from + patch.u_to);
    for (Patch half : {Patch{patch.outline, patch.u_from, middle}, Patch{patch.outline, middle, patch.u_to}}) {
      const OutlinePoint from = half.outline->at(half.u_from), to = half.outline->at(half.u_to);
      half.radius_mm = std::hypot(0.5 * (to.x - from.x), std::max(from.y, to.y));
      half.middle_mm = at_mm({0.0, 0.0, 0.5 * (from.x + to.x)});
      keep(half);
    }
  }

  const StructureDistance& structure_;
  glm::dmat3 turn_PT_;
  glm::dvec3 origin_P_mm_;
  double voxel_mm_;
  double least_mm_;
  std::vector<Patch> open_;  ///< a heap, the least bound on top
};

/// Outlines of a head or a shaft; edges and tips beside the faces that meet there.
struct Outlines {
  std::array<Outline, assets::kMostKnots + 5> part{};
  std::size_t count = 0;

  void add(const Outline& one) { part[count++] = one; }
  void addLine(const OutlinePoint& from, const OutlinePoint& to) { add({from, to}); }
  void addEdge(const OutlinePoint& at) { add({at, at}); }
};

void addHead(const BurShape& head, Outlines& outlines) {
  const double r = head.radius_mm, half = 0.5 * head.length_mm;
  switch (head.kind) {
    case ShapeKind::sphere:
      return;
    case ShapeKind::capsule:
      outlines.add({{-half - r, 0.0}, {-half, r}, true, -half});
      outlines.addLine({-half, r}, {half, r});
      outlines.add({{half, r}, {half + r, 0.0}, true, half});
      return;
    case ShapeKind::cylinder:
      outlines.addLine({-half, 0.0}, {-half, r});
      outlines.addLine({-half, r}, {half, r});
      outlines.addLine({half, r}, {half, 0.0});
      outlines.addEdge({-half, r}), outlines.addEdge({half, r});
      return;
    case ShapeKind::cone:
      outlines.addLine({-half, 0.0}, {half, r});
      outlines.addLine({half, r}, {half, 0.0});
      outlines.addEdge({-half, 0.0}), outlines.addEdge({half, r});
      return;
    case ShapeKind::revolved: {
      const assets::BurOutline outline = revolvedOutline(head);
      const std::size_t last = outline.count - 1;
      const auto knot = [&](std::size_t n) { return OutlinePoint(outline.z_mm[n], outline.radius_mm[n]); };
      for (std::size_t n = 0; n < last; ++n)
        if (knot(n) != knot(n + 1)) outlines.addLine(knot(n), knot(n + 1));
      for (const std::size_t n : {std::size_t{0}, last}) {
        if (knot(n).y > 0.0) outlines.addLine({knot(n).x, 0.0}, knot(n));
        outlines.addEdge(knot(n));
      }
      return;
    }
  }
}

/// Where the rod comes out of the head; 0 where it is as wide.
double shaftFront_mm(const Tool& tool) {
  const double r = tool.shaft.radius_mm, head_r = tool.head.radius_mm;
  if (r >= head_r) return 0.0;
  const bool is_round = tool.head.kind == ShapeKind::sphere || tool.head.kind == ShapeKind::capsule ||
                        (tool.head.kind == ShapeKind::revolved && tool.head.profile == assets::BurProfile::egg);
  return halfHeight_mm(tool.head) - (is_round ? head_r - std::sqrt(head_r * head_r - r * r) : 0.0);
}

/// The rod as far as it stands out of the head; its front face where it is wider.
void addShaft(const Tool& tool, Outlines& outlines) {
  const double r = tool.shaft.radius_mm, end = tool.shaft.length_mm, front = shaftFront_mm(tool);
  if (r <= 0.0 || end <= front) return;
  if (r >= tool.head.radius_mm) outlines.addLine({front, 0.0}, {front, r}), outlines.addEdge({front, r});
  outlines.addLine({front, r}, {end, r});
  outlines.addLine({end, r}, {end, 0.0});
  outlines.addEdge({end, r});
}

/// The least of the field over a tool's surface: of a sphere its centre's, less the radius. `found_mm`: if none is
/// less.
double inField_mm(const StructureDistance& structure, const Tool& tool, const ToolPose& X_PT, double found_mm) {
  const bool is_sphere = tool.head.kind == ShapeKind::sphere;
  if (is_sphere) found_mm = std::min(found_mm, structure.at_mm(X_PT.translation_mm) - tool.head.radius_mm);
  LeastOver least(structure, X_PT, found_mm);
  Outlines head, shaft;
  addHead(tool.head, head);
  addShaft(tool, shaft);
  for (const Outlines* outlines : {&head, &shaft})
    for (std::size_t n = 0; n < outlines->count; ++n) least.add(outlines->part[n]);
  return least.least_mm();
}

/// From a point of frame T to the tool; 0 inside.
class ToTool {
 public:
  explicit ToTool(const Tool& tool)
      : outline_(tool.head.kind == ShapeKind::revolved ? revolvedOutline(tool.head) : assets::BurOutline{}),
        kind_(tool.head.kind),
        r_(static_cast<float>(tool.head.radius_mm)),
        half_(static_cast<float>(0.5 * tool.head.length_mm)),
        front_(static_cast<float>(shaftFront_mm(tool))),
        end_(static_cast<float>(tool.shaft.length_mm)),
        shaft_r_(static_cast<float>(tool.shaft.radius_mm)) {}

  float operator()(const glm::vec3& p_T_mm) const {
    const float across = std::sqrt(p_T_mm.x * p_T_mm.x + p_T_mm.y * p_T_mm.y), z = p_T_mm.z;
    float mm = toHead(across, z);
    if (shaft_r_ > 0.0F && end_ > front_)
      mm = std::min(mm, length(std::max(0.0F, across - shaft_r_), std::max(0.0F, std::max(front_ - z, z - end_))));
    return mm;
  }

 private:
  static float length(float a, float b) { return std::sqrt(a * a + b * b); }

  float toHead(float across, float z) const {
    switch (kind_) {
      case ShapeKind::sphere:
      case ShapeKind::capsule:
        return std::max(0.0F, length(across, z - std::clamp(z, -half_, half_)) - r_);
      case ShapeKind::cylinder:
        return length(std::max(0.0F, across - r_), std::max(0.0F, std::abs(z) - half_));
      case ShapeKind::cone:
        return toCone(across, z);
      case ShapeKind::revolved:
        return std::max(0.0F, static_cast<float>(assets::outlineDistance_mm(outline_, across, z)));
    }
    return 0.0F;
  }

  /// Beyond the base, or to the side: the nearest place of the line from the tip to the rim.
  float toCone(float across, float z) const {
    if (z >= half_) return length(std::max(0.0F, across - r_), z - half_);
    const float high = 2.0F * half_, from_tip = z + half_;
    const float t = std::clamp((across * r_ + from_tip * high) / (r_ * r_ + high * high), 0.0F, 1.0F);
    if (across * high <= from_tip * r_) return 0.0F;
    return length(across - t * r_, from_tip - t * high);
  }

  assets::BurOutline outline_;
  ShapeKind kind_;
  float r_, half_, front_, end_, shaft_r_;
};

}  // namespace

double clearance_mm(const StructureDistance& structure, const Tool& tool, const ToolPose& X_PT) {
  assert(!structure.isEmpty());
  const double voxel_mm = structure.grid.spacing_mm;
  const glm::mat3 turn_TP(glm::transpose(glm::dmat3(X_PT.rotation)));
  const glm::vec3 origin_P_mm(X_PT.translation_mm);
  const ToTool to_tool(tool);
  const double outside_mm = structure.leastOverSurface([&](const glm::vec3& q_P_mm) {
    return to_tool(turn_TP * (q_P_mm - origin_P_mm));
  }) - StructureDistance::kSurface_voxels * voxel_mm;
  const bool is_within = structure.near_mm(X_PT.translation_mm) < 0.0;
  if (outside_mm >= voxel_mm && !is_within) return outside_mm;
  const double field_mm = inField_mm(structure, tool, X_PT, outside_mm);
  return is_within ? field_mm : glm::mix(field_mm, outside_mm, std::clamp(outside_mm / voxel_mm, 0.0, 1.0));
}

Clearances clearances_mm(const assets::RiskStructures& structures, const Tool& tool, const ToolPose& X_PT) {
  Clearances found;
  for (std::size_t n = 0; n < found.size(); ++n)
    if (!structures.distance[n].isEmpty()) found[n] = clearance_mm(structures.distance[n], tool, X_PT);
  return found;
}

}  // namespace haptics
