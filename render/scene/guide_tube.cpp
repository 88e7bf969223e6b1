#include "render/scene/guide_tube.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace render {
namespace {

constexpr std::uint32_t kSides = 24;
constexpr glm::vec4 kCanalColour{0.90f, 0.36f, 0.05f, 1.0f};  // customary for the nerve in planning software
constexpr glm::vec4 kRulerColour{0.02f, 0.85f, 0.55f, 1.0f};  // of no tissue and no other guide
constexpr glm::vec4 kArrowColour{0.95f, 0.82f, 0.10f, 1.0f};
constexpr int kBeadRows = 12;
constexpr float kBehind = 0.6f;  // share of the colour behind bone

glm::dvec3 perpendicularTo(const glm::dvec3& along) {
  const glm::dvec3 other = std::abs(along.z) < 0.8 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  return glm::normalize(glm::cross(along, other));
}

struct Ring {
  std::array<glm::dvec3, kSides> position_mm, normal;
};

/// Points of the line that do not coincide.
std::vector<glm::dvec3> distinct(std::span<const glm::dvec3> line_P_mm) {
  std::vector<glm::dvec3> line;
  for (const glm::dvec3& p : line_P_mm)
    if (line.empty() || glm::distance(p, line.back()) > 1e-6) line.push_back(p);
  return line;
}

/// A ring of the wall at each point; the side is transported along the line without rotating about it.
std::vector<Ring> ringsAlong(std::span<const glm::dvec3> line, double radius_mm) {
  std::vector<Ring> rings(line.size());
  glm::dvec3 side = perpendicularTo(glm::normalize(line[1] - line[0]));
  for (std::size_t n = 0; n < line.size(); ++n) {
    const glm::dvec3 along = glm::normalize(line[std::min(n + 1, line.size() - 1)] - line[n == 0 ? 0 : n - 1]);
    side = glm::normalize(side - glm::dot(side, along) * along);
    const glm::dvec3 other = glm::cross(along, side);
    for (std::uint32_t s = 0; s < kSides; ++s) {
      const double angle = 2.0 * M_PI * s / kSides;
      rings[n].normal[s] = std::cos(angle) * side + std::sin(angle) * other;
      rings[n].position_mm[s] = line[n] + radius_mm * rings[n].normal[s];
    }
  }
  return rings;
}

/// Between two rings, on the wall.
Ring mixed(const Ring& a, const Ring& b, double share) {
  Ring ring;
  for (std::uint32_t s = 0; s < kSides; ++s) {
    ring.position_mm[s] = glm::mix(a.position_mm[s], b.position_mm[s], share);
    ring.normal[s] = glm::normalize(glm::mix(a.normal[s], b.normal[s], share));
  }
  return ring;
}

/// A ring shrunk to its centre: the end of a tube.
Ring endAt(const glm::dvec3& centre, const glm::dvec3& outward) {
  Ring ring;
  ring.position_mm.fill(centre);
  ring.normal.fill(outward);
  return ring;
}

void append(assets::MeshPart& part, const Ring& ring) {
  for (std::uint32_t s = 0; s < kSides; ++s) {
    part.position_mm.emplace_back(ring.position_mm[s]);
    part.normal.emplace_back(ring.normal[s]);
  }
}

/// The wall between the last two rings.
void joinLastTwo(assets::MeshPart& part) {
  const auto first = static_cast<std::uint32_t>(part.position_mm.size()) - 2 * kSides;
  for (std::uint32_t s = 0; s < kSides; ++s) {
    const std::uint32_t a = first + s, b = first + (s + 1) % kSides, c = a + kSides, d = b + kSides;
    for (const std::uint32_t index : {a, b, c, c, b, d}) part.triangles.push_back(index);
  }
}

assets::MeshPart partNamed(const std::string& name, const glm::vec4& colour) {
  assets::MeshPart part;
  part.name = name;
  part.material = {.base_colour = colour, .roughness = 0.45f};
  return part;
}

/// A ball of rings from pole to pole.
void appendBead(assets::MeshPart& part, const glm::dvec3& centre) {
  for (int row = 0; row <= kBeadRows; ++row) {
    const double polar = M_PI * row / kBeadRows;
    Ring ring;
    for (std::uint32_t s = 0; s < kSides; ++s) {
      const double turn = 2.0 * M_PI * s / kSides;
      ring.normal[s] = {std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), -std::cos(polar)};
      ring.position_mm[s] = centre + kRulerBead_mm * ring.normal[s];
    }
    append(part, ring);
    if (row > 0) joinLastTwo(part);
  }
}

