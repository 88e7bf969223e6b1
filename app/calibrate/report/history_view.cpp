#include "app/calibrate/report/report_views.h"

#include <algorithm>
#include <cmath>

#include "app/report/axes.h"
#include "app/report/markup.h"

namespace app {
namespace {

using calibration::DriftEntry;
using calibration::DriftKind;
using calibration::DriftQuantity;
using calibration::DriftReview;

constexpr double kWidth = 760.0, kLeft = 52.0, kRight = 92.0, kTop = 30.0, kBelow = 30.0;
constexpr double kTall = 190.0, kFlat = 110.0, kSmallLine = 12.3;
constexpr std::size_t kMaxEntries = 60;

/// One quantity of the newest entries.
struct DriftChart {
  const std::vector<DriftEntry>& history;
  const DriftReview& review;
  DriftQuantity quantity;
  std::size_t from = 0;
  Axes axes;

  const auto& limits() const { return review.limits[static_cast<std::size_t>(quantity)]; }
  glm::dvec2 at(std::size_t entry) const {
    return axes.at({static_cast<double>(entry), calibration::valueOf_mm(history[entry], quantity)});
  }
};

/// x: index of the entry.
Axes axesOf(const DriftChart& chart) {
  const bool is_rms = chart.quantity == DriftQuantity::rms;
  double low_mm = is_rms ? 0.0 : -0.2, high_mm = is_rms ? 0.5 : 0.2;
  for (std::size_t i = chart.from; i < chart.history.size(); ++i) {
    low_mm = std::min(low_mm, calibration::valueOf_mm(chart.history[i], chart.quantity));
    high_mm = std::max(high_mm, calibration::valueOf_mm(chart.history[i], chart.quantity));
  }
  if (const auto& limits = chart.limits()) {
    high_mm = std::max(high_mm, limits->at(3.0));
    if (!is_rms) low_mm = std::min(low_mm, limits->at(-3.0));
  }
  const double first = static_cast<double>(chart.from), end = static_cast<double>(chart.history.size());
  Axes axes{{kLeft, kTop},
            {kWidth - kLeft - kRight, is_rms ? kTall : kFlat},
            {first - 0.5, std::max(end, first + 1.0) - 0.5, {}, ""},
            axisOf(axisTicks(low_mm, high_mm, 4, true), ""),
            std::string(calibration::nameOf(chart.quantity)) + " / mm"};
  // About five dates, the newest among them.
  const std::size_t count = chart.history.size() - chart.from, step = std::max<std::size_t>(1, (count + 4) / 5);
  for (std::size_t back = 0; back < count; back += step) {
    const std::size_t entry = chart.history.size() - 1 - back;
    axes.x.marks.push_back({static_cast<double>(entry), chart.history[entry].utc.substr(0, 10)});
  }
  return axes;
}

void drawLimits(const Drawing& drawing, const DriftChart& chart) {
  if (!chart.limits() || chart.review.charted.empty()) return;
  const double left = chart.at(std::max(chart.review.charted.front(), chart.from)).x - 4.0, right = chart.axes.foot().x;
  const auto draw = [&](double sigmas, double width, const Ink& ink, const Dashes& dashes, const std::string& label) {
    const double mm = chart.limits()->at(sigmas), y = chart.axes.at({0.0, mm}).y;
    if (mm < chart.axes.y.from - 1e-9) return;
    drawing.line({left, y}, {right, y}, width, ink, dashes);
    if (!label.empty()) drawing.text(label + fixedText(mm, 2), {right + 6.0, y}, kSmallLine, paper::kInk, Align::left);
  };
  draw(0.0, 1.6, paper::kGreen, {}, "mean ");
  for (const double side : {1.0, -1.0}) {
    if (chart.quantity == DriftQuantity::rms && side < 0.0) continue;
    draw(3.0 * side, 1.6, paper::kOrange, {7.0, 4.0}, side > 0.0 ? "+3\u03c3 " : "\u22123\u03c3 ");
    draw(2.0 * side, 0.9, paper::kOrange, {2.0, 4.0}, "");
  }
}

void drawValues(const Drawing& drawing, const DriftChart& chart) {
  const std::vector<DriftEntry>& history = chart.history;
  std::vector<glm::dvec2> line;
  for (std::size_t i = chart.from; i < history.size(); ++i) {
    const glm::dvec2 at = chart.at(i);
    // A calibration breaks the line.
    line.push_back(history[i].kind == DriftKind::calibration ? glm::dvec2(NAN) : at);
    if (history[i].kind != DriftKind::calibration) continue;
    drawing.line({at.x, kTop}, {at.x, chart.axes.foot().y}, 1.2, paper::kInk, {1.0, 3.0});
    drawing.text("calibrated", {at.x, kTop - 8.0}, kSmallLine, paper::kInk);
  }
  drawing.path(line, 1.2, paper::kBlue);
  for (std::size_t i = chart.from; i < history.size(); ++i) {
    const glm::dvec2 at = chart.at(i);
    if (history[i].kind == DriftKind::rezero) {
      drawing.box(at - 3.2, glm::dvec2(6.4), paper::kWhite);
      drawing.outline(at - 3.2, glm::dvec2(6.4), 1.5, paper::kBlue);
    } else {
      drawing.disc(at, 3.2, history[i].kind == DriftKind::check ? paper::kBlue : paper::kInk);
    }
  }
  for (const calibration::DriftAlarm& alarm : chart.review.alarms)
    if (alarm.quantity == chart.quantity && alarm.entry >= chart.from)
      drawing.circle(chart.at(alarm.entry), 7.5, 2.2, paper::kOrange);
}

}  // namespace

std::string historyView(const std::vector<DriftEntry>& history, const DriftReview& review, DriftQuantity quantity) {
  DriftChart chart{history, review, quantity, history.size() - std::min(history.size(), kMaxEntries), {}};
  chart.axes = axesOf(chart);
  Drawing drawing({kWidth, chart.axes.foot().y + kBelow});
  chart.axes.draw(drawing);
  drawLimits(drawing, chart);
  drawValues(drawing, chart);
  return drawing.markup("Control chart of " + std::string(calibration::nameOf(quantity)));
}

}  // namespace app
