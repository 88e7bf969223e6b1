// What the instrument does to the light on the patient: shade of its round parts, soft with distance, and the ring of
// the gap. Closed forms; twin: render/cpu/tool_body.h. A part is a line whose radius grows evenly. The room: the part's
// nearest point as a ball (solid angle r^2/d^2 under the cosine). The lamp: a strip of half-width r at the nearest
// approach of the ray, across a disc that grows with the way.
#include "tool_block.glsl"
#include "tool_constants.glsl"
#include "lighting.glsl"

struct ToolPart {
  vec3 way;        // from the point to the beginning
  vec3 axis;       // from there to the end
  float radius, growth;
};

ToolPart toolPart(int n, vec3 p_P) {
  return ToolPart(tool.from_P[n].xyz - p_P, tool.to_P[n].xyz - tool.from_P[n].xyz, tool.from_P[n].w,
                  tool.to_P[n].w - tool.from_P[n].w);
}

// Open share of the room beside a part.
float besidePart(ToolPart part, vec3 normal) {
  float at = clamp(-dot(part.way, part.axis) / dot(part.axis, part.axis), 0.0, 1.0);
  vec3 way = part.way + at * part.axis;
  float square = max(dot(way, way), 1e-6), radius = part.radius + at * part.growth;
  return 1.0 - TOOL_SHADE * max(dot(normal, way) * inversesqrt(square), 0.0) * min(radius * radius / square, 1.0);
}

// Share of the lamp's light that passes a part.
float pastPart(ToolPart part, vec3 to_lamp) {
  float along = dot(part.way, to_lamp), slope = dot(part.axis, to_lamp);
  float across = max(dot(part.axis, part.axis) - slope * slope, 1e-6);
  float at = clamp((along * slope - dot(part.way, part.axis)) / across, 0.0, 1.0);
  float reach = along + at * slope;
  vec3 aside = part.way + at * part.axis - reach * to_lamp;
  float away = length(aside), radius = part.radius + at * part.growth;
  float soft = TOOL_LAMP_SPREAD * max(reach, 0.0) + TOOL_LAMP_SOFT;
  float covered = smoothstep(-soft, soft, away + radius) - smoothstep(-soft, soft, away - radius);
  return 1.0 - covered * smoothstep(-0.5 * radius, 0.5 * radius, reach);
}

float lampPastTool(vec3 p_P, vec3 to_lamp) {
  if (tool.from_P[0].w == 0.0) return 1.0;
  float passes = 1.0;
  for (int n = 0; n < TOOL_PARTS; ++n) passes = min(passes, pastPart(toolPart(n, p_P), to_lamp));
  return mix(TOOL_LAMP_MIN, 1.0, passes);
}

Visibility besideTool(Visibility visibility, vec3 p_P, vec3 normal) {
  if (tool.from_P[0].w == 0.0) return visibility;
  for (int n = 0; n < TOOL_PARTS; ++n) visibility.ambient *= besidePart(toolPart(n, p_P), normal);
  visibility.lamp *= lampPastTool(p_P, normalize(eye.lamp_P.xyz - p_P));
  return visibility;
}

// The ring over the light of a point.
vec3 underRing(vec3 light, vec3 p_P) {
  if (tool.ring_P.w == 0.0) return light;
  vec3 offset = p_P - tool.ring_P.xyz;
  float along = dot(offset, tool.ring_axis_P.xyz);
  float aside = length(offset - along * tool.ring_axis_P.xyz);
  float cover = 1.0 - smoothstep(0.5 * RING_HALF_WIDTH, 1.5 * RING_HALF_WIDTH, abs(aside - tool.ring_P.w));
  cover *= abs(along) < RING_REACH + tool.ring_P.w ? tool.ring_axis_P.w : 0.0;
  return mix(light, tool.ring_colour.rgb, cover);
}
