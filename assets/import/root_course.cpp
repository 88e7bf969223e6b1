#include "assets/import/root_course.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assets/import/tooth_axis.h"
#include "assets/tooth.h"

namespace assets {
namespace {

constexpr double kReach_mm = 9.0;  ///< of a slice, from the axis
constexpr double kShortRoot_mm = 2.5;
constexpr double kNeckShare = 0.1;  ///< of the enamel below the neck
constexpr std::size_t kFewCells = 4;

bool isOwn(const CtVolume& ct, int fdi, const glm::dvec3& p_P) {
  const glm::ivec3 ijk(glm::floor(ct.grid.indexFromPoint(p_P) + 0.5));
  return ct.grid.contains(ijk) && ct.tooth[ct.grid.index(ijk)] == fdi;
}

/// A connected part of a slice.
struct Part {
  std::vector<glm::ivec2> cells;
  RootSlice slice;
};

class Slicer {
 public:
  Slicer(const CtVolume& ct, int fdi, const ToothFrame& frame)
      : ct_(ct), fdi_(fdi), frame_(frame), step_mm_(ct.grid.spacing_mm), half_(int(kReach_mm / step_mm_)) {}

  double step_mm() const { return step_mm_; }

  std::vector<Part> partsAt(double z_mm) const {
    const int width = 2 * half_ + 1;
    std::vector<char> open(static_cast<std::size_t>(width * width));
    const auto at = [&](glm::ivec2 cell) {
      return static_cast<std::size_t>((cell.y + half_) * width + cell.x + half_);
    };
    for (int j = -half_; j <= half_; ++j)
      for (int i = -half_; i <= half_; ++i)
        open[at({i, j})] = isOwn(ct_, fdi_, frame_.inP({i * step_mm_, j * step_mm_, z_mm})) ? 1 : 0;
    std::vector<Part> parts;
    for (int j = -half_; j <= half_; ++j)
      for (int i = -half_; i <= half_; ++i) {
        if (open[at({i, j})] == 0) continue;
        Part part;
        std::vector<glm::ivec2> front{{i, j}};
        open[at({i, j})] = 0;
        while (!front.empty()) {
          const glm::ivec2 cell = front.back();
          front.pop_back();
          part.cells.push_back(cell);
          for (int b = -1; b <= 1; ++b)
            for (int a = -1; a <= 1; ++a) {
              const glm::ivec2 next = cell + glm::ivec2(a, b);
              if (std::max(std::abs(next.x), std::abs(next.y)) > half_ || open[at(next)] == 0) continue;
              open[at(next)] = 0;
              front.push_back(next);
            }
        }
        if (part.cells.size() < kFewCells) continue;
        part.slice = measured(part.cells, z_mm);
        parts.push_back(std::move(part));
      }
    return parts;
  }

 private:
  RootSlice measured(const std::vector<glm::ivec2>& cells, double z_mm) const {
    glm::dvec2 sum(0.0), low(1e9), high(-1e9);
    for (const glm::ivec2& cell : cells) {
      sum += glm::dvec2(cell);
      low = glm::min(low, glm::dvec2(cell));
      high = glm::max(high, glm::dvec2(cell));
    }
    return {glm::dvec3(step_mm_ * sum / static_cast<double>(cells.size()), z_mm), 0.5 * step_mm_ * (high - low + 1.0)};
  }

