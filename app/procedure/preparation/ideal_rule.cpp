#include "app/procedure/preparation/ideal_rule.h"

#include <algorithm>
#include <array>
#include <numbers>

#include <fmt/core.h>

#include "app/text/list.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr double kSix_rad = 6.0 * std::numbers::pi / 180.0;

constexpr std::array<IdealRule, 6> kRules{{
    {.name = "crown:all-ceramic",
     .for_people = "all-ceramic crown, lithium disilicate",
     .occlusal_mm = 1.5,
     .margin_mm = 1.0,
     .half_angle_rad = kSix_rad},
    {.name = "crown:zirconia",
     .for_people = "all-ceramic crown, zirconia",
     .occlusal_mm = 1.2,
     .margin_mm = 0.5,
     .half_angle_rad = kSix_rad},
    {.name = "crown:metal-ceramic",
     .for_people = "metal-ceramic crown",
     .occlusal_mm = 2.0,
     .margin_mm = 1.2,
     .half_angle_rad = kSix_rad},
    {.name = "class-1", .for_people = "class I cavity", .kind = IdealKind::cavity},
    {.name = "class-2:mesial", .for_people = "class II cavity, mesial", .kind = IdealKind::cavity, .box_side = 1},
    {.name = "class-2:distal", .for_people = "class II cavity, distal", .kind = IdealKind::cavity, .box_side = -1},
}};

}  // namespace

std::span<const IdealRule> idealRules() { return kRules; }

const IdealRule& idealRule(std::string_view name, const std::string& option) {
  const auto found = std::ranges::find(kRules, name, &IdealRule::name);
  if (found == kRules.end())
    throw UsageError(fmt::format("{} {}: no such preparation, give {}", option, name,
                                 joined(kRules, [](const IdealRule& rule) { return std::string(rule.name); })));
  return *found;
}

}  // namespace app
