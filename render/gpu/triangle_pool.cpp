#include "render/gpu/triangle_pool.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>

#include "render/shaders/shared_constants.glsl"

namespace render {
namespace {

constexpr std::size_t kVertexBytes = sizeof(glm::vec3), kIndexBytes = sizeof(std::uint16_t);

GlName layoutOf(const Buffer& vertices, const Buffer& indices) {
  GlName layout = newVertexArray();
  const GLuint name = layout.get();
  glEnableVertexArrayAttrib(name, POSITION_ATTRIBUTE);
  glVertexArrayAttribFormat(name, POSITION_ATTRIBUTE, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(name, POSITION_ATTRIBUTE, 0);
  glVertexArrayVertexBuffer(name, 0, vertices.name(), 0, kVertexBytes);
  glVertexArrayElementBuffer(name, indices.name());
  return layout;
}

void copy(const Buffer& from, std::size_t from_byte, const Buffer& to, std::size_t to_byte, std::size_t bytes) {
  glCopyNamedBufferSubData(from.name(), to.name(), static_cast<GLintptr>(from_byte), static_cast<GLintptr>(to_byte),
                           static_cast<GLsizeiptr>(bytes));
}

/// A quarter more than needed, since every cut changes the size of a patch a little.
std::size_t withSlack(std::size_t count) { return count + count / 4 + 24; }

}  // namespace

TrianglePool::TrianglePool(std::size_t patches, std::size_t vertices, std::size_t indices)
    : slots_(patches),
      vertex_room_(std::max<std::size_t>(vertices, 1024)),
      index_room_(std::max<std::size_t>(indices, 4096)),
      vertices_(Buffer::ofSize(vertex_room_ * kVertexBytes)),
      indices_(Buffer::ofSize(index_room_ * kIndexBytes)),
      layout_(layoutOf(vertices_, indices_)) {}

void TrianglePool::set(std::size_t patch, std::span<const glm::vec3> positions,
                       std::span<const std::uint32_t> indices) {
  assert(positions.size() <= 65536);
  Slot& slot = slots_[patch];
  listed_ = false;
  slot.indices = indices.size();
  if (indices.empty()) return;
  if (positions.size() > slot.vertex_room || indices.size() > slot.index_room)
    makeRoom(slot, positions.size(), indices.size());
  narrow_.resize(indices.size());
  std::ranges::transform(indices, narrow_.begin(), [](std::uint32_t n) { return static_cast<std::uint16_t>(n); });
  vertices_.update(std::as_bytes(positions), slot.first_vertex * kVertexBytes);
  indices_.update(std::as_bytes(std::span(narrow_)), slot.first_index * kIndexBytes);
}

void TrianglePool::makeRoom(Slot& slot, std::size_t vertices, std::size_t indices) {
  slot.vertex_room = slot.index_room = 0;  // its old part becomes a gap
  const std::size_t vertex_room = withSlack(vertices), index_room = withSlack(indices);
  if (vertices_used_ + vertex_room > vertex_room_ || indices_used_ + index_room > index_room_)
    grow(vertex_room, index_room);
  slot.first_vertex = vertices_used_;
  slot.first_index = indices_used_;
  slot.vertex_room = vertex_room;
  slot.index_room = index_room;
  vertices_used_ += vertex_room;
  indices_used_ += index_room;
}

// Copies into larger buffers and closes the gaps.
void TrianglePool::grow(std::size_t vertices, std::size_t indices) {
  std::size_t kept_vertices = 0, kept_indices = 0;
  for (const Slot& slot : slots_) {
    kept_vertices += slot.vertex_room;
    kept_indices += slot.index_room;
  }
  vertex_room_ = 3 * (kept_vertices + vertices) / 2;
  index_room_ = 3 * (kept_indices + indices) / 2;
  Buffer new_vertices = Buffer::ofSize(vertex_room_ * kVertexBytes);
  Buffer new_indices = Buffer::ofSize(index_room_ * kIndexBytes);
  vertices_used_ = indices_used_ = 0;
  for (Slot& slot : slots_) {
    if (slot.vertex_room == 0) continue;
    copy(vertices_, slot.first_vertex * kVertexBytes, new_vertices, vertices_used_ * kVertexBytes,
         slot.vertex_room * kVertexBytes);
    copy(indices_, slot.first_index * kIndexBytes, new_indices, indices_used_ * kIndexBytes,
         slot.index_room * kIndexBytes);
    slot.first_vertex = vertices_used_;
    slot.first_index = indices_used_;
    vertices_used_ += slot.vertex_room;
    indices_used_ += slot.index_room;
  }
  vertices_ = std::move(new_vertices);
  indices_ = std::move(new_indices);
  layout_ = layoutOf(vertices_, indices_);
}

void TrianglePool::draw() {
  if (!listed_) {
    counts_.clear(), first_vertices_.clear(), first_indices_.clear();
    for (const Slot& slot : slots_) {
      if (slot.indices == 0) continue;
      counts_.push_back(static_cast<int>(slot.indices));
      first_vertices_.push_back(static_cast<int>(slot.first_vertex));
      first_indices_.push_back(reinterpret_cast<const void*>(slot.first_index * kIndexBytes));
    }
    listed_ = true;
  }
  if (counts_.empty()) return;
  glBindVertexArray(layout_.get());
  glMultiDrawElementsBaseVertex(GL_TRIANGLES, counts_.data(), GL_UNSIGNED_SHORT, first_indices_.data(),
                                static_cast<GLsizei>(counts_.size()), first_vertices_.data());
}

}  // namespace render
