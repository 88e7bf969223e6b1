#include "app/review/session_marks.h"

#include <algorithm>

#include "app/options/bur_name.h"
#include "app/session/coach_event.h"
#include "app/session/step_event.h"
#include "app/session/touch_event.h"

namespace app {
namespace {

constexpr double kUndoPause_s = 1.0;
constexpr std::string_view kBegin = "begin ", kError = "error in ";

/// "begin gutter at 12.000 s: Cut the gutter": what stands after the time.
std::string afterTime(const std::string& text) {
  const std::size_t at = text.find(" s: ");
  return at == std::string::npos ? text : text.substr(at + 4);
}

/// What is worth a mark.
std::optional<SessionMark> markFrom(const SessionEvent& event, double t_s) {
  if (event.kind == kStepEvent) {
    if (event.text.starts_with(kBegin)) return SessionMark{t_s, MarkKind::step, afterTime(event.text)};
    if (event.text.starts_with(kError)) return SessionMark{t_s, MarkKind::error, afterTime(event.text)};
    return {};
  }
  if (event.kind == kCoachEvent) return SessionMark{t_s, MarkKind::coach, event.text};
  if (event.kind == kTouchEvent) {
    // The tooth that is operated on is meant to be touched.
    const auto touch = touchFrom(event.text);
    if (!touch || touch->what.ends_with("third molar")) return {};
    return SessionMark{std::max(0.0, t_s - kTouchPause_s), MarkKind::touch, touch->what + " touched"};
  }
  if (event.kind == "soft tissue" && event.text.starts_with("bur on"))
    return SessionMark{t_s, MarkKind::touch, event.text};
  for (const char* kind : {"tooth", "forceps", "elevator", "stitch", "procedure", "flap told", "emergency stop"})
    if (event.kind == kind) return SessionMark{t_s, MarkKind::event, event.text};
  return {};
}

}  // namespace

void SessionMarks::follow(const haptics::Tick& tick, const haptics::Tool& tool) {
  for (; next_ < events_.size() && events_[next_].tick <= tick.index; ++next_)
    if (auto mark = markFrom(events_[next_], tick.t_s)) marks_.push_back(std::move(*mark));
  if (!tool_ || !(*tool_ == tool)) {
    if (tool_) marks_.push_back({tick.t_s, MarkKind::tool, toolName(tool)});
    tool_ = tool;
  }
  if (tick.broken.piece != 0) marks_.push_back({tick.t_s, MarkKind::event, "a bridge of the tooth broke"});
  if (tick.restored_total_mm3 > restored_mm3_ &&
      (marks_.empty() || marks_.back().kind != MarkKind::undo || tick.t_s - marks_.back().t_s > kUndoPause_s))
    marks_.push_back({tick.t_s, MarkKind::undo, "undone"});
  restored_mm3_ = tick.restored_total_mm3;
}

}  // namespace app
