#include "assets/segment/region_graph.h"

#include <algorithm>
#include <numeric>

namespace assets {
namespace {

constexpr double kJoin = 0.88, kRootBonus = 0.25, kCrumbBonus = 0.25, kBareEnamel = 0.04, kCrumb_mm3 = 90.0;

double scoreOf(const RegionPart& a, const RegionPart& b, double neck) {
  const double bare = std::min(a.enamel_mm3 / a.volume_mm3, b.enamel_mm3 / b.volume_mm3);
  return neck / std::min(a.peak, b.peak) + (bare < kBareEnamel ? kRootBonus : 0.0) +
         (std::min(a.volume_mm3, b.volume_mm3) < kCrumb_mm3 ? kCrumbBonus : 0.0);
}

}  // namespace

std::vector<std::int32_t> joinedParts(std::vector<RegionPart> parts, RegionNecks necks) {
  std::vector<std::int32_t> joined(parts.size());
  std::iota(joined.begin(), joined.end(), 0);
  const auto part_of = [&](std::int32_t number) -> RegionPart& { return parts[static_cast<std::size_t>(number)]; };
  for (;;) {
    double best = kJoin;
    std::pair<std::int32_t, std::int32_t> chosen{0, 0};
    for (const auto& [sides, neck] : necks)
      if (const double score = scoreOf(part_of(sides.first), part_of(sides.second), static_cast<double>(neck));
          score > best)
        best = score, chosen = sides;
    if (chosen.second == 0) return joined;

    const auto [kept, gone] = chosen;
    std::ranges::replace(joined, gone, kept);
    RegionPart& whole = part_of(kept);
    whole.peak = std::max(whole.peak, part_of(gone).peak);
    whole.volume_mm3 += part_of(gone).volume_mm3;
    whole.enamel_mm3 += part_of(gone).enamel_mm3;
    RegionNecks rest;
    for (const auto& [sides, neck] : necks) {
      const auto renamed = [kept = kept, gone = gone](std::int32_t number) { return number == gone ? kept : number; };
      const std::int32_t a = renamed(sides.first), b = renamed(sides.second);
      if (a == b) continue;
      float& known = rest[{std::min(a, b), std::max(a, b)}];
      known = std::max(known, neck);
    }
    necks = std::move(rest);
  }
}

}  // namespace assets
