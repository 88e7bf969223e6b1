// Many small patches of triangles in one pair of buffers, drawn by one call; each patch can be replaced. Positions
// only, all in one frame; gaps left by resized patches are closed when the buffers grow. Move-only. Thread: the
// context's. Cost: replacing a patch, two uploads; growing, one copy on the GPU, occasionally.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/gpu/buffer.h"

namespace render {

class TrianglePool {
 public:
  /// Initial capacity for all patches; grows when needed.
  TrianglePool(std::size_t patches, std::size_t vertices, std::size_t indices);

  /// Three indices a triangle, into `positions` (at most 65536). Empty: removes the patch.
  void set(std::size_t patch, std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);
  void draw();

 private:
  /// A patch's part of a buffer, counted in elements.
  struct Part {
    std::size_t first = 0, room = 0;
  };
  struct Slot {
    Part vertices, indices;
    std::size_t index_count = 0;
  };
  struct Store {
    Buffer buffer;
    std::size_t element_bytes, room, used = 0;  ///< used: from the beginning, including gaps
  };
  static Store storeOf(std::size_t element_bytes, std::size_t room);
  void reserve(Store& store, Slot& slot, Part Slot::*part, std::size_t count);
  void grow(Store& store, Part Slot::*part, std::size_t room);

  std::vector<Slot> slots_;
  Store vertices_, indices_;
  GlName layout_;
  std::vector<std::uint16_t> narrow_;
  // Arguments of the draw call, one per non-empty patch.
  bool listed_ = false;
  std::vector<int> counts_, first_vertices_;
  std::vector<const void*> first_indices_;
};

}  // namespace render
