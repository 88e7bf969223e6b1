#include "app/case/gutter_strokes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace app {
namespace {

constexpr int kRow = 4;  ///< columns from one row of strokes to the next
static_assert(HeightMap::kHalf % kRow == 0, "a cut of the middle row alone has strokes");
constexpr double kLeastStroke_mm = 0.25;
constexpr double kStraight_mm = 0.05;  ///< corners that a stroke leaves out

/// Leaves out the corners that lie on the line between their neighbours.
std::vector<glm::dvec3> straightened(const std::vector<glm::dvec3>& stroke) {
  std::vector<glm::dvec3> kept{stroke.front()};
  for (std::size_t begin = 0, end = 2; end < stroke.size(); ++end) {
    const glm::dvec3 line = glm::normalize(stroke[end] - stroke[begin]);
    const auto off_mm = [&](const glm::dvec3& p) { return glm::length(glm::cross(p - stroke[begin], line)); };
    bool straight = true;
    for (std::size_t n = begin + 1; n < end; ++n) straight = straight && off_mm(stroke[n]) < kStraight_mm;
    if (straight) continue;
    begin = end - 1;
    kept.push_back(stroke[begin]);
  }
  if (stroke.size() > 1) kept.push_back(stroke.back());
  return kept;
}

/// Level by level from the top, row by row along the crown, to and fro.
class Strokes {
 public:
  Strokes(const WayIn& way, const Heights& heights, const std::vector<char>& planned, const StrokePlan& plan)
      : way_(way), h_(heights), planned_(planned), plan_(plan) {}

  std::vector<std::vector<glm::dvec3>> make() {
    double top_mm = kNoHeight_mm, bottom_mm = -kNoHeight_mm;
    for (int j = 0; j < HeightMap::kSide; ++j)
      for (int i = 0; i < HeightMap::kSide; ++i)
        if (isPlanned(i, j)) {
          top_mm = std::max(top_mm, h_.bone.at(i, j));
          bottom_mm = std::min(bottom_mm, h_.lowest.at(i, j));
        }
    double level_mm = top_mm;
    while (level_mm > bottom_mm) {
      const double above_mm = level_mm;
      level_mm = std::max(level_mm - plan_.level_mm, bottom_mm);
      for (int j = HeightMap::kSide - 1; j >= 0; --j)
        if (j % kRow == 0) row(j, level_mm, above_mm);
    }
    // Along the bottom, between the rows too, while the bone gives way.
    for (int pass = 0; pass < plan_.finishing_passes; ++pass)
      for (int j = HeightMap::kSide - 1; j >= 0; --j)
        if (pass > 0 || j % (kRow / 2) == 0) row(j, bottom_mm, -kNoHeight_mm);
    return std::move(strokes_);
  }

 private:
  bool isPlanned(int i, int j) const { return planned_[HeightMap::column(i, j)] != 0; }

  void row(int j, double level_mm, double above_mm) {
    std::vector<std::vector<glm::dvec3>> runs;
    bool in_run = false;
    double former_mm = 0.0;
    for (int i = 0; i < HeightMap::kSide; ++i) {
      const double height_mm = std::max(level_mm, h_.lowest.at(i, j));
      const bool cuts = isPlanned(i, j) && height_mm < h_.bone.at(i, j) && height_mm < above_mm;
      if (cuts) {
        if (!in_run) runs.emplace_back();
        // Over an edge: across while high, then down; up first, then across.
        if (in_run && std::abs(height_mm - former_mm) > HeightMap::kColumn_mm)
          runs.back().push_back(way_.inPatient({HeightMap::place_mm(height_mm < former_mm ? i : i - 1),
                                                HeightMap::place_mm(j), std::max(height_mm, former_mm)}));
        former_mm = height_mm;
        runs.back().push_back(way_.inPatient({HeightMap::place_mm(i), HeightMap::place_mm(j), height_mm}));
      }
      in_run = cuts;
    }
    std::erase_if(runs, [](const auto& run) { return glm::distance(run.front(), run.back()) < kLeastStroke_mm; });
    if (runs.empty()) return;
    // From the end that is nearer to where the bur is.
    const auto way_mm = [&](const glm::dvec3& p) {
      return strokes_.empty() ? 0.0 : glm::distance(strokes_.back().back(), p);
    };
    if (way_mm(runs.back().back()) < way_mm(runs.front().front())) {
      std::ranges::reverse(runs);
      for (auto& run : runs) std::ranges::reverse(run);
    }
    for (const auto& run : runs) strokes_.push_back(straightened(run));
  }

  const WayIn& way_;
  const Heights& h_;
  const std::vector<char>& planned_;
  StrokePlan plan_;
  std::vector<std::vector<glm::dvec3>> strokes_;
};

}  // namespace

std::vector<std::vector<glm::dvec3>> gutterStrokes(const WayIn& way, const Heights& heights,
                                                   const std::vector<char>& planned, const StrokePlan& plan) {
  return Strokes(way, heights, planned, plan).make();
}

}  // namespace app
