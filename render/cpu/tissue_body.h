// tissue_appearance.glsl, guides.glsl, paint.glsl and the normals of ray_march.glsl in lanes. Included only by the
// kernels (shade_kernel.cpp); internal linkage.
#pragma once

#include "render/cpu/field_body.h"
#include "render/cpu/occlusion_body.h"

namespace render::cpu {
namespace {

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

struct Appearance {
  Float3 root;
  Float finish;
};
inline Appearance mix(const Appearance& from, const Appearance& to, Float part) {
  return {mix(from.root, to.root, part), mix(from.finish, to.finish, part)};
}

// Colour and finish, trilinear in the stored roots.
inline Float3 appearanceAt(const ShadeScene& scene, const Float3& index, Mask mask, Float& finish) {
  const FieldView<std::uint32_t>& field = scene.appearance;
  const Float3 at{clamp(index.x, 0.0f, static_cast<float>(field.size.x - 1)) + 1.0f,
                  clamp(index.y, 0.0f, static_cast<float>(field.size.y - 1)) + 1.0f,
                  clamp(index.z, 0.0f, static_cast<float>(field.size.z - 1)) + 1.0f};
  const auto unpacked = [](Int rgba) {
    return Appearance{{toFloat(rgba & 0xff), toFloat((rgba >> 8) & 0xff), toFloat((rgba >> 16) & 0xff)},
                      toFloat(shiftRightLogical(rgba, 24))};
  };
  const Appearance appearance = mixedAround(field, at, mask, [&](const std::uint32_t* from, Int offset, Float part) {
    const IntPair both = gather64<4>(from, offset);
    return mix(unpacked(both.low), unpacked(both.high), part);
  });
  finish = appearance.finish * (1.0f / 255.0f);
  const Float3 root = (1.0f / 255.0f) * appearance.root;
  return root * root;
}

inline Float fract(Float x) { return x - floor(x); }

// mm to the canal wall and to the planned cut.
struct GuideDistances {
  Float mandibular_canal, cut;
};
inline GuideDistances mix(const GuideDistances& from, const GuideDistances& to, Float part) {
  return {mix(from.mandibular_canal, to.mandibular_canal, part), mix(from.cut, to.cut, part)};
}

inline GuideDistances guideDistances(const ShadeScene& scene, const Float3& index, Mask mask) {
  constexpr float kCell = 1.0f / AMBIENT_CELL_VOXELS;
  const Float3 at = kCell * (index + 0.5f) + 0.5f;
  const Mask inside = mask & insideBorder(at, scene.guides.size);
  const auto unpacked = [](Int halves) {
    return GuideDistances{toFloat(halves & 0xffff), toFloat(shiftRightLogical(halves, 16))};
  };
  const GuideDistances share =
      mixedAround(scene.guides, at, inside, [&](const glm::u16vec2* from, Int offset, Float part) {
        const IntPair both = gather64<4>(from, offset);
        return mix(unpacked(both.low), unpacked(both.high), part);
      });
  const auto distance = [&](Float value) {
    constexpr float kPerUnit = (GUIDE_HIGH_MM - GUIDE_LOW_MM) / 65535.0f;
    return GUIDE_LOW_MM + kPerUnit * select(inside, value, splat(0.0f));
  };
  return {distance(share.mandibular_canal), distance(share.cut)};
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
  return (scene.visible_guides & GUIDE_PLAN) == 0 ? albedo : withPlan(albedo, guideDistances(scene, index, mask).cut);
}

inline Float3 guided(const ShadeScene& scene, const Float3& albedo, const Float3& index, const Float3& p_P,
                     const Float& enamel, Mask mask) {
  if (scene.visible_guides == 0) return albedo;
  const GuideDistances mm = guideDistances(scene, index, mask);
  Float3 colour = albedo;
  if ((scene.visible_guides & GUIDE_CLEARANCE) != 0) colour = withClearance(colour, mm.mandibular_canal, p_P);
  if ((scene.visible_guides & GUIDE_PLAN) != 0) colour = mix(withPlan(colour, mm.cut), colour, enamel);
  return colour;
}

// paint.glsl
inline Float3 painted(const ShadeScene& scene, const Float3& albedo, const Float3& index, Mask mask) {
  if (scene.paint.size.x == 0) return albedo;
  const Float3 at = index - splat(glm::vec3(scene.paint_low - 1));
  const Mask inside = mask & insideBorder(at, scene.paint.size);
  if (none(inside)) return albedo;
  const auto unpacked = [](Int rgba) {
    return Appearance{{toFloat(rgba & 0xff), toFloat((rgba >> 8) & 0xff), toFloat((rgba >> 16) & 0xff)},
                      toFloat(shiftRightLogical(rgba, 24))};
  };
  const Appearance paint = mixedAround(scene.paint, at, inside, [&](const std::uint32_t* from, Int offset, Float part) {
    const IntPair both = gather64<4>(from, offset);
    return mix(unpacked(both.low), unpacked(both.high), part);
  });
  const Float3 colour = (1.0f / 255.0f) * paint.root;
  return select(inside, (1.0f - (1.0f / 255.0f) * paint.finish) * albedo + colour, albedo);
}

inline Surface tissueAt(const ShadeScene& scene, const Float3& index, const Float3& outward, const Float3& grain,
                        const Float3& p_P, const Float3& normal, Float open, Mask mask, Float& enamel) {
  Float finish;
  Float3 albedo = appearanceAt(scene, index - static_cast<float>(COLOUR_DEPTH_VOXELS) * outward, mask, finish);
  enamel = clamp(2.0f * finish - 1.0f, 0.0f, 1.0f);
  const Float marrow = clamp(1.0f - 2.0f * finish, 0.0f, 1.0f);
  const Float3 shine = mix(mix(FINISH_DULL, FINISH_MARROW, marrow), FINISH_ENAMEL, enamel);

  // Faint mottling, and blood-filled pores in open marrow.
  const Float mottle = noise(0.9f * grain) * 0.6f + noise(3.1f * grain) * 0.4f - 0.5f;
  albedo = (1.0f + 0.14f * mottle * shine.x) * albedo;
  if (any(mask & (marrow > 0.0f))) {
    const Float pore = smoothStep(0.42f, 0.68f, noise(2.3f * grain) * 0.7f + noise(5.7f * grain) * 0.3f);
    albedo = mix(albedo, vec3(0.36f, 0.09f, 0.07f), 0.75f * pore * marrow);
  }
  return covered(scene.eye, {albedo, vec3(shine.y), shine.x, shine.z, albedo}, p_P, normal, marrow, mottle, open);
}

inline Surface tissueSurface(const ShadeScene& scene, const Float3& index, const Float3& normal, const Float3& p_P,
                             Float open, Mask mask) {
  Float enamel;
  Surface surface = tissueAt(scene, index, normal, p_P, p_P, normal, open, mask, enamel);
  surface.albedo = guided(scene, painted(scene, surface.albedo, index, mask), index, p_P, enamel, mask);
  surface.scatter = surface.albedo;
  return surface;
}

// Negative gradient of the smoothed field over two voxels, by central differences.
inline Float3 outwardGradientAt(const ShadeScene& scene, const Float3& index, Mask mask) {
  const FieldView<std::uint16_t>& field = scene.smooth;
  const Float3 at = index + 1.0f;
  const auto neighbour = [&](float dx, float dy, float dz) {
    const Float3 moved{clamp(at.x + dx, 0.0f, static_cast<float>(field.size.x + 1)),
                       clamp(at.y + dy, 0.0f, static_cast<float>(field.size.y + 1)),
                       clamp(at.z + dz, 0.0f, static_cast<float>(field.size.z + 1))};
    return trilinear(field, moved, mask);
  };
  return (1.0f / 65535.0f) * Float3{neighbour(-1, 0, 0) - neighbour(1, 0, 0), neighbour(0, -1, 0) - neighbour(0, 1, 0),
                                    neighbour(0, 0, -1) - neighbour(0, 0, 1)};
}

inline Float3 surfaceNormal(const ShadeScene& scene, const Float3& index, Mask mask) {
  const Float3 gradient = outwardGradientAt(scene, index, mask);
  return inverseSquareRoot(maximum(dot(gradient, gradient), 1e-12f)) * gradient;
}

}  // namespace
}  // namespace render::cpu
