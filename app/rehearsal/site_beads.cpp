#include "app/rehearsal/site_beads.h"

namespace app {

std::optional<SuctionTip> suctionOf(const haptics::Tick& tick, const haptics::Command& command) {
  if (command.tool.hand_instrument != haptics::HandInstrument::suction) return {};
  const glm::dvec3 to_tip = tick.heldRotation() * glm::dvec3(0.0, 0.0, -command.tool.head.radius_mm);
  return SuctionTip{tick.proxy_P.mm + to_tip, command.irrigating};
}

std::vector<render::Bead> siteBeads(const LooseChips& chips, const Follicle& follicle, const Stitches* stitches) {
  constexpr double kStitch_mm = 0.45;  // radius
  std::vector<render::Bead> beads;
  const std::vector<LooseChip>& all = chips.chips();
  for (std::size_t n = 0; n < all.size(); ++n)
    if (all[n].state == LooseChip::State::loose)
      beads.push_back({{all[n].at_P_mm}, all[n].radius_mm, render::BeadKind::chip, n});
  for (const FollicleBlob& blob : follicle.blobs())
    if (blob.state != FollicleBlob::State::taken)
      beads.push_back({{blob.at_P_mm}, blob.radius_mm, render::BeadKind::follicle, 0, blob.outward_P});
  if (stitches != nullptr)
    for (const StitchPlace& place : stitches->places())
      beads.push_back({{place.at_P_mm}, kStitch_mm, place.is_made ? render::BeadKind::stitch : render::BeadKind::mark});
  return beads;
}

}  // namespace app
