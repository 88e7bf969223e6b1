// The plot of a figure: box with grid, numbers, labels, title, and legend. Grid steps are 1, 2 or 5 times a power of
// ten, with as many digits as the step needs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/report/drawing.h"

namespace app {

/// Heights of lines: numbers, labels, titles.
inline constexpr double kNumberLine = 12.9, kLabelLine = 13.5, kTitleLine = 15.2;

struct AxisTicks {
  double low = 0.0, high = 1.0;  ///< the range, widened to whole steps where it was asked
  double step = 0.2;
  std::vector<double> at;

  std::string text(double value) const;
};

/// About `wanted` of them. `whole`: the range ends on ticks. A range that is none, or not finite, becomes 0..1.
AxisTicks axisTicks(double low, double high, int wanted, bool whole);

struct Axis {
  struct Mark {
    double at = 0.0;
    std::string text;
  };

  double from = 0.0, to = 1.0;  ///< at the left or the foot, and at the other end; either may be the larger
  std::vector<Mark> marks;
  std::string label;
};

/// From the lower to the higher end.
Axis axisOf(const AxisTicks& ticks, std::string label);

struct Axes {
  static constexpr double kAbove = 42.0, kBelow = 38.0;  ///< what title, numbers and labels need

  glm::dvec2 corner{0.0}, size{0.0};  ///< the plot, upper left
  Axis x, y;
  std::string title;

  /// Where a place of the plot is drawn.
  glm::dvec2 at(const glm::dvec2& value) const;
  glm::dvec2 foot() const { return corner + size; }
  void draw(const Drawing& drawing) const;
};

struct LegendEntry {
  std::string label;
  double sample_width = 0.0;
  std::function<void(const glm::dvec2& left)> draw_sample;  ///< from its left, half-way up
};

/// In rows, each as full as it may be, centred below `top`. Returns the height; `draws`: else it is measured alone.
double legend(const Drawing& drawing, const std::vector<LegendEntry>& entries, const glm::dvec2& top, double width,
              bool draws = true);

}  // namespace app
