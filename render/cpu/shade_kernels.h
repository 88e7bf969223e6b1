// Light on what rays meet, many places at once: the twin, formula by formula, of the shaders lighting.glsl,
// occlusion.glsl, tissue_appearance.glsl, ray_translucent.glsl, mesh.frag, background.frag and output.frag, whose
// numbers it shares (light_constants.glsl, finish.glsl). Compiled once for each instruction set. Frame P, mm; linear
// light. Any thread; no allocation. Cost: about 0.1 us a place with soft shade, 5 ns without.
#pragma once

#include <cstdint>

#include "assets/instruction_set.h"
#include "render/cpu/mesh_points.h"
#include "render/eye_block.h"

namespace render {

/// A field of the volume as the kernels read it: voxel (-1,-1,-1), the first of the border, and strides in values.
template <class T>
struct FieldView {
  const T* border = nullptr;
  std::int32_t row = 0, slice = 0;
  glm::ivec3 size{0};  ///< without the border
};

/// What light depends on besides the place itself. The fields are borrowed.
struct ShadeScene {
  EyeBlock eye;
  glm::vec3 right_axis_P{1.0f, 0.0f, 0.0f};   ///< unit, along the image's rows
  glm::vec3 window_axis_P{0.0f, 0.0f, 1.0f};  ///< unit, down the window in the face …
  float window_reach_mm = 0.0f;               ///< … from the eyes to the site
  glm::vec3 origin_P{0.0f};                   ///< of voxel (0,0,0)
  float spacing_mm = 1.0f;
  glm::ivec3 voxels{0};
  FieldView<std::uint16_t> smooth, ambient;
  FieldView<std::uint32_t> appearance;
  FieldView<std::uint8_t> matter_distance;  ///< per brick, without border: bricks to the next with anything in it
  FieldView<glm::u16vec2> guides;           ///< guide_field.h on the cells of the ambient map
  int visible_guides = 0;                   ///< GUIDE_CLEARANCE, GUIDE_PLAN
  bool ambient_occlusion = true, lamp_shadow = true;
};

/// Structure of arrays; as long as the count, rounded up to kLanePadding.
struct Light {
  float *r = nullptr, *g = nullptr, *b = nullptr;
};

struct ShadeKernels {
  /// Unit directions through places of the image, 0..1 from its lower left, and where near and far plane lie along
  /// them. rays.count of them.
  void (*aim)(const EyeBlock& eye, const float* uv_x, const float* uv_y, RayBatch& rays);
  void (*background)(const EyeBlock& eye, const RayBatch& rays, const float* uv_x, const float* uv_y, Light light);
  void (*meshes)(const ShadeScene& scene, const RayBatch& rays, const MeshPoints& points, Light light);
  /// Tooth and bone: `count` rays of the batch by number, and how far along each the surface is, in voxels.
  void (*surface)(const ShadeScene& scene, const RayBatch& rays, const std::int32_t* ray, const float* length_voxels,
                  int count, Light light);
  /// Places within translucent matter, the same way: what each scatters towards the eye, before its opacity.
  void (*matter)(const ShadeScene& scene, const RayBatch& rays, const std::int32_t* ray, const float* length_voxels,
                 int count, Light light);
  /// In place: bright values roll off towards white.
  void (*shoulder)(Light light, int count);
  /// Linear light, within 0..1 after clamping, to sRGB bytes with alpha 255, red lowest; at most 0.56/255 from the
  /// exact value, of which 0.5 is rounding.
  void (*encode)(const float* r, const float* g, const float* b, int count, std::uint32_t* rgba);
};

/// Of an instruction set that the machine has.
const ShadeKernels& shadeKernels(assets::InstructionSet set);
const ShadeKernels& shadeKernels();

}  // namespace render
