// Draw calls and their state, set in full for every pass so that no pass depends on the one before.
// Depth is reverse-Z in 0..1. Thread: the context's.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "render/gpu/buffer.h"
#include "render/gpu/program.h"

namespace render {

struct DrawState {
  bool depth_test = true;
  bool depth_write = true;
  bool allow_equal_depth = false;  ///< depth test passes at equal depth
  bool blend = false;              ///< premultiplied, over the first colour attachment
  bool mirrored = false;           ///< the view is left-handed: front faces are clockwise
  bool write_colour = true;        ///< first colour attachment
  bool write_distance = true;      ///< second colour attachment
};

void apply(const DrawState& state);

/// Restricts the following draws to a rectangle of the bound framebuffer, px from its lower left.
void setViewport(glm::ivec2 corner, glm::ivec2 size);

/// Fragments and clears outside the rectangle are dropped, until the next call; a size of 0: everything is drawn.
void setScissor(glm::ivec2 corner, glm::ivec2 size);

/// Makes shader writes to buffers and images visible to the next draw.
void finishStorageWrites();

/// Makes what was drawn into the bound framebuffer readable as a texture by the next draw, if that does not write it.
void finishTargetWrites();

/// The triangle of screen.vert over all of the bound framebuffer, or of its viewport.
void drawScreen(const Program& program, const DrawState& state);

/// Runs the current compute program over `size` invocations in square groups; its image writes are then visible to
/// texture reads.
void dispatch(glm::ivec2 size, int group);

/// One vertex as the mesh shaders read it.
struct MeshVertex {
  glm::vec3 position_mm;
  glm::vec3 normal;
  glm::vec4 colour;
};

/// Indexed triangles on the GPU. Move-only.
class Triangles {
 public:
  Triangles(std::span<const MeshVertex> vertices, std::span<const std::uint32_t> indices);
  void draw() const;

 private:
  Buffer vertices_, indices_;
  GlName layout_;
  int index_count_ = 0;
};

}  // namespace render