assets::MeshModel closedTube(std::span<const glm::dvec3> line_P_mm, double radius_mm, assets::MeshPart part) {
  const std::vector<glm::dvec3> line = distinct(line_P_mm);
  if (line.size() < 2 || !(radius_mm > 0.0)) return {};
  std::vector<Ring> rings = ringsAlong(line, radius_mm);
  rings.insert(rings.begin(), endAt(line.front(), glm::normalize(line[0] - line[1])));
  rings.push_back(endAt(line.back(), glm::normalize(line.back() - line[line.size() - 2])));
  for (std::size_t n = 0; n < rings.size(); ++n) {
    append(part, rings[n]);
    if (n > 0) joinLastTwo(part);
  }
  return {{std::move(part)}};
}

}  // namespace

assets::MeshModel mandibularCanalTube(std::span<const glm::dvec3> line_P_mm, double radius_mm) {
  return closedTube(line_P_mm, radius_mm, partNamed("Mandibular canal", kCanalColour));
}

assets::MeshModel mandibularCanalDashes(std::span<const glm::dvec3> line_P_mm, double radius_mm) {
  const std::vector<glm::dvec3> line = distinct(line_P_mm);
  if (line.size() < 2 || !(radius_mm > 0.0)) return {};
  assets::MeshPart part = partNamed("Mandibular canal", glm::vec4(kBehind * glm::vec3(kCanalColour), 1.0f));
  const std::vector<Ring> rings = ringsAlong(line, radius_mm);
  constexpr double kPeriod_mm = kCanalDash_mm + kCanalDashGap_mm;
  double along_mm = 0.0;
  bool in_dash = false;
  for (std::size_t n = 0; n + 1 < line.size(); ++n) {
    const double length_mm = glm::distance(line[n], line[n + 1]);
    // From the beginning of the segment through every change to its end.
    for (double at_mm = 0.0; at_mm < length_mm;) {
      const double phase_mm = std::fmod(along_mm + at_mm, kPeriod_mm);
      const bool drawn = phase_mm < kCanalDash_mm - 1e-9;
      const double next_mm =
          std::min(at_mm + std::max((drawn ? kCanalDash_mm : kPeriod_mm) - phase_mm, 1e-6), length_mm);
      if (drawn && !in_dash) append(part, mixed(rings[n], rings[n + 1], at_mm / length_mm));
      if (drawn) {
        append(part, mixed(rings[n], rings[n + 1], next_mm / length_mm));
        joinLastTwo(part);
      }
      in_dash = drawn;
      at_mm = next_mm;
    }
    along_mm += length_mm;
  }
  return {{std::move(part)}};
}

assets::MeshModel rulerMesh(const RulerLine& ruler, bool behind) {
  assets::MeshPart part = partNamed("Ruler", glm::vec4((behind ? kBehind : 1.0f) * glm::vec3(kRulerColour), 1.0f));
  appendBead(part, ruler.from_P.mm);
  if (ruler.to_P) {
    appendBead(part, ruler.to_P->mm);
    const std::array<glm::dvec3, 2> line{ruler.from_P.mm, ruler.to_P->mm};
    if (ruler.length_mm() > 1e-6) {
      for (const Ring& ring : ringsAlong(line, kRulerRadius_mm)) append(part, ring);
      joinLastTwo(part);
    }
  }
  return {{std::move(part)}};
}

assets::MeshModel arrowMesh(const GuideArrow& arrow, bool behind) {
  const double length_mm = glm::distance(arrow.from_P.mm, arrow.to_P.mm);
  if (length_mm < 1e-6) return {};
  assets::MeshPart part = partNamed("Arrow", glm::vec4((behind ? kBehind : 1.0f) * glm::vec3(kArrowColour), 1.0f));
  const glm::dvec3 along = (arrow.to_P.mm - arrow.from_P.mm) / length_mm;
  const glm::dvec3 neck = arrow.to_P.mm - std::min(kArrowHeadLength_mm, length_mm) * along;
  const std::array<glm::dvec3, 2> shaft{arrow.from_P.mm, neck}, head{neck, arrow.to_P.mm};
  const auto join = [&](const Ring& from, const Ring& to) {
    append(part, from);
    append(part, to);
    joinLastTwo(part);
  };
  if (length_mm > kArrowHeadLength_mm) {
    const std::vector<Ring> rings = ringsAlong(shaft, kArrowRadius_mm);
    join(endAt(arrow.from_P.mm, -along), rings[0]);
    join(rings[0], rings[1]);
  }
  // The head's base, and its cone with the slant's normals.
  Ring base = ringsAlong(head, kArrowHead_mm)[0];
  Ring flat = base;
  flat.normal.fill(-along);
  join(endAt(neck, -along), flat);
  Ring tip = endAt(arrow.to_P.mm, along);
  for (std::uint32_t s = 0; s < kSides; ++s)
    base.normal[s] = tip.normal[s] = glm::normalize(kArrowHeadLength_mm * base.normal[s] + kArrowHead_mm * along);
  join(base, tip);
  return {{std::move(part)}};
}

}  // namespace render
