#include "app/calibrate/report/history_view.h"

#include <algorithm>
#include <cmath>

#include "app/report/axis_ticks.h"
#include "app/report/svg.h"

namespace app {
namespace {

using calibration::DriftEntry;
using calibration::DriftKind;
using calibration::DriftQuantity;
using calibration::DriftReview;

constexpr double kWidth = 760.0, kLeft = 52.0, kRight = 92.0, kTop = 30.0, kBelow = 30.0;
constexpr double kTall = 190.0, kFlat = 110.0;
constexpr std::size_t kMost = 60;

/// Where an entry and a value stand on paper.
struct Frame {
  std::size_t from = 0, count = 0;
  double low_mm = 0.0, high_mm = 1.0, height = kTall;

  double x(std::size_t entry) const {
    const double step = (kWidth - kLeft - kRight) / std::max(static_cast<double>(count), 1.0);
    return kLeft + step * (static_cast<double>(entry - from) + 0.5);
  }
  double y(double mm) const { return kTop + height * (high_mm - mm) / (high_mm - low_mm); }
};

Frame frameOf(const std::vector<DriftEntry>& history, const DriftReview& review, DriftQuantity quantity) {
  Frame frame;
  frame.count = std::min(history.size(), kMost);
  frame.from = history.size() - frame.count;
  frame.height = quantity == DriftQuantity::rms ? kTall : kFlat;
  double low_mm = 0.0, high_mm = quantity == DriftQuantity::rms ? 0.5 : 0.2;
  if (quantity != DriftQuantity::rms) low_mm = -0.2;
  for (std::size_t i = frame.from; i < history.size(); ++i) {
    low_mm = std::min(low_mm, calibration::valueOf_mm(history[i], quantity));
    high_mm = std::max(high_mm, calibration::valueOf_mm(history[i], quantity));
  }
  if (const auto& limits = review.limits[static_cast<std::size_t>(quantity)]) {
    high_mm = std::max(high_mm, limits->at(3.0));
    if (quantity != DriftQuantity::rms) low_mm = std::min(low_mm, limits->at(-3.0));
  }
  const AxisTicks ticks = axisTicks(low_mm, high_mm, 4, true);
  frame.low_mm = ticks.low, frame.high_mm = ticks.high;
  return frame;
}

void drawAxes(Svg& svg, const Frame& frame, const std::vector<DriftEntry>& history) {
  const double right = kWidth - kRight, bottom = kTop + frame.height;
  const AxisTicks ticks = axisTicks(frame.low_mm, frame.high_mm, 4, true);
  for (const double tick : ticks.at) {
    svg.line({kLeft, frame.y(tick)}, {right, frame.y(tick)}, {paper::kFaint, tick == 0.0 ? 1.6 : 0.7});
    svg.words({kLeft - 6.0, frame.y(tick) + 4.0}, ticks.text(tick), TextAnchor::end, paper::kQuiet, 11.0);
  }
  svg.box({kLeft, kTop}, {right - kLeft, frame.height}, paper::kNone, {paper::kQuiet, 1.0});
  // About five dates, the newest among them.
  const std::size_t step = std::max<std::size_t>(1, (frame.count + 4) / 5);
  for (std::size_t back = 0; back < frame.count; back += step) {
    const std::size_t entry = history.size() - 1 - back;
    svg.line({frame.x(entry), bottom}, {frame.x(entry), bottom + 4.0}, {paper::kQuiet, 1.0});
    svg.words({frame.x(entry), bottom + 17.0}, history[entry].utc.substr(0, 10), TextAnchor::middle, paper::kQuiet,
              11.0);
  }
}

void drawLimits(Svg& svg, const Frame& frame, const DriftReview& review, DriftQuantity quantity) {
  const auto& limits = review.limits[static_cast<std::size_t>(quantity)];
  if (!limits || review.judged.empty()) return;
  const double left = frame.x(std::max(review.judged.front(), frame.from)) - 4.0, right = kWidth - kRight;
  const auto draw = [&](double sigmas, const Stroke& stroke, const std::string& label) {
    const double mm = limits->at(sigmas);
    if (mm < frame.low_mm - 1e-9) return;
    svg.line({left, frame.y(mm)}, {right, frame.y(mm)}, stroke);
    svg.words({right + 6.0, frame.y(mm) + 4.0}, label + fixedText(mm, 2), TextAnchor::start, paper::kInk, 10.5);
  };
  draw(0.0, {paper::kGreen, 1.6}, "mean ");
  for (const double side : {1.0, -1.0}) {
    if (quantity == DriftQuantity::rms && side < 0.0) continue;
    draw(3.0 * side, {paper::kOrange, 1.6, "7 4"}, (side > 0.0 ? "+3\u03c3 " : "\u22123\u03c3 "));
    const double two = frame.y(limits->at(2.0 * side));
    svg.line({left, two}, {right, two}, {paper::kOrange, 0.9, "2 4"});
  }
}

void drawValues(Svg& svg, const Frame& frame, const std::vector<DriftEntry>& history, const DriftReview& review,
                DriftQuantity quantity) {
  std::vector<glm::dvec2> way;
  for (std::size_t i = frame.from; i < history.size(); ++i) {
    const glm::dvec2 at{frame.x(i), frame.y(calibration::valueOf_mm(history[i], quantity))};
    if (history[i].kind == DriftKind::calibration) {
      svg.path(way, {paper::kBlue, 1.2});
      way.clear();
      svg.line({at.x, kTop}, {at.x, kTop + frame.height}, {paper::kInk, 1.2, "1 3"});
      svg.words({at.x, kTop - 4.0}, "calibrated", TextAnchor::middle, paper::kInk, 10.5);
    } else {
      way.push_back(at);
    }
  }
  svg.path(way, {paper::kBlue, 1.2});
  for (std::size_t i = frame.from; i < history.size(); ++i) {
    const glm::dvec2 at{frame.x(i), frame.y(calibration::valueOf_mm(history[i], quantity))};
    if (history[i].kind == DriftKind::rezero)
      svg.box(at - 3.2, glm::dvec2(6.4), paper::kWhite, {paper::kBlue, 1.5});
    else
      svg.disc(at, 3.2, history[i].kind == DriftKind::check ? paper::kBlue : paper::kInk);
  }
  for (const calibration::DriftAlarm& alarm : review.alarms)
    if (alarm.quantity == quantity && alarm.entry >= frame.from)
      svg.disc({frame.x(alarm.entry), frame.y(calibration::valueOf_mm(history[alarm.entry], quantity))}, 7.5,
               paper::kNone, {paper::kOrange, 2.2});
}

}  // namespace

std::string historyView(const std::vector<DriftEntry>& history, const DriftReview& review, DriftQuantity quantity) {
  const Frame frame = frameOf(history, review, quantity);
  const std::string name(calibration::nameOf(quantity));
  Svg svg({kWidth, kTop + frame.height + kBelow}, "Control chart of " + name);
  svg.words({kLeft, 14.0}, name + " / mm", TextAnchor::start, paper::kInk, 13.0, true);
  drawAxes(svg, frame, history);
  drawLimits(svg, frame, review, quantity);
  drawValues(svg, frame, history, review, quantity);
  return svg.markup();
}

}  // namespace app
