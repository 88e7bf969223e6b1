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
  /// A patch's part of both buffers, counted in vertices and indices.
  struct Slot {
    std::size_t first_vertex = 0, vertex_room = 0, first_index = 0, index_room = 0, indices = 0;
  };
  void makeRoom(Slot& slot, std::size_t vertices, std::size_t indices);
  void grow(std::size_t vertices, std::size_t indices);

  std::vector<Slot> slots_;
  std::size_t vertex_room_, index_room_;              ///< capacity of the buffers
  std::size_t vertices_used_ = 0, indices_used_ = 0;  ///< from their beginning, including gaps
  Buffer vertices_, indices_;
  GlName layout_;
  std::vector<std::uint16_t> narrow_;
  // Arguments of the draw call, one per non-empty patch.
  bool listed_ = false;
  std::vector<int> counts_, first_vertices_;
  std::vector<const void*> first_indices_;
};

}  // namespace render
