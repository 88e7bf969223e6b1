#include "app/procedure/third_molar/cleaning_plan.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/core.h>

#include "app/procedure/debris/follicle.h"
#include "app/procedure/debris/suction_tip.h"

namespace app {
namespace {

// Our defaults.
constexpr double kSurely_mm = 0.3;                 ///< nearer than the reach of suction or curette
constexpr double kAtWall_mm = 0.4;                 ///< of a curette before it is pressed
constexpr double kDrawn_mm = 0.5;                  ///< of a curette, to either side
constexpr double kWorthFiling_mm = 1.0;            ///< length of an edge
constexpr std::array kFiledLeans{0.0, 0.6, -0.6};  ///< to either side of an edge
constexpr std::size_t kFiledPoints = 8;            ///< of an edge, filed at once
constexpr double kFileSinks_mm = 0.35;             ///< beside an edge the file may touch as deep
constexpr double kFileOffTongue_mm = 0.6;          ///< off the jaw's surface there: what it takes away, and a voxel
/// What may be loose after each is taken at last; what a file leaves is filed once more.
constexpr std::array kRound{Cleaning::suction, Cleaning::curette, Cleaning::suction,
                            Cleaning::curette, Cleaning::suction, Cleaning::file,
                            Cleaning::file,    Cleaning::suction, Cleaning::stitch};

/// Order along an edge, from one of its ends.
std::vector<glm::dvec3> inOrder(std::vector<glm::dvec3> points) {
  if (points.size() < 3) return points;
  const glm::dvec3 any = points.front();
  std::iter_swap(points.begin(),
                 std::ranges::max_element(points, {}, [&](const glm::dvec3& p) { return glm::distance(p, any); }));
  for (std::size_t n = 1; n < points.size(); ++n) {
    const auto from = points.begin() + static_cast<std::ptrdiff_t>(n);
    std::iter_swap(from, std::ranges::min_element(from, points.end(), {}, [&](const glm::dvec3& p) {
                     return glm::distance(p, points[n - 1]);
                   }));
  }
  return points;
}

std::vector<CleaningPlace> suckedAt(const std::vector<glm::dvec3>& loose, const SocketReach& reach, double tip_mm) {
  std::vector<CleaningPlace> places;
  const auto sucks = [&](const TipPlace& place, const glm::dvec3& goal) {
    const glm::dvec3 opening = place.at_P_mm - tip_mm * place.shaft_P;
    return glm::distance(opening, goal) < kRinsed_mm - kSurely_mm && reach.isOpen(opening, goal);
  };
  constexpr double kAnyWall_mm = 10.0;
  for (const auto& chosen : reach.fewestFor(loose, tip_mm, kRinsed_mm, kAnyWall_mm, sucks))
    places.push_back({{chosen.place.at_P_mm}, chosen.place.shaft_P, {}});
  return places;
}

/// Against the wall, and drawn along it towards the handle.
std::vector<CleaningPlace> scrapedAt(const std::vector<glm::dvec3>& stuck, const SocketReach& reach, double tip_mm) {
  std::vector<CleaningPlace> places;
  const double reach_mm = tip_mm + kScrapeReach_mm - kSurely_mm;
  // Pressed, the tip touches the wall.
  const auto scrapes = [&](const TipPlace& place, const glm::dvec3& goal) {
    const glm::dvec3 pressed_P_mm = place.at_P_mm - (place.wall_mm - tip_mm) * place.wall_P;
    return glm::distance(pressed_P_mm, goal) < reach_mm;
  };
  for (const auto& chosen : reach.fewestFor(stuck, tip_mm, reach_mm, kAtWall_mm, scrapes)) {
    const TipPlace& place = chosen.place;
    const glm::dvec3 n = place.wall_P;
    glm::dvec3 along = place.shaft_P - glm::dot(place.shaft_P, n) * n;
    along = glm::length(along) > 0.2 ? glm::normalize(along) : glm::normalize(glm::cross(n, glm::dvec3(1.0, 0.3, 0.0)));
    const glm::dvec3 foot = place.at_P_mm - place.wall_mm * n;
    places.push_back({{foot - kDrawn_mm * along, foot + kDrawn_mm * along}, place.shaft_P, {-n}});
  }
  return places;
}

/// From straight above and from either side, as far as the handle is clear and the jaw's surface towards the tongue,
/// `tongue_P_mm`, stays whole.
std::optional<CleaningPlace> filedAlong(const std::vector<glm::dvec3>& way, const SocketReach& reach, double tip_mm,
                                        const std::vector<glm::dvec3>& tongue_P_mm) {
  const auto spares_tongue = [&](const glm::dvec3& middle_P_mm) {
    return std::ranges::none_of(
        tongue_P_mm, [&](const glm::dvec3& q) { return glm::distance(middle_P_mm, q) < tip_mm + kFileOffTongue_mm; });
  };
  glm::dvec3 out(0.0);
  for (const glm::dvec3& p : way) out += reach.placeAt(p, reach.shafts_P().front()).wall_P;
  out = glm::length(out) > 1e-6 ? glm::normalize(out) : reach.shafts_P().front();
  glm::dvec3 along = way.back() - way.front();
  along -= glm::dot(along, out) * out;
  along = glm::length(along) > 0.1 ? glm::normalize(along)
                                   : glm::normalize(glm::cross(out, std::abs(out.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0)
                                                                                          : glm::dvec3(0.0, 1.0, 0.0)));
  const glm::dvec3 side = glm::cross(out, along);
  std::optional<CleaningPlace> best;
  for (const glm::dvec3& shaft : reach.shafts_P()) {
    CleaningPlace place{way, shaft, {}};
    for (const double lean : kFiledLeans) {
      const glm::dvec3 into = -glm::normalize(out + lean * side);
      if (std::ranges::all_of(way, [&](const glm::dvec3& p) {
            const glm::dvec3 middle_P_mm = p - tip_mm * into;
            return spares_tongue(middle_P_mm) && reach.isFree(middle_P_mm, shaft, tip_mm, kFileSinks_mm);
          }))
        place.into_P.push_back(into);
    }
    if (!place.into_P.empty() && (!best || place.into_P.size() > best->into_P.size())) best = std::move(place);
    if (best && best->into_P.size() == kFiledLeans.size()) break;
  }
  return best;
}

std::vector<CleaningPlace> filedAt(const std::vector<SharpEdge>& edges, const SocketReach& reach, double tip_mm,
                                   const std::vector<glm::dvec3>& tongue_P_mm) {
  std::vector<CleaningPlace> places;
  for (const SharpEdge& edge : edges) {
    if (edge.length_mm < kWorthFiling_mm) continue;
    const std::vector<glm::dvec3> course = inOrder(edge.points_P_mm);
    const std::size_t parts = (course.size() + kFiledPoints - 1) / kFiledPoints;
    for (std::size_t part = 0; part < parts; ++part) {
      const auto at = [&](std::size_t n) {
        return course.begin() + static_cast<std::ptrdiff_t>(n * course.size() / parts);
      };
      if (auto place = filedAlong({at(part), at(part + 1)}, reach, tip_mm, tongue_P_mm))
        places.push_back(std::move(*place));
    }
  }
  return places;
}

std::string wordsOf(Cleaning what, std::size_t count) {
  constexpr std::array<const char*, kCleanings> kWords{"suck away what is loose", "scrape the follicle off",
                                                       "file sharp edges", "confirm the stitches"};
  return fmt::format("{} ({} place{})", kWords[static_cast<std::size_t>(what)], count, count == 1 ? "" : "s");
}

bool isAnything(Cleaning what, const SiteLeft& left) {
  switch (what) {
    case Cleaning::suction:
      return !left.chips_P_mm.empty() || !left.loose_P_mm.empty();
    case Cleaning::curette:
      return !left.stuck_P_mm.empty();
    case Cleaning::file:
      return !left.edges.empty();
    case Cleaning::stitch:
      return !left.stitches_P_mm.empty();
  }
  return false;
}

/// Of what is in the socket.
glm::dvec3 middleOf(const SiteLeft& left) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  const auto take = [&](const std::vector<glm::dvec3>& places) {
    for (const glm::dvec3& p : places) low = glm::min(low, p), high = glm::max(high, p);
  };
  take(left.chips_P_mm), take(left.stuck_P_mm), take(left.loose_P_mm);
  for (const SharpEdge& edge : left.edges) take(edge.points_P_mm);
  return 0.5 * (low + high);
}

}  // namespace

