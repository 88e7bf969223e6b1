#include "app/procedure/third_molar/cleaning_plan.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/core.h>

namespace app {
namespace {

// Our defaults.
constexpr double kOneReach_mm = 2.5;     ///< of a suction tip that stands still
constexpr double kOneScrape_mm = 1.6;    ///< of a curette drawn at a place
constexpr double kWorthFiling_mm = 1.5;  ///< length of an edge
/// What may be loose after each is taken at last; what a file leaves is filed once more.
constexpr std::array kRound{Cleaning::suction, Cleaning::curette, Cleaning::suction, Cleaning::file,
                            Cleaning::suction, Cleaning::file,    Cleaning::suction, Cleaning::stitch};

/// Middles of groups that lie within `reach_mm`, in the order of a way from one to the nearest next.
std::vector<glm::dvec3> grouped(std::vector<glm::dvec3> places, double reach_mm) {
  std::vector<glm::dvec3> middles;
  while (!places.empty()) {
    const glm::dvec3 first = places.front();
    glm::dvec3 sum(0.0);
    double count = 0.0;
    std::erase_if(places, [&](const glm::dvec3& p) {
      if (glm::distance(p, first) > reach_mm) return false;
      sum += p;
      count += 1.0;
      return true;
    });
    middles.push_back(sum / count);
  }
  for (std::size_t n = 1; n < middles.size(); ++n) {
    const auto from = middles.begin() + static_cast<std::ptrdiff_t>(n);
    std::iter_swap(from, std::ranges::min_element(from, middles.end(), {}, [&](const glm::dvec3& p) {
                     return glm::distance(p, middles[n - 1]);
                   }));
  }
  return middles;
}

std::string wordsOf(Cleaning what, std::size_t count) {
  constexpr std::array<const char*, kCleanings> kWords{"suck away what is loose", "scrape the follicle off",
                                                       "file sharp edges", "confirm the stitches"};
  return fmt::format("{} ({} place{})", kWords[static_cast<std::size_t>(what)], count, count == 1 ? "" : "s");
}

}  // namespace

std::optional<CleaningStep> CleaningPlanner::stepOf(Cleaning what, const SiteLeft& left) const {
  CleaningStep step{what, {}, out_P_};
  switch (what) {
    case Cleaning::suction: {
      std::vector<glm::dvec3> loose = left.chips_P_mm;
      loose.insert(loose.end(), left.loose_P_mm.begin(), left.loose_P_mm.end());
      for (const glm::dvec3& p : grouped(loose, kOneReach_mm)) step.ways_P_mm.push_back({p});
      break;
    }
    case Cleaning::curette: {
      glm::dvec3 middle(0.0);
      for (const glm::dvec3& p : left.stuck_P_mm) middle += p / static_cast<double>(left.stuck_P_mm.size());
      step.middle_P_mm = middle;
      for (const glm::dvec3& p : grouped(left.stuck_P_mm, kOneScrape_mm)) step.ways_P_mm.push_back({p});
      break;
    }
    case Cleaning::file:
      for (const SharpEdge& edge : left.edges) {
        if (edge.length_mm < kWorthFiling_mm) continue;
        std::vector<glm::dvec3> way = grouped(edge.points_P_mm, 0.1 * kEdgeStep_mm);
        step.ways_P_mm.push_back(std::move(way));
      }
      break;
    case Cleaning::stitch:
      for (const glm::dvec3& p : left.stitches_P_mm) step.ways_P_mm.push_back({p});
      break;
  }
  return step.ways_P_mm.empty() ? std::nullopt : std::optional(std::move(step));
}

std::optional<OperationStep> CleaningPlanner::next(const SiteLeft& left) {
  while (next_ < kRound.size()) {
    const Cleaning what = kRound[next_++];
    if (!has_[static_cast<std::size_t>(what)]) continue;
    if (auto step = stepOf(what, left)) {
      const std::string words = wordsOf(what, step->ways_P_mm.size());
      return OperationStep{std::move(*step), words};
    }
  }
  return {};
}

}  // namespace app
