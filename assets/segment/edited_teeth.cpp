#include "assets/segment/edited_teeth.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "assets/load_error.h"
#include "assets/segment/cheapest_path.h"
#include "assets/segment/flooding.h"

namespace assets {
namespace {

constexpr double kNear_mm = 1.5, kThickest_mm = 2.0, kRootReach_mm = 14.0, kRootTube_mm = 0.55;
constexpr double kMostCost = 9.0, kLeastCost = 0.05, kLevelsPerMm = 200.0;
constexpr std::size_t kMostNumbered = 254;

class TeethEditor {
 public:
  TeethEditor(const Mandible& jaw, const GreyLevels& levels, ToothRegions& regions)
      : jaw_(jaw), levels_(levels), regions_(regions) {
    told_.fdi.resize(static_cast<std::size_t>(regions.count) + 1, 0);
    told_.is_apart.resize(told_.fdi.size(), 0);
  }

  void apply(const ToothClick& click, std::size_t number) {
    number_ = number;
    switch (click.edit) {
      case ToothEdit::same_tooth:
        return join(partAt(click.at_P_mm[0]), partAt(click.at_P_mm[1]));
      case ToothEdit::two_teeth:
        return divide(click.at_P_mm[0], click.at_P_mm[1]);
      case ToothEdit::number:
        return setNumber(partAt(click.at_P_mm[0]), click.fdi);
      case ToothEdit::no_tooth:
        return rename(partAt(click.at_P_mm[0]), 0);
      case ToothEdit::root_tip:
        return addRoot(click.at_P_mm[0]);
    }
  }
  ToldParts take() { return std::move(told_); }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw LoadError("clicks: tooth click " + std::to_string(number_) + ": " + why);
  }

  glm::dvec3 cellOf(const glm::dvec3& p_P_mm) const {
    return jaw_.grid.indexFromPoint(p_P_mm) - glm::dvec3(regions_.box.low);
  }

  std::uint8_t partAt(const glm::dvec3& p_P_mm) const {
    std::uint8_t part = 0;
    double nearest_mm = 2.0 * kNear_mm;
    const glm::ivec3 size = regions_.box.size();
    forCellsNear(cellOf(p_P_mm), kNear_mm, jaw_.grid.spacing_mm, size, [&](glm::ivec3 ijk, double away_mm) {
      const std::uint8_t here = regions_.part[indexIn(size, ijk)];
      if (here != 0 && away_mm < nearest_mm) part = here, nearest_mm = away_mm;
    });
    if (part == 0) refuse("no tooth was found within 1.5 mm of it");
    return part;
  }

  void rename(std::uint8_t part, std::uint8_t to) {
    std::ranges::replace(regions_.part, part, to);
    const int fdi = std::exchange(told_.fdi[part], 0);
    if (to != 0 && fdi != 0) told_.fdi[to] = fdi;
  }

  void join(std::uint8_t part, std::uint8_t other) {
    if (told_.fdi[part] != 0 && told_.fdi[other] != 0 && part != other)
      refuse("its two pieces were given different numbers");
    if (part != other) rename(other, part);
  }

  void setNumber(std::uint8_t part, int fdi) {
    for (std::size_t other = 1; other < told_.fdi.size(); ++other)
      if (told_.fdi[other] == fdi && other != part) refuse(std::to_string(fdi) + " was given to another piece before");
    told_.fdi[part] = fdi;
    told_.is_apart[part] = 1;
  }

  void divide(const glm::dvec3& a_P_mm, const glm::dvec3& b_P_mm) {
    const std::uint8_t part = partAt(a_P_mm), other = partAt(b_P_mm);
    told_.is_apart[part] = told_.is_apart[other] = 1;
    if (part != other) return;
    if (told_.fdi.size() > kMostNumbered) refuse("there are too many pieces already");
    const CellBox box = boxOfPart(part);
    const glm::ivec3 size = box.size();
    CellMask mask = croppedTo(box, regions_.box.size(), regions_.part);
    for (std::uint8_t& cell : mask) cell = cell == part ? 1 : 0;
    const std::vector<float> thickness_mm = depthInside_mm(size, jaw_.grid.spacing_mm, mask);
    const auto thickest = [&](const glm::dvec3& p_P_mm) {
      std::optional<std::size_t> cell;
      forCellsNear(cellOf(p_P_mm) - glm::dvec3(box.low), kThickest_mm, jaw_.grid.spacing_mm, size,
                   [&](glm::ivec3 ijk, double) {
                     const std::size_t n = indexIn(size, ijk);
                     if (mask[n] != 0 && (!cell || thickness_mm[n] > thickness_mm[*cell])) cell = n;
                   });
      return *cell;
    };
    const std::size_t a = thickest(a_P_mm), b = thickest(b_P_mm);
    if (a == b) refuse("both its points lie in one place, give a point of either tooth");
    // From thick to thin: the two meet at the neck between them.
    const float most_mm = *std::ranges::max_element(thickness_mm);
    std::vector<std::uint16_t> level(mask.size());
    for (std::size_t n = 0; n < level.size(); ++n)
      level[n] = mask[n] == 0
                     ? std::uint16_t{0}
                     : static_cast<std::uint16_t>(std::min(4000.0, kLevelsPerMm * (most_mm - thickness_mm[n])));
    std::vector<std::uint8_t> label(mask.size(), 0);
    label[a] = 1, label[b] = 2;
    flood(size, level, mask, label);
    const auto fresh = static_cast<std::uint8_t>(told_.fdi.size());
    forCells(size, [&](glm::ivec3 ijk, std::size_t n) {
      if (label[n] == 2) regions_.part[indexIn(regions_.box.size(), box.low + ijk)] = fresh;
    });
    regions_.count = fresh;
    told_.fdi.push_back(0);
    told_.is_apart.push_back(1);
  }

