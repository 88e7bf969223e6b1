#include "render/scene/mandibular_canal_tube.h"

#include <cmath>
#include <vector>

namespace render {
namespace {

constexpr std::uint32_t kSides = 24;
constexpr glm::vec4 kColour{0.90f, 0.36f, 0.05f, 1.0f};  // customary for the nerve in planning software

constexpr float kBehind = 0.6f;  // share of the colour behind bone

glm::dvec3 perpendicularTo(const glm::dvec3& along) {
  const glm::dvec3 other = std::abs(along.z) < 0.8 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  return glm::normalize(glm::cross(along, other));
}

}  // namespace

assets::MeshModel mandibularCanalTube(std::span<const glm::dvec3> line_P_mm, double radius_mm) {
  // Points that do not coincide.
  std::vector<glm::dvec3> line;
  for (const glm::dvec3& p : line_P_mm)
    if (line.empty() || glm::distance(p, line.back()) > 1e-6) line.push_back(p);
  if (line.size() < 2 || !(radius_mm > 0.0)) return {};

  assets::MeshPart part;
  part.name = "Mandibular canal";
  part.material = {.base_colour = kColour, .roughness = 0.45f};
  glm::dvec3 side = perpendicularTo(glm::normalize(line[1] - line[0]));
  const auto ring = [&](const glm::dvec3& centre, const glm::dvec3& along, double radius, double lean) {
    // The side is transported along the line without rotating about it.
    side = glm::normalize(side - glm::dot(side, along) * along);
    const glm::dvec3 other = glm::cross(along, side);
    for (std::uint32_t s = 0; s < kSides; ++s) {
      const double angle = 2.0 * M_PI * s / kSides;
      const glm::dvec3 out = std::cos(angle) * side + std::sin(angle) * other;
      part.position_mm.emplace_back(centre + radius * out);
      part.normal.emplace_back(glm::normalize((1.0 - std::abs(lean)) * out + lean * along));
    }
  };
  const glm::dvec3 first = glm::normalize(line[1] - line[0]),
                   last = glm::normalize(line.back() - line[line.size() - 2]);
  ring(line.front(), first, 1e-4 * radius_mm, -1.0);
  for (std::size_t n = 0; n < line.size(); ++n) {
    const glm::dvec3 &before = line[n == 0 ? 0 : n - 1], &after = line[std::min(n + 1, line.size() - 1)];
    ring(line[n], glm::normalize(after - before), radius_mm, 0.0);
  }
  ring(line.back(), last, 1e-4 * radius_mm, 1.0);
  const auto rings = static_cast<std::uint32_t>(part.position_mm.size()) / kSides;
  for (std::uint32_t r = 0; r + 1 < rings; ++r)
    for (std::uint32_t s = 0; s < kSides; ++s) {
      const std::uint32_t a = r * kSides + s, b = r * kSides + (s + 1) % kSides, c = a + kSides, d = b + kSides;
      for (const std::uint32_t index : {a, b, c, c, b, d}) part.triangles.push_back(index);
    }
  return {{part}};
}

assets::MeshModel mandibularCanalDashes(std::span<const glm::dvec3> line_P_mm, double radius_mm) {
  // Each dash is a tube along its part of the line; all are one part of the mesh.
  assets::MeshPart all;
  std::vector<glm::dvec3> dash;
  double along_mm = 0.0;
  const auto finish = [&] {
    for (const assets::MeshPart& tube : mandibularCanalTube(dash, radius_mm).parts) {
      const auto first = static_cast<std::uint32_t>(all.position_mm.size());
      all.position_mm.insert(all.position_mm.end(), tube.position_mm.begin(), tube.position_mm.end());
      all.normal.insert(all.normal.end(), tube.normal.begin(), tube.normal.end());
      for (const std::uint32_t index : tube.triangles) all.triangles.push_back(first + index);
      all.name = tube.name, all.material = tube.material;
    }
    dash.clear();
  };
  constexpr double kPeriod_mm = kCanalDash_mm + kCanalDashGap_mm;
  for (std::size_t n = 0; n + 1 < line_P_mm.size(); ++n) {
    const double length_mm = glm::distance(line_P_mm[n], line_P_mm[n + 1]);
    // From the beginning of the segment through every change to its end.
    for (double at_mm = 0.0; at_mm < length_mm;) {
      const double phase_mm = std::fmod(along_mm + at_mm, kPeriod_mm);
      const bool drawn = phase_mm < kCanalDash_mm - 1e-9;
      const double next_mm =
          std::min(at_mm + std::max((drawn ? kCanalDash_mm : kPeriod_mm) - phase_mm, 1e-6), length_mm);
      const auto point = [&](double mm) { return glm::mix(line_P_mm[n], line_P_mm[n + 1], mm / length_mm); };
      if (drawn && dash.empty()) dash.push_back(point(at_mm));
      if (drawn) dash.push_back(point(next_mm));
      if (!drawn) finish();
      at_mm = next_mm;
    }
    along_mm += length_mm;
  }
  finish();
  if (all.triangles.empty()) return {};
  all.material.base_colour = glm::vec4(kBehind * glm::vec3(all.material.base_colour), 1.0f);
  return {{all}};
}

}  // namespace render
