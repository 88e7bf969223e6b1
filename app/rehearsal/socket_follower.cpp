#include "app/rehearsal/socket_follower.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

namespace app {
namespace {

constexpr double kRestMark_mm = 0.6;  ///< radius
constexpr double kBetweenEvents_s = 1.0;

Amount amountOf(const std::vector<const LooseChip*>& chips) {
  Amount amount;
  for (const LooseChip* const chip : chips) ++amount.count, amount.mm3 += chip->chip.volume_mm3;
  return amount;
}

}  // namespace

SocketFollower::SocketFollower(const RehearsalPlan& plan, const haptics::Bodies& bodies, EventLog& event_log)
    : event_log_(event_log), desk_(bodies), loose_(plan.patient, bodies, plan.soft_tissue, plan.gravity_P()) {
  if (bodies.pieces() == 0 || !plan.patient.site || plan.patient.ct.label.empty()) return;
  watch_.emplace(plan.patient, plan.scanned_solid.empty() ? plan.patient.ct.solid : plan.scanned_solid, bodies);
}

void SocketFollower::follow(std::span<const haptics::Tick> ticks, const haptics::Command& command) {
  for (const haptics::Tick& tick : ticks) {
    if (!loose_.follow(tick, command)) continue;
    news_ = fmt::format("stitch {} of {}", loose_.stitches().made(), loose_.stitches().places().size());
    event_log_.note("stitch", news_);
  }
}

std::optional<haptics::ChipOrder> SocketFollower::follow(const Frame& frame) {
  const auto order = desk_.follow(frame.bricks, frame.newest, frame.is_applied, frame.waits);
  loose_.followBone(frame.bricks, frame.newest);
  if (const haptics::ChipPlan* const loosened = desk_.takeLoosened()) loose_.loosen(*loosened, frame.newest);
  if (watch_) watch_->follow(frame.bricks, frame.newest, frame.waits);
  tell(frame.newest.t_s, false);
  return order;
}

void SocketFollower::finish(std::span<const glm::ivec3> bricks, const haptics::Tick& newest) {
  loose_.followBone(bricks, newest);
  if (watch_) watch_->finish(bricks, newest);
  tell(newest.t_s, true);
}

std::optional<SocketRecord> SocketFollower::record() const {
  SocketRecord record;
  if (watch_ && watch_->newest())
    record = watch_->newest()->record;
  else
    record.is_out = false;
  const std::vector<const LooseChip*> left = loose_.chips().left();
  record.chips = amountOf(left);
  if (record.is_out) {
    record.stitches = loose_.stitches().made();
    record.stitch_places = static_cast<int>(loose_.stitches().places().size());
  }
  record.follicle_left = loose_.follicle().left();
  record.chips_taken = amountOf(loose_.chips().taken());
  for (const LooseChip* const chip : left) record.chip_places.push_back({chip->chip.volume_mm3, chip->at_P_mm});
  std::ranges::stable_sort(record.chip_places, std::greater{}, &Place::amount);
  if (record.chip_places.size() > kMostPlaces) record.chip_places.resize(kMostPlaces);
  if (!record.is_out && record.chips.count + record.chips_taken.count == 0) return {};
  return record;
}

void SocketFollower::tell(double t_s, bool is_last) {
  if (!is_last && told_s_ && t_s - *told_s_ < kBetweenEvents_s) return;
  const std::optional<SocketRecord> now = record();
  told_s_ = t_s;
  if (told_ == now) return;
  told_ = now;
  // Put back by an undo: the recording must not keep what it was.
  event_log_.note(kSocketEvent, told_ ? socketText(*told_) : "nothing is out or loose");
}

bool SocketFollower::isAnyOut() const { return watch_ && watch_->newest(); }

std::optional<std::string> SocketFollower::news() {
  if (news_.empty()) return {};
  return std::exchange(news_, {});
}

std::string SocketFollower::line() const {
  const std::string words = told_ ? socketInWords(*told_) : "";
  return words.empty() ? words : told_->is_out ? "socket " + words : words;
}

SiteLeft SocketFollower::left() const {
  SiteLeft left;
  for (const LooseChip* const chip : loose_.chips().left())
    if (chip->chip.volume_mm3 >= kDust_mm3) left.chips_P_mm.push_back(chip->at_P_mm);
  for (const FollicleBlob& blob : loose_.follicle().blobs()) {
    if (blob.state == FollicleBlob::State::stuck) left.stuck_P_mm.push_back(blob.at_P_mm);
    if (blob.state == FollicleBlob::State::loose) left.loose_P_mm.push_back(blob.at_P_mm);
  }
  if (watch_ && watch_->newest()) left.edges = watch_->newest()->edges;
  for (const StitchPlace& place : loose_.stitches().places())
    if (!place.is_made) left.stitches_P_mm.push_back(place.at_P_mm);
  return left;
}

std::vector<render::Bead> SocketFollower::beads() const {
  std::vector<render::Bead> beads = loose_.beads();
  if (!isAnyOut()) return beads;
  for (const SharpEdge& edge : watch_->newest()->edges)
    for (const glm::dvec3& p : edge.points_P_mm) beads.push_back(edgeMark(p));
  for (const Place& rest : watch_->newest()->record.retained)
    beads.push_back({{rest.centre_P_mm}, kRestMark_mm, render::BeadKind::mark});
  return beads;
}

}  // namespace app