  /// With a layer around it, as far as there is one.
  CellBox boxOfPart(std::uint8_t part) const {
    CellMask mask(regions_.part.size());
    std::ranges::transform(regions_.part, mask.begin(),
                           [part](std::uint8_t here) { return static_cast<std::uint8_t>(here == part ? 1 : 0); });
    return boxOfCells(regions_.box.size(), mask).grown(1, regions_.box.size());
  }

  /// The regions in a box that holds this cell of the jaw with room around it.
  void makeRoomFor(glm::ivec3 at) {
    const int room = static_cast<int>(std::ceil(2.0 / jaw_.grid.spacing_mm));
    const CellBox tight = regions_.box;
    const CellBox wide =
        CellBox{glm::min(tight.low, at - room), glm::max(tight.end, at + room + 1)}.grown(0, jaw_.grid.size);
    std::vector<std::uint8_t> part(countIn(wide.size()), 0);
    forCells(tight.size(), [&](glm::ivec3 ijk, std::size_t n) {
      part[indexIn(wide.size(), tight.low - wide.low + ijk)] = regions_.part[n];
    });
    regions_.box = wide;
    regions_.part = std::move(part);
  }

  /// The way from the tip to a tooth through what is as dense as dentine.
  void addRoot(const glm::dvec3& tip_P_mm) {
    const glm::ivec3 tip(glm::floor(jaw_.grid.indexFromPoint(tip_P_mm) + 0.5));
    if (!jaw_.grid.contains(tip) || jaw_.solid[jaw_.grid.index(tip)] == 0) refuse("it does not lie in the lower jaw");
    makeRoomFor(tip);
    const int reach = static_cast<int>(std::ceil(kRootReach_mm / jaw_.grid.spacing_mm));
    const glm::ivec3 here = tip - regions_.box.low;
    const CellBox box = CellBox{here, here + 1}.grown(reach, regions_.box.size());
    const glm::ivec3 size = box.size();
    std::vector<float> cost(countIn(size), 0.0F);
    std::vector<std::size_t> teeth;
    const double range_hu = std::max(100.0, levels_.dentine_hu - levels_.cortical_hu);
    forCells(size, [&](glm::ivec3 ijk, std::size_t n) {
      const glm::ivec3 at = box.low + ijk;
      const std::size_t voxel = jaw_.grid.index(regions_.box.low + at);
      if (jaw_.solid[voxel] == 0) return;
      const double lacks = std::max(0.0, levels_.dentine_hu - static_cast<double>(jaw_.smooth_hu[voxel])) / range_hu;
      cost[n] = static_cast<float>(kLeastCost + std::min(kMostCost, lacks * lacks));
      if (regions_.part[indexIn(regions_.box.size(), at)] != 0) teeth.push_back(n);
    });
    const std::vector<std::size_t> from{indexIn(size, here - box.low)};
    const std::vector<std::size_t> way = teeth.empty() ? teeth : cheapestPath(size, cost, from, teeth);
    if (way.empty()) refuse("no tooth within 14 mm of it has a way to it");
    const glm::ivec3 end = box.low + elementAt(size, way.back());
    const std::uint8_t owner = regions_.part[indexIn(regions_.box.size(), end)];
    // At least a cell on every side, or nothing is left of it when its surface is placed.
    const double tube_mm = std::max(kRootTube_mm, 1.2 * jaw_.grid.spacing_mm);
    for (const std::size_t cell : way)
      forCellsNear(glm::dvec3(box.low + elementAt(size, cell)), tube_mm, jaw_.grid.spacing_mm, regions_.box.size(),
                   [&](glm::ivec3 ijk, double) {
                     std::uint8_t& part = regions_.part[indexIn(regions_.box.size(), ijk)];
                     if (part == 0 && jaw_.solid[jaw_.grid.index(regions_.box.low + ijk)] != 0) part = owner;
                   });
  }

  const Mandible& jaw_;
  const GreyLevels& levels_;
  ToothRegions& regions_;
  ToldParts told_;
  std::size_t number_ = 0;
};

}  // namespace

void ToldParts::tell(std::vector<FoundTooth>& teeth) const {
  std::size_t told = 0;
  for (FoundTooth& tooth : teeth) {
    tooth.told_fdi = fdi[static_cast<std::size_t>(tooth.part)];
    tooth.is_apart = is_apart[static_cast<std::size_t>(tooth.part)] != 0;
    if (tooth.told_fdi != 0) ++told;
  }
  if (told < fdi.size() - static_cast<std::size_t>(std::ranges::count(fdi, 0)))
    throw LoadError("clicks: a piece that was given a number is smaller than any tooth");
}

ToldParts editTeeth(const Mandible& jaw, const GreyLevels& levels, std::span<const ToothClick> clicks,
                    ToothRegions& regions) {
  TeethEditor editor(jaw, levels, regions);
  for (std::size_t n = 0; n < clicks.size(); ++n) editor.apply(clicks[n], n + 1);
  return editor.take();
}

}  // namespace assets
