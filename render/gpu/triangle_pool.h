// Many small patches of triangles in one pair of buffers, drawn by one call, each patch replaceable by itself.
// Positions alone, in one frame; what a patch of another size leaves behind is closed up when the buffers have to grow.
// Move-only. Thread: the context's. Replacing a patch: two uploads; growing: one copy on the GPU, now and then.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/gpu/buffer.h"

namespace render {

class TrianglePool {
 public:
  /// Room for that many vertices and indices in all; more is made when needed.
  TrianglePool(std::size_t patches, std::size_t vertices, std::size_t indices);

  /// Three indices a triangle, into `positions` (at most 65536). Empty: the patch goes.
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
  std::size_t vertex_room_, index_room_;              ///< of the buffers
  std::size_t vertices_used_ = 0, indices_used_ = 0;  ///< from their beginning, gaps and all
  Buffer vertices_, indices_;
  GlName layout_;
  std::vector<std::uint16_t> narrow_;
  // What draw() hands over, by patch that is not empty.
  bool listed_ = false;
  std::vector<int> counts_, first_vertices_;
  std::vector<const void*> first_indices_;
};

}  // namespace render
