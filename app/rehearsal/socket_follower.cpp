#include "app/rehearsal/socket_follower.h"

namespace app {
namespace {

constexpr double kEdgeMark_mm = 0.18, kRestMark_mm = 0.6;  ///< radii

std::vector<render::Bead> marksOf(const SocketFindings& found) {
  std::vector<render::Bead> marks;
  for (const SharpEdge& edge : found.edges)
    for (const glm::dvec3& p : edge.points_P_mm) marks.push_back({{p}, kEdgeMark_mm, render::BeadKind::mark});
  for (const Place& rest : found.record.retained)
    marks.push_back({{rest.centre_P_mm}, kRestMark_mm, render::BeadKind::mark});
  return marks;
}

}  // namespace

SocketFollower::SocketFollower(const RehearsalPlan& plan, const haptics::Bodies& bodies, EventLog& event_log)
    : event_log_(event_log) {
  if (bodies.pieces() == 0 || !plan.patient.site || plan.patient.ct.label.empty()) return;
  watch_.emplace(plan.patient, plan.scanned_solid.empty() ? plan.patient.ct.solid : plan.scanned_solid, bodies);
}

void SocketFollower::follow(std::span<const glm::ivec3> bricks, const haptics::Tick& newest, bool waits) {
  if (!watch_) return;
  watch_->follow(bricks, newest, waits);
  tell();
}

void SocketFollower::finish(std::span<const glm::ivec3> bricks, const haptics::Tick& newest) {
  if (!watch_) return;
  watch_->finish(bricks, newest);
  tell();
}

void SocketFollower::tell() {
  const std::optional<SocketFindings>& found = watch_->newest();
  if (!found) {
    // Put back by an undo: the recording must not keep what it was.
    if (told_) event_log_.note(kSocketEvent, "no piece is out");
    told_.reset();
    marks_.clear();
    return;
  }
  if (told_ == found->record) return;
  told_ = found->record;
  marks_ = marksOf(*found);
  event_log_.note(kSocketEvent, socketText(*told_));
}

std::string SocketFollower::line() const { return told_ ? "socket " + socketInWords(*told_) : std::string(); }

}  // namespace app
