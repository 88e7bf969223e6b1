#include "app/review/session_course.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "app/options/bur_name.h"

namespace app {
namespace {

constexpr double kBridged_s = 0.5;

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
  auto command = commands.begin();
  SessionMarks marks(session.events());
  haptics::Tool tool;
  session.rewind();
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock())
    for (const haptics::Tick& tick : block.ticks) {
      course.duration_s = tick.t_s + tick.dt_s;
      for (; command != commands.end() && command->first_tick <= tick.index; ++command) {
        tool = command->command.tool;
        const std::string name = toolName(tool);
        if (!course.tools.empty() && !(course.tools.back().to_s > course.tools.back().from_s)) course.tools.pop_back();
        if (course.tools.empty() || course.tools.back().what != name)
          course.tools.push_back({tick.t_s, tick.t_s, name});
      }
      if (!course.tools.empty()) course.tools.back().to_s = course.duration_s;
      marks.follow(tick, tool);

      const double force_N = glm::length(tick.law_force_P_N.xyz);
      if (double& most_N = binAt(course.most_force_N, tick.t_s); force_N > most_N) most_N = force_N;
      binAt(course.removed_mm3, tick.t_s) += std::max(0.0, tick.removed_mm3);
      if (!tick.drilling || !(tick.overlap_mm3 > 0.0)) continue;
      extend(course.drilling, tick.t_s, tick.dt_s);
      const auto bin = static_cast<std::size_t>(std::clamp(force_N / SessionCourse::kForceBin_N, 0.0, 1e6));
      course.force_s[std::min(bin, SessionCourse::kForceBins - 1)] += tick.dt_s;
    }
  session.rewind();
  // The figure has rows of its own for steps and instruments.
  std::ranges::copy_if(marks.all(), std::back_inserter(course.marks), [](const SessionMark& mark) {
    return mark.kind != MarkKind::step && mark.kind != MarkKind::tool;
  });
  std::ranges::stable_sort(course.marks, {}, &SessionMark::t_s);
  return course;
}

}  // namespace app
