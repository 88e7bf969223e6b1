#include "app/controls/tool_ring.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "app/view/ring_shape.h"
#include "calibration/geometry/units.h"

namespace app {

void ToolRing::open(std::size_t tools, std::size_t in_hand, const glm::dvec2& at) {
  assert(tools > 0 && tools <= kMostInRing);
  tools_ = tools;
  in_hand_ = in_hand;
  middle_ = at;
  chosen_.reset();
}

void ToolRing::moveTo(const glm::dvec2& at) {
  if (!isOpen()) return;
  const glm::dvec2 off = at - middle_;
  chosen_.reset();
  if (!(glm::length(off) > kRingMiddle)) return;
  // From the top, clockwise.
  const double sector = std::atan2(off.x, -off.y) / (2.0 * calibration::kPi / static_cast<double>(tools_));
  const auto count = static_cast<long>(tools_);
  chosen_ = static_cast<std::size_t>((std::lround(sector) % count + count) % count);
}

std::optional<std::size_t> ToolRing::take() {
  const std::optional<std::size_t> taken = chosen_ != in_hand_ ? chosen_ : std::nullopt;
  cancel();
  return taken;
}

}  // namespace app
