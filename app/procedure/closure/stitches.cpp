#include "app/procedure/closure/stitches.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "app/case/impaction_measures.h"
#include "assets/ct_volume.h"

namespace app {
namespace {

constexpr double kBehind_mm[] = {2.0, 6.0};  ///< the second molar
constexpr double kGum_mm = 1.5;              ///< over the bone
constexpr double kBite_mm = 2.5;             ///< of the papilla's stitch from the tooth, into the flap
constexpr double kColumnRadius_mm = 0.8;

struct Reach {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void take(double value) { low = std::min(low, value), high = std::max(high, value); }
};

/// The top of what is solid in a column of the scan, without the tooth that stands beside it.
std::optional<double> topOf_mm(const assets::CtVolume& ct, const ArchFrame& frame, const glm::dvec3& at_P_mm, int fdi) {
  // The box around the column, through the whole scan.
  const glm::dvec3 half_mm =
      glm::length(glm::dvec3(ct.grid.size)) * ct.grid.spacing_mm * glm::abs(frame.up_P) + kColumnRadius_mm;
  const auto voxel_at = [&](const glm::dvec3& p) {
    return glm::clamp(glm::ivec3(glm::floor(ct.grid.indexFromPoint(p))), glm::ivec3(0), ct.grid.size);
  };
  std::optional<double> top_mm;
  assets::forVoxels(
      voxel_at(at_P_mm - half_mm), voxel_at(at_P_mm + half_mm + 2.0 * ct.grid.spacing_mm), [&](glm::ivec3 ijk) {
        const std::size_t v = ct.grid.index(ijk);
        if (ct.solid[v] < assets::kHalfSolid || ct.tooth[v] == fdi) return;
        const glm::dvec3 p = ct.grid.centre_P_mm(ijk), off = p - at_P_mm;
        if (glm::length(off - glm::dot(off, frame.up_P) * frame.up_P) > kColumnRadius_mm) return;
        top_mm = std::max(top_mm.value_or(-std::numeric_limits<double>::infinity()), glm::dot(p, frame.up_P));
      });
  return top_mm;
}

}  // namespace

std::vector<glm::dvec3> stitchPlaces_P_mm(const assets::Patient& patient) {
  const assets::CtVolume& ct = patient.ct;
  if (!patient.site || ct.tooth.empty()) return {};
  const int second_fdi = patient.site->fdi - 1;
  const ArchFrame frame = archFrame(patient);
  Reach along, across;
  double count = 0.0;
  glm::dvec3 sum(0.0);
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (ct.tooth[v] != second_fdi) return;
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    along.take(glm::dot(p, frame.distal_P));
    across.take(glm::dot(p, frame.buccal_P));
    sum += p;
    count += 1.0;
  });
  if (count == 0.0) return {};
  const glm::dvec3 middle = sum / count;
  std::vector<glm::dvec3> wanted;
  for (const double behind_mm : kBehind_mm)
    wanted.push_back(middle + (along.high + behind_mm - glm::dot(middle, frame.distal_P)) * frame.distal_P);
  wanted.push_back(middle + (along.low - glm::dot(middle, frame.distal_P)) * frame.distal_P +
                   (across.high + kBite_mm - glm::dot(middle, frame.buccal_P)) * frame.buccal_P);
  std::vector<glm::dvec3> places;
  for (const glm::dvec3& at : wanted)
    if (const auto top_mm = topOf_mm(ct, frame, at, second_fdi))
      places.push_back(at + (*top_mm + kGum_mm - glm::dot(at, frame.up_P)) * frame.up_P);
  return places;
}

Stitches::Stitches(const std::vector<glm::dvec3>& places_P_mm) {
  for (const glm::dvec3& p : places_P_mm) places_.push_back({p, false});
}

bool Stitches::follow(const haptics::Tick& tick, const haptics::Tool& tool) {
  const auto nearest = std::ranges::min_element(places_, {}, [&](const StitchPlace& place) {
    return place.is_made ? std::numeric_limits<double>::infinity() : glm::distance(place.at_P_mm, tick.proxy_P.mm);
  });
  const bool holds = nearest != places_.end() && !nearest->is_made && !tool.turns() && tick.hand.drill_pedal &&
                     tick.gripped == 0 &&
                     glm::distance(nearest->at_P_mm, tick.proxy_P.mm) <= kStitchReach_mm + tool.head.radius_mm;
  held_s_ = holds ? held_s_ + tick.dt_s : 0.0;
  if (held_s_ < kStitchHold_s) return false;
  held_s_ = 0.0;
  nearest->is_made = true;
  return true;
}

int Stitches::made() const { return static_cast<int>(std::ranges::count_if(places_, &StitchPlace::is_made)); }

}  // namespace app
