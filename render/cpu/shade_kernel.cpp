// The kernels of shade_kernels.h, compiled once for each instruction set. The shaders' formulas are in light_body.h,
// occlusion_body.h, tissue_body.h and tool_body.h. Everything but the table has internal linkage.
#include <cmath>

#include "render/cpu/soft_body.h"
#include "render/cpu/srgb_pieces.h"
#include "render/cpu/tissue_body.h"
#include "render/cpu/tool_body.h"
#include "render/display/eye_projection.h"

namespace render::cpu {
namespace {

// ---- ray_translucent.glsl

// Centre of a ray's span through the volume and its border of air, P.
inline Float3 spanCentre(const ShadeScene& scene, const RayBatch& rays, const Float3& direction) {
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
  const Float3 gradient = outwardGradientAt(scene, index, mask);
  const Float steep = length(gradient);
  const Float3 normal = (1.0f / maximum(steep, 1e-6f)) * gradient;
  const Float surface = minimum(steep * (1.0f / DVR_FULL_GRADIENT), 1.0f);
  const Float3 p_P = splat(scene.origin_P) + scene.spacing_mm * index;
  const Float lambert =
      lampPastTool(scene, p_P, to_lamp) * mix(splat(DVR_INNER_LAMBERT), maximum(dot(normal, to_lamp), 0.0f), surface);
  const Float sky = 0.5f + 0.5f * surface * dot(normal, splat(scene.eye.up_P));
  Float finish;
  const Float3 light = planned(scene, appearanceAt(scene, index, mask, finish), index, mask) *
                       ((lambert / kPi) * lamp_light + mix(vec3(FLOOR_LIGHT), vec3(SKY_LIGHT), sky));
  return underRing(scene, light, p_P);
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

void aim(const EyeBlock& eye, const float* uv_x, const float* uv_y, RayBatch& rays) {
  rays.origin_P.x = eye.eye_P.x, rays.origin_P.y = eye.eye_P.y, rays.origin_P.z = eye.eye_P.z;
  const Float3 corner = splat(eye.lower_left_P) - splat(eye.eye_P), out = splat(eye.begin_P);
  for (int i = 0; i < rays.count; i += kLanes) {
    const Float3 to_screen = corner + load(uv_x + i) * splat(eye.right_edge_P) + load(uv_y + i) * splat(eye.up_edge_P);
    const Float reach = length(to_screen), inverse = 1.0f / reach;
    const Float3 direction = inverse * to_screen;
    store(rays.x + i, direction.x);
    store(rays.y + i, direction.y);
    store(rays.z + i, direction.z);
    // rayBegin of eye_block.glsl.
    const Float begin = eye.begin_P.w == 0.0f ? splat(0.0f) : eye.begin_P.w / maximum(dot(direction, out), 1e-6f);
    store(rays.begin_mm + i, begin);
    store(rays.near_mm + i, maximum(static_cast<float>(kNearOfScreen) * reach, begin));
    store(rays.far_mm + i, static_cast<float>(kFarOfScreen) * reach);
  }
}

void background(const EyeBlock& eye, const RayBatch& rays, const float* uv_x, const float* uv_y, Light light) {
  for (int i = 0; i < rays.count; i += kLanes) {
    const Float height = load(rays.x + i) * eye.up_P.x + load(rays.y + i) * eye.up_P.y + load(rays.z + i) * eye.up_P.z;
    const Float dx = load(uv_x + i) - 0.5f, dy = load(uv_y + i) - 0.5f;
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

inline Surface select(Mask mask, const Surface& a, const Surface& b) {
  return {select(mask, a.albedo, b.albedo), select(mask, a.f0, b.f0), select(mask, a.roughness, b.roughness),
          select(mask, a.wrap, b.wrap), select(mask, a.scatter, b.scatter)};
}

// piece.frag.
inline Surface pieceSurface(const ShadeScene& scene, const MeshPoints& points, int i, Mask outside, const Float3& p_P,
                            const Float3& normal, Float open, Mask mask) {
  const Float3 p_Q{load(points.qx + i), load(points.qy + i), load(points.qz + i)};
  const Float3 normal_Q = normalised({load(points.mx + i), load(points.my + i), load(points.mz + i)});
  Float enamel;
  return tissueAt(scene, indexOf(scene, p_Q), select(outside, normal_Q, -normal_Q), p_Q, p_P, normal, open, mask,
                  enamel);
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
    s.roughness = clamp(load(points.roughness + i), MIN_ROUGHNESS, 1.0f);
    s.albedo = (1.0f - metallic) * base;
    s.scatter = s.albedo;
    const Mask skin = finish == FINISH_SKIN, gingiva = finish == FINISH_GINGIVA,
               steel = (finish == FINISH_INSTRUMENT) | (finish == FINISH_GLASS);
    const Float f0 = select(skin, splat(SKIN_F0), splat(MESH_F0));
    s.f0 = select(gingiva, vec3(GINGIVA_F0, GINGIVA_F0, GINGIVA_F0), mix(vec3(f0), base, metallic));
    s.wrap = select(skin, splat(SKIN_WRAP), select(gingiva, splat(GINGIVA_WRAP), splat(0.0f)));
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
    s.scatter = select(gingiva, vec3(GINGIVA_SCATTER), s.scatter);
    const Mask tooth = finish == FINISH_TOOTH;
    if (any(mask & tooth)) {
      const Float3 enamel = FINISH_ENAMEL;
      s.roughness = select(tooth, enamel.x, s.roughness);
      s.f0 = select(tooth, vec3(enamel.y), s.f0);
      s.wrap = select(tooth, enamel.z, s.wrap);
    }

    const Mask soft = mask & (gingiva | (skin & (load(points.is_cut + i) != 0)));
    if ((scene.soft.counts.x > 0 || scene.soft.counts.y > 0) && any(soft)) {
      const Surface mark = marked(scene.soft, s, p_P, soft);
      s.albedo = select(soft, mark.albedo, s.albedo);
      s.roughness = select(soft, mark.roughness, s.roughness);
    }

    // A piece of tooth is shaded as surface() shades it at its first place.
    const Mask piece = mask & (finish == FINISH_PIECE);
    const Float lift = select(piece, splat(0.0f), splat(MESH_LIFT));
    Visibility visibility = visibilityFromVolume(scene, p_P + lift * normal, normal, mask);
    if (any(piece)) {
      s = select(piece, pieceSurface(scene, points, i, outside, p_P, normal, visibility.ambient, piece), s);
      const Visibility hollow = litHollow(scene.eye, visibility);
      visibility.ambient = select(piece, hollow.ambient, visibility.ambient);
      visibility.lamp = select(piece, hollow.lamp, visibility.lamp);
    }
    const auto at_least = [&](float least, Float value) {
      return select(steel, least + (1.0f - least) * value, value);
    };
    const Visibility shaded = besideTool(scene, visibility, p_P, normal);
    visibility.ambient = select(steel, visibility.ambient, shaded.ambient);
    visibility.lamp = select(steel, visibility.lamp, shaded.lamp);
    visibility.ambient =
        at_least(STEEL_MIN_AMBIENT, visibility.ambient) * select(outside, splat(1.0f), splat(INSIDE_AMBIENT));
    visibility.lamp = at_least(STEEL_MIN_LAMP, visibility.lamp) * select(outside, splat(1.0f), splat(INSIDE_LAMP));
    Float3 shown = lit(scene, s, p_P, normal, -direction, visibility);
    if (any(piece)) shown = select(piece, throughSpray(scene.eye, shown, p_P), shown);
    shown = select(gingiva | piece, underRing(scene, shown, p_P), shown);
    // Guides are unlit: they are not part of the patient and are visible inside the bone.
    const Float facing = absolute(dot(normal, direction));
    const Mask unlit = (finish == FINISH_GUIDE) | (finish == FINISH_OBSTACLE);
    put(light, i, select(unlit, (GUIDE_DARKEST + (1.0f - GUIDE_DARKEST) * facing) * base, shown));
  }
}

/// Calls shade(direction, t, mask) for kLanes points at a time and stores the light that it returns.
template <class Shade>
inline void shadePoints(const RayBatch& rays, const std::int32_t* ray, const float* length_voxels, int count,
                        Light light, Shade shade) {
  for (int i = 0; i < count; i += kLanes) {
    const Mask mask = firstLanes(count - i);
    const Float3 direction = directionsOf(rays, load(ray + i) & mask, mask);
    put(light, i, shade(direction, select(mask, load(length_voxels + i), 0.0f), mask));
  }
}

void surface(const ShadeScene& scene, const RayBatch& rays, const std::int32_t* ray, const float* length_voxels,
             int count, Light light) {
  const Float3 eye_index = indexOf(scene, splat(rays.origin_P));
  shadePoints(rays, ray, length_voxels, count, light, [&](const Float3& direction, Float t, Mask mask) {
    const Float3 index = eye_index + t * direction;
    const Float3 p_P = splat(rays.origin_P) + (t * scene.spacing_mm) * direction;
    const Float3 normal = surfaceNormal(scene, index, mask);
    const Visibility open = visibilityFromVolume(scene, p_P, normal, mask);
    const Surface s = tissueSurface(scene, index, normal, p_P, open.ambient, mask);
    const Visibility visibility = besideTool(scene, litHollow(scene.eye, open), p_P, normal);
    const Float3 shown = throughSpray(scene.eye, lit(scene, s, p_P, normal, -direction, visibility), p_P);
    return underRing(scene, shown, p_P);
  });
}

void matter(const ShadeScene& scene, const RayBatch& rays, const std::int32_t* ray, const float* length_voxels,
            int count, Light light) {
  const Float3 eye_index = indexOf(scene, splat(rays.origin_P));
  shadePoints(rays, ray, length_voxels, count, light, [&](const Float3& direction, Float t, Mask mask) {
    const Float3 lamp_offset = splat(scene.eye.lamp_P) - spanCentre(scene, rays, direction);
    const Float lamp_distance = length(lamp_offset);
    const Float3 to_lamp = (1.0f / lamp_distance) * lamp_offset;
    return scattered(scene, eye_index + t * direction, to_lamp, lampRadiance(scene.eye, to_lamp, lamp_distance), mask);
  });
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

}  // namespace
}  // namespace render::cpu

namespace render::KERNEL_SET {

extern const ShadeKernels kShadeKernels;
const ShadeKernels kShadeKernels{cpu::aim,    cpu::background, cpu::meshes, cpu::surface,
                                 cpu::matter, cpu::shoulder,   cpu::encode};

}  // namespace render::KERNEL_SET
