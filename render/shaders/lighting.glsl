// Light of the theatre: an operating lamp with a soft cone and a hemisphere of ambient light. Linear light, frame P.
// Specular: GGX (Walter et al. 2007) with the height-correlated Smith term (Heitz 2014) and Schlick's Fresnel (1994).
// Ambient specular: the fit of Lazarov, "Getting more physical in Call of Duty: Black Ops II" (SIGGRAPH 2013).
#include "eye_block.glsl"

struct Surface {
  vec3 albedo;
  vec3 f0;              // reflectance at normal incidence
  float roughness;
  float wrap;           // 0: Lambert; more lets light creep round, as in skin and enamel
  vec3 scatter;         // colour of the light that creeps
};

struct Shade {
  float ambient;        // 1: nothing around it
  float lamp;           // 1: nothing between it and the lamp
};

const vec3 kLampLight = vec3(3.05, 2.95, 2.75);
const vec3 kSkyLight = vec3(0.50, 0.53, 0.56);
const vec3 kFloorLight = vec3(0.20, 0.17, 0.155);
const float kConeInner = 0.985, kConeOuter = 0.86;

// What shines from a direction besides the lamp: ceiling, a bright panel overhead, floor.
vec3 surroundings(vec3 direction, float roughness) {
  float height = dot(direction, eye.up_P.xyz);
  vec3 light = mix(kFloorLight, kSkyLight, smoothstep(-0.6, 0.8, height));
  float panel = smoothstep(0.55 - 0.5 * roughness, 0.75 + 0.5 * roughness, height);
  return light + panel * vec3(0.9) * (1.0 - 0.6 * roughness);
}

vec3 lampRadiance(vec3 p_P, vec3 to_lamp, float distance) {
  float cosine = dot(-to_lamp, eye.lamp_axis_P.xyz);
  float cone = mix(0.25, 1.0, smoothstep(kConeOuter, kConeInner, cosine));
  float fall = eye.lamp_P.w / distance;
  return kLampLight * cone * fall * fall;
}

vec3 ambientSpecular(vec3 f0, float roughness, float n_v) {
  vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a = min(r.x * r.x, exp2(-9.28 * n_v)) * r.x + r.y;
  vec2 scale_bias = vec2(-1.04, 1.04) * a + r.zw;
  return f0 * scale_bias.x + scale_bias.y;
}

vec3 lit(Surface s, vec3 p_P, vec3 normal, vec3 to_eye, Shade shade) {
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
  vec3 light = (diffuse + highlight) * lampRadiance(p_P, to_lamp, lamp_distance) * shade.lamp;

  // The room.
  float sky = 0.5 + 0.5 * dot(normal, eye.up_P.xyz);
  light += s.albedo * mix(kFloorLight, kSkyLight, sky) * shade.ambient;
  vec3 mirrored = reflect(-to_eye, normal);
  light += ambientSpecular(s.f0, s.roughness, n_v) * surroundings(mirrored, s.roughness) * shade.ambient * 0.6;
  return light;
}
