// Blends the patches of an overlay (overlay.h) over a composed output in OpenGL; without OpenGL: cpu/cpu_compositor. A
// picture is uploaded when its content changes, and drawn as a rectangle. Render thread.
#pragma once

#include <span>
#include <vector>

#include "render/display/overlay.h"
#include "render/gpu/framebuffer.h"
#include "render/gpu/program.h"

namespace render {

class PatchPass {
 public:
  /// The patches of one output on the GPU.
  struct GpuPatch {
    Texture image;
    std::vector<glm::ivec2> corners_px;
    std::uint64_t serial = 0;
  };
  /// Takes over what changed.
  static void update(std::span<const OverlayPatch> patches, std::vector<GpuPatch>& on_gpu);
  void draw(std::span<const GpuPatch> patches, const Framebuffer& output) const;

 private:
  Program program_{"screen.vert", "patch.frag"};
};

}  // namespace render
