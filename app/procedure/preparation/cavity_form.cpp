#include "app/procedure/preparation/cavity_form.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "app/procedure/preparation/made_surface.h"

namespace app {
namespace {

constexpr double kReach_mm = 7.0, kCut_mm = 0.2, kAlong_mm = 0.1, kMost_mm = 8.0;
constexpr double kBehind_mm = 1.5;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Ways through the solid in the tooth's frame.
class Probe {
 public:
  Probe(const Crown& crown, const BoxBytes& solid) : crown_(crown), solid_(solid) {}

  /// To where solid begins; none within `most_mm`, or a neighbour before.
  double toSolid_mm(const glm::dvec3& from_mm, const glm::dvec3& way, double most_mm) const {
    const double step_mm = 0.5 * solid_.grid().spacing_mm, half_mm = wallReach_mm(solid_.grid());
    for (double mm = 0.0; mm <= most_mm; mm += step_mm) {
      const glm::dvec3 p_P = crown_.frame.inP(from_mm + mm * way);
      if (crown_.label.nearest(p_P) == static_cast<std::uint8_t>(assets::Tissue::other_teeth)) return kNone;
      if (solid_.nearest(p_P) < 128) continue;
      const glm::dvec3 low_P = crown_.frame.inP(from_mm + (mm - half_mm) * way);
      return mm + half_mm - solid_.solidBetween_mm(low_P, crown_.frame.axes_P * way, 2.0 * half_mm);
    }
    return kNone;
  }

 private:
  const Crown& crown_;
  const BoxBytes& solid_;
};

struct Slice {
  double x_mm = 0.0, top_mm = 0.0, floor_mm = 0.0;
};

/// Width between the walls of cheek and tongue around a place.
double width_mm(const Probe& made, const glm::dvec3& at_mm) {
  return made.toSolid_mm(at_mm, {0.0, 1.0, 0.0}, kMost_mm) + made.toSolid_mm(at_mm, {0.0, -1.0, 0.0}, kMost_mm);
}

double meanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

}  // namespace

CavityForm cavityForm(const Crown& crown, const BoxBytes& made, const IdealRule& rule) {
  CavityForm form;
  const Probe was(crown, crown.solid), is(crown, made);
  const OcclusalMap top(crown);
  std::vector<Slice> slices;
  for (double x = -kReach_mm; x <= kReach_mm; x += kAlong_mm) {
    const double top_mm = top.at({x, 0.0});
    if (top_mm == static_cast<double>(OcclusalMap::kNone)) continue;
    const double down_mm = is.toSolid_mm({x, 0.0, top_mm + 1.0}, {0.0, 0.0, -1.0}, top_mm + 1.0);
    if (!std::isnan(down_mm) && down_mm - 1.0 >= kCut_mm) slices.push_back({x, top_mm, top_mm + 1.0 - down_mm});
  }
  if (slices.empty()) return form;

  // The groove is what is no deeper than its middle: the box lies lower.
  std::vector<double> floors;
  for (const Slice& slice : slices) floors.push_back(slice.floor_mm);
  std::ranges::nth_element(floors, floors.begin() + static_cast<std::ptrdiff_t>(floors.size() / 2));
  const double floor_mm = floors[floors.size() / 2];
  constexpr double kSameFloor_mm = 0.3;
  std::vector<double> depths, widths, rises;
  for (const Slice& slice : slices) {
    if (std::abs(slice.floor_mm - floor_mm) > kSameFloor_mm) continue;
    depths.push_back(slice.top_mm - slice.floor_mm);
    const double depth_mm = depths.back();
    const double low = width_mm(is, {slice.x_mm, 0.0, slice.floor_mm + 0.3 * depth_mm});
    const double middle = width_mm(is, {slice.x_mm, 0.0, slice.floor_mm + 0.5 * depth_mm});
    const double high = width_mm(is, {slice.x_mm, 0.0, slice.floor_mm + 0.7 * depth_mm});
    if (!std::isnan(middle)) widths.push_back(middle);
    if (!std::isnan(low) && !std::isnan(high)) rises.push_back((high - low) / (0.4 * depth_mm));
  }
  form.depth_mm = meanOf(depths);
  form.least_depth_mm = *std::ranges::min_element(depths), form.most_depth_mm = *std::ranges::max_element(depths);
  // The ends of a groove are round: its width is that of its middle half.
  if (!widths.empty()) {
    std::vector<double> middle(widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 4),
                               widths.end() - static_cast<std::ptrdiff_t>(widths.size() / 4));
    form.isthmus_mm = meanOf(middle);
    form.least_isthmus_mm = *std::ranges::min_element(middle);
  }
  if (!rises.empty()) {
    std::ranges::nth_element(rises, rises.begin() + static_cast<std::ptrdiff_t>(rises.size() / 2));
    form.divergence_rad = 2.0 * std::atan(0.5 * rises[rises.size() / 2]);
  }
  const Slice& middle = slices[slices.size() / 2];
  const glm::dvec3 at_mm(middle.x_mm, 0.0, 0.5 * (middle.top_mm + middle.floor_mm));
  form.length_mm = is.toSolid_mm(at_mm, {1.0, 0.0, 0.0}, kMost_mm) + is.toSolid_mm(at_mm, {-1.0, 0.0, 0.0}, kMost_mm);

  if (rule.box_side != 0) {
    const double side = rule.box_side;
    std::vector<Slice> box;
    for (const Slice& slice : slices)
      if (side * slice.x_mm > 0.0 && slice.floor_mm < floor_mm - kSameFloor_mm) box.push_back(slice);
    if (!box.empty()) {
      // At the rim the surface itself falls off: the middle one of its floors.
      const auto floor = box.begin() + static_cast<std::ptrdiff_t>(box.size() / 2);
      std::ranges::nth_element(box, floor, {}, &Slice::floor_mm);
      form.box_height_mm = floor->floor_mm;
      const double half_mm = 0.5 * (floor->floor_mm + floor_mm);
      const glm::dvec3 outside(side * (crown.reach_mm + 0.5), 0.0, half_mm), inwards(-side, 0.0, 0.0);
      form.box_axial_mm = is.toSolid_mm(outside, inwards, kMost_mm) - was.toSolid_mm(outside, inwards, kMost_mm);
      // Half of its depth from the axial wall, whose angles are round.
      const auto inner = std::ranges::min_element(box, {}, [&](const Slice& slice) { return side * slice.x_mm; });
      form.box_width_mm = width_mm(is, {inner->x_mm + 0.5 * side * rule.box_axial_mm, 0.0, half_mm});
    }
  }

  const double spacing_mm = made.grid().spacing_mm;
  forPreparedSurface(crown, made, made, [&](const SurfacePlace& place) {
    if (assets::Tissue{crown.label.voxel(place.voxel)} != assets::Tissue::enamel) return;
    for (double mm = spacing_mm; mm <= kBehind_mm; mm += spacing_mm) {
      const glm::ivec3 ijk(glm::floor(made.grid().indexFromPoint(place.p_P_mm - mm * place.out_P) + 0.5));
      if (assets::Tissue{crown.label.voxel(ijk)} == assets::Tissue::dentine && made.voxel(ijk) >= 128) return;
    }
    form.unsupported_mm2 += place.area_mm2;
  });
  return form;
}

}  // namespace app
