#include "app/review/session_course.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/options/bur_name.h"
#include "app/session/touch_event.h"
#include "app/text/clock_text.h"

namespace app {
namespace {

constexpr double kBridged_s = 0.5;

/// What is worth a mark on a timeline; empty: not that. Never a path or a calibration's name.
std::string markOf(const SessionEvent& event) {
  if (event.kind == kTouchEvent) {
    // The tooth that is operated on is meant to be touched.
    const auto touch = touchFrom(event.text);
    return touch && !touch->what.ends_with("third molar") ? touch->what + " touched" : "";
  }
  if (event.kind == "soft tissue") return event.text.starts_with("bur on") ? event.text : "";
  for (const char* kind : {"tooth", "forceps", "elevator", "stitch", "emergency stop"})
    if (event.kind == kind) return event.text;
  return "";
}

void extend(std::vector<TimeSpan>& spans, double t_s, double dt_s) {
  if (spans.empty() || t_s - spans.back().to_s > kBridged_s) spans.push_back({t_s, t_s, ""});
  spans.back().to_s = t_s + dt_s;
}

template <class T>
T& binAt(std::vector<T>& bins, double t_s) {
  const auto n = static_cast<std::size_t>(std::clamp(t_s / SessionCourse::kBin_s, 0.0, 1e6));
  if (bins.size() <= n) bins.resize(n + 1);
  return bins[n];
}

}  // namespace

SessionCourse courseOf(SessionReader& session) {
  SessionCourse course;
  const std::vector<SessionCommand> commands = session.commands();
  const std::vector<SessionEvent> events = session.events();
  auto command = commands.begin();
  auto event = events.begin();
  double restored_mm3 = 0.0;
  session.rewind();
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock())
    for (const haptics::Tick& tick : block.ticks) {
      course.duration_s = tick.t_s + tick.dt_s;
      for (; command != commands.end() && command->first_tick <= tick.index; ++command) {
        const std::string name = toolName(command->command.tool);
        if (!course.tools.empty() && !(course.tools.back().to_s > course.tools.back().from_s)) course.tools.pop_back();
        if (course.tools.empty() || course.tools.back().what != name)
          course.tools.push_back({tick.t_s, tick.t_s, name});
      }
      if (!course.tools.empty()) course.tools.back().to_s = course.duration_s;
      for (; event != events.end() && event->tick <= tick.index; ++event)
        if (std::string what = markOf(*event); !what.empty()) course.marks.push_back({tick.t_s, std::move(what)});
      if (tick.broken.piece != 0) course.marks.push_back({tick.t_s, "a bridge of the tooth broke"});
      if (tick.restored_total_mm3 > restored_mm3 &&
          (course.marks.empty() || course.marks.back().what != "undone" || tick.t_s - course.marks.back().t_s > 1.0))
        course.marks.push_back({tick.t_s, "undone"});
      restored_mm3 = tick.restored_total_mm3;

      const double force_N = glm::length(tick.law_force_P_N.xyz);
      if (double& most_N = binAt(course.most_force_N, tick.t_s); force_N > most_N) most_N = force_N;
      binAt(course.removed_mm3, tick.t_s) += std::max(0.0, tick.removed_mm3);
      if (!tick.drilling || !(tick.overlap_mm3 > 0.0)) continue;
      extend(course.drilling, tick.t_s, tick.dt_s);
      const auto bin = static_cast<std::size_t>(std::clamp(force_N / SessionCourse::kForceBin_N, 0.0, 1e6));
      course.force_s[std::min(bin, SessionCourse::kForceBins - 1)] += tick.dt_s;
    }
  session.rewind();
  return course;
}

}  // namespace app
