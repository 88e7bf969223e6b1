#include "app/rehearsal/loose_site.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "app/procedure/debris/suction_tip.h"

namespace app {
namespace {

/// Of the tool in the hand; none: it is no suction.
std::optional<SuctionTip> suctionOf(const haptics::Tick& tick, const haptics::Command& command) {
  if (command.tool.hand_instrument != haptics::HandInstrument::suction) return {};
  const glm::dvec3 to_tip = tick.heldRotation() * glm::dvec3(0.0, 0.0, -command.tool.head.radius_mm);
  return SuctionTip{tick.proxy_P.mm + to_tip, command.irrigating};
}

}  // namespace

LooseSite::LooseSite(const assets::Patient& patient, const haptics::Bodies& bodies,
                     const assets::SoftTissueField& soft_tissue, const glm::dvec3& down_P)
    : chips_(bodies, soft_tissue, down_P), follicle_(follicleOf(patient)), stitches_(stitchPlaces_P_mm(patient)) {}

bool LooseSite::follow(const haptics::Tick& tick, const haptics::Command& command) {
  const std::optional<SuctionTip> tip = suctionOf(tick, command);
  chips_.follow(tick, tip);
  follicle_.follow(tick, command.tool, tip);
  return out_ > 0 && stitches_.follow(tick, command.tool);
}

void LooseSite::followBone(std::span<const glm::ivec3> bricks, const haptics::Tick& newest) {
  chips_.followBone(bricks, newest);
  // A piece that is lifted leaves the follicle where it was.
  const auto out = std::ranges::count_if(newest.X_PQ, haptics::Bodies::isAside);
  const bool has_come = std::exchange(out_, out) != out;
  if ((!bricks.empty() || has_come) && out > 0)
    follicle_.letLoose([this](const glm::dvec3& p, double within_mm) { return chips_.isBare(p, within_mm); });
}

std::vector<render::Bead> LooseSite::beads() const {
  constexpr double kStitch_mm = 0.45;  // radius
  std::vector<render::Bead> beads;
  const std::vector<LooseChip>& all = chips_.chips();
  for (std::size_t n = 0; n < all.size(); ++n)
    if (all[n].state == LooseChip::State::loose)
      beads.push_back({{all[n].at_P_mm}, all[n].radius_mm, render::BeadKind::chip, n});
  for (const FollicleBlob& blob : follicle_.blobs())
    if (blob.state != FollicleBlob::State::taken)
      beads.push_back({{blob.at_P_mm}, blob.radius_mm, render::BeadKind::follicle, 0, blob.outward_P});
  if (out_ > 0)
    for (const StitchPlace& place : stitches_.places())
      beads.push_back({{place.at_P_mm}, kStitch_mm, place.is_made ? render::BeadKind::stitch : render::BeadKind::mark});
  return beads;
}

}  // namespace app
