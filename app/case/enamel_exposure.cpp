#include "app/case/enamel_exposure.h"

#include <algorithm>
#include <cmath>

#include "app/case/trough_plan.h"
#include "assets/cut_field.h"
#include "assets/tissue.h"

namespace app {
namespace {

constexpr double kBeside = 0.7;  // tangent of 35 degrees
constexpr double kFirst_mm = 0.6, kWayOut_mm = 16.0;

}  // namespace

EnamelExposure::EnamelExposure(const assets::CtVolume& ct, std::span<const std::uint8_t> before,
                               const assets::OperativeSite& site, const assets::PlannedCut& cut)
    : grid_(ct.grid) {
  const glm::dvec3 out = glm::normalize(cut.outward_P), across = glm::normalize(cut.lateral_P);
  const glm::dvec3 along = glm::cross(out, across);
  for (const glm::dvec3& way :
       {out, out + kBeside * across, out - kBeside * across, out + kBeside * along, out - kBeside * along})
    ways_out_.push_back(glm::normalize(way));

  // The jaw with the plan carried out.
  const assets::CutField field(cut, 1.0);
  std::vector<std::uint8_t> done(before.begin(), before.end());
  const glm::ivec3 low = glm::max(glm::ivec3(glm::floor(grid_.indexFromPoint(field.low_P_mm()))), glm::ivec3(0));
  const glm::ivec3 high = glm::min(glm::ivec3(glm::ceil(grid_.indexFromPoint(field.high_P_mm()))) + 1, grid_.size);
  assets::forVoxels(low, high, [&](glm::ivec3 ijk) {
    if (field.contains(grid_.centre_P_mm(ijk))) done[grid_.index(ijk)] = 0;
  });

  assets::forVoxels(glm::max(low - 8, glm::ivec3(1)), glm::min(high + 8, grid_.size - 1), [&](glm::ivec3 ijk) {
    const std::size_t v = grid_.index(ijk);
    const assets::Tissue tissue{ct.label[v]};
    if (ct.tooth.empty() ? tissue != assets::Tissue::enamel : ct.tooth[v] != site.fdi) return;
    if (tissue != assets::Tissue::enamel && tissue != assets::Tissue::other_teeth) return;
    // On the surface that faces the way in.
    const glm::ivec3 next(glm::round(grid_.indexFromPoint(grid_.centre_P_mm(ijk) + grid_.spacing_mm * out)));
    if (next == ijk || !grid_.contains(next) || assets::isTooth(ct.label[grid_.index(next)])) return;
    places_.push_back(ijk);
    if (!isOpen(places_.size() - 1, done) || isOpen(places_.size() - 1, before)) places_.pop_back();
  });
}

double EnamelExposure::planned_mm2() const {
  return static_cast<double>(places_.size()) * grid_.spacing_mm * grid_.spacing_mm;
}

double EnamelExposure::share(std::span<const std::uint8_t> solid) const {
  std::size_t open = 0;
  for (std::size_t place = 0; place < places_.size(); ++place) open += isOpen(place, solid) ? 1 : 0;
  return places_.empty() ? 1.0 : static_cast<double>(open) / static_cast<double>(places_.size());
}

bool EnamelExposure::isOpen(std::size_t place, std::span<const std::uint8_t> solid) const {
  const glm::dvec3 from = grid_.centre_P_mm(places_[place]);
  return std::ranges::any_of(ways_out_, [&](const glm::dvec3& way) {
    for (double way_mm = kFirst_mm; way_mm < kWayOut_mm; way_mm += grid_.spacing_mm) {
      const glm::ivec3 ijk(glm::round(grid_.indexFromPoint(from + way_mm * way)));
      if (grid_.contains(ijk) && solid[grid_.index(ijk)] >= assets::kHalfSolid) return false;
    }
    return true;
  });
}

}  // namespace app
