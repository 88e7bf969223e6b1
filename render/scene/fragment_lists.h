// Transparent parts of meshes in exact order per pixel: each fragment is added to the linked list of its pixel, then
// all lists are sorted and blended over the image at once. The sixteen nearest fragments of a pixel count. Render
// thread. Memory: 64 bytes a pixel from the first transparent part on, at most 128 MiB; fragments beyond that are
// dropped.
#pragma once

#include <optional>

#include "render/gpu/buffer.h"
#include "render/gpu/framebuffer.h"
#include "render/gpu/program.h"

namespace render {

class FragmentLists {
 public:
  /// Empties the lists, for images of `size`, and binds them for mesh_transparent.frag.
  void begin(glm::ivec2 size);
  /// Blends them over the colour of the image, guides where they lie behind its distance.
  void blendOver(const Framebuffer& image);

 private:
  std::optional<Program> over_;
  Texture heads_;
  Buffer list_;
  std::uint32_t capacity_ = 0;
};

}  // namespace render
