#include "assets/import/tooth_axis.h"

#include <cmath>
#include <limits>
#include <vector>

#include "assets/import/tissue_from_grey.h"
#include "assets/tooth.h"

namespace assets {
namespace {

constexpr double kMinCap_mm2 = 6.0;  ///< vector area; below it there is no usable enamel

enum class Part { none, core, enamel };

/// Enamel and core (dentine, pulp) of one tooth.
class ToothParts {
 public:
  ToothParts(const CtVolume& ct, int fdi) : ct_(ct), fdi_(static_cast<std::uint8_t>(fdi)) {}

  Part at(glm::ivec3 ijk) const {
    if (!ct_.grid.contains(ijk)) return Part::none;
    const std::size_t v = ct_.grid.index(ijk);
    if (ct_.tooth[v] != fdi_) return Part::none;
    switch (Tissue{ct_.label[v]}) {
      case Tissue::enamel:
        return Part::enamel;
      case Tissue::other_teeth:
        return !ct_.hounsfield.empty() && tissueFromGrey(ct_.hounsfield[v]) == Tissue::enamel ? Part::enamel
                                                                                              : Part::core;
      default:
        return Part::core;
    }
  }

 private:
  const CtVolume& ct_;
  std::uint8_t fdi_;
};

struct Box {
  glm::ivec3 low{std::numeric_limits<int>::max()}, high{-1};
};

Box boxOf(const CtVolume& ct, int fdi) {
  Box box;
  forVoxels(ct.grid, [&](glm::ivec3 p, std::size_t v) {
    if (ct.tooth[v] != fdi) return;
    box.low = glm::min(box.low, p);
    box.high = glm::max(box.high, p);
  });
  return box;
}

/// Of the interface from dentine to enamel, in voxel faces.
glm::dvec3 vectorAreaOfCap(const ToothParts& tooth, const Box& box) {
  glm::dvec3 area(0.0);
  forVoxels(box.low, box.high + 1, [&](glm::ivec3 p) {
    const Part here = tooth.at(p);
    if (here == Part::none) return;
    for (int axis = 0; axis < 3; ++axis) {
      glm::ivec3 next = p;
      ++next[axis];
      const Part there = tooth.at(next);
      if (there == Part::none || there == here) continue;
      area[axis] += there == Part::enamel ? 1.0 : -1.0;
    }
  });
  return area;
}

/// Enamel voxels next to the root, away from the volume's border.
std::vector<glm::dvec3> cervicalLine(const VolumeGrid& grid, const ToothParts& tooth, const Box& box) {
  constexpr int kMargin = 2;
  std::vector<glm::dvec3> line;
  forVoxels(box.low, box.high + 1, [&](glm::ivec3 p) {
    if (tooth.at(p) != Part::enamel || glm::any(glm::lessThan(p, glm::ivec3(kMargin))) ||
        glm::any(glm::greaterThanEqual(p, grid.size - kMargin)))
      return;
    bool covers = false, is_outer = false;
    for (int axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        glm::ivec3 next = p;
        next[axis] += step;
        covers |= tooth.at(next) == Part::core;
        is_outer |= tooth.at(next) == Part::none;
      }
    if (covers && is_outer) line.emplace_back(p);
  });
  return line;
}

/// Normal of the plane through points, towards `side`: smallest principal axis, by power iteration on the inverse.
glm::dvec3 planeNormal(const std::vector<glm::dvec3>& points, const glm::dvec3& side) {
  glm::dvec3 mean(0.0);
  for (const glm::dvec3& p : points) mean += p / static_cast<double>(points.size());
  glm::dmat3 spread(1.0e-6);
  for (const glm::dvec3& p : points) spread += glm::outerProduct(p - mean, p - mean);
  const glm::dmat3 inverse = glm::inverse(spread);
  glm::dvec3 normal = glm::normalize(side);
  for (int step = 0; step < 200; ++step) normal = glm::normalize(inverse * normal);
  return glm::dot(normal, side) < 0.0 ? -normal : normal;
}

struct Shape {
  double count = 0.0, enamel_count = 0.0;
  glm::dvec3 sum{0.0}, enamel_sum{0.0};
  glm::dmat3 squares{0.0};
};

/// First principal axis by power iteration, from root to crown.
glm::dvec3 principalAxis(const ToothParts& tooth, const Box& box, int fdi) {
  Shape shape;
  const glm::dvec3 middle = 0.5 * glm::dvec3(box.low + box.high);
  forVoxels(box.low, box.high + 1, [&](glm::ivec3 p) {
    const Part here = tooth.at(p);
    if (here == Part::none) return;
    const glm::dvec3 q = glm::dvec3(p) - middle;
    shape.count += 1.0;
    shape.sum += q;
    shape.squares += glm::outerProduct(q, q);
    if (here != Part::enamel) return;
    shape.enamel_count += 1.0;
    shape.enamel_sum += q;
  });
  const glm::dvec3 mean = shape.sum / shape.count;
  const glm::dmat3 spread = shape.squares / shape.count - glm::outerProduct(mean, mean);
  const glm::dvec3 to_crown =
      shape.enamel_count > 0.0 ? shape.enamel_sum / shape.enamel_count - mean : occlusalDirection_P(fdi);
  glm::dvec3 axis = glm::normalize(glm::dvec3(0.1, 0.2, 1.0));
  for (int step = 0; step < 200 && glm::length(spread * axis) > 0.0; ++step) axis = glm::normalize(spread * axis);
  return glm::dot(axis, to_crown) < 0.0 ? -axis : axis;
}

}  // namespace

glm::dvec3 toothAxis_P(const CtVolume& ct, int fdi) {
  constexpr std::size_t kMinPoints = 20;
  const ToothParts tooth(ct, fdi);
  const Box box = boxOf(ct, fdi);
  const glm::dvec3 area = vectorAreaOfCap(tooth, box);
  const double face_mm2 = ct.grid.spacing_mm * ct.grid.spacing_mm;
  if (glm::length(area) * face_mm2 < kMinCap_mm2) return principalAxis(tooth, box, fdi);
  bool is_cut = false;
  forVoxels(box.low, box.high + 1, [&](glm::ivec3 p) {
    is_cut |= (glm::any(glm::equal(p, glm::ivec3(0))) || glm::any(glm::equal(p, ct.grid.size - 1))) &&
              tooth.at(p) == Part::enamel;
  });
  if (!is_cut) return glm::normalize(area);
  const std::vector<glm::dvec3> line = cervicalLine(ct.grid, tooth, box);
  return line.size() < kMinPoints ? glm::normalize(area) : planeNormal(line, area);
}

}  // namespace assets
