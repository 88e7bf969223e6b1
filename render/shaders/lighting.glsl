// Lighting: an operating lamp with a soft cone and a hemisphere of ambient light. Linear light, frame P.
// Specular: GGX (Walter et al. 2007) with the height-correlated Smith term (Heitz 2014) and Schlick's Fresnel (1994).
// Ambient specular: the fit of Lazarov, "Getting more physical in Call of Duty: Black Ops II" (SIGGRAPH 2013).
#include "eye_block.glsl"
#include "light_constants.glsl"

struct Surface {
  vec3 albedo;
  vec3 f0;              // reflectance at normal incidence
  float roughness;
  float wrap;           // 0: Lambert; more for light scattered beyond the terminator, as in skin and enamel
  vec3 scatter;         // colour of that light
};

struct Visibility {
  float ambient;        // 1: unoccluded
  float lamp;           // 1: unshadowed
};

const vec3 kLampLight = vec3(LAMP_LIGHT);
const vec3 kSkyLight = vec3(SKY_LIGHT);
const vec3 kFloorLight = vec3(FLOOR_LIGHT);

// Light from a direction without the lamp: walls, floor, a bright panel overhead and a window strip on each side.
vec3 surroundings(vec3 direction, float roughness) {
  float height = dot(direction, eye.up_P.xyz);
  float aside = abs(dot(direction, normalize(eye.right_edge_P.xyz)));
  vec3 light = mix(WALL_FLOOR_SHARE * kFloorLight, kSkyLight, smoothstep(WALL_LOW, WALL_HIGH, height));
  float soft = MIRROR_SOFT + MIRROR_SOFT_ROUGH * roughness;
  float panel = smoothstep(PANEL_EDGE - soft, PANEL_EDGE + soft, height);
  float strip = smoothstep(STRIP_FROM - soft, STRIP_FROM + soft, aside) *
                (1.0 - smoothstep(STRIP_TO - soft, STRIP_TO + soft, aside));
  return light + (panel * vec3(PANEL_LIGHT) + strip * vec3(STRIP_LIGHT)) * (1.0 - MIRROR_ROUGH_LOSS * roughness);
}

vec3 lampRadiance(vec3 p_P, vec3 to_lamp, float distance) {
  float cosine = dot(-to_lamp, eye.lamp_axis_P.xyz);
  float cone = mix(LAMP_CONE_DARK, 1.0, smoothstep(LAMP_CONE_OUTER, LAMP_CONE_INNER, cosine));
  float fall = eye.lamp_P.w / distance;
  return kLampLight * cone * fall * fall;
}

vec3 ambientSpecular(vec3 f0, float roughness, float n_v) {
  vec4 r = roughness * vec4(SPECULAR_FIT_SLOPE) + vec4(SPECULAR_FIT_START);
  float a = min(r.x * r.x, exp2(SPECULAR_FIT_FALL * n_v)) * r.x + r.y;
  vec2 scale_bias = SPECULAR_FIT_SCALE * vec2(-a, a) + r.zw;
  return f0 * scale_bias.x + scale_bias.y;
}

// Multi-bounce ambient light: Jimenez et al., "Practical real-time strategies for accurate indirect occlusion"
// (SIGGRAPH 2016), equation 8.
vec3 bouncedAmbient(float open, vec3 albedo) {
  const vec2 kA = vec2(BOUNCE_A), kB = vec2(BOUNCE_B), kC = vec2(BOUNCE_C);
  vec3 a = kA.x * albedo + kA.y, b = kB.x * albedo + kB.y, c = kC.x * albedo + kC.y;
  return max(vec3(open), ((open * a + b) * open + c) * open);
}

// What a curing lamp adds.
vec3 cured(Surface s, vec3 p_P, vec3 normal) {
  if (eye.curing_P.w == 0.0) return vec3(0.0);
  vec3 offset = p_P - eye.curing_P.xyz;
  float along = dot(offset, eye.curing_axis_P.xyz);
  float aside = length(offset - along * eye.curing_axis_P.xyz) / eye.curing_axis_P.w;
  float spot = (1.0 - smoothstep(CURING_EDGE, 1.0, aside)) * smoothstep(-0.1, 0.0, along);
  float fall = clamp(1.0 - along / eye.curing_P.w, 0.0, 1.0);
  float facing = max(CURING_WRAP - dot(normal, eye.curing_axis_P.xyz), 0.0) / (1.0 + CURING_WRAP);
  return mix(s.albedo, vec3(1.0), CURING_WHITE) * vec3(CURING_LIGHT) * (spot * fall * facing / 3.14159265);
}

vec3 lit(Surface s, vec3 p_P, vec3 normal, vec3 to_eye, Visibility visibility) {
  vec3 lamp_offset = eye.lamp_P.xyz - p_P;
  float lamp_distance = length(lamp_offset);
  vec3 to_lamp = lamp_offset / lamp_distance;
  vec3 half_way = normalize(to_lamp + to_eye);
  float n_v = max(abs(dot(normal, to_eye)), 1e-3);
  float n_l = dot(normal, to_lamp), n_h = max(dot(normal, half_way), 0.0), v_h = max(dot(to_eye, half_way), 0.0);

  // The lamp: diffuse with wrap, GGX highlight.
  float a = s.roughness * s.roughness, a2 = a * a;
  float d = n_h * n_h * (a2 - 1.0) + 1.0;
  float lambert = max(n_l, 0.0);
  float smith = 0.5 / max(lambert * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(lambert * lambert * (1.0 - a2) + a2), 1e-5);
  vec3 fresnel = s.f0 + (1.0 - s.f0) * pow(1.0 - v_h, 5.0);
  vec3 highlight = fresnel * (a2 / (3.14159265 * d * d)) * smith * lambert;
  float wrapped = max(n_l + s.wrap, 0.0) / (1.0 + s.wrap);
  vec3 diffuse = s.albedo / 3.14159265 * wrapped * mix(s.scatter, vec3(1.0), smoothstep(-s.wrap, 0.5, n_l));
  vec3 light = (diffuse + highlight) * lampRadiance(p_P, to_lamp, lamp_distance) * visibility.lamp;
  light += cured(s, p_P, normal);

  // The room.
  float sky = 0.5 + 0.5 * dot(normal, eye.up_P.xyz);
  light += s.albedo * mix(kFloorLight, kSkyLight, sky) * bouncedAmbient(visibility.ambient, s.albedo);
  vec3 mirrored = reflect(-to_eye, normal);
  light += ambientSpecular(s.f0, s.roughness, n_v) * surroundings(mirrored, s.roughness) * visibility.ambient;
  return light;
}
