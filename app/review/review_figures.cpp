#include "app/review/review_figures.h"

#include <algorithm>

#include <fmt/core.h>

#include "app/report/axes.h"
#include "app/report/drawing.h"
#include "app/report/markup.h"
#include "app/text/clock_text.h"

namespace app {
namespace {

constexpr double kWidth = 800.0, kLeft = 110.0, kRight = 12.0;

/// Minutes and seconds below a drawing of this height.
Axis timeAxis(double duration_s) {
  Axis axis{0.0, std::max(1.0, duration_s), {}, "time, min:s"};
  const AxisTicks ticks = axisTicks(0.0, axis.to, 8, false);
  // Whole minutes where the session is long enough for them.
  const double step_s = duration_s > 240.0 ? std::max(60.0, 60.0 * std::round(ticks.step / 60.0)) : ticks.step;
  for (double t_s = 0.0; t_s <= axis.to; t_s += step_s) axis.marks.push_back({t_s, clockText(t_s)});
  return axis;
}

/// A row of bars, with its name to the left; the pointer tells what each is.
void drawSpans(Drawing& drawing, const Axes& axes, const std::vector<TimeSpan>& spans, const std::string& name,
               double top, bool with_words) {
  constexpr double kHeight = 18.0;
  drawing.text(name, {kLeft - 8.0, top + 0.5 * kHeight}, kNumberLine, paper::kInk, Align::right);
  bool odd = false;
  for (const TimeSpan& span : spans) {
    const double from = axes.at({span.from_s, 0.0}).x, to = std::max(from + 1.0, axes.at({span.to_s, 0.0}).x);
    const Ink ink = !with_words ? paper::kBlue : odd ? inkOf(0xdde6ee) : inkOf(0xc5d6e4);
    drawing.box({from, top}, {to - from, kHeight}, ink);
    odd = !odd;
    if (with_words && drawing.textWidth(span.what, kNumberLine) < to - from - 6.0)
      drawing.text(span.what, {from + 4.0, top + 0.5 * kHeight}, kNumberLine, paper::kInk, Align::left);
    drawing.hint({from, top}, {to - from, kHeight},
                 fmt::format("{}: {} to {}", span.what.empty() ? name : span.what, clockText(span.from_s),
                             clockText(span.to_s)));
  }
}

Axes rowAxes(const Axis& time, double top, double height, const std::vector<double>& values, const char* label) {
  Axes axes;
  axes.corner = {kLeft, top};
  axes.size = {kWidth - kLeft - kRight, height};
  axes.x = time;
  axes.x.label.clear();
  axes.y = axisOf(axisTicks(0.0, values.empty() ? 1.0 : *std::ranges::max_element(values), 3, true), label);
  return axes;
}

std::vector<glm::dvec2> stepsOf(const Axes& axes, const std::vector<double>& values, double bin_s) {
  std::vector<glm::dvec2> points;
  for (std::size_t n = 0; n < values.size(); ++n)
    points.push_back(axes.at({(static_cast<double>(n) + 0.5) * bin_s, std::min(values[n], axes.y.to)}));
  return points;
}

/// What each half second was, under the pointer; nothing where nothing was felt or removed.
void hintBins(Drawing& drawing, const Axes& above, const Axes& below, const SessionCourse& course) {
  for (std::size_t n = 0; n < course.most_force_N.size(); ++n) {
    const double from_s = static_cast<double>(n) * SessionCourse::kBin_s;
    const double removed_mm3 = n < course.removed_mm3.size() ? course.removed_mm3[n] : 0.0;
    if (!(course.most_force_N[n] > 0.0) && !(removed_mm3 > 0.0)) continue;
    const double x = above.at({from_s, 0.0}).x;
    drawing.hint({x, above.corner.y},
                 {above.at({from_s + SessionCourse::kBin_s, 0.0}).x - x, below.foot().y - above.corner.y},
                 fmt::format("{}: {:.1f} N, {:.1f} mm³/s", clockText(from_s), course.most_force_N[n],
                             removed_mm3 / SessionCourse::kBin_s));
  }
}

std::vector<TimeSpan> stepsAsSpans(const ProcedureRun& run) {
  std::vector<TimeSpan> spans;
  for (const StepRecord& step : run.steps)
    if (step.begin_s && step.duration_s > 0.0)
      spans.push_back({*step.begin_s, *step.begin_s + step.duration_s, step.title});
  return spans;
}

}  // namespace

std::string markId(int number) { return fmt::format("moment-{}", number); }

std::string pictureId(std::size_t number) { return fmt::format("picture-{}", number + 1); }

std::string timelineFigure(const SessionCourse& course, const std::optional<ProcedureRun>& procedure,
                           const std::vector<MomentPicture>& moments) {
  const Axis time = timeAxis(course.duration_s);
  const double steps = procedure ? 26.0 : 0.0;
  Drawing drawing({kWidth, 372.0 + steps});
  Axes force =
      rowAxes(time, 96.0 + steps, 90.0, course.most_force_N, "force of the model, N, largest in half a second");
  drawSpans(drawing, force, course.tools, "in the hand", 6.0, true);
  drawSpans(drawing, force, course.drilling, "drilling in bone", 32.0, false);
  if (procedure) drawSpans(drawing, force, stepsAsSpans(*procedure), "step", 58.0, true);
  force.draw(drawing);
  drawing.path(stepsOf(force, course.most_force_N, SessionCourse::kBin_s), 1.2, paper::kOrange);

  std::vector<double> rate = course.removed_mm3;
  for (double& value : rate) value /= SessionCourse::kBin_s;
  Axes removed = rowAxes(time, 236.0 + steps, 70.0, rate, "bone and tooth removed, mm³/s");
  removed.x.label = time.label;
  removed.draw(drawing);
  drawing.path(stepsOf(removed, rate, SessionCourse::kBin_s), 1.2, paper::kBlue);

  hintBins(drawing, force, removed, course);
  // What is shown, by a picture's place; what happened, numbered, over both plots.
  for (std::size_t n = 0; n < moments.size(); ++n) {
    const double x = force.at({moments[n].moment.t_s, 0.0}).x, y = removed.foot().y;
    drawing.polygon({{x, y}, {x - 5.0, y + 9.0}, {x + 5.0, y + 9.0}}, paper::kBlue);
    drawing.hint({x - 6.0, y}, {12.0, 11.0},
                 fmt::format("picture: {} at {}", moments[n].moment.what, clockText(moments[n].moment.t_s)),
                 pictureId(n));
  }
  const auto leads_to = [&moments](const SessionMark& mark, int at) {
    const auto shown = pictureOf(moments, mark.t_s);
    return shown ? pictureId(*shown) : markId(at);
  };
  int number = 0;
  double last_x = -1e9;
  for (const SessionMark& mark : course.marks) {
    const double x = force.at({mark.t_s, 0.0}).x;
    drawing.line({x, force.corner.y}, {x, removed.foot().y}, 0.8, paper::kQuiet, {3.0, 3.0});
    ++number;
    drawing.hint({x - 3.0, force.corner.y}, {6.0, removed.foot().y - force.corner.y},
                 fmt::format("{}: {} at {}", number, mark.what, clockText(mark.t_s)), leads_to(mark, number));
    if (x - last_x < 18.0) continue;
    drawing.text(std::to_string(number), {x + 3.0, force.corner.y + 8.0}, kNumberLine, paper::kInk, Align::left, true);
    last_x = x;
  }
  return drawing.markup("Timeline of the rehearsal");
}

std::string stepsFigure(const SessionMetrics& first, const SessionMetrics& second) {
  const Axis time = timeAxis(std::max(first.duration_s, second.duration_s));
  Drawing drawing({kWidth, 96.0});
  Axes axes = rowAxes(time, 4.0, 54.0, {}, "");
  axes.y.marks.clear();
  axes.x.label = time.label;
  axes.draw(drawing);
  if (first.procedure) drawSpans(drawing, axes, stepsAsSpans(*first.procedure), "first", 9.0, true);
  if (second.procedure) drawSpans(drawing, axes, stepsAsSpans(*second.procedure), "second", 35.0, true);
  return drawing.markup("Steps of both rehearsals over time");
}

std::string forceFigure(const SessionCourse& course) {
  const auto last =
      std::ranges::find_if(course.force_s.rbegin(), course.force_s.rend(), [](double s) { return s > 0.0; });
  if (last == course.force_s.rend()) return "";
  const auto bins = static_cast<std::size_t>(course.force_s.rend() - last);
  Axes axes;
  axes.corner = {60.0, Axes::kAbove};
  axes.size = {380.0, 150.0};
  axes.x =
      axisOf(axisTicks(0.0, SessionCourse::kForceBin_N * static_cast<double>(bins), 6, true), "force of the model, N");
  axes.y = axisOf(axisTicks(0.0, *std::ranges::max_element(course.force_s), 4, true), "time drilling in bone, s");
  Drawing drawing({470.0, Axes::kAbove + 150.0 + Axes::kBelow});
  axes.draw(drawing);
  for (std::size_t n = 0; n < bins; ++n) {
    const double from_N = SessionCourse::kForceBin_N * static_cast<double>(n);
    const glm::dvec2 top = axes.at({from_N, course.force_s[n]}),
                     foot = axes.at({from_N + SessionCourse::kForceBin_N, 0.0});
    if (!(course.force_s[n] > 0.0)) continue;
    drawing.box(top + glm::dvec2(1.0, 0.0), foot - top - glm::dvec2(2.0, 0.0), paper::kBlue);
    drawing.hint(
        {top.x, axes.corner.y}, {foot.x - top.x, axes.size.y},
        fmt::format("{:.2f} to {:.2f} N: {:.1f} s", from_N, from_N + SessionCourse::kForceBin_N, course.force_s[n]));
  }
  return drawing.markup("Histogram of the force while drilling in bone");
}

std::string picturesFigure(const std::vector<BonePicture>& pictures, std::string_view description, bool has_words) {
  if (pictures.empty()) return "";
  constexpr double kColumn = 400.0;
  const double words = has_words ? 20.0 : 0.0;
  const render::Image& first = pictures.front().image;
  const double height = (kColumn - 8.0) * first.h / first.w;
  const double rows = std::ceil(static_cast<double>(pictures.size()) / 2.0);
  Drawing drawing({2.0 * kColumn, rows * (height + words + 4.0)});
  for (std::size_t n = 0; n < pictures.size(); ++n) {
    const glm::dvec2 corner{static_cast<double>(n % 2) * kColumn, static_cast<double>(n / 2) * (height + words + 4.0)};
    drawing.image(pictures[n].image, corner, {kColumn - 8.0, height});
    if (has_words)
      drawing.text(pictures[n].from, corner + glm::dvec2(0.0, height + 0.5 * words), kLabelLine, paper::kInk,
                   Align::left);
  }
  return drawing.markup(description);
}

std::string trendFigure(const CaseTrend& trend) {
  constexpr double kColumn = 200.0, kRow = 118.0;
  constexpr std::size_t kInRow = 4;
  const TrendTable table = trendTable(trend);
  const auto rows = static_cast<double>((table.names.size() + kInRow - 1) / kInRow);
  Drawing drawing({kColumn * kInRow, kRow * rows});
  for (std::size_t n = 0; n < table.names.size(); ++n) {
    std::vector<double> values;
    for (const TrendTable::Row& run : table.runs)
      if (run.values[n]) values.push_back(*run.values[n]);
    const glm::dvec2 corner{static_cast<double>(n % kInRow) * kColumn, static_cast<double>(n / kInRow) * kRow};
    drawing.text(table.names[n], corner + glm::dvec2(8.0, 12.0), kNumberLine, paper::kInk, Align::left);
    if (values.empty()) continue;
    const auto [low, high] = std::ranges::minmax(values);
    Axes axes;
    axes.corner = corner + glm::dvec2(46.0, 26.0);
    axes.size = {kColumn - 58.0, kRow - 46.0};
    axes.x = {0.5, static_cast<double>(table.runs.size()) + 0.5, {}, ""};
    axes.y = axisOf(axisTicks(std::min(0.0, low), high, 2, true), "");
    axes.draw(drawing);
    if (!table.spread.empty() && table.spread.front().values[n]) {
      const double y = axes.at({0.5, *table.spread.front().values[n]}).y;
      drawing.line({axes.corner.x, y}, {axes.foot().x, y}, 1.0, paper::kQuiet, {4.0, 3.0});
    }
    for (std::size_t run = 0; run < table.runs.size(); ++run) {
      const auto& value = table.runs[run].values[n];
      if (!value) continue;
      const glm::dvec2 at = axes.at({static_cast<double>(run) + 1.0, *value});
      trend.runs[run].is_own ? drawing.box(at - 4.0, glm::dvec2(8.0), paper::kOrange)
                             : drawing.disc(at, 3.5, paper::kBlue);
      drawing.hint(at - 6.0, glm::dvec2(12.0), table.runs[run].name + ": " + shortText(*value));
    }
  }
  return drawing.markup("Measures of the rehearsals of this case from old to new");
}

std::string answerSymbol(std::optional<bool> is_error) {
  Drawing drawing({44.0, 44.0});
  if (!is_error)
    drawing.outline({4.0, 4.0}, {36.0, 36.0}, 3.0, paper::kQuiet, {6.0, 4.0});
  else if (!*is_error)
    drawing.disc({22.0, 22.0}, 19.0, paper::kGreen);
  else
    drawing.box({4.0, 4.0}, {36.0, 36.0}, paper::kOrange);
  return drawing.markup("");
}

}  // namespace app
