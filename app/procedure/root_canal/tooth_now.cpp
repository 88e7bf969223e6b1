#include "app/procedure/root_canal/tooth_now.h"

namespace app {

ToothNow::ToothNow(const ToothBlocks& before)
    : before_(before), blocks_(before.grid().size / kEdge), index_(assets::countIn(blocks_)) {}

FineSolid::Block ToothNow::block(glm::ivec3 block) const {
  const std::uint32_t place = index_[assets::indexIn(blocks_, block)];
  return place == 0 ? before_.block(block) : Block{bytes_[place - 1].data(), 0};
}

std::optional<std::size_t> ToothNow::set(glm::ivec3 block, const Bytes& bytes) {
  if (glm::any(glm::lessThan(block, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(block, blocks_))) return {};
  const Block is = this->block(block);
  bool is_new = false;
  for (std::size_t v = 0; v < bytes.size(); ++v) is_new = is_new || is.at(v) != bytes[v];
  if (!is_new) return {};
  std::uint32_t& place = index_[assets::indexIn(blocks_, block)];
  if (place == 0) {
    bytes_.push_back(bytes);
    told_.push_back(block);
    place = static_cast<std::uint32_t>(bytes_.size());
  } else {
    bytes_[place - 1] = bytes;
  }
  return place - 1;
}

}  // namespace app
