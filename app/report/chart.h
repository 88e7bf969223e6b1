// A figure for a report: panels side by side with curves, points with error bars, reference lines, one legend. PNG at
// 300 dpi. Colours by Okabe and Ito, distinct for colour-blind readers and in grey; dashes help where lines cross. Any
// one thread; a tenth of a second.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibration/output_file.h"

namespace app {

struct Curve {
  std::string label;  ///< in the legend; empty: no entry. A label in two panels is one entry
  int colour = 0;     ///< 0..6, see chart.cpp
  std::vector<glm::dvec2> points;
  bool joined = true, dotted = false, dashed = false;
  std::vector<glm::dvec2> bars;  ///< low and high of each point, or none
  std::vector<double> sizes;     ///< of each dot, 1 is the default; or none
};

/// A labelled grey line across the panel.
struct ReferenceLine {
  std::string label;
  double at = 0.0;
  bool across = true;  ///< horizontal; else vertical
};

struct Panel {
  std::string title, x_label, y_label;
  std::vector<Curve> curves;
  std::vector<ReferenceLine> lines;
  std::optional<glm::dvec2> x_range, y_range;  ///< else fitted to curves and lines
};

struct Chart {
  std::string title, caption;
  std::vector<Panel> panels;
  glm::dvec2 size{816.0, 432.0};  ///< 120ths of an inch
};

/// Throws UsageError when the file cannot be written. The file is committed.
void drawChart(const Chart& chart, calibration::OutputFile& file);

}  // namespace app
