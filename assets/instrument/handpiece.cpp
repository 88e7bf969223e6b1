#include "assets/instrument/handpiece.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "assets/load_error.h"
#include "assets/mesh/closed_sweep.h"
#include "assets/vertex_normals.h"
#include "calibration/geometry/units.h"

namespace assets {
namespace {

using calibration::kPi;

constexpr double kShankRadius_mm = 2.35 / 2.0;

// Outline of a surface of revolution about z. A crease keeps its edge sharp.
struct Section {
  double z_mm;
  double radius_mm;
  bool crease = false;
};

// `rings` times `around` vertices; point(ring, angle_rad).
MeshPart sweep(std::size_t rings, std::size_t around, const std::function<glm::dvec3(std::size_t, double)>& point) {
  MeshPart part;
  for (std::size_t ring = 0; ring < rings; ++ring) {
    for (std::size_t a = 0; a < around; ++a) {
      part.position_mm.emplace_back(point(ring, 2.0 * kPi * static_cast<double>(a) / static_cast<double>(around)));
    }
  }
  appendSweepTriangles(part.triangles, rings, around);
  return part;
}

void append(MeshPart& to, const MeshPart& from) {
  const auto first = static_cast<std::uint32_t>(to.position_mm.size());
  to.position_mm.insert(to.position_mm.end(), from.position_mm.begin(), from.position_mm.end());
  to.colour.insert(to.colour.end(), from.colour.begin(), from.colour.end());
  for (const std::uint32_t vertex : from.triangles) to.triangles.push_back(first + vertex);
}

// Surface of revolution from the lowest z up, split at creases.
MeshPart revolved(const std::vector<Section>& outline, const glm::vec4& colour) {
  MeshPart body;
  std::size_t begin = 0;
  for (std::size_t end = 1; end < outline.size(); ++end) {
    if (!outline[end].crease && end + 1 != outline.size()) continue;
    append(body, sweep(end - begin + 1, 48, [&](std::size_t ring, double turn) {
             const Section& s = outline[begin + ring];
             return glm::dvec3(s.radius_mm * std::cos(turn), s.radius_mm * std::sin(turn), s.z_mm);
           }));
    begin = end;
  }
  body.colour.assign(body.position_mm.size(), colour);
  return body;
}

// Depth of a gullet 0..1 at a fraction of the pitch: a narrow land, a steep cutting face, a gullet that rises slowly.
double gulletDepth(double fraction) {
  return fraction < 0.12 ? 0.0 : std::sin(kPi * std::pow((fraction - 0.12) / 0.88, 1.6));
}

// Gullets receive less light.
glm::vec4 gulletShade(float depth) {
  const float shade = 1.0f - 0.6f * depth;
  return {shade, shade, shade, 1.0f};
}

// Round head: blades that lean back and wind around the sphere with cross-cuts; gullets fade towards tip and neck.
MeshPart burHead(const HandpieceParameters& parameters) {
  const double radius = parameters.bur_radius_mm;
  const std::size_t rings = 65;
  const std::size_t around = static_cast<std::size_t>(parameters.flutes) * 24;
  const double neck_angle = std::asin(std::min(0.6, 0.45 * kShankRadius_mm / radius + 0.1));

  const auto gullet = [&](double polar, double turn) {
    const double winding = 0.9 * (polar - kPi / 2.0);
    const double phase = std::fmod(turn + winding + 8.0 * kPi, 2.0 * kPi) * parameters.flutes / (2.0 * kPi);
    const double across = phase - std::floor(phase);
    const double groove = gulletDepth(across);
    const double nick = std::fmod(polar * 9.0 + std::floor(phase) * 0.5, 1.0) < 0.16 ? 0.25 : 0.0;
    const double fade = std::pow(std::sin(polar), 0.7);
    return fade * std::min(1.0, std::max(groove, nick));
  };
  MeshPart head = sweep(rings, around, [&](std::size_t ring, double turn) {
    const double polar = kPi - (kPi - neck_angle) * static_cast<double>(ring) / static_cast<double>(rings - 1);
    return radius * (1.0 - 0.2 * gullet(kPi - polar, turn)) *
           glm::dvec3(std::sin(kPi - polar) * std::cos(turn), std::sin(kPi - polar) * std::sin(turn), std::cos(polar));
  });
  for (const glm::vec3& p : head.position_mm) {
    const auto depth = static_cast<float>((radius - glm::length(glm::dvec3(p))) / (0.2 * radius));
    head.colour.push_back(gulletShade(std::clamp(depth, 0.0f, 1.0f)));
  }
  return head;
}

// Outline of a long head from tip to neck in smooth stretches of (radius, z).
using Stretch = std::vector<glm::dvec2>;
/// Edges where a flat end or two segments meet at more than 20 degrees.
std::vector<Stretch> revolvedStretches(const HandpieceParameters& parameters, double neck) {
  const BurOutline outline = burOutline(parameters.profile, parameters.bur_radius_mm, parameters.bur_length_mm);
  std::vector<glm::dvec2> knots;
  const auto add = [&](const glm::dvec2& knot) {
    if (knots.empty() || glm::distance(knots.back(), knot) > 1e-6) knots.push_back(knot);
  };
  add({0.0, outline.z_mm[0]});
  for (std::size_t n = 0; n < outline.count; ++n) add({outline.radius_mm[n], outline.z_mm[n]});
  add({std::min(neck, knots.back().x), knots.back().y});
  const double cosine = std::cos(20.0 * kPi / 180.0);
  std::vector<Stretch> stretches;
  for (std::size_t n = 0; n + 1 < knots.size(); ++n) {
    const glm::dvec2 way = knots[n + 1] - knots[n];
    const bool edge = n == 0 || glm::dot(glm::normalize(way), glm::normalize(knots[n] - knots[n - 1])) < cosine;
    if (edge) stretches.push_back({knots[n]});
    const int steps = std::max(2, static_cast<int>(std::ceil(glm::length(way) / (0.25 * parameters.bur_radius_mm))));
    for (int k = 1; k <= steps; ++k) stretches.back().push_back(knots[n] + way * (static_cast<double>(k) / steps));
  }
  return stretches;
}

std::vector<Stretch> outlineOf(const HandpieceParameters& parameters, double neck) {
  const double radius = parameters.bur_radius_mm, half = 0.5 * parameters.bur_length_mm;
  constexpr int kSteps = 24;
  const auto straight = [](const glm::dvec2& from, const glm::dvec2& to) {
    Stretch stretch;
    for (int n = 0; n <= kSteps; ++n) stretch.push_back(glm::mix(from, to, static_cast<double>(n) / kSteps));
    return stretch;
  };
  if (parameters.form == BurForm::cylinder)
    return {straight({0.0, -half}, {radius, -half}), straight({radius, -half}, {radius, half}),
            straight({radius, half}, {neck, half})};
  if (parameters.form == BurForm::cone)
    return {straight({0.0, -half}, {radius, half}), straight({radius, half}, {neck, half})};
  if (parameters.form == BurForm::revolved) return revolvedStretches(parameters, neck);
  // Round ends, the upper one up to the neck.
  Stretch stretch;
  for (int n = 0; n <= kSteps; ++n) {
    const double turn = 0.5 * kPi * n / kSteps;
    stretch.emplace_back(radius * std::sin(turn), -half - radius * std::cos(turn));
  }
  for (int n = 1; n < kSteps; ++n) stretch.emplace_back(radius, half * (2.0 * n / kSteps - 1.0));
  const double last = std::acos(std::min(1.0, neck / radius));
  for (int n = 0; n <= kSteps; ++n) {
    const double turn = last * n / kSteps;
    stretch.emplace_back(radius * std::cos(turn), half + radius * std::sin(turn));
  }
  return {stretch};
}

// Long head: winding blades with their edges on the outline, gullets towards the axis.
MeshPart longHead(const HandpieceParameters& parameters, double neck) {
  const double radius = parameters.bur_radius_mm;
  const std::size_t around = static_cast<std::size_t>(parameters.flutes) * 24;
  const auto gullet = [&](double z, double turn) {
    const double phase = std::fmod(turn + 0.35 * z / radius + 16.0 * kPi, 2.0 * kPi) * parameters.flutes / (2.0 * kPi);
    const double across = phase - std::floor(phase);
    const double groove = gulletDepth(across);
    // Staggered cross-cuts.
    const double nick = std::fmod(z / radius * 1.6 + std::floor(phase) * 0.5 + 64.0, 1.0) < 0.14 ? 0.3 : 0.0;
    return std::min(1.0, std::max(groove, nick));
  };
  MeshPart head;
  for (const Stretch& stretch : outlineOf(parameters, neck)) {
    MeshPart part = sweep(stretch.size(), around, [&](std::size_t ring, double turn) {
      const double rho = stretch[ring].x * (1.0 - 0.2 * gullet(stretch[ring].y, turn));
      return glm::dvec3(rho * std::cos(turn), rho * std::sin(turn), stretch[ring].y);
    });
    for (std::size_t ring = 0; ring < stretch.size(); ++ring)
      for (std::size_t a = 0; a < around; ++a) {
        const double angle = 2.0 * kPi * static_cast<double>(a) / static_cast<double>(around);
        part.colour.push_back(gulletShade(static_cast<float>(gullet(stretch[ring].y, angle))));
      }
    append(head, part);
  }
  return head;
}

MeshPart bur(const HandpieceParameters& parameters) {
  const double radius = parameters.bur_radius_mm, half = 0.5 * parameters.bur_length_mm;
  const double fitting = std::min(0.55 * radius, 0.75 * kShankRadius_mm);
  const double neck = parameters.neck_radius_mm > 0.0 ? std::min(parameters.neck_radius_mm, radius) : fitting;
  // z at which the round end has the neck's radius.
  const double shoulder = std::sqrt(std::max(0.0, 0.98 * radius * radius - neck * neck));
  const bool round = parameters.form == BurForm::round, capsule = parameters.form == BurForm::capsule;
  double start = round ? shoulder : capsule ? half + shoulder : half;
  if (parameters.form == BurForm::revolved) {
    // A round end goes into the neck where it is as thin.
    const BurOutline outline = burOutline(parameters.profile, radius, parameters.bur_length_mm);
    for (std::size_t n = outline.count; n-- > 0 && outline.radius_mm[outline.count - 1] <= 0.0;) {
      start = outline.z_mm[n];
      if (outline.radius_mm[n] >= neck) break;
    }
  }
  MeshPart part = round ? burHead(parameters) : longHead(parameters, neck);
  append(part, revolved({{start - (round || capsule ? 0.15 * radius : 0.0), neck},
                         {start + 0.6, neck * 0.92},
                         {start + 4.0, neck * 0.95},
                         {start + 9.0, kShankRadius_mm, false},
                         {26.0, kShankRadius_mm},
                         {26.6, kShankRadius_mm, true}},
                        glm::vec4(0.95f, 0.95f, 0.95f, 1.0f)));
  // Bevelled, and dark, so that a bur without handpiece ends without a flash of the lamp.
  append(part, revolved({{26.6, kShankRadius_mm, true}, {27.0, 0.75 * kShankRadius_mm, true}, {27.0, 0.0, true}},
                        glm::vec4(0.2f, 0.2f, 0.21f, 1.0f)));
  part.name = "Bur";
  part.material = {{0.56f, 0.57f, 0.58f, 1.0f}, 0.28f, 1.0f};
  part.normal = vertexNormals(part.position_mm, part.triangles);
  return part;
}

// Nose cone, collet ring, waisted grip with rings, body and coupling.
MeshPart handpiece() {
  const glm::vec4 steel(0.92f, 0.93f, 0.95f, 1.0f);
  const glm::vec4 dark(0.42f, 0.43f, 0.45f, 1.0f);
  MeshPart part = revolved({{20.0, kShankRadius_mm + 0.02, true},
                            {20.0, 1.9, true},
                            {20.6, 2.3, true},
                            {30.0, 3.6},
                            {38.0, 4.6},
                            {40.0, 4.8, true}},
                           steel);
  append(part, revolved({{40.0, 4.8, true}, {40.0, 4.45, true}, {41.6, 4.45, true}, {41.6, 5.1, true}}, dark));
  // Grip: shallow rounded rings.
  std::vector<Section> grip = {{41.6, 5.1, true}};
  for (double z = 42.6; z < 66.0; z += 0.35) {
    const double wave = std::pow(std::abs(std::sin(kPi * (z - 42.6) / 2.8)), 0.5);
    const double waist = 6.3 - 0.7 * std::sin(kPi * (z - 42.0) / 40.0);
    grip.push_back({z, waist - 0.35 + 0.35 * wave, false});
  }
  grip.push_back({66.3, 6.6, true});
  append(part, revolved(grip, glm::vec4(0.80f, 0.81f, 0.83f, 1.0f)));
  append(part, revolved({{66.3, 6.6, true},
                         {68.0, 7.6},
                         {72.0, 8.2},
                         {98.0, 8.6},
                         {100.5, 8.6, true},
                         {100.5, 8.1, true},
                         {102.5, 8.1, true},
                         {102.5, 8.8, true},
                         {108.0, 8.8},
                         {109.4, 8.4},
                         {110.0, 7.4, true},
                         {110.0, 0.0, true}},
                        steel));
  part.name = "Handpiece";
  part.material = {{0.60f, 0.61f, 0.63f, 1.0f}, 0.32f, 1.0f};
  part.normal = vertexNormals(part.position_mm, part.triangles);
  return part;
}

}  // namespace

MeshModel surgicalHandpiece(const HandpieceParameters& parameters) {
  if (!(parameters.bur_radius_mm >= 0.25 && parameters.bur_radius_mm <= 5.0)) {
    throw LoadError("instrument: bur radius is outside 0.25..5 mm, choose another bur");
  }
  const bool round = parameters.form == BurForm::round;
  if (!(parameters.bur_length_mm >= (round || parameters.form == BurForm::capsule ? 0.0 : 0.1) &&
        parameters.bur_length_mm <= 20.0)) {
    throw LoadError("instrument: bur length is outside 0.1..20 mm, choose another bur");
  }
  if (!(parameters.neck_radius_mm >= 0.0)) {
    throw LoadError("instrument: neck radius is negative, give 0 for the default");
  }
  if (parameters.flutes < 8 || parameters.flutes > 40) {
    throw LoadError("instrument: a bur has 8..40 flutes, choose a number in between");
  }
  MeshModel instrument{{bur(parameters)}};
  if (parameters.handpiece) instrument.parts.push_back(handpiece());
  return instrument;
}

}  // namespace assets
