// tool_shade.glsl in lanes. Included only by the kernels (shade_kernel.cpp); internal linkage.
#pragma once

#include "render/cpu/light_body.h"
#include "render/shaders/tool_constants.glsl"

namespace render::cpu {
namespace {

/// The same for all points.
struct ToolPart {
  glm::vec3 from_P, axis;
  float square, radius, growth;

  ToolPart(const ToolBlock& tool, std::size_t n)
      : from_P(tool.from_P[n]),
        axis(glm::vec3(tool.to_P[n]) - from_P),
        square(glm::dot(axis, axis)),
        radius(tool.from_P[n].w),
        growth(tool.to_P[n].w - radius) {}
};

/// A part as seen from the points.
struct ToolPartBeside {
  Float3 begin, axis;
  Float begin_axis;

  ToolPartBeside(const ToolPart& part, const Float3& p_P)
      : begin(splat(part.from_P) - p_P), axis(splat(part.axis)), begin_axis(dot(begin, axis)) {}
};

inline Float besidePart(const ToolPart& part, const ToolPartBeside& seen, const Float3& normal) {
  const Float at = clamp(-seen.begin_axis * (1.0f / part.square), 0.0f, 1.0f);
  const Float3 way = seen.begin + at * seen.axis;
  const Float inverse = inverseSquareRoot(maximum(dot(way, way), 1e-6f)), radius = part.radius + at * part.growth;
  const Float share = radius * inverse;
  return 1.0f - TOOL_SHADE * maximum(dot(normal, way) * inverse, 0.0f) * minimum(share * share, 1.0f);
}

inline Float eased(Float t) { return t * t * (3.0f - 2.0f * t); }

inline Float pastPart(const ToolPart& part, const ToolPartBeside& seen, const Float3& to_lamp) {
  const Float along = dot(seen.begin, to_lamp), slope = dot(seen.axis, to_lamp);
  const Float across = maximum(part.square - slope * slope, 1e-6f);
  const Float at = clamp((along * slope - seen.begin_axis) / across, 0.0f, 1.0f);
  const Float reach = along + at * slope;
  const Float away = length(seen.begin + at * seen.axis - reach * to_lamp), radius = part.radius + at * part.growth;
  const Float half_per_soft = 0.5f / (TOOL_LAMP_SPREAD * maximum(reach, 0.0f) + TOOL_LAMP_SOFT);
  const Float middle = 0.5f + half_per_soft * away, edge = half_per_soft * radius;
  const Float covered = eased(clamp(middle + edge, 0.0f, 1.0f)) - eased(clamp(middle - edge, 0.0f, 1.0f));
  return 1.0f - covered * eased(clamp(0.5f + reach / radius, 0.0f, 1.0f));
}

inline Float lampPastTool(const ShadeScene& scene, const Float3& p_P, const Float3& to_lamp) {
  if (scene.tool.from_P[0].w == 0.0f) return splat(1.0f);
  Float passes = splat(1.0f);
  for (std::size_t n = 0; n < TOOL_PARTS; ++n) {
    const ToolPart part(scene.tool, n);
    passes = minimum(passes, pastPart(part, ToolPartBeside(part, p_P), to_lamp));
  }
  return TOOL_LAMP_MIN + (1.0f - TOOL_LAMP_MIN) * passes;
}

inline Visibility besideTool(const ShadeScene& scene, Visibility visibility, const Float3& p_P, const Float3& normal) {
  if (scene.tool.from_P[0].w == 0.0f) return visibility;
  const Float3 to_lamp = normalised(splat(scene.eye.lamp_P) - p_P);
  Float passes = splat(1.0f);
  for (std::size_t n = 0; n < TOOL_PARTS; ++n) {
    const ToolPart part(scene.tool, n);
    const ToolPartBeside seen(part, p_P);
    visibility.ambient = visibility.ambient * besidePart(part, seen, normal);
    passes = minimum(passes, pastPart(part, seen, to_lamp));
  }
  visibility.lamp = visibility.lamp * (TOOL_LAMP_MIN + (1.0f - TOOL_LAMP_MIN) * passes);
  return visibility;
}

inline Float3 underRing(const ShadeScene& scene, const Float3& light, const Float3& p_P) {
  const ToolBlock& tool = scene.tool;
  if (tool.ring_P.w == 0.0f) return light;
  const Float3 offset = p_P - splat(tool.ring_P), axis = splat(tool.ring_axis_P);
  const Float along = dot(offset, axis), aside = length(offset - along * axis);
  const Float line = 1.0f - smoothStep(0.5f * RING_HALF_WIDTH, 1.5f * RING_HALF_WIDTH, absolute(aside - tool.ring_P.w));
  const Float cover = select(absolute(along) < RING_REACH + tool.ring_P.w, tool.ring_axis_P.w * line, 0.0f);
  return mix(light, splat(tool.ring_colour), cover);
}

}  // namespace
}  // namespace render::cpu
