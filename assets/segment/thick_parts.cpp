#include "assets/segment/thick_parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace assets {
namespace {

/// Growing parts, of which two may become one.
class GrowingParts {
 public:
  std::int32_t add(float peak) {
    joined_.push_back(static_cast<std::int32_t>(joined_.size()));
    peak_.push_back(peak);
    return joined_.back();
  }
  std::int32_t rootOf(std::int32_t part) {
    while (joined_[at(part)] != part) part = joined_[at(part)] = joined_[at(joined_[at(part)])];
    return part;
  }
  float peakOf(std::int32_t root) const { return peak_[at(root)]; }
  /// The lower of two roots becomes part of the higher.
  void join(std::int32_t a, std::int32_t b) {
    if (peakOf(a) < peakOf(b)) std::swap(a, b);
    joined_[at(b)] = a;
  }
  std::size_t count() const { return joined_.size(); }

 private:
  static std::size_t at(std::int32_t part) { return static_cast<std::size_t>(part); }
  std::vector<std::int32_t> joined_;
  std::vector<float> peak_;
};

/// Cells of the mask from thick to thin; of equal ones the first comes first.
std::vector<std::uint32_t> fromThick(std::span<const float> thickness, std::span<const std::uint8_t> mask) {
  constexpr float kStepsPerUnit = 20000.0F;
  const auto step_of = [&](std::size_t cell) {
    return static_cast<std::size_t>(std::max(0.0F, thickness[cell] * kStepsPerUnit));
  };
  std::vector<std::size_t> start;
  for (std::size_t cell = 0; cell < mask.size(); ++cell) {
    if (mask[cell] == 0) continue;
    if (step_of(cell) >= start.size()) start.resize(step_of(cell) + 1, 0);
    ++start[step_of(cell)];
  }
  std::size_t before = 0;
  for (auto step = start.rbegin(); step != start.rend(); ++step) before += std::exchange(*step, before);
  std::vector<std::uint32_t> order(before);
  for (std::size_t cell = 0; cell < mask.size(); ++cell)
    if (mask[cell] != 0) order[start[step_of(cell)]++] = static_cast<std::uint32_t>(cell);
  return order;
}

}  // namespace

CellPieces thickParts(glm::ivec3 size, std::span<const float> thickness, std::span<const std::uint8_t> mask,
                      double least_rise) {
  constexpr std::int32_t kNone = -1;
  GrowingParts parts;
  std::vector<std::int32_t> of(mask.size(), kNone);
  for (const std::uint32_t cell : fromThick(thickness, mask)) {
    // It belongs to the part of its thickest neighbour; others end here, or are the same part.
    std::size_t thickest = cell;
    forNeighbours(size, cell, [&](std::size_t next) {
      if (of[next] != kNone && (thickest == cell || thickness[next] > thickness[thickest])) thickest = next;
    });
    of[cell] = thickest == cell ? parts.add(thickness[cell]) : of[thickest];
    forNeighbours(size, cell, [&](std::size_t next) {
      if (of[next] == kNone) return;
      const std::int32_t here = parts.rootOf(of[cell]), there = parts.rootOf(of[next]);
      if (here != there && std::min(parts.peakOf(here), parts.peakOf(there)) - thickness[cell] < least_rise)
        parts.join(here, there);
    });
  }

  std::vector<std::int32_t> roots, number(parts.count(), 0);
  for (std::size_t part = 0; part < parts.count(); ++part)
    if (const auto root = static_cast<std::int32_t>(part); parts.rootOf(root) == root) roots.push_back(root);
  std::ranges::stable_sort(roots, std::greater<>(), [&](std::int32_t root) { return parts.peakOf(root); });
  for (std::size_t n = 0; n < roots.size(); ++n)
    number[static_cast<std::size_t>(roots[n])] = static_cast<std::int32_t>(n) + 1;
  CellPieces pieces{std::move(of), std::vector<std::size_t>(roots.size() + 1, 0)};
  for (std::int32_t& part : pieces.of) {
    part = part == kNone ? 0 : number[static_cast<std::size_t>(parts.rootOf(part))];
    if (part != 0) ++pieces.cells[static_cast<std::size_t>(part)];
  }
  return pieces;
}

std::map<std::pair<std::int32_t, std::int32_t>, float> necksBetween(glm::ivec3 size, std::span<const float> thickness,
                                                                    std::span<const std::int32_t> part) {
  std::map<std::pair<std::int32_t, std::int32_t>, float> necks;
  for (std::size_t cell = 0; cell < part.size(); ++cell) {
    if (part[cell] == 0) continue;
    forNeighbours(size, cell, [&](std::size_t next) {
      if (next < cell || part[next] == 0 || part[next] == part[cell]) return;
      const float neck = std::min(thickness[cell], thickness[next]);
      float& known = necks[std::minmax(part[cell], part[next])];
      known = std::max(known, neck);
    });
  }
  return necks;
}

}  // namespace assets
