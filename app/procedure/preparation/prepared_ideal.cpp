#include "app/procedure/preparation/prepared_ideal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "app/procedure/preparation/stump_walls.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

static_assert(PreparedIdeal::kAround == StumpWalls::kAround);

constexpr double kFar_mm = 100.0;
constexpr double kLeastStump_mm = 1.0, kLeastCrown_mm = 3.0;
constexpr double kGrooveRound_mm = 0.3, kBoxRound_mm = 0.5;
constexpr double kMarginZone_mm = 0.4;
constexpr double kWellBelow_mm = 0.5;  ///< the margin: more than a voxel

/// Depth into both of two solids that meet at an edge of a radius.
double bothRound(double a, double b, double radius) {
  const double u = std::max(radius - a, 0.0), v = std::max(radius - b, 0.0);
  return std::max(radius, std::min(a, b)) - std::hypot(u, v);
}
double eitherRound(double a, double b, double radius) { return -bothRound(-a, -b, radius); }

double smallest(const std::array<double, PreparedIdeal::kAround>& values) { return *std::ranges::min_element(values); }

}  // namespace

std::string_view nameOf(PreparedZone zone) {
  constexpr std::array<std::string_view, kPreparedZones> kNames{"occlusal", "axial", "margin"};
  return kNames[static_cast<std::size_t>(zone)];
}

OcclusalMap::OcclusalMap(const Crown& crown, const BoxBytes& solid)
    : height_mm_(static_cast<std::size_t>(kSide) * kSide, kNone) {
  const double step_mm = 0.5 * solid.grid().spacing_mm, half_mm = wallReach_mm(solid.grid());
  const glm::dvec3& up_P = crown.frame.axes_P[2];
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const glm::dvec2 at(x * kStep_mm - kHalf_mm, y * kStep_mm - kHalf_mm);
      if (glm::length(at) > crown.reach_mm + kStep_mm) continue;
      for (double z = crown.top_mm + 4.0 * step_mm; z > 0.0; z -= step_mm) {
        const glm::dvec3 p_P = crown.frame.inP({at, z});
        if (solid.nearest(p_P) < 128 || !crown.isTooth(p_P)) continue;
        const double low_mm = z - half_mm;
        cell(x, y) =
            static_cast<float>(low_mm + solid.solidBetween_mm(crown.frame.inP({at, low_mm}), up_P, 2.0 * half_mm));
        break;
      }
    }
}

OcclusalMap OcclusalMap::lowered(double radius_mm) const {
  OcclusalMap bites = *this, map = *this;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      if (isSteep(x, y)) bites.cell(x, y) = kNone;
  const int reach = static_cast<int>(radius_mm / kStep_mm);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      if (cell(x, y) == kNone) continue;
      float least = cell(x, y);
      for (int b = std::max(0, y - reach); b <= std::min(kSide - 1, y + reach); ++b)
        for (int a = std::max(0, x - reach); a <= std::min(kSide - 1, x + reach); ++a) {
          const double off_mm = kStep_mm * std::hypot(a - x, b - y);
          if (off_mm > radius_mm || bites.cell(a, b) == kNone) continue;
          least = std::min(least,
                           bites.cell(a, b) - static_cast<float>(std::sqrt(radius_mm * radius_mm - off_mm * off_mm)));
        }
      map.cell(x, y) = least;
    }
  return map;
}

bool OcclusalMap::isSteep(int x, int y) const {
  constexpr double kSteepest = 2.14;  // of 65 degrees
  if (x == 0 || y == 0 || x + 1 == kSide || y + 1 == kSide) return true;
  const float here = cell(x, y);
  const std::array<float, 4> beside{cell(x - 1, y), cell(x + 1, y), cell(x, y - 1), cell(x, y + 1)};
  return std::ranges::any_of(beside, [&](float one) {
    return one == kNone || std::abs(static_cast<double>(one - here)) > kSteepest * kStep_mm;
  });
}

