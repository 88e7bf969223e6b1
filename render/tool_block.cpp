#include "render/tool_block.h"

#include <algorithm>

#include "render/shaders/tool_constants.glsl"

namespace render {
namespace {

constexpr double kShankRadius_mm = 2.35 / 2.0;  // ISO 1797, type 2
constexpr double kTouching_mm = 0.05;           // no ring below
constexpr double kShown_mm = 0.3;               // the whole ring from here
constexpr double kFades_mm = 9.0;               // to the largest gap

glm::vec4 packedPart(const glm::dvec3& xyz, double w) { return {glm::vec3(xyz), static_cast<float>(w)}; }

void addParts(const Frame& frame, ToolBlock& block) {
  const double radius = frame.bur_radius_mm, half = 0.5 * frame.bur_length_mm;
  const double neck =
      frame.shaft_radius_mm > 0.0 ? std::min(frame.shaft_radius_mm, radius) : std::min(0.55 * radius, kShankRadius_mm);
  // The ends of a part are round.
  double low = 0.0, high = 0.0, top = half, tip_radius = radius;
  switch (frame.bur_form) {
    case assets::BurForm::round:
      top = radius;
      break;
    case assets::BurForm::capsule:
      low = -half, high = half, top = half + radius;
      break;
    case assets::BurForm::cylinder:
      high = std::max(half - 0.8 * radius, 0.0), low = -high;
      break;
    case assets::BurForm::cone:
      tip_radius = std::min(0.1, 0.5 * radius);
      low = -half + tip_radius, high = std::max(half - 0.8 * radius, low);
      break;
    case assets::BurForm::revolved: {
      const assets::BurOutline outline = assets::burOutline(frame.bur_profile, radius, 2.0 * half);
      const double end = outline.radius_mm[outline.count - 1];
      tip_radius = std::clamp(outline.radius_mm[0], std::min(0.3 * radius, half), radius);
      low = -half + std::min(tip_radius, 0.8 * half), high = std::max(half - 0.8 * std::max(end, 0.5 * radius), low);
      break;
    }
  }
  struct Part {
    double from_mm, from_radius_mm, to_mm, to_radius_mm;
  };
  std::array<Part, TOOL_PARTS> parts{{{low, tip_radius, high, radius},
                                      {top, neck, 20.0, kShankRadius_mm},
                                      {20.5, 1.9, 40.0, 4.8},
                                      {44.0, 5.4, 104.0, 8.6}}};
  // A dust grain far away shades nothing.
  if (!frame.has_handpiece) parts[2] = parts[3] = {1e4, 1e-3, 1e4, 1e-3};
  const auto at = [&](double z_mm) {
    return frame.X_PT.translation_mm + frame.X_PT.rotation * glm::dvec3(0.0, 0.0, z_mm);
  };
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const Part& part = parts[n];
    block.from_P[n] = packedPart(at(part.from_mm), part.from_radius_mm);
    // A point becomes a short line, so that it has a direction.
    block.to_P[n] = packedPart(at(std::max(part.to_mm, part.from_mm + 1e-2)), part.to_radius_mm);
  }
}

void addRing(const Frame& frame, ToolBlock& block) {
  const double gap_mm = frame.gap->mm;
  const glm::dvec3 way = frame.X_PT.translation_mm - frame.gap->nearest_P.mm;
  if (gap_mm <= kTouching_mm || gap_mm >= kMaxGap_mm || !(glm::length(way) > 1e-6)) return;
  const double near = glm::clamp((gap_mm - kTouching_mm) / (kShown_mm - kTouching_mm), 0.0, 1.0);
  const double far = glm::clamp((kMaxGap_mm - gap_mm) / (kMaxGap_mm - kFades_mm), 0.0, 1.0);
  block.ring_P = packedPart(frame.gap->nearest_P.mm, frame.bur_radius_mm + RING_SPREAD * gap_mm);
  block.ring_axis_P = packedPart(glm::normalize(way), RING_COVER * near * far);
  block.ring_colour = glm::vec4(colourOfGap(gap_mm), 1.0f);
}

}  // namespace

glm::vec3 colourOfGap(double gap_mm) {
  struct Stop {
    double gap_mm;
    glm::vec3 colour;
  };
  constexpr std::array<Stop, 4> kStops{
      {{0.3, {RING_NEAR_COLOUR}}, {2.0, {RING_CLOSE_COLOUR}}, {5.0, {RING_MIDDLE_COLOUR}}, {9.0, {RING_FAR_COLOUR}}}};
  for (std::size_t n = 0; n + 1 < kStops.size(); ++n)
    if (gap_mm < kStops[n + 1].gap_mm) {
      const double share = (gap_mm - kStops[n].gap_mm) / (kStops[n + 1].gap_mm - kStops[n].gap_mm);
      return glm::mix(kStops[n].colour, kStops[n + 1].colour, static_cast<float>(glm::clamp(share, 0.0, 1.0)));
    }
  return kStops.back().colour;
}

ToolBlock toolBlock(const Frame& frame) {
  ToolBlock block;
  if (!frame.tool_visible) return block;
  if (frame.quality.tool_shadow && frame.tool_shades) addParts(frame, block);
  if (frame.layers.gap_ring && frame.gap) addRing(frame, block);
  return block;
}

}  // namespace render
