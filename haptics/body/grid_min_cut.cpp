#include "haptics/body/grid_min_cut.h"

#include <algorithm>
#include <cassert>

namespace haptics {
namespace {

std::size_t moved(std::size_t cell, std::ptrdiff_t step) {
  return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(cell) + step);
}

}  // namespace

GridMinCut::GridMinCut(glm::ivec3 size)
    : padded_(size + 2),
      capacity_(assets::countIn(padded_)),
      level_(capacity_.size(), 0),
      next_(capacity_.size(), 0),
      is_sink_(capacity_.size(), 0) {
  const std::ptrdiff_t row = padded_.x, layer = row * padded_.y;
  step_ = {1, -1, row, -row, layer, -layer};
}

void GridMinCut::link(glm::ivec3 cell, int axis, std::uint16_t capacity) {
  const std::size_t from = at(cell), forward = 2 * static_cast<std::size_t>(axis);
  const std::size_t to = moved(from, step_[forward]);
  assert(capacity < 0x8000);
  capacity_[from][forward] = capacity;
  capacity_[to][forward + 1] = capacity;
}

/// Breadth first from the sources: level 1 and up; 0 is not reached. False: no sink is reached.
bool GridMinCut::numberLevels(const std::vector<std::size_t>& sources) {
  std::ranges::fill(level_, 0);
  queue_.assign(sources.begin(), sources.end());
  for (const std::size_t source : sources) level_[source] = 1;
  std::int32_t sink_level = 0;
  for (std::size_t head = 0; head < queue_.size(); ++head) {
    const std::size_t cell = queue_[head];
    if (sink_level != 0 && level_[cell] >= sink_level) break;
    if (is_sink_[cell] != 0) {
      sink_level = level_[cell];
      continue;
    }
    for (std::size_t way = 0; way < 6; ++way) {
      if (left_[cell][way] == 0) continue;
      const std::size_t to = moved(cell, step_[way]);
      if (level_[to] != 0) continue;
      level_[to] = level_[cell] + 1;
      queue_.push_back(to);
    }
  }
  return sink_level != 0;
}

/// All shortest paths that begin at this source, depth first.
std::int64_t GridMinCut::augmentFrom(std::size_t source) {
  std::int64_t flow = 0;
  path_.clear();
  std::size_t cell = source;
  for (;;) {
    if (is_sink_[cell] != 0) {
      std::uint16_t least = 0xffff;
      for (const Edge& edge : path_) least = std::min(least, left_[edge.from][edge.direction]);
      std::size_t first_full = path_.size();
      for (std::size_t n = path_.size(); n-- > 0;) {
        const Edge& edge = path_[n];
        const std::size_t way = edge.direction;
        left_[edge.from][way] = static_cast<std::uint16_t>(left_[edge.from][way] - least);
        std::uint16_t& back = left_[moved(edge.from, step_[way])][way ^ 1u];
        back = static_cast<std::uint16_t>(back + least);
        if (left_[edge.from][way] == 0) first_full = n;
      }
      flow += least;
      // On from the start of the first link that is full.
      cell = path_[first_full].from;
      path_.resize(first_full);
      continue;
    }
    std::uint8_t& way = next_[cell];
    while (way < 6 && (left_[cell][way] == 0 || level_[moved(cell, step_[way])] != level_[cell] + 1)) ++way;
    if (way < 6) {
      path_.push_back({cell, way});
      cell = moved(cell, step_[way]);
      continue;
    }
    if (path_.empty()) return flow;
    cell = path_.back().from;
    path_.pop_back();
    ++next_[cell];
  }
}

std::int64_t GridMinCut::cut(const std::vector<glm::ivec3>& sources, const std::vector<glm::ivec3>& sinks) {
  left_ = capacity_;
  std::ranges::fill(is_sink_, std::uint8_t{0});
  for (const glm::ivec3 sink : sinks) is_sink_[at(sink)] = 1;
  std::vector<std::size_t> starts;
  for (const glm::ivec3 source : sources) {
    starts.push_back(at(source));
    assert(is_sink_[starts.back()] == 0);
  }
  std::int64_t flow = 0;
  while (numberLevels(starts)) {
    std::ranges::fill(next_, std::uint8_t{0});
    for (const std::size_t source : starts) flow += augmentFrom(source);
  }
  return flow;
}

}  // namespace haptics
