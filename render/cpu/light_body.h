// lighting.glsl in lanes. Included only by the kernels (shade_kernel.cpp); internal linkage.
#pragma once

#include "render/cpu/float3.h"
#include "render/cpu/shade_kernels.h"
#include "render/shaders/light_constants.glsl"

namespace render::cpu {
namespace {

constexpr float kPi = 3.14159265f;

inline Float3 splat(const glm::vec4& v) { return {splat(v.x), splat(v.y), splat(v.z)}; }
inline Float3 splat(const glm::vec3& v) { return {splat(v.x), splat(v.y), splat(v.z)}; }

struct Surface {
  Float3 albedo, f0;
  Float roughness, wrap;
  Float3 scatter;
};

struct Visibility {
  Float ambient, lamp;
};

inline Float3 surroundings(const ShadeScene& scene, const Float3& direction, Float roughness) {
  const Float height = dot(direction, splat(scene.eye.up_P));
  const Float aside = absolute(dot(direction, splat(scene.right_axis_P)));
  const Float3 light =
      mix(WALL_FLOOR_SHARE * vec3(FLOOR_LIGHT), vec3(SKY_LIGHT), smoothStep(WALL_LOW, WALL_HIGH, height));
  const Float soft = MIRROR_SOFT + MIRROR_SOFT_ROUGH * roughness;
  const Float panel = smoothStep(PANEL_EDGE - soft, PANEL_EDGE + soft, height);
  const Float strip = smoothStep(STRIP_FROM - soft, STRIP_FROM + soft, aside) *
                      (1.0f - smoothStep(STRIP_TO - soft, STRIP_TO + soft, aside));
  const Float kept = 1.0f - MIRROR_ROUGH_LOSS * roughness;
  return light + kept * (panel * vec3(PANEL_LIGHT) + strip * vec3(STRIP_LIGHT));
}

inline Float3 lampRadiance(const EyeBlock& eye, const Float3& to_lamp, Float distance) {
  const Float cosine = -dot(to_lamp, splat(eye.lamp_axis_P));
  const Float cone = LAMP_CONE_DARK + (1.0f - LAMP_CONE_DARK) * smoothStep(LAMP_CONE_OUTER, LAMP_CONE_INNER, cosine);
  const Float fall = eye.lamp_P.w / distance;
  return (cone * fall * fall) * vec3(LAMP_LIGHT);
}

inline Float3 ambientSpecular(const Float3& f0, Float roughness, Float n_v) {
  constexpr float kSlope[] = {SPECULAR_FIT_SLOPE}, kStart[] = {SPECULAR_FIT_START};
  const Float x = roughness * kSlope[0] + kStart[0], y = roughness * kSlope[1] + kStart[1];
  const Float z = roughness * kSlope[2] + kStart[2], w = roughness * kSlope[3] + kStart[3];
  const Float a = minimum(x * x, exp2(SPECULAR_FIT_FALL * n_v)) * x + y;
  return (z - SPECULAR_FIT_SCALE * a) * f0 + vec3(w + SPECULAR_FIT_SCALE * a);
}

inline Float bouncedAmbient(Float open, Float albedo) {
  constexpr float kA[] = {BOUNCE_A}, kB[] = {BOUNCE_B}, kC[] = {BOUNCE_C};
  const Float a = kA[0] * albedo + kA[1], b = kB[0] * albedo + kB[1], c = kC[0] * albedo + kC[1];
  return maximum(open, ((open * a + b) * open + c) * open);
}

inline Float3 cured(const EyeBlock& eye, const Surface& s, const Float3& p_P, const Float3& normal) {
  const Float3 offset = p_P - splat(eye.curing_P), axis = splat(eye.curing_axis_P);
  const Float along = dot(offset, axis);
  const Float aside = (1.0f / eye.curing_axis_P.w) * length(offset - along * axis);
  const Float spot = (1.0f - smoothStep(CURING_EDGE, 1.0f, aside)) * smoothStep(-0.1f, 0.0f, along);
  const Float fall = clamp(1.0f - (1.0f / eye.curing_P.w) * along, 0.0f, 1.0f);
  const Float facing = maximum(CURING_WRAP - dot(normal, axis), 0.0f) * (1.0f / (1.0f + CURING_WRAP));
  const Float3 colour = mix(s.albedo, vec3(1.0f, 1.0f, 1.0f), splat(CURING_WHITE));
  return (spot * fall * facing * (1.0f / kPi)) * (colour * vec3(CURING_LIGHT));
}

inline Float3 lit(const ShadeScene& scene, const Surface& s, const Float3& p_P, const Float3& normal,
                  const Float3& to_eye, const Visibility& visibility) {
  const EyeBlock& eye = scene.eye;
  const Float3 lamp_offset = splat(eye.lamp_P) - p_P;
  const Float lamp_distance = length(lamp_offset);
  const Float3 to_lamp = (1.0f / lamp_distance) * lamp_offset;
  const Float3 half_way = normalised(to_lamp + to_eye);
  const Float n_v = maximum(absolute(dot(normal, to_eye)), 1e-3f);
  const Float n_l = dot(normal, to_lamp), n_h = maximum(dot(normal, half_way), 0.0f);
  const Float v_h = maximum(dot(to_eye, half_way), 0.0f);

  // The lamp: diffuse with wrap, GGX highlight.
  const Float a = s.roughness * s.roughness, a2 = a * a;
  const Float d = n_h * n_h * (a2 - 1.0f) + 1.0f;
  const Float lambert = maximum(n_l, 0.0f);
  const Float smith = 0.5f / maximum(lambert * squareRoot(n_v * n_v * (1.0f - a2) + a2) +
                                         n_v * squareRoot(lambert * lambert * (1.0f - a2) + a2),
                                     1e-5f);
  const Float left = 1.0f - v_h, left2 = left * left, left5 = left2 * left2 * left;
  const Float3 fresnel = s.f0 + left5 * (vec3(1.0f, 1.0f, 1.0f) - s.f0);
  const Float3 highlight = (a2 / (kPi * d * d) * smith * lambert) * fresnel;
  const Float wrapped = maximum(n_l + s.wrap, 0.0f) / (1.0f + s.wrap);
  const Float3 creeping = mix(s.scatter, vec3(1.0f, 1.0f, 1.0f), smoothStep(-s.wrap, splat(0.5f), n_l));
  const Float3 diffuse = (wrapped / kPi) * (s.albedo * creeping);
  Float3 light = visibility.lamp * ((diffuse + highlight) * lampRadiance(eye, to_lamp, lamp_distance));
  if (eye.curing_P.w != 0.0f) light = light + cured(eye, s, p_P, normal);

  // The room.
  const Float sky = 0.5f + 0.5f * dot(normal, splat(eye.up_P));
  const Float3 bounced{bouncedAmbient(visibility.ambient, s.albedo.x), bouncedAmbient(visibility.ambient, s.albedo.y),
                       bouncedAmbient(visibility.ambient, s.albedo.z)};
  light = light + s.albedo * (mix(vec3(FLOOR_LIGHT), vec3(SKY_LIGHT), sky) * bounced);
  const Float3 mirrored = (2.0f * dot(normal, to_eye)) * normal - to_eye;
  return light +
         visibility.ambient * (ambientSpecular(s.f0, s.roughness, n_v) * surroundings(scene, mirrored, s.roughness));
}

}  // namespace
}  // namespace render::cpu
