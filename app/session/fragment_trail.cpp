#include "app/session/fragment_trail.h"

#include <algorithm>
#include <cmath>

namespace app {

std::optional<assets::MetalFragment> brokenOff(const haptics::Tick& tick, const haptics::CanalFile& file) {
  const auto made = file.made();
  if (!(tick.file.broken_from_tip_mm > 0.0) || !made) return {};
  // As the servo has divided it (haptics/file/file_chain).
  const double link_mm = made->length_mm / static_cast<double>(haptics::kUsualLinks);
  const double break_mm = made->length_mm - tick.file.broken_from_tip_mm;
  assets::MetalFragment fragment{made->size, file.nickel_titanium, {}, {}};
  const auto& node = tick.file.node_P_mm;
  for (auto n = static_cast<std::size_t>(std::lround(break_mm / link_mm)); n < node.size(); ++n) {
    // Of a file that had broken before, the last nodes are one.
    if (!fragment.node_P_mm.empty() && glm::dvec3(node[n]) == fragment.node_P_mm.back()) break;
    fragment.node_P_mm.emplace_back(node[n]);
    fragment.radius_mm.push_back(0.5 * made->diameter_mm(made->length_mm - static_cast<double>(n) * link_mm));
  }
  if (fragment.node_P_mm.size() < 2) return {};
  return fragment;
}

bool FragmentTrail::follow(const haptics::Tick& tick, const haptics::CanalFile& file) {
  const std::size_t before = lying_;
  const auto broken = brokenOff(tick, file);
  if (broken) {
    // What was undone cannot be redone after it.
    all_.resize(lying_);
    if (all_.size() < assets::kMostMetalFragments) all_.push_back(*broken);
  }
  lying_ = std::min<std::size_t>(tick.file.fragments, all_.size());
  return broken || lying_ != before;
}

}  // namespace app
