#include "assets/segment/flooding.h"

#include <algorithm>

namespace assets {

void flood(glm::ivec3 size, std::span<const std::uint16_t> level, std::span<const std::uint8_t> may_flood,
           std::vector<std::uint8_t>& label) {
  std::vector<std::vector<std::uint32_t>> queues(std::size_t{*std::ranges::max_element(level)} + 1);
  const auto wait = [&](std::size_t from, std::size_t lowest) {
    forNeighbours(size, from, [&](std::size_t next) {
      if (label[next] != 0 || may_flood[next] == 0) return;
      label[next] = label[from];
      queues[std::max<std::size_t>(lowest, level[next])].push_back(static_cast<std::uint32_t>(next));
    });
  };
  // The first cells themselves, so that a label reaches its neighbours only when their level comes.
  for (std::size_t cell = 0; cell < label.size(); ++cell)
    if (label[cell] != 0 && may_flood[cell] != 0) queues[level[cell]].push_back(static_cast<std::uint32_t>(cell));
  for (std::size_t at = 0; at < queues.size(); ++at) {
    for (std::size_t n = 0; n < queues[at].size(); ++n) wait(queues[at][n], at);
    std::vector<std::uint32_t>().swap(queues[at]);
  }
}

}  // namespace assets
