#include "app/review/site_view.h"

#include <algorithm>

#include "app/case/operated_crown.h"
#include "assets/synthetic/practice_block.h"

namespace app {
namespace {

/// Where no patient tells: the middle of the tooth, or of what was removed.
SiteView siteFromBone(const StoredStart& start, std::span<const std::uint8_t> after) {
  SiteView site;
  glm::dvec3 sum(0.0);
  double weight = 0.0;
  const bool by_tooth = !start.is_tooth.empty();
  assets::forVoxels(start.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const double w = by_tooth ? (start.is_tooth[v] != 0 ? 1.0 : 0.0) : std::max(0, start.solid[v] - after[v]) / 255.0;
    sum += w * start.grid.centre_P_mm(ijk);
    weight += w;
  });
  const glm::dvec3 middle = start.grid.centre_P_mm(start.grid.size / 2);
  site.middle_P_mm = weight > 0.0 ? sum / weight : middle;
  if (site.middle_P_mm.x < middle.x) site.buccal_P.x = -1.0;
  return site;
}

SiteView siteOf(const assets::Patient& patient) {
  const SiteAxes axes = siteAxes(patient.ct, *patient.site);
  return {patient.site->centre_P_mm + 3.0 * axes.up_P, axes.distal_P, axes.buccal_P, axes.up_P};
}

/// Over the neck of a single tooth.
SiteView siteOfTooth(const assets::ToothFrame& frame) {
  constexpr double kCrownMiddle_mm = 4.0;
  return {frame.inP({0.0, 0.0, kCrownMiddle_mm}), -frame.axes_P[0], frame.axes_P[1], frame.axes_P[2]};
}

/// Of a practice block: over its face.
SiteView siteOfBlock() {
  return {glm::dvec3(0.0), assets::fromBlock({1.0, 0.0, 0.0}), -assets::fromBlock({0.0, 1.0, 0.0}),
          assets::fromBlock({0.0, 0.0, 1.0})};
}

}  // namespace

SiteView siteViewOf(const StoredStart& start, const assets::Patient* patient, std::span<const std::uint8_t> after) {
  if (!start.setup.practice.empty()) return siteOfBlock();
  if (start.setup.prepared) return siteOfTooth(start.setup.prepared->frame);
  return patient != nullptr && patient->site ? siteOf(*patient) : siteFromBone(start, after);
}

}  // namespace app
