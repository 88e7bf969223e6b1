#include "assets/instrument/canal_file.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "assets/mesh/catmull_rom.h"
#include "assets/mesh/closed_sweep.h"
#include "calibration/geometry/units.h"

namespace assets {
namespace {

using calibration::kPi;
using glm::dvec3;

constexpr std::size_t kAround = 12, kRings = 200;
constexpr double kHandle_mm = 10.0, kHandleRadius_mm = 1.9, kStopRadius_mm = 1.3, kStopHalf_mm = 0.6;

/// Linear RGB of a handle.
glm::vec4 colourOf(std::string_view name) {
  constexpr std::pair<std::string_view, glm::vec3> kColours[] = {
      {"pink", {0.82f, 0.25f, 0.42f}},  {"grey", {0.25f, 0.26f, 0.28f}},   {"purple", {0.22f, 0.05f, 0.38f}},
      {"white", {0.85f, 0.85f, 0.83f}}, {"yellow", {0.85f, 0.62f, 0.03f}}, {"red", {0.62f, 0.02f, 0.02f}},
      {"blue", {0.02f, 0.12f, 0.55f}},  {"green", {0.01f, 0.30f, 0.09f}},  {"black", {0.02f, 0.02f, 0.02f}}};
  for (const auto& [key, colour] : kColours)
    if (key == name) return {colour, 1.0f};
  return {0.5f, 0.5f, 0.5f, 1.0f};
}

constexpr glm::vec3 kSteel{0.55f, 0.56f, 0.58f}, kAmber{0.90f, 0.42f, 0.02f}, kRed{0.80f, 0.02f, 0.01f};
/// As laid (render/volume/tissue_appearance).
constexpr glm::vec4 kGuttaPercha{0.85f, 0.36f, 0.30f, 1.0f};
constexpr float kAmberFrom = 0.4f;

/// Of the wire where it bears that share of what breaks it.
glm::vec3 colourUnder(float share) {
  const float s = std::clamp(share, 0.0f, 1.0f);
  return s < kAmberFrom ? glm::mix(kSteel, kAmber, s / kAmberFrom)
                        : glm::mix(kAmber, kRed, (s - kAmberFrom) / (1.0f - kAmberFrom));
}

float shareAt(std::span<const float> of_node, double place) {
  if (of_node.empty()) return 0.0f;
  const double at = std::clamp(place, 0.0, 1.0) * static_cast<double>(of_node.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  return std::lerp(of_node[low], of_node[std::min(low + 1, of_node.size() - 1)],
                   static_cast<float>(at - static_cast<double>(low)));
}

/// The file's way, and how far each place is from its tip.
struct Way {
  std::vector<dvec3> node_mm;
  double whole_mm, left_mm;

  dvec3 at(double share) const {
    const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(node_mm.size() - 1);
    const auto span = std::min(static_cast<std::size_t>(place), node_mm.size() - 2);
    return catmullRomAt(node_mm, span, place - static_cast<double>(span));
  }
  dvec3 along(double share) const { return glm::normalize(at(share + 1e-3) - at(share - 1e-3)); }
  double fromTip_mm(double share) const { return whole_mm - share * left_mm; }
};

Way wayOf(std::span<const glm::vec3> node_T_mm, double whole_mm, double made_mm) {
  Way way{{}, whole_mm > 0.0 ? whole_mm : made_mm, 0.0};
  for (const glm::vec3& node : node_T_mm) way.node_mm.emplace_back(node);
  if (way.node_mm.size() < 2) way.node_mm = {dvec3(0.0), dvec3(0.0, 0.0, -made_mm)};
  for (std::size_t n = 1; n < way.node_mm.size(); ++n) way.left_mm += glm::distance(way.node_mm[n], way.node_mm[n - 1]);
  // A broken file has its last nodes in one place.
  while (way.node_mm.size() > 2 && glm::distance(way.node_mm.back(), way.node_mm[way.node_mm.size() - 2]) < 1e-6)
    way.node_mm.pop_back();
  return way;
}

Way wayOf(const DrawnFile& drawn) { return wayOf(drawn.node_T_mm, drawn.whole_mm, drawn.file.length_mm); }

/// The twisted wire: its corners run round it once a lead.
Ring section(const DrawnFile& drawn, const Way& way, double share, dvec3& side) {
  const dvec3 centre = way.at(share), along = way.along(share);
  side = glm::normalize(side - glm::dot(side, along) * along);
  const dvec3 up = glm::cross(along, side);
  const double from_tip_mm = way.fromTip_mm(share), radius = 0.5 * drawn.file.diameter_mm(from_tip_mm);
  const bool cuts = from_tip_mm < KFile::kCutting_mm;
  const int corners = drawn.file.section() == KFileSection::square ? 4 : 3;
  const double turned = drawn.roll_rad + 2.0 * kPi * from_tip_mm / drawn.file.lead_mm();
  // The tip's cone.
  const double room = std::clamp((from_tip_mm + 0.02) / (0.6 * drawn.file.tip_mm()), 0.15, 1.0);
  Ring ring;
  for (std::size_t n = 0; n < kAround; ++n) {
    const double angle = -2.0 * kPi * static_cast<double>(n) / static_cast<double>(kAround);
    const double flat = cuts ? 0.86 + 0.14 * std::cos(corners * (angle - turned)) : 1.0;
    ring.push_back(centre + room * radius * flat * (std::cos(angle) * side + std::sin(angle) * up));
  }
  return ring;
}

/// Along the file; strained metal is no mirror, so that its colour is seen.
void colourWire(const DrawnFile& drawn, MeshPart& wire) {
  const float most = drawn.torque_share.empty() ? 0.0f : std::ranges::max(drawn.torque_share);
  wire.material = {{1.0f, 1.0f, 1.0f, 1.0f}, 0.3f, 1.0f - std::clamp(2.0f * most, 0.0f, 1.0f)};
  const auto colour = [&](std::size_t ring) {
    return glm::vec4(colourUnder(shareAt(drawn.torque_share, static_cast<double>(ring) / kRings)), 1.0f);
  };
  for (std::size_t ring = 0; ring <= kRings; ++ring) wire.colour.insert(wire.colour.end(), kAround, colour(ring));
  // The middles of both ends.
  wire.colour.insert(wire.colour.end(), {colour(0), colour(kRings)});
}

MeshPart wireOf(const DrawnFile& drawn) {
  const Way way = wayOf(drawn);
  std::vector<Ring> rings;
  dvec3 side(1.0, 0.0, 0.0);
  // Not along it.
  if (std::fabs(way.along(0.0).x) > 0.9) side = {0.0, 1.0, 0.0};
  for (std::size_t n = 0; n <= kRings; ++n) rings.push_back(section(drawn, way, static_cast<double>(n) / kRings, side));
  MeshPart wire = closedSweep(rings);
  wire.name = "Wire";
  colourWire(drawn, wire);
  return wire;
}

MeshPart rod(double from_z_mm, double to_z_mm, std::span<const std::pair<double, double>> profile, const char* name) {
  std::vector<Ring> rings;
  for (const auto& [share, radius_mm] : profile)
    rings.push_back(circle({0.0, 0.0, glm::mix(from_z_mm, to_z_mm, share)}, {0.0, 0.0, 1.0}, radius_mm, 24));
  MeshPart part = closedSweep(rings);
  part.name = name;
  return part;
}

/// Round and smooth, its tip blunt.
MeshPart coneOf(const DrawnCone& drawn) {
  const Way way = wayOf(drawn.node_T_mm, 0.0, drawn.cone.length_mm);
  std::vector<Ring> rings;
  for (std::size_t n = 0; n <= kRings; ++n) {
    const double share = static_cast<double>(n) / kRings, from_tip_mm = way.fromTip_mm(share);
    const double room = std::clamp((from_tip_mm + 0.02) / (0.3 * drawn.cone.diameter_mm(0.0)), 0.4, 1.0);
    rings.push_back(circle(way.at(share), way.along(share), 0.5 * room * drawn.cone.diameter_mm(from_tip_mm), 16));
  }
  MeshPart cone = closedSweep(rings);
  cone.name = "Cone";
  cone.material = {kGuttaPercha, 0.5f, 0.0f};
  return cone;
}

}  // namespace

MeshModel fragmentWires(std::span<const MetalFragment> fragments) {
  MeshModel model;
  for (const MetalFragment& one : fragments) {
    const std::vector<glm::vec3> node_mm(one.node_P_mm.begin(), one.node_P_mm.end());
    const KFile file{one.size, one.length_mm(), one.nickel_titanium ? KFileMetal::nickel_titanium : KFileMetal::steel};
    model.parts.push_back(wireOf({.file = file, .node_T_mm = node_mm, .torque_share = {}}));
  }
  return model;
}

MeshModel canalCone(const DrawnCone& drawn) {
  constexpr std::pair<double, double> kBeaks[] = {{0.0, 0.6}, {0.02, 0.9}, {0.3, 1.0}, {0.6, 1.6}, {1.0, 2.4}};
  MeshPart pliers = rod(-0.5, 14.0, kBeaks, "Pliers");
  pliers.material = {glm::vec4(kSteel, 1.0f), 0.35f, 1.0f};
  MeshModel model;
  if (drawn.is_held) model.parts.push_back(coneOf(drawn));
  model.parts.push_back(std::move(pliers));
  return model;
}

MeshModel canalFile(const DrawnFile& drawn) {
  const Way way = wayOf(drawn);
  MeshPart wire = wireOf(drawn);

  constexpr std::pair<double, double> kGrip[] = {
      {0.0, 0.9}, {0.0, 1.5}, {0.1, kHandleRadius_mm}, {0.3, 1.55}, {0.5, 1.75}, {0.8, 1.6}, {0.95, 1.8}, {1.0, 1.2}};
  MeshPart handle = rod(0.0, kHandle_mm, kGrip, "Handle");
  handle.material = {colourOf(drawn.file.colour()), 0.45f, 0.0f};
  MeshModel model;
  model.parts = {std::move(wire), std::move(handle)};

  const double share = (way.whole_mm - drawn.stop_mm) / std::max(way.left_mm, 1e-6);
  if (drawn.stop_mm > 0.0 && share > 0.0 && share < 1.0) {
    const dvec3 centre = way.at(share), along = way.along(share);
    std::vector<Ring> ring;
    for (const double beside : {-kStopHalf_mm, -kStopHalf_mm + 0.1, kStopHalf_mm - 0.1, kStopHalf_mm})
      ring.push_back(circle(centre - beside * along, -along,
                            std::fabs(beside) == kStopHalf_mm ? kStopRadius_mm - 0.1 : kStopRadius_mm, 24));
    MeshPart stop = closedSweep(ring);
    stop.name = "Stop";
    stop.material = {{0.9f, 0.45f, 0.02f, 1.0f}, 0.7f, 0.0f};
    model.parts.push_back(std::move(stop));
  }
  return model;
}

}  // namespace assets
