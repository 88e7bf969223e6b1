#include "render/gpu/drawing.h"

#include <epoxy/gl.h>

#include <cstddef>

#include "render/shaders/shared_constants.glsl"

namespace render {
namespace {

void setMask(GLuint target, bool on) {
  const GLboolean write = on ? GL_TRUE : GL_FALSE;
  glColorMaski(target, write, write, write, write);
}

}  // namespace

void apply(const DrawState& state) {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  state.depth_test ? glEnable(GL_DEPTH_TEST) : glDisable(GL_DEPTH_TEST);
  glDepthFunc(state.allow_equal_depth ? GL_GEQUAL : GL_GREATER);
  glDepthMask(state.depth_write ? GL_TRUE : GL_FALSE);
  glDisable(GL_BLEND);
  if (state.blend) glEnablei(GL_BLEND, 0);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDisable(GL_CULL_FACE);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glFrontFace(state.mirrored ? GL_CW : GL_CCW);
  setMask(COLOUR_TARGET, state.write_colour);
  setMask(DISTANCE_TARGET, state.write_distance);
}

void setViewport(glm::ivec2 corner, glm::ivec2 size) { glViewport(corner.x, corner.y, size.x, size.y); }

void setScissor(glm::ivec2 corner, glm::ivec2 size) {
  size.x > 0 ? glEnable(GL_SCISSOR_TEST) : glDisable(GL_SCISSOR_TEST);
  if (size.x > 0) glScissor(corner.x, corner.y, size.x, size.y);
}

void finishStorageWrites() { glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT); }

void finishTargetWrites() { glTextureBarrier(); }

void drawScreen(const Program& program, const DrawState& state) {
  apply(state);
  program.use();
  const GlName nothing = newVertexArray();
  glBindVertexArray(nothing.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void dispatch(glm::ivec2 size, int group) {
  const glm::uvec2 groups((size + group - 1) / group);
  glDispatchCompute(groups.x, groups.y, 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

Triangles::Triangles(std::span<const MeshVertex> vertices, std::span<const std::uint32_t> indices)
    : vertices_(std::as_bytes(vertices)),
      indices_(std::as_bytes(indices)),
      layout_(newVertexArray()),
      index_count_(static_cast<int>(indices.size())) {
  const auto attribute = [this](GLuint slot, GLint components, std::size_t offset) {
    glEnableVertexArrayAttrib(layout_.get(), slot);
    glVertexArrayAttribFormat(layout_.get(), slot, components, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(layout_.get(), slot, 0);
  };
  glVertexArrayVertexBuffer(layout_.get(), 0, vertices_.name(), 0, sizeof(MeshVertex));
  glVertexArrayElementBuffer(layout_.get(), indices_.name());
  attribute(POSITION_ATTRIBUTE, 3, offsetof(MeshVertex, position_mm));
  attribute(NORMAL_ATTRIBUTE, 3, offsetof(MeshVertex, normal));
  attribute(COLOUR_ATTRIBUTE, 4, offsetof(MeshVertex, colour));
}

void Triangles::draw() const {
  glBindVertexArray(layout_.get());
  glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace render