double OcclusalMap::at(const glm::dvec2& p_mm) const {
  const glm::dvec2 index = glm::clamp((p_mm + kHalf_mm) / kStep_mm, glm::dvec2(0.0), glm::dvec2(kSide - 1.001));
  const int x = static_cast<int>(index.x), y = static_cast<int>(index.y);
  const double u = index.x - x, v = index.y - y;
  const float a = cell(x, y), b = cell(x + 1, y), c = cell(x, y + 1), d = cell(x + 1, y + 1);
  if (std::min(std::min(a, b), std::min(c, d)) == kNone) {
    // At the rim the nearest place.
    return static_cast<double>(v < 0.5 ? (u < 0.5 ? a : b) : (u < 0.5 ? c : d));
  }
  return glm::mix(glm::mix(static_cast<double>(a), static_cast<double>(b), u),
                  glm::mix(static_cast<double>(c), static_cast<double>(d), u), v);
}

double OcclusalMap::steepness(const glm::dvec2& p_mm) const {
  const double east = at(p_mm + glm::dvec2(kStep_mm, 0.0)), west = at(p_mm - glm::dvec2(kStep_mm, 0.0));
  const double north = at(p_mm + glm::dvec2(0.0, kStep_mm)), south = at(p_mm - glm::dvec2(0.0, kStep_mm));
  if (std::min(std::min(east, west), std::min(north, south)) == static_cast<double>(kNone)) return 1.0;
  return 1.0 / std::sqrt(1.0 + std::pow((east - west) / (2.0 * kStep_mm), 2) +
                         std::pow((north - south) / (2.0 * kStep_mm), 2));
}

PreparedIdeal::PreparedIdeal(const Crown& crown, const IdealRule& rule, const std::string& option)
    : rule_(rule), lowered_(crown) {
  const double top_mm = lowered_.at({0.0, 0.0});
  const auto refuse = [&](const std::string& why) {
    throw UsageError(fmt::format("{} {}: {}", option, rule.name, why));
  };
  if (top_mm < kLeastCrown_mm)
    refuse(fmt::format(
        "the middle of its biting surface lies {:.1f} mm over the cervical line, {:g} mm are needed: choose "
        "another tooth, or turn the volume",
        std::max(top_mm, 0.0), kLeastCrown_mm));
  const double at_mm = rule.kind == IdealKind::crown ? rule.margin_height_mm : 0.5 * top_mm;
  const double step_mm = crown.solid.grid().spacing_mm;
  const StumpWalls outline(crown, crown.solid, at_mm - step_mm, at_mm + step_mm);
  for (std::size_t n = 0; n < kAround; ++n) {
    outline_mm_[n] = outline.radius_mm(n, 1);
    if (std::isnan(outline_mm_[n])) refuse("the tooth is not closed around its axis, choose another");
  }
  for (std::size_t n = 0; n < kAround; ++n) square_[n] = outline.squareness(n, 1);

  if (rule.kind == IdealKind::crown) {
    const double height_mm = top_mm - rule.occlusal_mm - rule.margin_height_mm;
    const double narrowest_mm = smallest(outline_mm_) - rule.margin_mm - height_mm * std::tan(rule.half_angle_rad);
    if (height_mm < kLeastStump_mm || narrowest_mm < kLeastStump_mm)
      refuse(
          fmt::format("it would leave a stump of {:.1f} mm height and {:.1f} mm radius at its top, {:g} mm are "
                      "needed: choose another preparation",
                      height_mm, narrowest_mm, kLeastStump_mm));
    lowered_ = lowered_.lowered(rule.occlusal_mm);
    return;
  }
  floor_mm_ = top_mm - rule.depth_mm;
  length_mm_ = rule.length_share * (outline_mm_[0] + outline_mm_[kAround / 2]);
  const double reach_mm = rule.box_side > 0 ? outline_mm_[0] : outline_mm_[kAround / 2];
  box_from_mm_ = reach_mm - rule.box_axial_mm;
  const double wide_mm = outline_mm_[kAround / 4] + outline_mm_[3 * kAround / 4];
  if (floor_mm_ < rule.box_height_mm ||
      wide_mm < 2.0 * std::max(rule.isthmus_mm, rule.box_side == 0 ? 0.0 : rule.box_mm))
    refuse(
        fmt::format("it is bigger than the tooth leaves room for ({:.1f} mm wide, {:.1f} mm high): choose another "
                    "preparation",
                    wide_mm, top_mm));
}

