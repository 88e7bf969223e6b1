#include "app/procedure/preparation/undercut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "assets/tissue.h"

namespace app {
namespace {

/// Along the way: the widest place of a stump may be an edge, and 3 µm of it are 3 % of a usual undercut.
constexpr double kStep_voxels = 0.5;
constexpr double kLeastColumn_mm = 0.1;
/// Room for columns that lean: 5 degrees over a crown of 10 mm.
constexpr double kAside_mm = 1.2;
constexpr double kCone_rad = 5.0 * std::numbers::pi / 180.0;
/// Of the size of the voxels' roughness: no reason to leave the tooth's axis.
constexpr double kWorth_mm3 = 0.05;
/// A place begins that far off its surface, so that what leans over by less is not told.
constexpr double kOff_mm = 0.03;

}  // namespace

CrownColumns::CrownColumns(const Crown& crown, const BoxBytes& solid, double margin_mm)
    : column_mm_(std::max(kLeastColumn_mm, solid.grid().spacing_mm)),
      step_mm_(kStep_voxels * solid.grid().spacing_mm),
      low_mm_(-crown.reach_mm - kAside_mm),
      side_(static_cast<int>(-2.0 * low_mm_ / column_mm_)),
      levels_(std::max(1, static_cast<int>(std::ceil((crown.top_mm - margin_mm) / step_mm_)))),
      bytes_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_) * static_cast<std::size_t>(levels_)),
      stretches_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(levels_)) {
  const assets::VolumeGrid& grid = solid.grid();
  const glm::dvec3 along = crown.frame.axes_P[0] * (column_mm_ / grid.spacing_mm);
  std::size_t v = 0;
  for (int level = 0; level < levels_; ++level)
    for (int y = 0; y < side_; ++y) {
      const glm::dvec3 first = grid.indexFromPoint(crown.frame.inP(
          {low_mm_ + 0.5 * column_mm_, low_mm_ + (y + 0.5) * column_mm_, margin_mm + (level + 0.5) * step_mm_}));
      for (int x = 0; x < side_; ++x, ++v) {
        const glm::dvec3 index = first + static_cast<double>(x) * along;
        const double share = solid.atIndex(index);
        if (share == 0.0) continue;
        const std::uint8_t label = crown.label.voxel(glm::ivec3(glm::floor(index + 0.5)));
        if (label == static_cast<std::uint8_t>(assets::Tissue::other_teeth)) continue;
        bytes_[v] = static_cast<std::uint8_t>(255.0 * share + 0.5);
        stretches_[v / static_cast<std::size_t>(side_)].take({x, x + 1});
      }
    }
}

double CrownColumns::undercut_mm3(const glm::dvec2& lean) const {
  const auto side = static_cast<std::size_t>(side_);
  std::vector<float> most(side * side, 0.0F), lost_along(side, 0.0F);
  std::vector<Stretch> reaches(side);
  const int aside = static_cast<int>(kAside_mm / column_mm_) - 1;
  double lost = 0.0;
  for (int level = levels_ - 1; level >= 0; --level) {
    // The columns lean: at this level they stand aside by a whole number of cells and a share.
    const glm::dvec2 shift = lean * (static_cast<double>(level) * step_mm_ / column_mm_);
    const glm::ivec2 cells(glm::floor(shift));
    const glm::vec2 share(shift - glm::dvec2(cells));
    const float w00 = (1.0F - share.x) * (1.0F - share.y), w10 = share.x * (1.0F - share.y);
    const float w01 = (1.0F - share.x) * share.y, w11 = share.x * share.y;
    std::ranges::fill(lost_along, 0.0F);
    for (int y = aside; y < side_ - aside; ++y) {
      // Where this level or one above it holds something.
      Stretch& reached = reaches[static_cast<std::size_t>(y)];
      for (const int row : {y + cells.y, y + cells.y + 1})
        if (const Stretch& of = stretch(row, level); of.end > 0)
          reached.take({std::max(aside, of.from - cells.x - 1), std::min(side_ - aside, of.end - cells.x)});
      if (reached.end <= reached.from) continue;
      const std::uint8_t* const here = &bytes_[index(reached.from + cells.x, y + cells.y, level)];
      const std::uint8_t* const next = here + side;
      float* const so_far = &most[static_cast<std::size_t>(y) * side + static_cast<std::size_t>(reached.from)];
      float* const lost_here = &lost_along[static_cast<std::size_t>(reached.from)];
      for (int x = 0; x < reached.end - reached.from; ++x) {
        const float w = w00 * here[x] + w10 * here[x + 1] + w01 * next[x] + w11 * next[x + 1];
        const float most_now = std::max(so_far[x], w);
        lost_here[x] += most_now - w;
        so_far[x] = most_now;
      }
    }
    for (const float one : lost_along) lost += static_cast<double>(one);
  }
  return lost / 255.0 * column_mm_ * column_mm_ * step_mm_;
}

InsertionWay bestInsertion(const CrownColumns& columns) {
  const auto way_of = [&](const glm::dvec2& lean) {
    return InsertionWay{lean, std::atan(glm::length(lean)), columns.undercut_mm3(lean)};
  };
  const InsertionWay axis = way_of(glm::dvec2(0.0));
  InsertionWay best = axis;
  const double rim = std::tan(kCone_rad);
  // A compass search: from the axis, halving the step where no neighbour is better.
  for (double step = 0.5 * rim; step > 0.05 * rim;) {
    InsertionWay better = best;
    for (const glm::dvec2& way : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)}) {
      const glm::dvec2 lean = best.lean + step * way;
      if (glm::length(lean) > rim + 1e-9) continue;
      if (const InsertionWay one = way_of(lean); one.undercut_mm3 < better.undercut_mm3) better = one;
    }
    if (better.undercut_mm3 < best.undercut_mm3)
      best = better;
    else
      step *= 0.5;
  }
  return axis.undercut_mm3 - best.undercut_mm3 < kWorth_mm3 ? axis : best;
}

glm::dvec3 wayOf(const InsertionWay& insertion, const assets::ToothFrame& frame) {
  return frame.axes_P * glm::normalize(glm::dvec3(insertion.lean, 1.0));
}

std::vector<glm::dvec3> undercutPlaces_P_mm(const Crown& crown, const BoxBytes& made,
                                            std::span<const DeviationPlace> surface, const glm::dvec3& way_P) {
  std::vector<glm::dvec3> places;
  const double step_mm = made.grid().spacing_mm;
  for (const DeviationPlace& place : surface) {
    const glm::dvec3 p_P(place.p_P_mm), out_P(place.out_P);
    const double up_mm = crown.top_mm - crown.frame.local(p_P).z;
    for (double mm = step_mm; mm < up_mm + step_mm; mm += step_mm) {
      const glm::dvec3 over_P = p_P + kOff_mm * out_P + mm * way_P;
      if (made.at(over_P) < 0.5 || !crown.isTooth(over_P)) continue;
      places.push_back(p_P);
      break;
    }
  }
  return places;
}

}  // namespace app
