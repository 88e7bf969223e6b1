#include "app/procedure/flap/flap_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assets/cut_field.h"

namespace app {
namespace {

constexpr double kBared_mm = 1.0;                          // around what the bur sweeps
constexpr double kUnderGum_mm = 0.5;                       // looked for from there on
constexpr double kBehind_mm = 2.0;                         // of the incision behind what is bared
constexpr double kInFront_mm = 0.6;                        // of the releasing cut in front of it
constexpr double kOffPapilla_mm = 2.2;                     // of the releasing cut
constexpr double kLimb_mm = 9.0, kForwards = 0.55;         // of it, and how far it runs forwards for each mm
constexpr double kOffTooth_mm = 1.4;                       // where the blade finds its way to the bone
constexpr double kBehindLimb_mm = 7.0, kBackwards = 0.35;  // the same at the ramus
constexpr double kBase_mm = 4.0;                           // beyond what is bared
constexpr double kFlat = 0.8;                              // of the normal upwards: on the ridge
constexpr double kCrownOver_mm = 11.0;                     // from the map's line: crowns, not roots

}  // namespace

double acrossGum_mm(const GumChart& chart, double m_mm, double from_rad, double to_rad) {
  constexpr int kSteps = 24;
  double sum_mm = 0.0;
  glm::dvec3 before = chart.surface_P_mm({m_mm, from_rad});
  for (int n = 1; n <= kSteps; ++n) {
    const glm::dvec3 p = chart.surface_P_mm({m_mm, from_rad + (to_rad - from_rad) * n / kSteps});
    sum_mm += glm::distance(before, p);
    before = p;
  }
  return to_rad < from_rad ? -sum_mm : sum_mm;
}

FlapPlan::FlapPlan(const GumChart& chart, const assets::Patient& patient, const assets::PlannedCut& cut)
    : chart_(chart), over_rad_(static_cast<std::size_t>(chart.columns())) {
  findLingualCrest();
  findTeeth(patient);
  findBared(cut);
  findIncision();
}

void FlapPlan::findLingualCrest() {
  for (int column = 0; column < chart_.columns(); ++column) {
    double found = 0.0;
    for (int row = 1; row < chart_.rows(); ++row) {
      const ChartPlace at = chart_.node(column, row);
      found = at.angle_rad;
      if (at.angle_rad >= 0.0 || (chart_.isGum(column, row) && glm::dot(chart_.normal_P(at), chart_.up_P()) > kFlat) ||
          !chart_.isGum(column, row))
        break;
    }
    lingual_rad_.push_back(found);
  }
  // The middle one of seven neighbours.
  const std::vector<double> raw = lingual_rad_;
  for (std::size_t n = 3; n + 3 < raw.size(); ++n) {
    std::vector<double> near(raw.begin() + static_cast<std::ptrdiff_t>(n) - 3,
                             raw.begin() + static_cast<std::ptrdiff_t>(n) + 4);
    std::ranges::nth_element(near, near.begin() + 3);
    lingual_rad_[n] = near[3];
  }
}

double FlapPlan::lingualCrest_rad(double m_mm) const {
  // Behind the planned incision the ridge goes over into the ramus.
  const double from_mm = line_.empty() ? m_mm : line_[first_crest_].m_mm;
  const double at = (std::max(m_mm, from_mm) - chart_.node(0, 0).m_mm) / GumChart::kColumn_mm;
  return lingual_rad_[static_cast<std::size_t>(
      std::clamp(std::lround(at), 0L, static_cast<long>(lingual_rad_.size()) - 1))];
}

void FlapPlan::findTeeth(const assets::Patient& patient) {
  if (!patient.site || patient.ct.tooth.empty()) return;
  struct Crown {
    double low_m_mm = 1e9, high_m_mm = -1e9, sum_b_mm = 0.0, count = 0.0;
  } second, first;
  assets::forVoxels(patient.ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const int fdi = patient.ct.tooth[v];
    if (fdi != patient.site->fdi - 1 && fdi != patient.site->fdi - 2) return;
    const glm::dvec3 p = patient.ct.grid.centre_P_mm(ijk);
    const ChartPlace at = chart_.placeOf(p);
    const double r_mm = chart_.radiusOf_mm(p);
    if (r_mm * std::cos(at.angle_rad) < kCrownOver_mm) return;
    Crown& crown = fdi == patient.site->fdi - 1 ? second : first;
    crown.low_m_mm = std::min(crown.low_m_mm, at.m_mm), crown.high_m_mm = std::max(crown.high_m_mm, at.m_mm);
    crown.sum_b_mm += r_mm * std::sin(at.angle_rad), crown.count += 1.0;
  });
  if (second.count == 0.0) return;
  middle_b_mm_ = second.sum_b_mm / second.count;
  papilla_m_mm_ = first.count > 0.0 ? 0.5 * (second.high_m_mm + first.low_m_mm) : second.high_m_mm;
}

