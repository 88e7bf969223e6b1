// Shading of hits, many at once, in lanes: twin of the shaders lighting, occlusion, tissue_appearance, guides,
// ray_translucent, mesh_colour, background and output, with the same constants. Compiled once per instruction set.
// Frame P, mm; linear light. Any thread; no allocation. Cost: about 0.1 us a point with ambient occlusion, 5 ns
// without.
#pragma once

#include <cstdint>

#include "assets/instruction_set.h"
#include "render/cpu/mesh_points.h"
#include "render/eye_block.h"
#include "render/soft_block.h"
#include "render/tool_block.h"

namespace render {

/// A field of the volume: its first border value, voxel (-1,-1,-1), and strides in values.
template <class T>
struct FieldView {
  const T* border = nullptr;
  std::int32_t row = 0, slice = 0;
  glm::ivec3 size{0};  ///< without the border
};

/// Inputs of shading that are the same for all points. The fields are borrowed.
struct ShadeScene {
  EyeBlock eye;
  ToolBlock tool;
  SoftBlock soft;
  glm::vec3 right_axis_P{1.0f, 0.0f, 0.0f};   ///< unit, along the image's rows
  glm::vec3 window_axis_P{0.0f, 0.0f, 1.0f};  ///< unit, axis of the face window
  float window_reach_mm = 0.0f;               ///< from the eyes to the site
  glm::vec3 origin_P{0.0f};                   ///< of voxel (0,0,0)
  float spacing_mm = 1.0f;
  glm::ivec3 voxels{0};
  FieldView<std::uint16_t> smooth, ambient;
  FieldView<std::uint32_t> appearance;
  FieldView<std::uint8_t> matter_distance;  ///< per brick, without border: bricks to the next one with matter
  FieldView<glm::u16vec2> guides;           ///< guide_field.h on the cells of the ambient map
  int visible_guides = 0;                   ///< GUIDE_CLEARANCE, GUIDE_PLAN
  FieldView<std::uint32_t> paint;           ///< surface_paint.h; no size: none
  glm::ivec3 paint_low{0};                  ///< voxel of its first texel
  bool ambient_occlusion = true, lamp_shadow = true;
};

/// Structure of arrays; as long as the count, rounded up to kLanePadding.
struct Light {
  float *r = nullptr, *g = nullptr, *b = nullptr;
};

struct ShadeKernels {
  /// Unit directions through image points, 0..1 from the lower left, and distances of near and far plane along them.
  void (*aim)(const EyeBlock& eye, const float* uv_x, const float* uv_y, RayBatch& rays);
  void (*background)(const EyeBlock& eye, const RayBatch& rays, const float* uv_x, const float* uv_y, Light light);
  void (*meshes)(const ShadeScene& scene, const RayBatch& rays, const MeshPoints& points, Light light);
  /// Tooth and bone: `count` indices of rays, and the length to the surface along each, in voxels.
  void (*surface)(const ShadeScene& scene, const RayBatch& rays, const std::int32_t* ray, const float* length_voxels,
                  int count, Light light);
  /// Points in translucent matter, likewise: the light scattered towards the eye, before opacity.
  void (*matter)(const ShadeScene& scene, const RayBatch& rays, const std::int32_t* ray, const float* length_voxels,
                 int count, Light light);
  /// Tone mapping, in place.
  void (*shoulder)(Light light, int count);
  /// Linear light, clamped to 0..1, to sRGB bytes with alpha 255, red lowest; error at most 0.56/255, of which 0.5 is
  /// rounding.
  void (*encode)(const float* r, const float* g, const float* b, int count, std::uint32_t* rgba);
};

/// The instruction set must be available.
const ShadeKernels& shadeKernels(assets::InstructionSet set);
const ShadeKernels& shadeKernels();

}  // namespace render
