#include "app/rehearsal/tooth_follower.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

namespace app {
namespace {

/// The thinnest bridge of the largest piece; null: it is not cut through to one.
const haptics::Bridge* thinnestBridge(const haptics::ToothFindings& findings) {
  const haptics::ToothFindings::Held& held = findings.held[0];
  if (findings.pieces == 0 || held.parts < 2 || held.bridges == 0) return nullptr;
  const auto last = held.bridge.begin() + static_cast<std::ptrdiff_t>(std::min(held.bridges, held.bridge.size()));
  return &*std::min_element(held.bridge.begin(), last, [](const haptics::Bridge& a, const haptics::Bridge& b) {
    return a.thickness_mm < b.thickness_mm;
  });
}

std::string bridgeText(const haptics::Bridge& bridge) {
  return fmt::format("a bridge of {:.1f} mm², {:.1f} mm thick", bridge.area_mm2, bridge.thickness_mm);
}

}  // namespace

std::string toothText(const haptics::ToothFindings& findings) {
  if (findings.pieces >= 2) {
    std::string words = fmt::format("in {} pieces, ", findings.pieces);
    const std::size_t listed = std::min(findings.pieces, haptics::kMostPieces);
    for (std::size_t n = 0; n < listed; ++n)
      words += fmt::format("{}{:.0f}", n == 0 ? "" : n + 1 == listed ? " and " : ", ", findings.piece[n].volume_mm3);
    return words + " mm³";
  }
  const haptics::Bridge* const bridge = thinnestBridge(findings);
  return bridge == nullptr ? "" : "held by " + bridgeText(*bridge);
}

ToothFollower::ToothFollower(haptics::Bodies& bodies, std::span<const std::uint8_t> whole) : bodies_(bodies) {
  if (bodies.pieces() == 0) return;
  const haptics::CarvedBone& tooth = bodies.bones()[1];
  const std::vector<std::uint8_t> now = tooth.solidInGridOrder();
  watch_ = std::make_unique<TeethWatch>(tooth.grid(), whole.size() == now.size() ? whole : std::span(now));
  if (whole.size() == now.size()) giveAll(0);
}

void ToothFollower::giveAll(std::uint64_t bone_digest) {
  const haptics::CarvedBone& tooth = bodies_.bones()[1];
  assets::forVoxels(glm::ivec3(0), tooth.grid().bricks(), [&](glm::ivec3 brick) {
    TeethWatch::Brick bytes{};
    tooth.copyBrick(brick, bytes);
    watch_->give(brick, bytes, bone_digest);
  });
}

void ToothFollower::follow(std::span<const glm::ivec3> bricks, std::uint64_t bone_digest) {
  if (!watch_) return;
  for (const glm::ivec3& brick : bricks) {
    const auto own = bodies_.brickOfPiece(0, brick);
    if (!own) continue;
    TeethWatch::Brick bytes{};
    bodies_.bones()[1].copyBrick(*own, bytes);
    watch_->give(*own, bytes, bone_digest);
  }
}

std::optional<std::string> ToothFollower::news() {
  if (!watch_) return {};
  const TeethWatch::Report& report = watch_->newest();
  if (report.serial == looks_) return {};
  looks_ = report.serial;
  const haptics::ToothFindings& found = report.findings;
  const bool more = found.pieces > pieces_told_, fewer = found.pieces < pieces_told_;
  pieces_told_ = std::max<std::size_t>(1, found.pieces);
  if (more) return "the tooth is " + toothText(found);
  if (fewer && found.pieces == 1) return "the tooth is in one piece again";
  const haptics::Bridge* const bridge = report.has_bridges && found.pieces == 1 ? thinnestBridge(found) : nullptr;
  if (bridge == nullptr) return {};
  const int below_mm = static_cast<int>(std::ceil(std::min(bridge->thickness_mm, 4.0)));
  const bool thinner = below_mm < bridge_told_mm_;
  bridge_told_mm_ = below_mm;
  return thinner ? std::optional("the tooth is held by " + bridgeText(*bridge)) : std::nullopt;
}

std::string ToothFollower::ending() {
  if (!watch_) return "";
  giveAll(bodies_.digest());
  watch_->settle();
  return toothText(watch_->newest().findings);
}

}  // namespace app
