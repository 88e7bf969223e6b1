#include "app/procedure/third_molar/section_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "app/procedure/third_molar/cut_sweep.h"
#include "haptics/body/components.h"

namespace app {
namespace {

constexpr double kLeastShare = 1.0 / 3.0;  ///< of the tooth, on either side of the slot
constexpr double kSlice_mm = 0.3;          ///< half the thickness in which the tooth's extent is taken
constexpr double kBeside_mm = 2.0;         ///< beyond the bur: what is looked at beside the slot
constexpr double kLostWeight = 5.0;        ///< of tooth that cannot be reached, against what is cut
constexpr int kMiddle = HeightMap::kHalf;

/// Where along the way in a slot across the tooth has the least to cut.
std::optional<double> thinnestSlice_mm(const std::vector<glm::dvec3>& tooth_P_mm, const WayIn& way) {
  constexpr int kHalf = 60;
  std::array<std::size_t, 2 * kHalf + 1> voxels{};
  for (const glm::dvec3& p : tooth_P_mm) {
    const double slice = std::clamp(way.local(p).x / kSlice_mm, -double(kHalf), double(kHalf));
    ++voxels[static_cast<std::size_t>(std::lround(slice) + kHalf)];
  }
  std::optional<double> best;
  std::size_t before = 0, least = 0;
  for (std::size_t n = 0; n + 1 < voxels.size(); ++n) {
    before += voxels[n];
    const double share = static_cast<double>(before) / static_cast<double>(tooth_P_mm.size());
    if (share < kLeastShare || share > 1.0 - kLeastShare) continue;
    const std::size_t here = voxels[n] + voxels[n + 1];
    if (best && here >= least) continue;
    least = here;
    best = (static_cast<double>(n) + 0.5 - kHalf) * kSlice_mm;
  }
  return best;
}

/// The tooth in the plane of a slot; x of the map runs from tongue to cheek.
struct Slot {
  WayIn way;
  Heights heights;
  HeightMap fork;  ///< middle row: the tooth's lowest place
  double lingual_mm = -kNoHeight_mm, buccal_mm = kNoHeight_mm;
  double all_mm2 = 0.0, lost_mm2 = 0.0;  ///< of the tooth, and what of it the bur cannot reach
  double cut_mm2 = 0.0;                  ///< of all that is solid

