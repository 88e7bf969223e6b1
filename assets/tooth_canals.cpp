#include "assets/tooth_canals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "assets/smooth_distance.h"

namespace assets {
namespace {

constexpr double kHeightStep_mm = 0.2;
constexpr double kFunnel_mm = 0.3;       ///< of the smooth union of canals and chamber
constexpr double kChamberEdge_mm = 0.4;  ///< its rounded edges
constexpr double kOpen_mm = 0.5;         ///< a line goes on beyond orifice and foramen
constexpr double kShortOfForamen_mm = 0.5;
constexpr double kFar_mm = 1e3;
constexpr double kChange = 1.25;  ///< of the distances, at most, to the way

/// Signed, of an ellipse about the origin: exact on it, first order beside it.
double ellipse_mm(double x, double y, double a, double b) {
  // Not std::hypot, which guards against overflow at twice the cost.
  const double u = x / a, v = y / b, k0 = std::sqrt(u * u + v * v), s = u / a, t = v / b, k1 = std::sqrt(s * s + t * t);
  return k1 < 1e-9 ? -std::min(a, b) : k0 * (k0 - 1.0) / k1;
}

double toSegment_mm(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 edge = b - a;
  const double squared = glm::dot(edge, edge);
  const double t = squared > 0.0 ? std::clamp(glm::dot(p - a, edge) / squared, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + t * edge);
}

}  // namespace

std::vector<glm::dvec2> hullOf(std::vector<glm::dvec2> points) {
  std::ranges::sort(points,
                    [](const glm::dvec2& a, const glm::dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  if (points.size() < 3) return points;
  const auto turns_left = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0.0;
  };
  std::vector<glm::dvec2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const glm::dvec2& p : points) {
      while (hull.size() >= first + 2 && !turns_left(hull[hull.size() - 2], hull.back(), p)) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

double outlineDistance_mm(const std::vector<glm::dvec2>& outline, const glm::dvec2& p) {
  double least_mm = std::numeric_limits<double>::max();
  bool inside = false;
  for (std::size_t n = 0; n < outline.size(); ++n) {
    const glm::dvec2 a = outline[n], b = outline[(n + 1) % outline.size()];
    least_mm = std::min(least_mm, toSegment_mm(p, a, b));
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside && outline.size() > 2 ? -least_mm : least_mm;
}

double ToothCanal::workingLength_mm() const {
  return glm::distance(reference_P_mm, orifice_P_mm()) + length_mm() - kShortOfForamen_mm;
}

double ToothCanal::smallestWidth_mm() const {
  double least_mm = std::numeric_limits<double>::max();
  for (const CanalPlace& place : places) least_mm = std::min(least_mm, 2.0 * std::min(place.narrow_mm, place.wide_mm));
  return least_mm;
}

CanalPlace ToothCanal::at(double along_mm) const {
  const auto next = std::ranges::upper_bound(places, along_mm, {}, &CanalPlace::along_mm);
  if (next == places.begin()) return places.front();
  if (next == places.end()) return places.back();
  const CanalPlace &a = *(next - 1), &b = *next;
  const double t = (along_mm - a.along_mm) / (b.along_mm - a.along_mm);
  return {glm::mix(a.p_P_mm, b.p_P_mm, t), along_mm, glm::mix(a.narrow_mm, b.narrow_mm, t),
          glm::mix(a.wide_mm, b.wide_mm, t)};
}

double schneider_rad(const std::vector<CanalPlace>& places) {
  constexpr double kNear_mm = 0.05, kClear_mm = 0.2;  // off the axis; an arc is there after sqrt(2 R mm)
  const glm::dvec3 orifice = places.front().p_P_mm, foramen = places.back().p_P_mm;
  const double quarter_mm = 0.25 * places.back().along_mm;
  std::size_t coronal = 0;
  while (coronal + 1 < places.size() && places[coronal].along_mm < quarter_mm) ++coronal;
  const glm::dvec3 axis = glm::normalize(places[coronal].p_P_mm - orifice);
  const auto aside_mm = [&](std::size_t n) { return glm::length(glm::cross(places[n].p_P_mm - orifice, axis)); };
  /// Along the canal, where it is first that far off its axis and remains so.
  const auto off_at = [&](double mm) {
    std::size_t n = places.size() - 1;
    while (n > coronal && aside_mm(n - 1) >= mm) --n;
    const double before = n > 0 ? aside_mm(n - 1) : 0.0, here = aside_mm(n);
    if (n == 0 || here <= before || here < mm) return places[n].along_mm;
    return glm::mix(places[n - 1].along_mm, places[n].along_mm, std::clamp((mm - before) / (here - before), 0.0, 1.0));
  };
  // Where it leaves: an arc is twice as far along at four times the way aside.
  const double leaves_mm = std::clamp(2.0 * off_at(kNear_mm) - off_at(kClear_mm), 0.0, places.back().along_mm);
  std::size_t next = 1;
  while (next + 1 < places.size() && places[next].along_mm < leaves_mm) ++next;
  const CanalPlace &a = places[next - 1], &b = places[next];
  const double t = std::clamp((leaves_mm - a.along_mm) / (b.along_mm - a.along_mm), 0.0, 1.0);
  const glm::dvec3 to_foramen = foramen - glm::mix(a.p_P_mm, b.p_P_mm, t);
  return std::atan2(glm::length(glm::cross(axis, to_foramen)), glm::dot(axis, to_foramen));
}

PulpDistance::PulpDistance(const ToothCanals& canals) : frame_(canals.frame), chamber_(canals.chamber) {
  for (const ToothCanal& canal : canals.canals) {
    std::vector<CanalPlace> places = canal.places;
    // What it shares with another is that one's: a union with itself would be wider.
    if (canal.joins) {
      const std::vector<CanalPlace>& other = canals.canals[*canal.joins].places;
      const auto shared = std::ranges::find_first_of(places, other, {}, &CanalPlace::p_P_mm, &CanalPlace::p_P_mm);
      places.erase(shared == places.end() ? shared : shared + 1, places.end());
    }
    for (CanalPlace& place : places) place.p_P_mm = frame_.local(place.p_P_mm);
    // Open at both ends: never a lid.
    const auto beyond = [](const CanalPlace& end, const CanalPlace& inner) {
      CanalPlace open = end;
      open.p_P_mm += kOpen_mm * glm::normalize(end.p_P_mm - inner.p_P_mm);
      return open;
    };
    places.insert(places.begin(), beyond(places[0], places[1]));
    if (!canal.joins) places.push_back(beyond(places.back(), places[places.size() - 2]));

    Line line;
    line.low_mm = line.high_mm = places.front().p_P_mm;
    double widest_mm = 0.0;
    for (std::size_t n = 0; n + 1 < places.size(); ++n) {
      const CanalPlace &a = places[n], &b = places[n + 1];
      const double length_mm = glm::distance(a.p_P_mm, b.p_P_mm);
      const glm::dvec3 along = (b.p_P_mm - a.p_P_mm) / length_mm, buccal(0.0, 1.0, 0.0);
      line.pieces.push_back({a.p_P_mm, along, glm::normalize(buccal - glm::dot(buccal, along) * along), length_mm,
                             a.narrow_mm, (b.narrow_mm - a.narrow_mm) / length_mm, a.wide_mm,
                             (b.wide_mm - a.wide_mm) / length_mm});
      line.low_mm = glm::min(line.low_mm, b.p_P_mm);
      line.high_mm = glm::max(line.high_mm, b.p_P_mm);
      widest_mm = std::max({widest_mm, a.wide_mm, a.narrow_mm, b.wide_mm, b.narrow_mm});
    }
    line.low_mm -= widest_mm;
    line.high_mm += widest_mm;
    line.top_mm = places.front().p_P_mm.z;
    std::size_t piece = 0;
    for (double z = line.top_mm; z > places.back().p_P_mm.z; z -= kHeightStep_mm) {
      while (piece + 1 < line.pieces.size() && line.pieces[piece + 1].from_mm.z > z) ++piece;
      line.by_height.push_back(piece);
    }
    if (line.by_height.empty()) line.by_height.push_back(0);
    lines_.push_back(std::move(line));
  }
}

double PulpDistance::chamberDistance_mm(const glm::dvec3& p) const {
  const double middle_mm = 0.5 * (chamber_.roof_mm + chamber_.floor_mm);
  const double slab_mm = std::abs(p.z - middle_mm) - 0.5 * (chamber_.roof_mm - chamber_.floor_mm);
  double distance_mm =
      smoothMax(outlineDistance_mm(chamber_.outline_mm, {p.x, p.y}) - chamber_.round_mm, slab_mm, kChamberEdge_mm);
  for (const PulpChamber::Horn& horn : chamber_.horns) {
    const double lowest_mm = std::min(horn.from_mm.z, horn.to_mm.z) - horn.from_radius_mm;
    if (lowest_mm - p.z > distance_mm + kChamberEdge_mm) continue;
    const glm::dvec3 edge = horn.to_mm - horn.from_mm;
    const double t = std::clamp(glm::dot(p - horn.from_mm, edge) / glm::dot(edge, edge), 0.0, 1.0);
    const double radius_mm = glm::mix(horn.from_radius_mm, horn.to_radius_mm, t);
    distance_mm = smoothMin(distance_mm, glm::distance(p, horn.from_mm + t * edge) - radius_mm, kChamberEdge_mm);
  }
  return distance_mm;
}

double PulpDistance::lineDistance_mm(const Line& line, const glm::dvec3& p) {
  // From the piece at this height to the nearest one.
  const double below =
      std::clamp((line.top_mm - p.z) / kHeightStep_mm, 0.0, static_cast<double>(line.by_height.size() - 1));
  std::size_t piece = line.by_height[static_cast<std::size_t>(below)];
  const auto squared_mm2 = [&](std::size_t n, double& t_mm) {
    const Piece& one = line.pieces[n];
    const glm::dvec3 to = p - one.from_mm;
    t_mm = std::clamp(glm::dot(to, one.along), 0.0, one.length_mm);
    const glm::dvec3 away = to - t_mm * one.along;
    return glm::dot(away, away);
  };
  double t_mm = 0.0, least_mm2 = squared_mm2(piece, t_mm);
  const auto walk = [&](bool down) {
    while (down ? piece + 1 < line.pieces.size() : piece > 0) {
      const std::size_t next = down ? piece + 1 : piece - 1;
      double next_t_mm = 0.0;
      const double next_mm2 = squared_mm2(next, next_t_mm);
      if (next_mm2 > least_mm2) return;
      least_mm2 = next_mm2, t_mm = next_t_mm, piece = next;
    }
  };
  walk(true);
  walk(false);

  const Piece& one = line.pieces[piece];
  const glm::dvec3 away = p - one.from_mm - t_mm * one.along;
  const double beyond_mm = std::abs(glm::dot(away, one.along)), wide = glm::dot(away, one.wide);
  const double narrow = std::sqrt(std::max(0.0, least_mm2 - beyond_mm * beyond_mm - wide * wide));
  const double aside_mm =
      ellipse_mm(narrow, wide, one.narrow_mm + t_mm * one.narrow_step, one.wide_mm + t_mm * one.wide_step);
  // At its ends it is cut off flat.
  const bool is_end = (piece == 0 && t_mm == 0.0) || (piece + 1 == line.pieces.size() && t_mm == one.length_mm);
  if (!is_end) return aside_mm;
  return aside_mm > 0.0 ? std::hypot(aside_mm, beyond_mm) : std::max(aside_mm, beyond_mm);
}

PulpDistance::Parts PulpDistance::partsNear(const glm::dvec3& p_P_mm, double reach_mm) const {
  const glm::dvec3 p = frame_.local(p_P_mm);
  std::array<double, 8 * sizeof(Parts)> distance_mm{};
  distance_mm[0] = chamberDistance_mm(p);
  double least_mm = distance_mm[0];
  for (std::size_t n = 0; n < lines_.size(); ++n) {
    distance_mm[n + 1] = lineDistance_mm(lines_[n], p);
    least_mm = std::min(least_mm, distance_mm[n + 1]);
  }
  Parts parts = 0;
  for (std::size_t n = 0; n <= lines_.size(); ++n)
    if (distance_mm[n] < least_mm + kFunnel_mm + kChange * 2.0 * reach_mm) parts |= 1u << n;
  return parts;
}

double PulpDistance::at_mm(const glm::dvec3& p_P_mm, Parts parts) const {
  const glm::dvec3 p = frame_.local(p_P_mm);
  double distance_mm = kFar_mm;
  for (std::size_t n = 0; n < lines_.size(); ++n) {
    if ((parts >> (n + 1) & 1u) == 0) continue;
    const Line& line = lines_[n];
    const glm::dvec3 outside = glm::max(glm::max(line.low_mm - p, p - line.high_mm), glm::dvec3(0.0));
    const double least_mm = distance_mm + kFunnel_mm;
    if (least_mm < 0.0 || glm::dot(outside, outside) > least_mm * least_mm) continue;
    distance_mm = smoothMin(distance_mm, lineDistance_mm(line, p), kFunnel_mm);
  }
  // Far below its floor the chamber decides nothing.
  if ((parts & 1u) == 0 || chamber_.floor_mm - kChamberEdge_mm - p.z > distance_mm + kFunnel_mm) return distance_mm;
  return smoothMin(distance_mm, chamberDistance_mm(p), kFunnel_mm);
}

}  // namespace assets
