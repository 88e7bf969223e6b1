// Transparent parts of meshes in the exact order of every pixel: each draws into the list of its pixel, then all lists
// are sorted and laid over the image at once. The sixteen nearest of a pixel count. Render thread. Memory: 64 bytes a
// pixel from the first transparent part on, at most 128 MiB; what does not fit is left out.
#pragma once

#include <optional>

#include "render/gpu/buffer.h"
#include "render/gpu/framebuffer.h"
#include "render/gpu/program.h"

namespace render {

class FragmentLists {
 public:
  /// Empty lists for a image of that size, bound for mesh_transparent.frag.
  void begin(glm::ivec2 size);
  /// Lays them over the image's colour.
  void blendOver(const Framebuffer& image);

 private:
  std::optional<Program> over_;
  Texture heads_;
  Buffer list_;
  std::uint32_t capacity_ = 0;
};

}  // namespace render
