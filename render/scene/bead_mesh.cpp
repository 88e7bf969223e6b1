#include "render/scene/bead_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "calibration/random.h"
#include "render/scene/models.h"

namespace render {
namespace {

constexpr double kBallGolden = 1.618033988749895;
constexpr std::array<glm::dvec3, 12> kBallCorners{
    glm::dvec3{-1, kBallGolden, 0}, {1, kBallGolden, 0}, {-1, -kBallGolden, 0}, {1, -kBallGolden, 0},
    {0, -1, kBallGolden},           {0, 1, kBallGolden}, {0, -1, -kBallGolden}, {0, 1, -kBallGolden},
    {kBallGolden, 0, -1},           {kBallGolden, 0, 1}, {-kBallGolden, 0, -1}, {-kBallGolden, 0, 1}};
constexpr std::array<std::array<int, 3>, 20> kBallSides{{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                                         {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                                         {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                                         {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};

void addTriangle(assets::MeshPart& part, const std::array<glm::dvec3, 3>& p, const std::array<glm::dvec3, 3>& normal) {
  for (std::size_t n = 0; n < 3; ++n) {
    part.triangles.push_back(static_cast<std::uint32_t>(part.position_mm.size()));
    part.position_mm.emplace_back(p[n]);
    part.normal.emplace_back(normal[n]);
  }
}

constexpr double kPatchWide = 1.6, kPatchThin = 0.4;  // of the radius: together about the ball's volume

/// A point of the unit ball, by `across` and `along` the thin direction.
glm::dvec3 stretched(const Bead& bead, const glm::dvec3& p, double across, double along) {
  const glm::dvec3 part = glm::dot(p, bead.thin_P) * bead.thin_P;
  return across * (p - part) + along * part;
}

/// Every side of an icosahedron in four.
void addBall(assets::MeshPart& part, const Bead& bead) {
  const bool is_patch = bead.thin_P != glm::dvec3(0.0);
  const double wide = is_patch ? kPatchWide : 1.0, thin = is_patch ? kPatchThin : 1.0;
  const auto add = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    std::array<glm::dvec3, 3> point{glm::normalize(a), glm::normalize(b), glm::normalize(c)}, normal{};
    for (std::size_t n = 0; n < 3; ++n) {
      normal[n] = glm::normalize(stretched(bead, point[n], 1.0 / wide, 1.0 / thin));
      point[n] = bead.at_P.mm + bead.radius_mm * stretched(bead, point[n], wide, thin);
    }
    addTriangle(part, point, normal);
  };
  for (const auto& side : kBallSides) {
    const auto corner = [&](std::size_t n) { return kBallCorners[static_cast<std::size_t>(side[n])]; };
    const glm::dvec3 a = corner(0), b = corner(1), c = corner(2), ab = a + b, bc = b + c, ca = c + a;
    add(a, glm::normalize(ab) * glm::length(a), glm::normalize(ca) * glm::length(a));
    add(b, glm::normalize(bc) * glm::length(a), glm::normalize(ab) * glm::length(a));
    add(c, glm::normalize(ca) * glm::length(a), glm::normalize(bc) * glm::length(a));
    add(ab, bc, ca);
  }
}

/// Flat sides at uneven distances, the same for the same number.
void addSplinter(assets::MeshPart& part, const Bead& bead, std::uint64_t number) {
  std::array<glm::dvec3, 12> corner;
  for (std::size_t n = 0; n < corner.size(); ++n) {
    const auto bits = static_cast<double>(calibration::mixedBits(16 * number + n) >> 40) / double(1 << 24);
    corner[n] = bead.at_P.mm + bead.radius_mm * (0.65 + 0.7 * bits) * glm::normalize(kBallCorners[n]);
  }
  for (const auto& side : kBallSides) {
    const std::array<glm::dvec3, 3> p{corner[static_cast<std::size_t>(side[0])],
                                      corner[static_cast<std::size_t>(side[1])],
                                      corner[static_cast<std::size_t>(side[2])]};
    const glm::dvec3 n = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
    addTriangle(part, p, {n, n, n});
  }
}

struct Look {
  const char* name;
  assets::Material material;
};
constexpr std::size_t kTrailColours = 4, kKinds = 5 + kTrailColours;
/// By BeadKind, trails by colour; linear colours.
const std::array<Look, kKinds>& looks() {
  static const std::array<Look, kKinds> kLooks{
      {{kMarksPart, {.base_colour = {0.95F, 0.72F, 0.04F, 1.0F}}},
       {kChipsPart, {.base_colour = {0.74F, 0.62F, 0.44F, 1.0F}}},
       {kFolliclePart, {.base_colour = {0.46F, 0.16F, 0.13F, 1.0F}, .roughness = 0.3F}},
       {kStitchesPart, {.base_colour = {0.02F, 0.03F, 0.12F, 1.0F}}},
       {kDrawnPart, {.base_colour = {0.05F, 0.25F, 0.85F, 1.0F}}},
       {kMarksPart, {.base_colour = {0.06F, 0.55F, 0.16F, 1.0F}}},
       {kMarksPart, {.base_colour = {0.75F, 0.62F, 0.05F, 1.0F}}},
       {kMarksPart, {.base_colour = {0.85F, 0.27F, 0.02F, 1.0F}}},
       {kMarksPart, {.base_colour = {0.72F, 0.02F, 0.02F, 1.0F}}}}};
  return kLooks;
}

std::size_t lookOf(const Bead& bead) {
  const auto kind = static_cast<std::size_t>(bead.kind);
  return bead.kind == BeadKind::trail ? kind + std::min<std::size_t>(bead.number, kTrailColours - 1) : kind;
}

}  // namespace

assets::MeshModel beadMesh(std::span<const Bead> beads) {
  assets::MeshModel model;
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    assets::MeshPart part;
    part.name = looks()[kind].name;
    part.material = looks()[kind].material;
    for (const Bead& bead : beads) {
      if (lookOf(bead) != kind) continue;
      if (bead.kind == BeadKind::chip)
        addSplinter(part, bead, bead.number);
      else
        addBall(part, bead);
    }
    if (!part.triangles.empty()) model.parts.push_back(std::move(part));
  }
  return model;
}

}  // namespace render
