#include "app/case/root_form.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "calibration/geometry/units.h"

namespace app {
namespace {

constexpr double kSlice_mm = 0.5, kLeastSection_mm2 = 1.0;

/// Of one root in one slice: mesial and buccal.
using SectionCentres = std::vector<glm::dvec2>;

/// Connected parts of the points on a square lattice, by mesial coordinate.
SectionCentres partsOf(const std::vector<glm::dvec2>& points_mm, double cell_mm) {
  glm::dvec2 low(1e9), high(-1e9);
  for (const glm::dvec2& p : points_mm) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::ivec2 size = glm::ivec2((high - low) / cell_mm) + 1;
  std::vector<char> full(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), 0);
  const auto at = [&](glm::ivec2 c) {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(c.x);
  };
  for (const glm::dvec2& p : points_mm) full[at(glm::ivec2((p - low) / cell_mm))] = 1;

  SectionCentres centres;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      if (full[at({x, y})] == 0) continue;
      std::vector<glm::ivec2> part{{x, y}};
      full[at({x, y})] = 0;
      glm::dvec2 sum(0.0);
      for (std::size_t n = 0; n < part.size(); ++n) {
        const glm::ivec2 here = part[n];
        sum += glm::dvec2(here);
        for (const glm::ivec2 way : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
          const glm::ivec2 next = here + way;
          if (glm::any(glm::lessThan(next, glm::ivec2(0))) || glm::any(glm::greaterThanEqual(next, size)) ||
              full[at(next)] == 0)
            continue;
          full[at(next)] = 0;
          part.push_back(next);
        }
      }
      const auto cells = static_cast<double>(part.size());
      if (cells * cell_mm * cell_mm >= kLeastSection_mm2) centres.push_back(low + cell_mm * (sum / cells + 0.5));
    }
  std::ranges::sort(centres, {}, [](const glm::dvec2& c) { return c.x; });
  return centres;
}

}  // namespace

std::optional<RootForm> rootForm(const ToothVoxels& tooth, const glm::dvec3& axis_P, const glm::dvec3& mesial_P,
                                 double voxel_mm) {
  constexpr double kLeastRoot_mm = 3.0, kApart_mm = 2.0;
  const std::vector<glm::dvec3> line = cervicalLine_P_mm(tooth, axis_P);
  if (line.empty()) return std::nullopt;
  double cervix_mm = 0.0, apex_mm = 1e9;
  for (const glm::dvec3& p : line) cervix_mm += glm::dot(p, axis_P) / static_cast<double>(line.size());
  for (const glm::dvec3& p : tooth.all_P_mm) apex_mm = std::min(apex_mm, glm::dot(p, axis_P));
  RootForm form{.length_mm = cervix_mm - apex_mm};
  if (form.length_mm < kLeastRoot_mm) return std::nullopt;

  const glm::dvec3 mesial = glm::normalize(mesial_P - glm::dot(mesial_P, axis_P) * axis_P);
  const glm::dvec3 across = glm::cross(axis_P, mesial);
  std::vector<std::vector<glm::dvec2>> slices(static_cast<std::size_t>(form.length_mm / kSlice_mm));
  for (const glm::dvec3& p : tooth.all_P_mm) {
    const double below = (cervix_mm - glm::dot(p, axis_P)) / kSlice_mm;
    if (below >= 0.0 && below < static_cast<double>(slices.size()))
      slices[static_cast<std::size_t>(below)].emplace_back(glm::dot(p, mesial), glm::dot(p, across));
  }
  std::vector<SectionCentres> sections;
  for (const auto& slice : slices)
    sections.push_back(slice.empty() ? SectionCentres{} : partsOf(slice, 1.25 * voxel_mm));

  // The largest number that holds over 2 mm of length.
  const auto slices_with = [&](std::size_t count) {
    return std::ranges::count_if(sections, [&](const SectionCentres& s) { return s.size() == count; });
  };
  std::size_t count = 1;
  for (std::size_t n = 2; n <= 4; ++n)
    if (static_cast<double>(slices_with(n)) * kSlice_mm >= kApart_mm) count = n;
  form.count = static_cast<int>(count);

  // From the first to the last slice in which all are apart.
  std::optional<std::size_t> first;
  std::size_t last = 0;
  for (std::size_t n = 0; n < sections.size(); ++n) {
    if (sections[n].size() != count) continue;
    if (!first) first = n;
    last = n;
  }
  if (!first || last == *first) return form;
  if (count > 1) form.furcation_mm = kSlice_mm * static_cast<double>(*first);
  const SectionCentres &neck = sections[*first], &end = sections[last];
  const double way_mm = kSlice_mm * static_cast<double>(last - *first);
  for (std::size_t root = 0; root < count; ++root) {
    const double bend_deg = calibration::degreesFromRad(std::atan2(neck[root].x - end[root].x, way_mm));
    if (std::abs(bend_deg) > std::abs(form.bend_deg)) form.bend_deg = bend_deg;
  }
  form.spread_mm = glm::distance(end.front(), end.back()) - glm::distance(neck.front(), neck.back());
  return form;
}

}  // namespace app