  const CtVolume& ct_;
  int fdi_;
  const ToothFrame& frame_;
  double step_mm_;
  int half_;
};

bool overlap(const Part& a, const Part& b) {
  return std::ranges::any_of(a.cells, [&](const glm::ivec2& cell) { return std::ranges::count(b.cells, cell) > 0; });
}

/// All ways down from a part of a slice.
std::vector<RootCourse> waysDown(const std::vector<std::vector<Part>>& slices, std::size_t depth, const Part& part,
                                 double step_mm) {
  std::vector<RootCourse> ways;
  if (depth + 1 < slices.size())
    for (const Part& below : slices[depth + 1])
      if (overlap(part, below)) {
        std::vector<RootCourse> more = waysDown(slices, depth + 1, below, step_mm);
        ways.insert(ways.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
      }
  // Ways that part and meet again end in one apex.
  const auto apex = [](const RootCourse& way) {
    return way.slices.empty() ? glm::dvec3(0.0) : way.slices.back().middle_mm;
  };
  for (std::size_t n = 0; n < ways.size(); ++n)
    ways.erase(std::remove_if(ways.begin() + static_cast<std::ptrdiff_t>(n) + 1, ways.end(),
                              [&](const RootCourse& way) { return apex(way) == apex(ways[n]); }),
               ways.end());
  if (ways.empty()) ways.push_back({});
  // Short ones are bumps.
  const auto longest =
      std::ranges::max_element(ways, {}, [](const RootCourse& way) { return way.slices.size() - way.own; });
  const RootCourse kept = *longest;
  if (ways.size() > 1)
    std::erase_if(
        ways, [&](const RootCourse& way) { return static_cast<double>(way.slices.size()) * step_mm < kShortRoot_mm; });
  if (ways.empty()) ways.push_back(kept);
  for (RootCourse& way : ways) {
    way.slices.insert(way.slices.begin(), part.slice);
    way.own = ways.size() > 1 && way.own == 0 ? 1 : way.own > 0 ? way.own + 1 : 0;
  }
  // What was divided and is one again after pruning is one root.
  if (ways.size() == 1) ways[0].own = 0;
  return ways;
}

/// Towards the midline along the arch.
glm::dvec3 mesialDirection_P(int fdi) {
  const glm::dvec3 cheek = buccalDirection_P(fdi);
  return isRight(fdi) ? glm::dvec3(-cheek.y, cheek.x, 0.0) : glm::dvec3(cheek.y, -cheek.x, 0.0);
}

}  // namespace

ToothFrame toothFrame(const CtVolume& ct, int fdi) {
  ToothFrame frame;
  const glm::dvec3 up = toothAxis_P(ct, fdi), mesial = mesialDirection_P(fdi);
  frame.axes_P[2] = up;
  frame.axes_P[0] = glm::normalize(mesial - glm::dot(mesial, up) * up);
  const glm::dvec3 cheek = buccalDirection_P(fdi), third = glm::normalize(glm::cross(up, frame.axes_P[0]));
  frame.axes_P[1] = glm::dot(third, cheek) > 0.0 ? third : -third;

  std::vector<double> enamel, pulp;
  forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (ct.tooth[v] != fdi) return;
    const double height_mm = glm::dot(ct.grid.centre_P_mm(ijk), up);
    if (Tissue{ct.label[v]} == Tissue::enamel) enamel.push_back(height_mm);
    if (Tissue{ct.label[v]} == Tissue::pulp) pulp.push_back(height_mm);
  });
  std::vector<double>& heights = enamel.empty() ? pulp : enamel;
  if (heights.empty()) return frame;
  std::ranges::sort(heights);
  const double share = enamel.empty() ? 0.9 : kNeckShare;
  const double neck_mm = heights[static_cast<std::size_t>(share * static_cast<double>(heights.size() - 1))];
  const VoxelSum around = voxelSum(ct.grid, [&](std::size_t v) {
    return ct.tooth[v] == fdi &&
           std::abs(glm::dot(ct.grid.centre_P_mm(elementAt(ct.grid.size, v)), up) - neck_mm) < 0.5 * ct.grid.spacing_mm;
  });
  if (around.count > 0.0) frame.cervix_P_mm = ct.grid.origin_P_mm + ct.grid.spacing_mm * around.sum / around.count;
  return frame;
}

std::vector<RootCourse> rootCourses(const CtVolume& ct, int fdi, const ToothFrame& frame) {
  constexpr double kBelowNeck_mm = 1.0, kLongest_mm = 25.0;
  const Slicer slicer(ct, fdi, frame);
  std::vector<std::vector<Part>> slices;
  for (double z = -kBelowNeck_mm; z > -kLongest_mm; z -= slicer.step_mm()) {
    slices.push_back(slicer.partsAt(z));
    if (slices.back().empty()) break;
  }
  if (slices.empty() || slices[0].empty()) return {};
  const Part& neck = *std::ranges::max_element(slices[0], {}, [](const Part& part) { return part.cells.size(); });
  std::vector<RootCourse> roots = waysDown(slices, 0, neck, slicer.step_mm());
  std::ranges::sort(roots, std::ranges::greater{}, [](const RootCourse& root) {
    return root.slices[(root.own + root.slices.size()) / 2].middle_mm.x;
  });
  return roots;
}

}  // namespace assets
