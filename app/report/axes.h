// The plot of a figure: box with grid, numbers, labels, title, and legend. Grid steps are 1, 2 or 5 times a power of
// ten, with as many digits as the step needs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/report/drawing.h"

namespace app {

/// Text heights: numbers, labels, titles.
inline constexpr double kNumberLine = 12.9, kLabelLine = 13.5, kTitleLine = 15.2;

struct AxisTicks {
  double low = 0.0, high = 1.0;  ///< the range, widened to whole steps if `whole`
  double step = 0.2;
  std::vector<double> at;

  std::string text(double value) const;
};

/// About `wanted` ticks. `whole`: the range ends on ticks. An empty or non-finite range becomes 0..1.
AxisTicks axisTicks(double low, double high, int wanted, bool whole);

struct Axis {
  struct Mark {
    double at = 0.0;
    std::string text;
  };

  double from = 0.0, to = 1.0;  ///< left or bottom, and right or top; either may be larger
  std::vector<Mark> marks;
  std::string label;
};

/// From the lower to the higher end.
Axis axisOf(const AxisTicks& ticks, std::string label);

struct Axes {
  static constexpr double kAbove = 42.0, kBelow = 38.0;  ///< space for title, numbers and labels

  glm::dvec2 corner{0.0}, size{0.0};  ///< the plot, upper left
  Axis x, y;
  std::string title;

  /// Position on the drawing of a point of the plot.
  glm::dvec2 at(const glm::dvec2& value) const;
  glm::dvec2 foot() const { return corner + size; }
  void draw(const Drawing& drawing) const;
};

struct LegendEntry {
  std::string label;
  double sample_width = 0.0;
  std::function<void(const glm::dvec2& left)> draw_sample;  ///< `left`: its left end, at half height
};

/// Rows filled in order, centred below `top`. Returns the height; without `draws` it is only measured.
double legend(const Drawing& drawing, const std::vector<LegendEntry>& entries, const glm::dvec2& top, double width,
              bool draws = true);

}  // namespace app
