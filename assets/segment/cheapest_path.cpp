#include "assets/segment/cheapest_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace assets {

std::vector<std::size_t> cheapestPath(glm::ivec3 size, std::span<const float> cost, std::span<const std::size_t> from,
                                      std::span<const std::size_t> to) {
  constexpr std::uint32_t kStart = 0xffffffff;
  struct Reached {
    float cost;
    std::uint32_t cell;
    bool operator>(const Reached& other) const { return cost != other.cost ? cost > other.cost : cell > other.cell; }
  };
  std::vector<float> least(cost.size(), std::numeric_limits<float>::infinity());
  std::vector<std::uint32_t> before(cost.size(), kStart);
  std::vector<std::uint8_t> is_goal(cost.size(), 0);
  for (const std::size_t cell : to) is_goal[cell] = 1;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  for (const std::size_t cell : from) {
    least[cell] = 0.0F;
    open.push({0.0F, static_cast<std::uint32_t>(cell)});
  }
  while (!open.empty()) {
    const Reached here = open.top();
    open.pop();
    if (here.cost > least[here.cell]) continue;
    if (is_goal[here.cell] != 0) {
      std::vector<std::size_t> path;
      for (std::uint32_t cell = here.cell; cell != kStart; cell = before[cell]) path.push_back(cell);
      std::ranges::reverse(path);
      return path;
    }
    const glm::ivec3 at = elementAt(size, here.cell);
    forVoxels(glm::max(at - 1, glm::ivec3(0)), glm::min(at + 2, size), [&](glm::ivec3 next) {
      const std::size_t n = indexIn(size, next);
      if (cost[n] <= 0.0F || n == here.cell) return;
      const float length =
          std::sqrt(static_cast<float>(std::abs(next.x - at.x) + std::abs(next.y - at.y) + std::abs(next.z - at.z)));
      const float way = here.cost + 0.5F * length * (cost[n] + cost[here.cell]);
      if (way >= least[n]) return;
      least[n] = way;
      before[n] = here.cell;
      open.push({way, static_cast<std::uint32_t>(n)});
    });
  }
  return {};
}

}  // namespace assets
