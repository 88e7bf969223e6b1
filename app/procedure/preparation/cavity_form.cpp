#include "app/procedure/preparation/cavity_form.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "app/procedure/preparation/made_surface.h"
#include "assets/prepared_tooth.h"

namespace app {
namespace {

constexpr double kReach_mm = 7.0, kCut_mm = 0.2, kAlong_mm = 0.1, kMost_mm = 8.0;
constexpr double kBehind_mm = 1.5;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The tooth's frame turned so that the groove runs along x through its origin.
assets::ToothFrame alongGroove(const assets::ToothFrame& frame, const IdealRule& rule) {
  const double c = std::cos(rule.groove_rad), s = std::sin(rule.groove_rad);
  assets::ToothFrame along = frame;
  along.cervix_P_mm = frame.inP({rule.groove_mm, 0.0});
  along.axes_P[0] = c * frame.axes_P[0] + s * frame.axes_P[1];
  along.axes_P[1] = c * frame.axes_P[1] - s * frame.axes_P[0];
  return along;
}

/// Ways through the solid in the groove's frame.
class Probe {
 public:
  Probe(const Crown& crown, const BoxBytes& solid, const assets::ToothFrame& frame)
      : crown_(crown), solid_(solid), frame_(frame) {}

  /// To where solid begins; none within `most_mm`, or a neighbour before.
  double toSolid_mm(const glm::dvec3& from_mm, const glm::dvec3& way, double most_mm) const {
    const double step_mm = 0.5 * solid_.grid().spacing_mm, half_mm = wallReach_mm(solid_.grid());
    for (double mm = 0.0; mm <= most_mm; mm += step_mm) {
      const glm::dvec3 p_P = frame_.inP(from_mm + mm * way);
      if (crown_.label.nearest(p_P) == static_cast<std::uint8_t>(assets::Tissue::other_teeth)) return kNone;
      if (solid_.nearest(p_P) < 128) continue;
      const glm::dvec3 low_P = frame_.inP(from_mm + (mm - half_mm) * way);
      return mm + half_mm - solid_.solidBetween_mm(low_P, frame_.axes_P * way, 2.0 * half_mm);
    }
    return kNone;
  }

 private:
  const Crown& crown_;
  const BoxBytes& solid_;
  const assets::ToothFrame& frame_;
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

/// What an ideal takes, seen from the bite: places and heights of its floors.
struct TakenPlace {
  glm::dvec2 at_mm;
  double floor_mm;
};
std::vector<TakenPlace> takenPlaces(const Crown& crown, const BoxBytes& ideal) {
  constexpr double kTaken_mm = 0.3;
  const OcclusalMap had(crown), left(crown, ideal);
  std::vector<TakenPlace> places;
  for (double y = -kReach_mm; y <= kReach_mm; y += kAlong_mm)
    for (double x = -kReach_mm; x <= kReach_mm; x += kAlong_mm) {
      const double was_mm = had.at({x, y});
      if (was_mm == static_cast<double>(OcclusalMap::kNone)) continue;
      const double is_mm = std::max(0.0, left.at({x, y}));
      if (was_mm - is_mm > kTaken_mm) places.push_back({{x, y}, is_mm});
    }
  return places;
}

}  // namespace

std::optional<IdealRule> cavityRuleOf(const Crown& crown, const BoxBytes& ideal) {
  constexpr double kSameFloor_mm = 0.3, kLongish = 1.3, kLeastDepth_mm = 0.5, kLeastWidth_mm = 0.3, kLeastBox_mm2 = 0.5;
  std::vector<TakenPlace> taken = takenPlaces(crown, ideal);
  if (taken.empty()) return {};
  const auto middle = taken.begin() + static_cast<std::ptrdiff_t>(taken.size() / 2);
  std::ranges::nth_element(taken, middle, {}, &TakenPlace::floor_mm);
  const double floor_mm = middle->floor_mm;
  // Middle and direction of the groove: of all places at its floor.
  double count = 0.0;
  glm::dvec2 sum(0.0);
  for (const TakenPlace& one : taken)
    if (std::abs(one.floor_mm - floor_mm) < kSameFloor_mm) sum += one.at_mm, count += 1.0;
  IdealRule rule{.name = assets::kGivenIdeal, .for_people = "an ideal from a file", .kind = IdealKind::cavity};
  rule.groove_mm = sum / count;
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (const TakenPlace& one : taken)
    if (std::abs(one.floor_mm - floor_mm) < kSameFloor_mm) {
      const glm::dvec2 off = one.at_mm - rule.groove_mm;
      xx += off.x * off.x, yy += off.y * off.y, xy += off.x * off.y;
    }
  const double half = 0.5 * (xx + yy), apart = std::hypot(0.5 * (xx - yy), xy);
  if (half + apart > kLongish * kLongish * (half - apart)) rule.groove_rad = 0.5 * std::atan2(2.0 * xy, xx - yy);
  // A box lies lower, at one end.
  const glm::dvec2 along(std::cos(rule.groove_rad), std::sin(rule.groove_rad));
  double mesial_mm2 = 0.0, distal_mm2 = 0.0;
  for (const TakenPlace& one : taken)
    if (one.floor_mm < floor_mm - kSameFloor_mm)
      (glm::dot(one.at_mm - rule.groove_mm, along) > 0.0 ? mesial_mm2 : distal_mm2) += kAlong_mm * kAlong_mm;
  if (std::max(mesial_mm2, distal_mm2) > kLeastBox_mm2) rule.box_side = mesial_mm2 > distal_mm2 ? 1 : -1;

  CavityForm form = cavityForm(crown, ideal, rule);
  if (!(form.depth_mm >= kLeastDepth_mm && form.isthmus_mm >= kLeastWidth_mm)) return {};
  rule.depth_mm = form.depth_mm, rule.isthmus_mm = form.isthmus_mm;
  if (rule.box_side == 0) return rule;
  // Its width is measured half of its depth from its wall: once that is known.
  rule.box_axial_mm = form.box_axial_mm;
  form = cavityForm(crown, ideal, rule);
  rule.box_mm = form.box_width_mm, rule.box_height_mm = form.box_height_mm;
  if (!(rule.box_axial_mm > kLeastWidth_mm && rule.box_mm > kLeastWidth_mm)) rule.box_side = 0;
  return rule;
}

CavityForm cavityForm(const Crown& crown, const BoxBytes& made, const IdealRule& rule) {
  CavityForm form;
  const assets::ToothFrame frame = alongGroove(crown.frame, rule);
  const Probe was(crown, crown.solid, frame), is(crown, made, frame);
  const OcclusalMap top(crown);
  std::vector<Slice> slices;
  for (double x = -kReach_mm; x <= kReach_mm; x += kAlong_mm) {
    const double top_mm = top.at(glm::dvec2(crown.frame.local(frame.inP({x, 0.0, 0.0}))));
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
      const glm::dvec3 outside(side * (crown.reach_mm + glm::length(rule.groove_mm) + 0.5), 0.0, half_mm),
          inwards(-side, 0.0, 0.0);
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
