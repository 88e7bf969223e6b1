#include "app/procedure/preparation/bite.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/core.h>

#include "app/procedure/preparation/jaw_closing.h"

namespace app {
namespace {

constexpr int kBiteCells = OcclusalRaster::kSide;
constexpr double kBiteCell_mm = OcclusalRaster::kStep_mm;
/// Smaller ones are the voxels' roughness.
constexpr double kLeastMark_mm2 = 0.003;
/// A tooth that touches when the jaws are closed is touched within the raster's last digit.
constexpr double kTouching_mm = 0.0005;
constexpr glm::dvec3 kInk(0.05, 0.14, 0.55);

/// Of a triangle whose corners have gaps: the share of it where the gap, linear between them, is at most `most`.
double shareWithin(std::array<double, 3> gap, double most) {
  std::ranges::sort(gap);
  if (gap[0] > most) return 0.0;
  if (gap[2] <= most) return 1.0;
  if (gap[1] > most) return (most - gap[0]) * (most - gap[0]) / ((gap[1] - gap[0]) * (gap[2] - gap[0]));
  return 1.0 - (gap[2] - most) * (gap[2] - most) / ((gap[2] - gap[0]) * (gap[2] - gap[1]));
}

/// Between the middle two of four places (Catmull and Rom), 0..1.
std::array<double, 4> cubicWeights(double t) {
  return {0.5 * t * ((2.0 - t) * t - 1.0), 0.5 * (t * t * (3.0 * t - 5.0) + 2.0), 0.5 * t * ((4.0 - 3.0 * t) * t + 1.0),
          0.5 * (t - 1.0) * t * t};
}

/// Of a cell whose corners have gaps, its own round form kept: linear over 0.05 mm a ball of 2 mm is 0.2 µm flatter
/// than it is, which is 3 % of the mark of a foil.
double markedArea_mm2(const OcclusalRaster& gap_mm, int x, int y, double paper_mm) {
  constexpr int kParts = 3;
  const auto gap = [&](int i, int j) {
    const double u = static_cast<double>(i) / kParts, v = static_cast<double>(j) / kParts;
    const std::array<double, 4> across = cubicWeights(u), along = cubicWeights(v);
    double sum = 0.0;
    for (int b = 0; b < 4; ++b)
      for (int a = 0; a < 4; ++a)
        sum += across[static_cast<std::size_t>(a)] * along[static_cast<std::size_t>(b)] *
               static_cast<double>(
                   gap_mm.at(std::clamp(x + a - 1, 0, kBiteCells - 1), std::clamp(y + b - 1, 0, kBiteCells - 1)));
    if (!std::isnan(sum)) return sum;
    const auto row = [&](int at) {
      return std::lerp(static_cast<double>(gap_mm.at(x, at)), static_cast<double>(gap_mm.at(x + 1, at)), u);
    };
    return std::lerp(row(y), row(y + 1), v);
  };
  double share = 0.0;
  for (int j = 0; j < kParts; ++j)
    for (int i = 0; i < kParts; ++i) {
      const double a = gap(i, j), b = gap(i + 1, j), c = gap(i, j + 1), d = gap(i + 1, j + 1);
      share += 0.5 * (shareWithin({a, b, d}, paper_mm) + shareWithin({a, d, c}, paper_mm));
    }
  return share * kBiteCell_mm * kBiteCell_mm / (kParts * kParts);
}

/// Numbers the places where paper is marked by their connected parts, from 1; 0: none.
std::vector<int> partsOf(const OcclusalRaster& gap_mm, double paper_mm, int& parts) {
  std::vector<int> part(static_cast<std::size_t>(kBiteCells) * kBiteCells, 0);
  std::vector<glm::ivec2> open;
  const auto is_marked = [&](glm::ivec2 at) { return static_cast<double>(gap_mm.at(at.x, at.y)) <= paper_mm; };
  const auto of = [&](glm::ivec2 at) -> int& { return part[static_cast<std::size_t>(at.y * kBiteCells + at.x)]; };
  for (int y = 0; y < kBiteCells; ++y)
    for (int x = 0; x < kBiteCells; ++x) {
      if (of({x, y}) != 0 || !is_marked({x, y})) continue;
      of({x, y}) = ++parts;
      open.assign(1, {x, y});
      while (!open.empty()) {
        const glm::ivec2 at = open.back();
        open.pop_back();
        for (int n = 0; n < 9; ++n) {
          const glm::ivec2 next = glm::clamp(at + glm::ivec2(n % 3 - 1, n / 3 - 1), 0, kBiteCells - 1);
          if (of(next) != 0 || !is_marked(next)) continue;
          of(next) = parts;
          open.push_back(next);
        }
      }
    }
  return part;
}

std::vector<BiteContact> contactsOf(const OcclusalRaster& gap_mm, double paper_mm) {
  int parts = 0;
  const std::vector<int> part = partsOf(gap_mm, paper_mm, parts);
  std::vector<BiteContact> contacts(static_cast<std::size_t>(parts),
                                    BiteContact{{}, std::numeric_limits<double>::infinity(), 0.0});
  const auto part_at = [&](int x, int y) { return part[static_cast<std::size_t>(y * kBiteCells + x)]; };
  for (int y = 0; y + 1 < kBiteCells; ++y)
    for (int x = 0; x + 1 < kBiteCells; ++x) {
      if (const int own = part_at(x, y); own != 0) {
        BiteContact& contact = contacts[static_cast<std::size_t>(own - 1)];
        const auto gap = static_cast<double>(gap_mm.at(x, y));
        if (gap < contact.gap_mm) contact.gap_mm = gap, contact.place_mm = OcclusalRaster::place_mm(x, y);
      }
      const int any = std::max({part_at(x, y), part_at(x + 1, y), part_at(x, y + 1), part_at(x + 1, y + 1)});
      if (any == 0) continue;
      if (!gap_mm.has(x, y) || !gap_mm.has(x + 1, y) || !gap_mm.has(x, y + 1) || !gap_mm.has(x + 1, y + 1)) continue;
      contacts[static_cast<std::size_t>(any - 1)].area_mm2 += markedArea_mm2(gap_mm, x, y, paper_mm);
    }
  // First contact lies between the places.
  for (BiteContact& one : contacts) one.gap_mm = std::max(0.0, one.gap_mm);
  std::erase_if(contacts, [](const BiteContact& one) { return one.area_mm2 < kLeastMark_mm2; });
  std::ranges::sort(contacts, std::greater<>(), &BiteContact::area_mm2);
  return contacts;
}

}  // namespace

double Bite::area_mm2() const {
  double sum = 0.0;
  for (const BiteContact& contact : contacts) sum += contact.area_mm2;
  return sum;
}

Bite biteOn(const OcclusalRaster& heights, const Antagonist& antagonist, double paper_mm) {
  ClosedJaws jaws = closedOn(heights, antagonist);
  Bite bite;
  bite.paper_mm = paper_mm, bite.is_made = antagonist.is_made;
  bite.closing = antagonist.closing, bite.is_balanced = jaws.is_balanced;
  bite.open_mm = jaws.open_mm;
  bite.clearance_mm = std::max(0.0, jaws.narrowest.gap_mm);
  if (bite.clearance_mm <= kTouching_mm) bite.first_mm = jaws.first_mm;
  bite.gap_mm = std::move(jaws.gap_mm);
  bite.contacts = contactsOf(bite.gap_mm, paper_mm);
  return bite;
}

std::string_view nameOf(assets::Closing closing) {
  constexpr std::array<std::string_view, 3> kNames{"axis", "hinge", "balance"};
  return kNames[static_cast<std::size_t>(closing)];
}

std::string placeName(const glm::dvec2& place_mm) {
  constexpr double kMiddle_mm = 1.0;
  const std::string_view along = place_mm.x > kMiddle_mm ? "mesio" : place_mm.x < -kMiddle_mm ? "disto" : "";
  if (std::abs(place_mm.y) <= kMiddle_mm) return along.empty() ? "middle" : place_mm.x > 0.0 ? "mesial" : "distal";
  return std::string(along) + (place_mm.y > 0.0 ? "buccal" : "lingual");
}

std::string biteLine(const Bite& bite) {
  const double paper_um = 1000.0 * bite.paper_mm;
  constexpr double kTold_mm = 0.005;
  std::string line;
  if (bite.open_mm > kTold_mm && bite.first_mm)
    line = fmt::format("bite: {:.2f} mm too high, {}; ", bite.open_mm, placeName(*bite.first_mm));
  else if (bite.contacts.empty() && bite.clearance_mm <= bite.paper_mm)
    return "bite: it touches in a point, too small to see";
  else if (bite.contacts.empty())
    return std::isfinite(bite.clearance_mm) ? fmt::format("bite: free by {:.2f} mm", bite.clearance_mm)
                                            : std::string("bite: nothing opposes it");
  else
    line = "bite: ";
  return line + fmt::format("{} mark{} of {:g} µm paper, {:.2f} mm²", bite.contacts.size(),
                            bite.contacts.size() == 1 ? "" : "s", paper_um, bite.area_mm2());
}

PaintSpots biteSpots(const Crown& crown, const BoxBytes& solid, const OcclusalRaster& heights, const Bite& bite) {
  PaintSpots spots;
  const assets::VolumeGrid& grid = solid.grid();
  const double near_mm = 2.5 * grid.spacing_mm;
  const glm::vec3 ink = render::linearFromSrgb(glm::vec3(kInk));
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = crown.frame.local(grid.centre_P_mm(ijk));
    if (p.z < 0.0) return;
    const float gap = bite.gap_mm.at(glm::dvec2(p)), height = heights.at(glm::dvec2(p));
    // Without a height or a gap both comparisons fail.
    if (!(static_cast<double>(gap) <= bite.paper_mm) || !(std::abs(static_cast<double>(height) - p.z) < near_mm))
      return;
    spots.push_back({static_cast<std::uint32_t>(v), render::paintTexel(ink, 1.0F)});
  });
  return spots;
}

std::vector<render::SurfacePaint::Row> biteRows(const Bite& bite) {
  const glm::vec3 ink = render::linearFromSrgb(glm::vec3(kInk));
  std::vector<render::SurfacePaint::Row> rows{{ink, fmt::format("paper {:g} µm", 1000.0 * bite.paper_mm)}};
  if (bite.is_made) rows.push_back({{}, kMadeAntagonist});
  if (bite.closing == assets::Closing::hinge) rows.push_back({{}, "closing about the hinge"});
  if (bite.closing == assets::Closing::balance)
    rows.push_back({{}, bite.is_balanced ? "resting on three contacts" : "nothing holds it on three contacts"});
  return rows;
}

}  // namespace app