void FlapPlan::findBared(const assets::PlannedCut& cut) {
  const assets::CutField field(cut, kBared_mm + 1.0, true);
  const auto is_over = [&](const ChartPlace& at) {
    const double gum_mm = chart_.gum_mm(at);
    for (double r_mm = chart_.bone_mm(at) - kUnderGum_mm; r_mm < gum_mm + 0.1; r_mm += 0.3)
      if (field.distance_mm(chart_.point_P_mm(at, r_mm)) < kBared_mm) return true;
    return false;
  };
  double highest_rad = -10.0;
  for (int column = 0; column < chart_.columns(); ++column)
    for (int row = 0; row < chart_.rows(); ++row) {
      const ChartPlace at = chart_.node(column, row);
      if (!chart_.isGum(column, row) || !is_over(at)) continue;
      bared_.push_back(at);
      auto& over = over_rad_[static_cast<std::size_t>(column)];
      if (!over) over = glm::dvec2(at.angle_rad);
      over->x = std::min(over->x, at.angle_rad), over->y = std::max(over->y, at.angle_rad);
      highest_rad = std::max(highest_rad, at.angle_rad);
    }
  if (bared_.empty()) return;
  const double m_mm = bared_[bared_.size() / 2].m_mm;
  base_rad_ = highest_rad;
  while (base_rad_ < GumChart::kHighest_rad - 0.1 && acrossGum_mm(chart_, m_mm, highest_rad, base_rad_) < kBase_mm)
    base_rad_ += 0.02;
}

void FlapPlan::findIncision() {
  if (bared_.empty()) return;
  double first_m = 1e9, last_m = -1e9;
  for (const ChartPlace& at : bared_) first_m = std::min(first_m, at.m_mm), last_m = std::max(last_m, at.m_mm);
  double end_m = last_m + kInFront_mm;
  if (papilla_m_mm_ && std::abs(end_m - *papilla_m_mm_) < kOffPapilla_mm) end_m = *papilla_m_mm_ + kOffPapilla_mm;

  // On each column the middle of the ridge, or the gum on the cheek's side of a tooth.
  std::vector<ChartPlace> crest;
  std::vector<double> least;  // beside a tooth
  for (int column = 0; column < chart_.columns(); ++column) {
    const double m_mm = chart_.node(column, 0).m_mm;
    if (m_mm < first_m - kBehind_mm || m_mm > end_m) continue;
    double low_rad = GumChart::kLowest_rad, wanted = GumChart::kLowest_rad;
    for (int row = 0; row < chart_.rows() && chart_.node(0, row).angle_rad < 0.6; ++row)
      if (!chart_.isGum(column, row))
        low_rad = chart_.node(column, row).angle_rad +
                  kOffTooth_mm / chart_.gum_mm(chart_.node(column, std::min(row + 2, chart_.rows() - 1)));
    for (int row = 0; row < chart_.rows(); ++row) {
      wanted = chart_.node(column, row).angle_rad;
      if (chart_.gum_mm(chart_.node(column, row)) * std::sin(wanted) > middle_b_mm_) break;
    }
    if (const auto& over = over_rad_[static_cast<std::size_t>(column)]) wanted = std::max(wanted, over->x - 0.04);
    crest.push_back({m_mm, std::max(low_rad, wanted)});
    least.push_back(low_rad);
  }
  for (int pass = 0; pass < 6; ++pass) {
    const std::vector<ChartPlace> raw = crest;
    for (std::size_t n = 1; n + 1 < raw.size(); ++n)
      crest[n].angle_rad =
          std::max(least[n], 0.25 * (raw[n - 1].angle_rad + 2.0 * raw[n].angle_rad + raw[n + 1].angle_rad));
  }
  if (crest.empty()) return;
  line_ = towardsCheek(crest.front(), kBehindLimb_mm, -kBackwards);
  std::ranges::reverse(line_);
  first_crest_ = line_.size(), crest_points_ = crest.size();
  line_.insert(line_.end(), crest.begin(), crest.end());
  const std::vector<ChartPlace> limb = towardsCheek(crest.back(), kLimb_mm, kForwards);
  line_.insert(line_.end(), limb.begin(), limb.end());
  std::erase_if(bared_, [&](const ChartPlace& place) {
    return place.angle_rad < crest_rad(place.m_mm) + 0.5 * GumChart::kRow_rad;
  });
}

/// A releasing cut, without the place it starts from.
std::vector<ChartPlace> FlapPlan::towardsCheek(ChartPlace at, double length_mm, double along) const {
  constexpr double kStep_mm = 0.4;
  std::vector<ChartPlace> way;
  for (double way_mm = 0.0; way_mm < length_mm;) {
    const double step_rad = kStep_mm / std::max(4.0, chart_.gum_mm(at));
    const ChartPlace next{at.m_mm + kStep_mm * along, at.angle_rad + step_rad};
    if (!chart_.isGum(next) || next.angle_rad > base_rad_ - 0.1) break;
    way_mm += glm::distance(chart_.surface_P_mm(at), chart_.surface_P_mm(next));
    way.push_back(at = next);
  }
  return way;
}

double FlapPlan::crest_rad(double m_mm) const {
  const auto begin = line_.begin() + static_cast<std::ptrdiff_t>(first_crest_);
  const auto end = begin + static_cast<std::ptrdiff_t>(crest_points_);
  const auto near = std::min_element(begin, end, [&](const ChartPlace& a, const ChartPlace& b) {
    return std::abs(a.m_mm - m_mm) < std::abs(b.m_mm - m_mm);
  });
  return near == end ? 0.0 : near->angle_rad;
}

std::vector<glm::dvec3> FlapPlan::incision_P_mm() const {
  std::vector<glm::dvec3> line;
  for (const ChartPlace& at : line_) line.push_back(chart_.surface_P_mm(at));
  return line;
}

double FlapPlan::incisionLength_mm() const {
  const std::vector<glm::dvec3> line = incision_P_mm();
  double sum_mm = 0.0;
  for (std::size_t n = 1; n < line.size(); ++n) sum_mm += glm::distance(line[n - 1], line[n]);
  return sum_mm;
}

}  // namespace app