double PreparedIdeal::wall_mm(const glm::dvec3& p_mm) const {
  const double turn = std::atan2(p_mm.y, p_mm.x) / (2.0 * std::numbers::pi) * kAround;
  const double around = turn < 0.0 ? turn + kAround : turn;
  const auto n = static_cast<std::size_t>(around) % kAround;
  const double share = around - std::floor(around);
  const double outline_mm = glm::mix(outline_mm_[n], outline_mm_[(n + 1) % kAround], share);
  const double square = glm::mix(square_[n], square_[(n + 1) % kAround], share);
  const double over_mm = std::max(0.0, p_mm.z - rule_.margin_height_mm);
  const double inside_mm = square * (outline_mm - std::hypot(p_mm.x, p_mm.y)) - rule_.margin_mm;
  return (inside_mm - over_mm * std::tan(rule_.half_angle_rad)) * std::cos(rule_.half_angle_rad);
}

double PreparedIdeal::occlusal_mm(const glm::dvec3& p_mm) const {
  const double top_mm = lowered_.at({p_mm.x, p_mm.y});
  if (top_mm == static_cast<double>(OcclusalMap::kNone)) return -kFar_mm;
  return (top_mm - p_mm.z) * lowered_.steepness({p_mm.x, p_mm.y});
}

double PreparedIdeal::crown_mm(const glm::dvec3& p_mm) const {
  const double base_mm = rule_.margin_height_mm - p_mm.z;
  if (base_mm > kWellBelow_mm) return base_mm;
  const double stump_mm = bothRound(wall_mm(p_mm), occlusal_mm(p_mm), rule_.edge_mm);
  return eitherRound(stump_mm, base_mm, std::min(rule_.fillet_mm, rule_.margin_mm));
}

double PreparedIdeal::cavity_mm(const glm::dvec3& p_mm) const {
  const double half_mm = 0.5 * length_mm_ - 0.5 * rule_.isthmus_mm;
  const double to_mm = rule_.box_side == 0 ? half_mm : box_from_mm_ + rule_.box_axial_mm;
  const double along_mm = rule_.box_side < 0 ? -p_mm.x : p_mm.x;
  const double off_mm = std::hypot(along_mm - std::clamp(along_mm, -half_mm, to_mm), p_mm.y);
  const double groove_mm = bothRound(0.5 * rule_.isthmus_mm - off_mm, p_mm.z - floor_mm_, kGrooveRound_mm);
  if (rule_.box_side == 0) return groove_mm;
  const double sides_mm = bothRound(0.5 * rule_.box_mm - std::abs(p_mm.y), along_mm - box_from_mm_, kBoxRound_mm);
  const double box_mm = bothRound(sides_mm, p_mm.z - rule_.box_height_mm, kGrooveRound_mm);
  return std::max(groove_mm, box_mm);
}

double PreparedIdeal::depth_mm(const glm::dvec3& p_mm) const {
  return rule_.kind == IdealKind::crown ? crown_mm(p_mm) : -cavity_mm(p_mm);
}

PreparedZone PreparedIdeal::zone(const glm::dvec3& p_mm) const {
  if (rule_.kind == IdealKind::cavity)
    return p_mm.z < floor_mm_ + kMarginZone_mm ? PreparedZone::occlusal : PreparedZone::axial;
  if (p_mm.z < rule_.margin_height_mm + kMarginZone_mm) return PreparedZone::margin;
  return occlusal_mm(p_mm) < wall_mm(p_mm) ? PreparedZone::occlusal : PreparedZone::axial;
}

BoxBytes PreparedIdeal::left(const Crown& crown) const {
  BoxBytes left = crown.solid;
  const assets::VolumeGrid& grid = left.grid();
  const std::span<std::uint8_t> bytes = left.bytes();
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (bytes[v] == 0 || crown.label.bytes()[v] == static_cast<std::uint8_t>(assets::Tissue::other_teeth)) return;
    const double share =
        std::clamp(0.5 + depth_mm(crown.frame.local(grid.centre_P_mm(ijk))) / grid.spacing_mm, 0.0, 1.0);
    bytes[v] = std::min(bytes[v], static_cast<std::uint8_t>(255.0 * share + 0.5));
  });
  return left;
}

}  // namespace app