std::vector<CleaningPlace> CleaningPlanner::placesFor(Cleaning what, const SiteLeft& left, const SocketReach& reach,
                                                      double tip_mm) const {
  if (what == Cleaning::curette) return scrapedAt(left.stuck_P_mm, reach, tip_mm);
  if (what == Cleaning::file) return filedAt(left.edges, reach, tip_mm, tongue_P_mm_);
  std::vector<glm::dvec3> loose = left.chips_P_mm;
  loose.insert(loose.end(), left.loose_P_mm.begin(), left.loose_P_mm.end());
  return suckedAt(loose, reach, tip_mm);
}

std::optional<OperationStep> CleaningPlanner::next(const SiteLeft& left, const assets::VolumeGrid& grid,
                                                   const std::vector<std::uint8_t>& jaw) {
  std::optional<SocketReach> reach;
  while (next_ < kRound.size()) {
    const Cleaning what = kRound[next_++];
    const auto& tip_mm = tips_mm_[static_cast<std::size_t>(what)];
    if (!tip_mm || !isAnything(what, left)) continue;
    CleaningStep step{what, {}, out_P_};
    if (what == Cleaning::stitch) {
      for (const glm::dvec3& p : left.stitches_P_mm) step.places.push_back({{p}, out_P_, {}});
    } else {
      if (!reach) reach.emplace(grid, jaw, middleOf(left), out_P_ + shaft_P_);
      step.places = placesFor(what, left, *reach, *tip_mm);
    }
    if (step.places.empty()) continue;
    const std::string words = wordsOf(what, step.places.size());
    return OperationStep{std::move(step), words};
  }
  return {};
}

}  // namespace app
