// occlusion.glsl in lanes. Included only by the kernels (shade_kernel.cpp); internal linkage.
#pragma once

#include "render/cpu/light_body.h"
#include "render/shaders/shared_constants.glsl"

namespace render::cpu {
namespace {

inline Float3 indexOf(const ShadeScene& scene, const Float3& p_P) {
  return (1.0f / scene.spacing_mm) * (p_P - splat(scene.origin_P));
}

// Trilinear interpolation at `at`, 0 at the first border value; `pair` interpolates two neighbours along i.
template <class T, class Pair>
inline auto mixedAround(const FieldView<T>& field, const Float3& at, Mask mask, Pair pair) {
  const Int i = toInt(at.x), j = toInt(at.y), k = toInt(at.z);
  const Float fx = at.x - toFloat(i), fy = at.y - toFloat(j), fz = at.z - toFloat(k);
  const Int offset = (k * field.slice + j * field.row + i) & mask;
  const auto row = [&](std::int32_t further) { return pair(field.border + further, offset, fx); };
  return mix(mix(row(0), row(field.row), fy), mix(row(field.slice), row(field.slice + field.row), fy), fz);
}

inline Float trilinear(const FieldView<std::uint16_t>& field, const Float3& at, Mask mask) {
  return mixedAround(field, at, mask, [](const std::uint16_t* from, Int offset, Float part) {
    const Int both = gather32<2>(from, offset);
    return mix(toFloat(both & 0xffff), toFloat(shiftRightLogical(both, 16)), part);
  });
}

// Whether a position, counted from the first border value, is inside the field and its border.
inline Mask insideBorder(const Float3& at, glm::ivec3 size) {
  return (at.x > 0.0f) & (at.y > 0.0f) & (at.z > 0.0f) & (at.x < static_cast<float>(size.x + 1)) &
         (at.y < static_cast<float>(size.y + 1)) & (at.z < static_cast<float>(size.z + 1));
}

inline Float densityAt(const ShadeScene& scene, const Float3& index, Mask mask) {
  constexpr float kCell = 1.0f / AMBIENT_CELL_VOXELS;
  const Float3 at = kCell * (index + 0.5f) + 0.5f;
  const Mask inside = mask & insideBorder(at, scene.ambient.size);
  if (none(inside)) return splat(0.0f);
  return select(inside, trilinear(scene.ambient, at, inside) * (1.0f / 65535.0f), 0.0f);
}

inline Float coneOpenness(const ShadeScene& scene, const Float3& index, const Float3& direction, float first,
                          Mask mask) {
  const Float close = densityAt(scene, index + first * direction, mask);
  const Float middle = densityAt(scene, index + (CONE_SECOND * first) * direction, mask);
  const Float far = densityAt(scene, index + (CONE_THIRD * first) * direction, mask);
  return (1.0f - close) * (1.0f - CONE_SECOND_SHADE * middle) * (1.0f - CONE_THIRD_SHADE * far);
}

// Voxels along any axis from a position to the nearest brick with matter.
inline Float freeVoxels(const ShadeScene& scene, const Float3& index, Mask mask) {
  const glm::ivec3& size = scene.matter_distance.size;
  constexpr float kBrick = 1.0f / BRICK_VOXELS;
  const Int i = clamp(toInt(kBrick * index.x), 0, size.x - 1), j = clamp(toInt(kBrick * index.y), 0, size.y - 1);
  const Int k = clamp(toInt(kBrick * index.z), 0, size.z - 1);
  const Int bricks =
      gather(scene.matter_distance.border, k * scene.matter_distance.slice + j * scene.matter_distance.row + i, mask);
  return static_cast<float>(BRICK_VOXELS) * toFloat(bricks - 1);
}

inline Visibility visibilityFromVolume(const ShadeScene& scene, const Float3& p_P, const Float3& normal, Mask mask) {
  Visibility visibility{splat(1.0f), splat(1.0f)};
  if (scene.ambient.border == nullptr) return visibility;
  const Float3 index = indexOf(scene, p_P);
  const float first = std::fmax(CONE_FIRST_CELLS * AMBIENT_CELL_VOXELS, CONE_FIRST_MM / scene.spacing_mm);
  const Float free = freeVoxels(scene, index, mask);

  // Five cones, where matter is within their length.
  const Mask near = mask & (free < CONE_THIRD * first);
  if (scene.ambient_occlusion && any(near)) {
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
    visibility.ambient = select(near, open * squareRoot(open), 1.0f);
  }

  // Towards the lamp, with growing steps.
  if (scene.lamp_shadow) {
    const Float3 to_lamp = normalised(splat(scene.eye.lamp_P) - p_P);
    const Float3 lifted = index + (LAMP_LIFT * first) * normal;
    Float through = splat(1.0f);
    float t = first;
    for (int i = 0; i < LAMP_SAMPLES; ++i, t *= LAMP_STEP_GROWTH) {
      const Mask near_matter = mask & (free < t + LAMP_LIFT * first) & (through > 0.0f);
      if (none(near_matter)) continue;
      through *= 1.0f - smoothStep(LAMP_CLEAR, LAMP_BLOCKED, densityAt(scene, lifted + t * to_lamp, near_matter));
    }
    visibility.lamp = LAMP_MIN + (1.0f - LAMP_MIN) * through;
  }
  return visibility;
}

}  // namespace
}  // namespace render::cpu
