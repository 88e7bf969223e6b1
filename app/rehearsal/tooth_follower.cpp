#include "app/rehearsal/tooth_follower.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/core.h>

#include "haptics/body/bridge_strength.h"

namespace app {
namespace {

/// Of all pieces; null: none is cut through to a bridge.
const haptics::Bridge* thinnestBridge(const haptics::ToothFindings& findings) {
  const haptics::Bridge* thinnest = nullptr;
  for (std::size_t n = 0; n < std::min(findings.pieces, haptics::kMostPieces); ++n) {
    const haptics::ToothFindings::Held& held = findings.held[n];
    for (std::size_t b = 0; held.parts > 1 && b < std::min(held.bridges, held.bridge.size()); ++b)
      if (thinnest == nullptr || held.bridge[b].thickness_mm < thinnest->thickness_mm) thinnest = &held.bridge[b];
  }
  return thinnest;
}

std::string breakText(const haptics::Bridge& bridge, double enamel_share = 0.0) {
  if (bridge.area_mm2 > haptics::kMostBreakable_mm2) return "too thick to break: cut on, do not force it";
  return fmt::format("breaks at about {:.2g} N m", 1e-3 * haptics::breakingTwist_Nmm(bridge, enamel_share));
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
  return bridge == nullptr ? "" : "held by " + bridgeText(*bridge) + ", " + breakText(*bridge);
}

ToothFollower::ToothFollower(haptics::Bodies& bodies, std::span<const std::uint8_t> whole) : bodies_(bodies) {
  if (bodies.pieces() == 0) return;
  whole_ = bodies.bones()[1].solidInGridOrder();
  if (whole.size() == whole_.size()) whole_.assign(whole.begin(), whole.end());
  watchAnew(bodies.pieces());
}

/// One piece: against the whole tooth. Several: each as it is now, what is cut from here on counts.
void ToothFollower::watchAnew(std::size_t pieces) {
  watches_.clear();
  for (std::size_t n = 0; n < pieces; ++n) {
    const haptics::CarvedBone& piece = bodies_.bones()[n + 1];
    watches_.push_back(std::make_unique<TeethWatch>(
        piece.grid(), pieces == 1 ? whole_ : piece.copyBox(glm::ivec3(0), piece.grid().size),
        piece.labelInGridOrder()));
  }
  to_arm_.assign(pieces, nullptr);
  arming_.reset();
  looks_ = 0;
  bridge_told_mm_ = 4;
  is_partial_ = true;
}

/// Bricks of the tooth's grid.
void ToothFollower::give(std::span<const glm::ivec3> bricks) {
  if (!bricks.empty()) {
    to_arm_.assign(watches_.size(), nullptr);
    arming_.reset();
  }
  for (std::size_t n = 0; n < watches_.size(); ++n)
    for (const glm::ivec3& brick : bricks) {
      TeethWatch::Brick bytes{};
      bodies_.bones()[n + 1].copyBrick(brick, bytes);
      watches_[n]->give(brick, bytes);
    }
}

void ToothFollower::giveAll() {
  std::vector<glm::ivec3> all;
  assets::forVoxels(glm::ivec3(0), bodies_.bones()[1].grid().bricks(), [&](glm::ivec3 brick) { all.push_back(brick); });
  give(all);
  is_partial_ = false;
}

/// Not while pieces part or join block by block. When they have, all is looked at anew.
bool ToothFollower::mayLook(const haptics::Tick& newest) {
  if (newest.dt_s == 0.0) return true;
  if (newest.split == haptics::SplitAnswer::running || newest.bridge == haptics::BreakAnswer::breaking ||
      newest.drill_inhibit == haptics::DrillInhibit::undo_running) {
    is_partial_ = true;
    return false;
  }
  if (newest.pieces != watches_.size()) watchAnew(newest.pieces);
  return true;
}

void ToothFollower::follow(std::span<const glm::ivec3> bricks, const haptics::Tick& newest, bool waits) {
  if (watches_.empty()) return;
  std::ranges::transform(newest.X_PQ, is_out_.begin(), haptics::Bodies::isAside);
  for (const glm::ivec3& brick : bricks)
    if (const auto own = bodies_.brickOfPiece(brick)) unseen_.push_back(*own);
  // A turning bur that grazes changes what voxels remember, if no solid yet.
  const bool is_quiet = std::exchange(quiet_at_, newest.bone_digest) == newest.bone_digest && bricks.empty();
  is_quiet_ = is_quiet;
  if ((waits && !is_quiet) || !mayLook(newest)) return;
  const bool was_partial = is_partial_;
  if (was_partial)
    giveAll();
  else
    give(unseen_);
  unseen_.clear();
  // Of a servo that runs, only what was copied a frame ago is sure.
  if (!is_quiet || (was_partial && !waits)) return;
  for (const auto& watch : watches_) watch->confirm(newest.bone_digest);
  if (waits) settle();
}

void ToothFollower::settle() {
  for (const auto& watch : watches_) watch->settle();
}

std::optional<haptics::SplitOrder> ToothFollower::order(const haptics::Tick& newest) {
  if (newest.split == haptics::SplitAnswer::waiting || newest.split == haptics::SplitAnswer::running) return {};
  for (std::size_t n = 0; n < watches_.size(); ++n) {
    const auto parting = watches_[n]->takeParting();
    if (!parting || parting->digest != newest.bone_digest) continue;
    const haptics::SplitPlan* const plan = &plans_.emplace_back(std::move(parting->plan));
    return haptics::SplitOrder{0, parting->digest, n, plan};
  }
  return {};
}

std::optional<haptics::BreakOrder> ToothFollower::bridgeOrder(const haptics::Tick& newest, bool in_hand, bool waits) {
  for (const auto& watch : watches_) watch->planBreaks(in_hand);
  // What came too early is asked again.
  if (arming_ && newest.bridge == haptics::BreakAnswer::refused) to_arm_[arming_->first] = arming_->second;
  arming_.reset();
  if (!in_hand || !is_quiet_ || newest.pieces != watches_.size()) return {};
  if (waits) settle();
  for (std::size_t n = 0; n < watches_.size(); ++n) {
    if (is_out_[n]) continue;
    if (auto plan = watches_[n]->takeBreak()) to_arm_[n] = &breaks_.emplace_back(std::move(*plan));
    const haptics::BreakPlan* const plan = std::exchange(to_arm_[n], nullptr);
    if (plan == nullptr) continue;
    arming_.emplace(n, plan);
    armed_news_ = "the " + bridgeText(plan->bridge).substr(2) + " " + breakText(plan->bridge, plan->enamel_share);
    return haptics::BreakOrder{0, newest.bone_digest, n, plan->digest, plan->bridge, plan};
  }
  return {};
}

/// Of all watches together, the largest piece first.
haptics::ToothFindings ToothFollower::found() {
  haptics::ToothFindings all;
  std::vector<std::pair<haptics::ToothPiece, haptics::ToothFindings::Held>> pieces;
  for (std::size_t piece = 0; piece < watches_.size(); ++piece) {
    const haptics::ToothFindings& own = watches_[piece]->newest().findings;
    for (std::size_t n = 0; n < std::min(own.pieces, haptics::kMostPieces); ++n)
      pieces.emplace_back(own.piece[n], is_out_[piece] ? haptics::ToothFindings::Held{} : own.held[n]);
    all.pieces += own.pieces;
    all.chips += own.chips;
    all.chips_mm3 += own.chips_mm3;
    all.cut_mm3 += own.cut_mm3;
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const auto& a, const auto& b) { return a.first.volume_mm3 > b.first.volume_mm3; });
  for (std::size_t n = 0; n < std::min(pieces.size(), haptics::kMostPieces); ++n)
    std::tie(all.piece[n], all.held[n]) = pieces[n];
  return all;
}

std::optional<std::string> ToothFollower::news() {
  if (!armed_news_.empty()) return std::exchange(armed_news_, {});
  std::uint64_t looks = 0;
  for (const auto& watch : watches_) {
    const std::uint64_t serial = watch->newest().serial;
    // All of them, or a part that was just made would seem to be missing.
    if (serial == 0) return {};
    looks += serial;
  }
  if (looks == looks_) return {};
  looks_ = looks;
  const haptics::ToothFindings all = found();
  const bool more = all.pieces > pieces_told_, fewer = all.pieces < pieces_told_;
  pieces_told_ = std::max<std::size_t>(1, all.pieces);
  if (more) return "the tooth is " + toothText(all);
  if (fewer && all.pieces == 1) return "the tooth is in one piece again";
  const haptics::Bridge* const bridge = thinnestBridge(all);
  const bool are_bridges_known =
      std::all_of(watches_.begin(), watches_.end(), [](const auto& watch) { return watch->newest().has_bridges; });
  if (bridge == nullptr || !are_bridges_known) return {};
  const int below_mm = static_cast<int>(std::ceil(std::min(bridge->thickness_mm, 4.0)));
  const bool thinner = below_mm < bridge_told_mm_;
  bridge_told_mm_ = below_mm;
  const std::string what = all.pieces > 1 ? "a piece of the tooth" : "the tooth";
  if (!thinner) return {};
  return what + " is held by " + bridgeText(*bridge) + ", " + breakText(*bridge);
}

std::optional<double> ToothFollower::bridge_mm() {
  const haptics::ToothFindings all = found();
  const haptics::Bridge* const bridge = thinnestBridge(all);
  return bridge == nullptr ? std::nullopt : std::optional(bridge->thickness_mm);
}

std::string ToothFollower::ending() {
  if (watches_.empty()) return "";
  if (bodies_.pieces() != watches_.size()) watchAnew(bodies_.pieces());
  giveAll();
  settle();
  return toothText(found());
}

}  // namespace app
