#include <algorithm>
#include <cmath>
#include <limits>

#include "app/procedure/flap/flap.h"

namespace app {
namespace {

constexpr double kVertex_mm = 0.6;
constexpr double kAtIncision_mm = 0.9;   // a vertex there is cut loose
constexpr double kColumnHalf_mm = 0.4;   // points of the incision within it are a column's
constexpr double kLeastColumn_mm = 3.0;  // from incision to base
constexpr int kMostSheetRows = 30, kMostSheetColumns = 80;
constexpr double kThinGum_mm = 0.8, kThickGum_mm = 1.9;

/// The incision's edge on one column of the sheet; none: no point of it.
std::optional<double> topOf_rad(const Incision& incision, double m_mm) {
  std::optional<double> top;
  for (const IncisionPoint& point : incision.points())
    if (point.is_full && std::abs(point.at.m_mm - m_mm) <= kColumnHalf_mm)
      top = std::min(top.value_or(10.0), point.at.angle_rad);
  return top;
}

/// Where columns have no point: between their neighbours.
std::vector<double> filled(const std::vector<std::optional<double>>& tops) {
  std::vector<double> all;
  for (std::size_t n = 0; n < tops.size(); ++n) {
    std::size_t before = n, after = n;
    while (before > 0 && !tops[before]) --before;
    while (after + 1 < tops.size() && !tops[after]) ++after;
    if (!tops[before]) before = after;
    if (!tops[after]) after = before;
    const double part = after > before ? static_cast<double>(n - before) / static_cast<double>(after - before) : 0.0;
    all.push_back((1.0 - part) * *tops[before] + part * *tops[after]);
  }
  return all;
}

/// Angles of a column's rows, evenly along the gum.
std::vector<double> rowsOf_rad(const GumChart& chart, double m_mm, double top_rad, double base_rad, int rows) {
  constexpr int kFine = 96;
  std::vector<double> way{0.0};
  glm::dvec3 before = chart.surface_P_mm({m_mm, top_rad});
  for (int n = 1; n <= kFine; ++n) {
    const glm::dvec3 p = chart.surface_P_mm({m_mm, top_rad + (base_rad - top_rad) * n / kFine});
    way.push_back(way.back() + glm::distance(before, p));
    before = p;
  }
  std::vector<double> angles;
  std::size_t at = 0;
  for (int row = 0; row < rows; ++row) {
    const double wanted = way.back() * row / (rows - 1);
    while (at + 1 < kFine && way[at + 1] < wanted) ++at;
    const double part = std::clamp((wanted - way[at]) / std::max(1e-9, way[at + 1] - way[at]), 0.0, 1.0);
    angles.push_back(top_rad + (base_rad - top_rad) * (static_cast<double>(at) + part) / kFine);
  }
  return angles;
}

}  // namespace

std::optional<FlapSheet> sheetFor(const GumChart& chart, const FlapPlan& plan, const Incision& incision) {
  double first_m = std::numeric_limits<double>::infinity(), last_m = -first_m;
  for (const IncisionPoint& point : incision.points())
    if (point.is_full) first_m = std::min(first_m, point.at.m_mm), last_m = std::max(last_m, point.at.m_mm);
  if (!(last_m - first_m > 4.0 * kVertex_mm)) return {};
  const int columns = std::min(kMostSheetColumns, static_cast<int>((last_m - first_m) / kVertex_mm) + 1);
  const double step_mm = (last_m - first_m) / (columns - 1);

  std::vector<std::optional<double>> tops;
  for (int c = 0; c < columns; ++c) tops.push_back(topOf_rad(incision, first_m + step_mm * c));
  std::vector<double> top = filled(tops), base;
  for (int pass = 0; pass < 2; ++pass) {
    const std::vector<double> raw = top;
    for (std::size_t n = 1; n + 1 < raw.size(); ++n) top[n] = 0.25 * (raw[n - 1] + 2.0 * raw[n] + raw[n + 1]);
  }
  // Beside a tooth on the gum.
  for (int c = 0; c < columns; ++c) {
    const double m_mm = first_m + step_mm * c;
    double& edge = top[static_cast<std::size_t>(c)];
    const auto is_whole = [&](double angle) {
      return chart.isGum({m_mm - 0.25, angle}) && chart.isGum({m_mm + 0.25, angle}) &&
             chart.isGum({m_mm, angle - 0.5 * GumChart::kRow_rad});
    };
    for (int n = 0; n < 20 && !is_whole(edge); ++n) edge += 0.25 * GumChart::kRow_rad;
  }
  double longest_mm = 0.0;
  for (int c = 0; c < columns; ++c) {
    const double m_mm = first_m + step_mm * c, from = top[static_cast<std::size_t>(c)];
    double to = plan.base_rad();
    while (to > from && !chart.isGum({m_mm, to + 2.0 * GumChart::kRow_rad})) to -= 0.5 * GumChart::kRow_rad;
    while (to < GumChart::kHighest_rad && acrossGum_mm(chart, m_mm, from, to) < kLeastColumn_mm) to += 0.02;
    base.push_back(to);
  }
  for (int pass = 0; pass < 4; ++pass) {
    const std::vector<double> raw = base;
    for (std::size_t n = 1; n + 1 < raw.size(); ++n) base[n] = 0.25 * (raw[n - 1] + 2.0 * raw[n] + raw[n + 1]);
  }
  for (int c = 0; c < columns; ++c)
    longest_mm = std::max(longest_mm, acrossGum_mm(chart, first_m + step_mm * c, top[static_cast<std::size_t>(c)],
                                                   base[static_cast<std::size_t>(c)]));
  const int rows = std::clamp(static_cast<int>(longest_mm / kVertex_mm) + 1, 6, kMostSheetRows);

  std::vector<SheetVertex> vertices(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int c = 0; c < columns; ++c) {
    const double m_mm = first_m + step_mm * c;
    const std::vector<double> angles =
        rowsOf_rad(chart, m_mm, top[static_cast<std::size_t>(c)], base[static_cast<std::size_t>(c)], rows);
    for (int r = 0; r < rows; ++r) {
      SheetVertex& v =
          vertices[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(c)];
      const ChartPlace at{m_mm, angles[static_cast<std::size_t>(r)]};
      v.home_P_mm = chart.surface_P_mm(at);
      v.normal_P = chart.normal_P(at);
      const double deep_mm = (chart.gum_mm(at) - chart.bone_mm(at)) * glm::dot(v.normal_P, chart.outward_P(at));
      v.bone_P_mm = chart.point_P_mm(at, chart.bone_mm(at));
      v.thickness_mm = std::clamp(deep_mm, kThinGum_mm, kThickGum_mm);
      const bool is_border = r == 0 || c == 0 || c + 1 == columns;
      v.is_cut = is_border && r + 1 < rows && std::ranges::any_of(incision.points(), [&](const IncisionPoint& point) {
                   return point.is_full && glm::distance(point.at_P_mm, v.home_P_mm) < kAtIncision_mm;
                 });
      v.is_attached = r + 1 == rows || (is_border && !v.is_cut);
    }
  }
  return FlapSheet(columns, rows, std::move(vertices));
}

}  // namespace app
