// The kernels of shade_kernels.h, written once in lanes. Included by shade_kernels_<set>.cpp, each compiled for its
// instruction set; everything but the table has internal linkage.
#pragma once

#include <cmath>

#include "render/cpu/float3.h"
#include "render/cpu/shade_kernels.h"
#include "render/cpu/srgb_pieces.h"
#include "render/display/eye_projection.h"
#include "render/shaders/finish.glsl"
#include "render/shaders/guide_numbers.glsl"
#include "render/shaders/light_numbers.glsl"
#include "render/shaders/shared_numbers.glsl"

namespace render::cpu {
namespace {

constexpr float kPi = 3.14159265f;

inline Float3 splat(const glm::vec4& v) { return {splat(v.x), splat(v.y), splat(v.z)}; }
inline Float3 splat(const glm::vec3& v) { return {splat(v.x), splat(v.y), splat(v.z)}; }

// ---- lighting.glsl

struct Surface {
  Float3 albedo, f0;
  Float roughness, wrap;
  Float3 scatter;
};

struct Shade {
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

inline Float3 lit(const ShadeScene& scene, const Surface& s, const Float3& p_P, const Float3& normal,
                  const Float3& to_eye, const Shade& shade) {
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
  Float3 light = shade.lamp * ((diffuse + highlight) * lampRadiance(eye, to_lamp, lamp_distance));

  // The room.
  const Float sky = 0.5f + 0.5f * dot(normal, splat(eye.up_P));
  const Float3 bounced{bouncedAmbient(shade.ambient, s.albedo.x), bouncedAmbient(shade.ambient, s.albedo.y),
                       bouncedAmbient(shade.ambient, s.albedo.z)};
  light = light + s.albedo * (mix(vec3(FLOOR_LIGHT), vec3(SKY_LIGHT), sky) * bounced);
  const Float3 mirrored = (2.0f * dot(normal, to_eye)) * normal - to_eye;
  return light + shade.ambient * (ambientSpecular(s.f0, s.roughness, n_v) * surroundings(scene, mirrored, s.roughness));
}

// ---- occlusion.glsl

inline Float3 indexOf(const ShadeScene& scene, const Float3& p_P) {
  return (1.0f / scene.spacing_mm) * (p_P - splat(scene.origin_P));
}

// Two neighbours along i from each of the four rows around a place, mixed; `x`, `y`, `z`: 0 at the first border value.
inline Float trilinear(const FieldView<std::uint16_t>& field, const Float3& at, Mask mask) {
  const Int i = toInt(at.x), j = toInt(at.y), k = toInt(at.z);
  const Float fx = at.x - toFloat(i), fy = at.y - toFloat(j), fz = at.z - toFloat(k);
  const Int offset = (k * field.slice + j * field.row + i) & mask;
  const auto row = [&](std::int32_t further) {
    const Int both = gather32<2>(field.border + further, offset);
    return mix(toFloat(both & 0xffff), toFloat(shiftRightLogical(both, 16)), fx);
  };
  return mix(mix(row(0), row(field.row), fy), mix(row(field.slice), row(field.slice + field.row), fy), fz);
}

// Where a place lies within a field and its border, in values from the first of the border.
inline Mask insideBorder(const Float3& at, glm::ivec3 size) {
  return (at.x > 0.0f) & (at.y > 0.0f) & (at.z > 0.0f) & (at.x < static_cast<float>(size.x + 1)) &
         (at.y < static_cast<float>(size.y + 1)) & (at.z < static_cast<float>(size.z + 1));
}

inline Float crowdingAt(const ShadeScene& scene, const Float3& index, Mask mask) {
  constexpr float kCell = 1.0f / AMBIENT_CELL_VOXELS;
  const Float3 at = kCell * (index + 0.5f) + 0.5f;
  const Mask inside = mask & insideBorder(at, scene.ambient.size);
  if (none(inside)) return splat(0.0f);
  return select(inside, trilinear(scene.ambient, at, inside) * (1.0f / 65535.0f), 0.0f);
}

inline Float coneOpenness(const ShadeScene& scene, const Float3& index, const Float3& direction, float first,
                          Mask mask) {
  const Float close = crowdingAt(scene, index + first * direction, mask);
  const Float middle = crowdingAt(scene, index + (CONE_SECOND * first) * direction, mask);
  const Float far = crowdingAt(scene, index + (CONE_THIRD * first) * direction, mask);
  return (1.0f - close) * (1.0f - CONE_SECOND_SHADE * middle) * (1.0f - CONE_THIRD_SHADE * far);
}

// Voxels that a place may be moved along every axis before it can feel a crowded brick.
inline Float freeVoxels(const ShadeScene& scene, const Float3& index, Mask mask) {
  const glm::ivec3& size = scene.crowded.size;
  constexpr float kBrick = 1.0f / BRICK_VOXELS;
  const Int i = clamp(toInt(kBrick * index.x), 0, size.x - 1), j = clamp(toInt(kBrick * index.y), 0, size.y - 1);
  const Int k = clamp(toInt(kBrick * index.z), 0, size.z - 1);
  const Int bricks = gather(scene.crowded.border, k * scene.crowded.slice + j * scene.crowded.row + i, mask);
  return static_cast<float>(BRICK_VOXELS) * toFloat(bricks - 1);
}

inline Shade shadeFromVolume(const ShadeScene& scene, const Float3& p_P, const Float3& normal, Mask mask) {
  Shade shade{splat(1.0f), splat(1.0f)};
  if (scene.ambient.border == nullptr) return shade;
  const Float3 index = indexOf(scene, p_P);
  const float first = std::fmax(CONE_FIRST_CELLS * AMBIENT_CELL_VOXELS, CONE_FIRST_MM / scene.spacing_mm);
  const Float free = freeVoxels(scene, index, mask);

  // Five cones, where anything is within their reach.
  const Mask near = mask & (free < CONE_THIRD * first);
  if (scene.ambient_shade && any(near)) {
    const Float zero = splat(0.0f);
    const Float3 side = normalised(
        select(absolute(normal.x) < 0.7f, Float3{zero, normal.z, -normal.y}, Float3{-normal.z, zero, normal.x}));
    const Float3 other = cross(normal, side);
    constexpr float kTilt = CONE_TILT;
    const Float leaning = coneOpenness(scene, index, kTilt * (normal + side), first, near) +
                          coneOpenness(scene, index, kTilt * (normal - side), first, near) +
                          coneOpenness(scene, index, kTilt * (normal + other), first, near) +
                          coneOpenness(scene, index, kTilt * (normal - other), first, near);
    const Float open =
        (coneOpenness(scene, index, normal, first, near) + kTilt * leaning) * (1.0f / (1.0f + 4.0f * kTilt));
    shade.ambient = select(near, open * squareRoot(open), 1.0f);
  }

  // Towards the lamp, with growing steps. A place looked at is `reach` from the point at most.
  if (scene.lamp_shadow) {
    const Float3 to_lamp = normalised(splat(scene.eye.lamp_P) - p_P);
    const Float3 lifted = index + (LAMP_LIFT * first) * normal;
    Float through = splat(1.0f);
    float t = first;
    for (int i = 0; i < LAMP_PLACES; ++i, t *= LAMP_STEP_GROWTH) {
      const Mask felt = mask & (free < t + LAMP_LIFT * first) & (through > 0.0f);
      if (none(felt)) continue;
      through *= 1.0f - smoothStep(LAMP_CLEAR, LAMP_BLOCKED, crowdingAt(scene, lifted + t * to_lamp, felt));
    }
    shade.lamp = LAMP_LEFT + (1.0f - LAMP_LEFT) * through;
  }
  return shade;
}

// ---- tissue_look.glsl, surfaceNormal of ray_cast.glsl

inline Word asWord(Int value) { return reinterpret_cast<Word>(value); }

inline Float hashed(Int i, Int j, Int k) {
  const Word h = (asWord(i) * 1597334673u ^ asWord(j) * 3812015801u ^ asWord(k) * 2798796415u) * 1597334673u;
  return toFloat(reinterpret_cast<Int>(h >> 8)) * (1.0f / 16777216.0f);
}

inline Float noise(const Float3& x) {
  const Float3 low{floor(x.x), floor(x.y), floor(x.z)};
  const Int i = toInt(low.x), j = toInt(low.y), k = toInt(low.z);
  const auto eased = [](Float f) { return f * f * (3.0f - 2.0f * f); };
  const Float fx = eased(x.x - low.x), fy = eased(x.y - low.y), fz = eased(x.z - low.z);
  const auto row = [&](Int jj, Int kk) { return mix(hashed(i, jj, kk), hashed(i + 1, jj, kk), fx); };
  return mix(mix(row(j, k), row(j + 1, k), fy), mix(row(j, k + 1), row(j + 1, k + 1), fy), fz);
}

// Colour and finish just below a surface place: eight corners, mixed in the stored roots.
inline Float3 lookAt(const ShadeScene& scene, const Float3& index, Mask mask, Float& finish) {
  const FieldView<std::uint32_t>& field = scene.look;
  const Float3 at{clamp(index.x, 0.0f, static_cast<float>(field.size.x - 1)) + 1.0f,
                  clamp(index.y, 0.0f, static_cast<float>(field.size.y - 1)) + 1.0f,
                  clamp(index.z, 0.0f, static_cast<float>(field.size.z - 1)) + 1.0f};
  const Int i = toInt(at.x), j = toInt(at.y), k = toInt(at.z);
  const Float fx = at.x - toFloat(i), fy = at.y - toFloat(j), fz = at.z - toFloat(k);
  const Int offset = (k * field.slice + j * field.row + i) & mask;
  struct Look {
    Float r, g, b, a;
  };
  const auto mixed = [](const Look& from, const Look& to, Float part) {
    return Look{mix(from.r, to.r, part), mix(from.g, to.g, part), mix(from.b, to.b, part), mix(from.a, to.a, part)};
  };
  const auto unpacked = [](Int rgba) {
    return Look{toFloat(rgba & 0xff), toFloat((rgba >> 8) & 0xff), toFloat((rgba >> 16) & 0xff),
                toFloat(shiftRightLogical(rgba, 24))};
  };
  const auto row = [&](std::int32_t further) {
    const IntPair both = gather64<4>(field.border + further, offset);
    return mixed(unpacked(both.low), unpacked(both.high), fx);
  };
  const Look look =
      mixed(mixed(row(0), row(field.row), fy), mixed(row(field.slice), row(field.slice + field.row), fy), fz);
  finish = look.a * (1.0f / 255.0f);
  const Float3 root = (1.0f / 255.0f) * Float3{look.r, look.g, look.b};
  return root * root;
}

// ---- guides.glsl

inline Float fract(Float x) { return x - floor(x); }

// mm to the canal's wall and to the planned cut.
struct GuideDistances {
  Float canal, cut;
};

inline GuideDistances guideDistances(const ShadeScene& scene, const Float3& index, Mask mask) {
  const FieldView<std::uint32_t>& field = scene.guides;
  constexpr float kCell = 1.0f / AMBIENT_CELL_VOXELS;
  const Float3 at = kCell * (index + 0.5f) + 0.5f;
  const Mask inside = mask & insideBorder(at, field.size);
  const Int i = toInt(at.x), j = toInt(at.y), k = toInt(at.z);
  const Float fx = at.x - toFloat(i), fy = at.y - toFloat(j), fz = at.z - toFloat(k);
  const Int offset = (k * field.slice + j * field.row + i) & inside;
  const auto row = [&](std::int32_t further) {
    const IntPair both = gather64<4>(field.border + further, offset);
    return GuideDistances{mix(toFloat(both.low & 0xffff), toFloat(both.high & 0xffff), fx),
                          mix(toFloat(shiftRightLogical(both.low, 16)), toFloat(shiftRightLogical(both.high, 16)), fx)};
  };
  const GuideDistances a = row(0), b = row(field.row), c = row(field.slice), d = row(field.slice + field.row);
  const auto distance = [&](Float p, Float q, Float r, Float s) {
    constexpr float kPerUnit = (GUIDE_HIGH_MM - GUIDE_LOW_MM) / 65535.0f;
    return GUIDE_LOW_MM + kPerUnit * select(inside, mix(mix(p, q, fy), mix(r, s, fy), fz), splat(0.0f));
  };
  return {distance(a.canal, b.canal, c.canal, d.canal), distance(a.cut, b.cut, c.cut, d.cut)};
}

inline Float lineAt(Float distance_mm, float half_width_mm) {
  return 1.0f - smoothStep(0.6f * half_width_mm, 1.4f * half_width_mm, absolute(distance_mm));
}

inline Float3 withClearance(const Float3& albedo, Float mm, const Float3& p_P) {
  const Float stripes =
      smoothStep(0.35f, 0.5f, absolute(fract(GUIDE_STRIPES_PER_MM * (p_P.x + p_P.y + p_P.z)) - 0.5f) * 2.0f);
  const Float3 cell{fract(GUIDE_DOTS_PER_MM * p_P.x) - 0.5f, fract(GUIDE_DOTS_PER_MM * p_P.y) - 0.5f,
                    fract(GUIDE_DOTS_PER_MM * p_P.z) - 0.5f};
  const Float dots = 1.0f - smoothStep(0.30f, 0.42f, length(cell));
  const Float3 band =
      select(mm < 1.0f, vec3(GUIDE_NEAR_COLOUR), select(mm < 2.0f, vec3(GUIDE_MIDDLE_COLOUR), vec3(GUIDE_FAR_COLOUR)));
  const Float striped = GUIDE_STRIPE_GAP_COVER + (GUIDE_FULL_COVER - GUIDE_STRIPE_GAP_COVER) * stripes;
  const Float dotted = GUIDE_DOT_GAP_COVER + (GUIDE_DOT_COVER - GUIDE_DOT_GAP_COVER) * dots;
  const Float cover =
      select(mm < 1.0f, splat(GUIDE_FULL_COVER), select(mm < 2.0f, striped, select(mm < 3.0f, dotted, splat(0.0f))));
  const Float ends = maximum(lineAt(mm - 1.0f, GUIDE_BAND_END),
                             maximum(lineAt(mm - 2.0f, GUIDE_BAND_END), lineAt(mm - 3.0f, GUIDE_BAND_END)));
  return select(mm > GUIDE_SHOWN_TO, albedo, mix(mix(albedo, band, cover), 0.25f * band, ends));
}

inline Float3 withPlan(const Float3& albedo, Float mm) {
  const Float3 inside =
      mix(albedo, vec3(GUIDE_PLANNED_COLOUR), GUIDE_PLAN_COVER * (1.0f - smoothStep(-0.05f, 0.05f, mm)));
  return mix(inside, vec3(GUIDE_RIM_COLOUR), GUIDE_PLAN_RIM_COVER * lineAt(mm, GUIDE_PLAN_RIM));
}

inline Float3 planned(const ShadeScene& scene, const Float3& albedo, const Float3& index, Mask mask) {
  return (scene.shown_guides & GUIDE_PLAN) == 0 ? albedo : withPlan(albedo, guideDistances(scene, index, mask).cut);
}

inline Float3 guided(const ShadeScene& scene, const Float3& albedo, const Float3& index, const Float3& p_P, Mask mask) {
  if (scene.shown_guides == 0) return albedo;
  const GuideDistances mm = guideDistances(scene, index, mask);
  Float3 colour = albedo;
  if ((scene.shown_guides & GUIDE_CLEARANCE) != 0) colour = withClearance(colour, mm.canal, p_P);
  if ((scene.shown_guides & GUIDE_PLAN) != 0) colour = withPlan(colour, mm.cut);
  return colour;
}

inline Surface tissueSurface(const ShadeScene& scene, const Float3& index, const Float3& normal, const Float3& p_P,
                             Mask mask) {
  Float finish;
  Float3 albedo = lookAt(scene, index - static_cast<float>(LOOK_DEPTH_VOXELS) * normal, mask, finish);
  const Float enamel = clamp(2.0f * finish - 1.0f, 0.0f, 1.0f), marrow = clamp(1.0f - 2.0f * finish, 0.0f, 1.0f);
  const Float3 shine = mix(mix(FINISH_DULL, FINISH_MARROW, marrow), FINISH_ENAMEL, enamel);

  // Faint mottling, and pores full of blood where the marrow lies open.
  const Float mottle = noise(0.9f * p_P) * 0.6f + noise(3.1f * p_P) * 0.4f - 0.5f;
  albedo = (1.0f + 0.14f * mottle * shine.x) * albedo;
  if (any(mask & (marrow > 0.0f))) {
    const Float pore = smoothStep(0.42f, 0.68f, noise(2.3f * p_P) * 0.7f + noise(5.7f * p_P) * 0.3f);
    albedo = mix(albedo, vec3(0.36f, 0.09f, 0.07f), 0.75f * pore * marrow);
  }
  albedo = guided(scene, albedo, index, p_P, mask);
  return {albedo, vec3(shine.y), shine.x, shine.z, albedo};
}

// Central differences of the smoothed field over two voxels, towards air.
inline Float3 fallAt(const ShadeScene& scene, const Float3& index, Mask mask) {
  const FieldView<std::uint16_t>& field = scene.smooth;
  const Float3 at = index + 1.0f;
  const auto beside = [&](float dx, float dy, float dz) {
    const Float3 moved{clamp(at.x + dx, 0.0f, static_cast<float>(field.size.x + 1)),
                       clamp(at.y + dy, 0.0f, static_cast<float>(field.size.y + 1)),
                       clamp(at.z + dz, 0.0f, static_cast<float>(field.size.z + 1))};
    return trilinear(field, moved, mask);
  };
  return (1.0f / 65535.0f) * Float3{beside(-1, 0, 0) - beside(1, 0, 0), beside(0, -1, 0) - beside(0, 1, 0),
                                    beside(0, 0, -1) - beside(0, 0, 1)};
}

inline Float3 surfaceNormal(const ShadeScene& scene, const Float3& index, Mask mask) {
  const Float3 fall = fallAt(scene, index, mask);
  return inverseSquareRoot(maximum(dot(fall, fall), 1e-12f)) * fall;
}

// ---- ray_through.glsl

// Middle of a ray's way through the volume and its border of air, P.
inline Float3 middleOfWay(const ShadeScene& scene, const RayBatch& rays, const Float3& direction) {
  const Float3 origin = indexOf(scene, splat(rays.origin_P));
  Float near = splat(0.0f), far = splat(1e9f);
  const auto narrow = [&](Float from, Float along, int size) {
    const Float inverse = 1.0f / select(absolute(along) < 1e-9f, splat(1e-9f), along);
    const Float a = (-1.0f - from) * inverse, b = (static_cast<float>(size) - from) * inverse;
    near = maximum(near, minimum(a, b));
    far = minimum(far, maximum(a, b));
  };
  narrow(origin.x, direction.x, scene.voxels.x);
  narrow(origin.y, direction.y, scene.voxels.y);
  narrow(origin.z, direction.z, scene.voxels.z);
  return splat(rays.origin_P) + (0.5f * scene.spacing_mm * (near + far)) * direction;
}

inline Float3 scattered(const ShadeScene& scene, const Float3& index, const Float3& to_lamp, const Float3& lamp_light,
                        Mask mask) {
  const Float3 fall = fallAt(scene, index, mask);
  const Float steep = length(fall);
  const Float3 normal = (1.0f / maximum(steep, 1e-6f)) * fall;
  const Float surface = minimum(steep * (1.0f / DVR_FULL_FALL), 1.0f);
  const Float lambert = mix(splat(DVR_INNER_LAMBERT), maximum(dot(normal, to_lamp), 0.0f), surface);
  const Float sky = 0.5f + 0.5f * surface * dot(normal, splat(scene.eye.up_P));
  Float finish;
  return planned(scene, lookAt(scene, index, mask, finish), index, mask) *
         ((lambert / kPi) * lamp_light + mix(vec3(FLOOR_LIGHT), vec3(SKY_LIGHT), sky));
}

// ---- the kernels

inline Float3 directionsOf(const RayBatch& rays, Int ray, Mask mask) {
  return {gather(rays.x, ray, mask), gather(rays.y, ray, mask), gather(rays.z, ray, mask)};
}

inline void put(const Light& light, int at, const Float3& value) {
  store(light.r + at, value.x);
  store(light.g + at, value.y);
  store(light.b + at, value.z);
}

void aim(const EyeBlock& eye, const float* place_x, const float* place_y, RayBatch& rays) {
  rays.origin_P.x = eye.eye_P.x, rays.origin_P.y = eye.eye_P.y, rays.origin_P.z = eye.eye_P.z;
  const Float3 corner = splat(eye.lower_left_P) - splat(eye.eye_P);
  for (int i = 0; i < rays.count; i += kLanes) {
    const Float3 to_screen =
        corner + load(place_x + i) * splat(eye.right_edge_P) + load(place_y + i) * splat(eye.up_edge_P);
    const Float reach = length(to_screen), inverse = 1.0f / reach;
    store(rays.x + i, inverse * to_screen.x);
    store(rays.y + i, inverse * to_screen.y);
    store(rays.z + i, inverse * to_screen.z);
    store(rays.near_mm + i, static_cast<float>(kNearOfScreen) * reach);
    store(rays.far_mm + i, static_cast<float>(kFarOfScreen) * reach);
  }
}

void background(const EyeBlock& eye, const RayBatch& rays, const float* place_x, const float* place_y, Light light) {
  for (int i = 0; i < rays.count; i += kLanes) {
    const Float height = load(rays.x + i) * eye.up_P.x + load(rays.y + i) * eye.up_P.y + load(rays.z + i) * eye.up_P.z;
    const Float dx = load(place_x + i) - 0.5f, dy = load(place_y + i) - 0.5f;
    const Float facing = 1.0f - smoothStep(0.0f, BACKGROUND_GLOW_REACH, squareRoot(dx * dx + dy * dy));
    const Float3 wall = mix(vec3(BACKGROUND_FLOOR), vec3(BACKGROUND_SKY), smoothStep(-0.5f, 0.5f, height));
    put(light, i, wall + (BACKGROUND_GLOW * facing) * vec3(BACKGROUND_GLOW_TINT));
  }
}

// rimDistance of mesh.frag.
inline Float rimDistance(const ShadeScene& scene, const Float3& p) {
  const Float3 axis = splat(scene.window_axis_P), offset = p - splat(scene.eye.window_eye_P);
  const Float along = dot(offset, axis);
  return maximum(length(offset - along * axis) - scene.eye.window_site_P.w,
                 along - (scene.window_reach_mm - RIM_BEHIND));
}

void meshes(const ShadeScene& scene, const RayBatch& rays, const MeshPoints& points, Light light) {
  const EyeBlock& eye = scene.eye;
  for (int i = 0; i < points.count; i += kLanes) {
    const Mask mask = firstLanes(points.count - i);
    const Float3 direction = directionsOf(rays, load(points.ray + i), mask);
    const Float3 p_P = splat(rays.origin_P) + load(points.distance_mm + i) * direction;
    const Float3 base{load(points.r + i), load(points.g + i), load(points.b + i)};
    const Float metallic = load(points.metallic + i);
    const Int finish = load(points.finish + i);
    const Mask outside = load(points.faces_eye + i) != 0;
    Float3 normal = normalised({load(points.nx + i), load(points.ny + i), load(points.nz + i)});
    normal = select(outside, normal, -normal);

    Surface s;
    s.roughness = clamp(load(points.roughness + i), ROUGHNESS_LEAST, 1.0f);
    s.albedo = (1.0f - metallic) * base;
    s.scatter = s.albedo;
    const Mask skin = finish == FINISH_SKIN, gum = finish == FINISH_GUM, steel = finish == FINISH_INSTRUMENT;
    const Float f0 = select(skin, splat(SKIN_F0), splat(MESH_F0));
    s.f0 = select(gum, vec3(GUM_F0, GUM_F0, GUM_F0), mix(vec3(f0), base, metallic));
    s.wrap = select(skin, splat(SKIN_WRAP), select(gum, splat(GUM_WRAP), splat(0.0f)));
    if (any(mask & skin)) {
      const Float brightest = maximum(maximum(s.albedo.x, s.albedo.y), maximum(s.albedo.z, 1e-3f));
      const Float3 hue = (1.0f / brightest) * s.albedo;
      s.scatter = select(skin, hue * hue, s.scatter);
      const Mask cut = mask & skin & (load(points.is_cut + i) != 0);
      if (eye.window_site_P.w > 0.0f && any(cut)) {
        const Float rim = select(cut, smoothStep(0.0f, RIM_WIDTH, rimDistance(scene, p_P)), 1.0f);
        s.albedo = mix(s.albedo * vec3(RIM_TINT), s.albedo, rim);
      }
    }
    s.scatter = select(gum, vec3(GUM_SCATTER), s.scatter);

    Shade shade = shadeFromVolume(scene, p_P + MESH_LIFT * normal, normal, mask);
    const auto atLeast = [&](float least, Float value) { return select(steel, least + (1.0f - least) * value, value); };
    shade.ambient = atLeast(STEEL_AMBIENT_LEAST, shade.ambient) * select(outside, splat(1.0f), splat(INSIDE_AMBIENT));
    shade.lamp = atLeast(STEEL_LAMP_LEAST, shade.lamp) * select(outside, splat(1.0f), splat(INSIDE_LAMP));
    const Float3 shown = lit(scene, s, p_P, normal, -direction, shade);
    // A guide is lit from everywhere: it is no part of the patient and shows inside the bone.
    const Float facing = absolute(dot(normal, direction));
    put(light, i, select(finish == FINISH_GUIDE, (GUIDE_DARKEST + (1.0f - GUIDE_DARKEST) * facing) * base, shown));
  }
}

void surface(const ShadeScene& scene, const RayBatch& rays, const std::int32_t* ray, const float* length_voxels,
             int count, Light light) {
  const Float3 eye_index = indexOf(scene, splat(rays.origin_P));
  for (int i = 0; i < count; i += kLanes) {
    const Mask mask = firstLanes(count - i);
    const Float3 direction = directionsOf(rays, load(ray + i) & mask, mask);
    const Float t = select(mask, load(length_voxels + i), 0.0f);
    const Float3 index = eye_index + t * direction;
    const Float3 p_P = splat(rays.origin_P) + (t * scene.spacing_mm) * direction;
    const Float3 normal = surfaceNormal(scene, index, mask);
    const Surface s = tissueSurface(scene, index, normal, p_P, mask);
    put(light, i, lit(scene, s, p_P, normal, -direction, shadeFromVolume(scene, p_P, normal, mask)));
  }
}

void matter(const ShadeScene& scene, const RayBatch& rays, const std::int32_t* ray, const float* length_voxels,
            int count, Light light) {
  const Float3 eye_index = indexOf(scene, splat(rays.origin_P));
  for (int i = 0; i < count; i += kLanes) {
    const Mask mask = firstLanes(count - i);
    const Float3 direction = directionsOf(rays, load(ray + i) & mask, mask);
    const Float t = select(mask, load(length_voxels + i), 0.0f);
    const Float3 lamp_offset = splat(scene.eye.lamp_P) - middleOfWay(scene, rays, direction);
    const Float lamp_distance = length(lamp_offset);
    const Float3 to_lamp = (1.0f / lamp_distance) * lamp_offset;
    put(light, i,
        scattered(scene, eye_index + t * direction, to_lamp, lampRadiance(scene.eye, to_lamp, lamp_distance), mask));
  }
}

// ---- output.frag

inline Float shouldered(Float x) {
  const Float over = maximum(x - SHOULDER_KNEE, 0.0f) * (1.0f / (1.0f - SHOULDER_KNEE));
  return minimum(x, SHOULDER_KNEE) + (1.0f - SHOULDER_KNEE) * (over / (1.0f + over));
}

void shoulder(Light light, int count) {
  for (float* channel : {light.r, light.g, light.b})
    for (int i = 0; i < count; i += kLanes) store(channel + i, shouldered(load(channel + i)));
}

// sRGB, 0..255 before rounding: straight lines over eighths of octaves.
inline Int encoded(Float light) {
  const Float x = clamp(light, 0.0f, 1.0f);
  const Int bits = minimum(maximum(bitsOf(x) - kSrgbFirstBits, splat(0)), splat(kSrgbLastBits));
  const Int piece = bits >> kSrgbPieceShift;
  const Float part = toFloat(bits & ((1 << kSrgbPieceShift) - 1)) * (1.0f / (1 << kSrgbPieceShift));
  const Float low = gather(kSrgbTable.low, piece, everyLane());
  const Float rise = gather(kSrgbTable.rise, piece, everyLane());
  const Float value = select(x < kSrgbLinearEnd, x * (12.92f * 255.0f), multiplyAdd(rise, part, low));
  return toInt(value + 0.5f);
}

void encode(const float* r, const float* g, const float* b, int count, std::uint32_t* rgba) {
  for (int i = 0; i < count; i += kLanes) {
    const Int packed = encoded(load(r + i)) | encoded(load(g + i)) << 8 | encoded(load(b + i)) << 16 |
                       splat(static_cast<int>(0xff000000u));
    if (i + kLanes <= count) {
      store(reinterpret_cast<std::int32_t*>(rgba + i), packed);
    } else {
      for (int n = 0; i + n < count; ++n) rgba[i + n] = static_cast<std::uint32_t>(packed[n]);
    }
  }
}

constexpr ShadeKernels kShadeKernels{aim, background, meshes, surface, matter, shoulder, encode};

}  // namespace
}  // namespace render::cpu