  double cost() const { return cut_mm2 + kLostWeight * lost_mm2; }
};

std::optional<Slot> slotAlong(const SiteSolid& site, const WayIn& over, double bur_radius_mm, const Margins& margins) {
  const auto slice_mm = thinnestSlice_mm(site.tooth_P_mm(), over);
  if (!slice_mm) return {};
  Slot slot;
  const double unit_mm2 = site.grid().voxelVolume_mm3() / (2.0 * kSlice_mm);
  slot.way = {over.inPatient({*slice_mm, 0.0, 0.0}), over.across, over.along, over.outward};
  slot.heights = site.heightsAlong(slot.way, bur_radius_mm, 0.0, margins, bur_radius_mm + kBeside_mm);
  for (int i = 0; i < HeightMap::kSide; ++i) slot.fork.at(i, kMiddle) = -kNoHeight_mm;
  for (const glm::dvec3& p : site.tooth_P_mm()) {
    const glm::dvec3 q = slot.way.local(p);
    const int i = static_cast<int>(std::lround(q.x / HeightMap::kColumn_mm)) + HeightMap::kHalf;
    if (std::abs(q.y) > kSlice_mm || i < 0 || i >= HeightMap::kSide) continue;
    slot.all_mm2 += unit_mm2;
    slot.lingual_mm = std::min(slot.lingual_mm, q.x);
    slot.buccal_mm = std::max(slot.buccal_mm, q.x);
    slot.fork.at(i, kMiddle) = std::min(slot.fork.at(i, kMiddle), q.z);
    if (slot.heights.lowest.at(i, kMiddle) > q.z + bur_radius_mm) slot.lost_mm2 += unit_mm2;
  }
  for (int i = 0; i < HeightMap::kSide; ++i) {
    const double fork_mm = slot.fork.at(i, kMiddle);
    if (fork_mm != -kNoHeight_mm)
      slot.cut_mm2 += HeightMap::kColumn_mm * std::max(0.0, slot.heights.bone.at(i, kMiddle) - fork_mm);
  }
  return slot;
}

/// Of what the tooth falls into.
double largestPieceAfter_mm3(const SiteSolid& site, const assets::PlannedCut& cut) {
  const double spacing_mm = site.grid().spacing_mm;
  glm::dvec3 low_P_mm(site.tooth_P_mm().front()), high_P_mm(low_P_mm);
  for (const glm::dvec3& p : site.tooth_P_mm()) low_P_mm = glm::min(low_P_mm, p), high_P_mm = glm::max(high_P_mm, p);
  const glm::ivec3 size(glm::round((high_P_mm - low_P_mm) / spacing_mm) + 1.0);
  const assets::VolumeGrid grid{size, spacing_mm, low_P_mm};
  std::vector<std::uint8_t> solid(grid.voxelCount(), 0);
  for (const glm::dvec3& p : site.tooth_P_mm()) solid[grid.index(glm::ivec3(glm::round(grid.indexFromPoint(p))))] = 255;
  sweep(cut, grid, solid);
  const haptics::Components tooth(grid, solid);
  return tooth.pieces().empty() ? 0.0 : tooth.pieces().front().volume_mm3;
}

double offTongue_mm(const SiteSolid& site, const assets::PlannedCut& cut) {
  const std::vector<glm::dvec3> places_P_mm = placesAlong_P_mm(cut);
  double least_mm = kCuttingHead_mm;
  for (const glm::dvec3& q : site.tongue_P_mm())
    for (const glm::dvec3& place : places_P_mm) {
      const double up_mm = std::clamp(glm::dot(q - place, cut.outward_P), 0.0, kCuttingHead_mm);
      least_mm = std::min(least_mm, glm::distance(q, place + up_mm * cut.outward_P) - cut.bur_radius_mm);
    }
  return least_mm;
}

}  // namespace

std::optional<PlannedSection> planSection(const SiteSolid& site, double bur_radius_mm, double overshoot_mm,
                                          const Margins& margins) {
  std::optional<Slot> best;
  for (const WayIn& over : site.waysIn()) {
    auto slot = slotAlong(site, over, bur_radius_mm, margins);
    if (slot && slot->all_mm2 > 0.0 && (!best || slot->cost() < best->cost())) best = std::move(slot);
  }
  if (!best) return {};

  Heights& h = best->heights;
  std::vector<char> planned(HeightMap::kColumns, 0);
  for (int i = 0; i < HeightMap::kSide; ++i) {
    const double x_mm = HeightMap::place_mm(i), fork_mm = best->fork.at(i, kMiddle);
    if (x_mm < best->lingual_mm + bur_radius_mm - overshoot_mm || x_mm > best->buccal_mm || fork_mm == -kNoHeight_mm)
      continue;
    double& lowest_mm = h.lowest.at(i, kMiddle);
    lowest_mm = std::max(lowest_mm, fork_mm + bur_radius_mm - overshoot_mm);
    planned[HeightMap::column(i, kMiddle)] = lowest_mm < h.bone.at(i, kMiddle) ? 1 : 0;
  }
  assets::PlannedCut cut = cutAlong(best->way, h, planned, bur_radius_mm);
  if (cut.strokes_P_mm.empty()) return {};
  const double largest_mm3 = largestPieceAfter_mm3(site, cut);
  const double off_tongue_mm = offTongue_mm(site, cut);
  return PlannedSection{std::move(cut), largest_mm3, off_tongue_mm};
}

}  // namespace app
