#include "render/gpu/triangle_pool.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "render/shaders/shared_constants.glsl"

namespace render {
namespace {

GlName layoutOf(const Buffer& vertices, const Buffer& indices) {
  GlName layout = newVertexArray();
  const GLuint name = layout.get();
  glEnableVertexArrayAttrib(name, POSITION_ATTRIBUTE);
  glVertexArrayAttribFormat(name, POSITION_ATTRIBUTE, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(name, POSITION_ATTRIBUTE, 0);
  glVertexArrayVertexBuffer(name, 0, vertices.name(), 0, sizeof(glm::vec3));
  glVertexArrayElementBuffer(name, indices.name());
  return layout;
}

/// A quarter more than needed, since every cut changes the size of a patch a little.
std::size_t withSlack(std::size_t count) { return count + count / 4 + 24; }

}  // namespace

TrianglePool::Store TrianglePool::storeOf(std::size_t element_bytes, std::size_t room) {
  return {Buffer::ofSize(room * element_bytes), element_bytes, room};
}

TrianglePool::TrianglePool(std::size_t patches, std::size_t vertices, std::size_t indices)
    : slots_(patches),
      vertices_(storeOf(sizeof(glm::vec3), std::max<std::size_t>(vertices, 1024))),
      indices_(storeOf(sizeof(std::uint16_t), std::max<std::size_t>(indices, 4096))),
      layout_(layoutOf(vertices_.buffer, indices_.buffer)) {}

void TrianglePool::set(std::size_t patch, std::span<const glm::vec3> positions,
                       std::span<const std::uint32_t> indices) {
  assert(positions.size() <= 65536);
  Slot& slot = slots_[patch];
  listed_ = false;
  slot.index_count = indices.size();
  if (indices.empty()) return;
  reserve(vertices_, slot, &Slot::vertices, positions.size());
  reserve(indices_, slot, &Slot::indices, indices.size());
  narrow_.resize(indices.size());
  std::ranges::transform(indices, narrow_.begin(), [](std::uint32_t n) { return static_cast<std::uint16_t>(n); });
  vertices_.buffer.update(std::as_bytes(positions), slot.vertices.first * vertices_.element_bytes);
  indices_.buffer.update(std::as_bytes(std::span(narrow_)), slot.indices.first * indices_.element_bytes);
}

void TrianglePool::reserve(Store& store, Slot& slot, Part Slot::*part, std::size_t count) {
  if (count <= (slot.*part).room) return;
  (slot.*part).room = 0;  // its old part becomes a gap
  const std::size_t room = withSlack(count);
  if (store.used + room > store.room) grow(store, part, room);
  slot.*part = {store.used, room};
  store.used += room;
}

// Copies into a larger buffer and closes the gaps.
void TrianglePool::grow(Store& store, Part Slot::*part, std::size_t room) {
  std::size_t kept = 0;
  for (const Slot& slot : slots_) kept += (slot.*part).room;
  Store larger = storeOf(store.element_bytes, 3 * (kept + room) / 2);
  const auto bytes = [&](std::size_t elements) { return static_cast<GLintptr>(elements * store.element_bytes); };
  for (Slot& slot : slots_) {
    Part& old = slot.*part;
    if (old.room == 0) continue;
    glCopyNamedBufferSubData(store.buffer.name(), larger.buffer.name(), bytes(old.first), bytes(larger.used),
                             bytes(old.room));
    old.first = std::exchange(larger.used, larger.used + old.room);
  }
  store = std::move(larger);
  layout_ = layoutOf(vertices_.buffer, indices_.buffer);
}

void TrianglePool::draw() {
  if (!listed_) {
    counts_.clear(), first_vertices_.clear(), first_indices_.clear();
    for (const Slot& slot : slots_) {
      if (slot.index_count == 0) continue;
      counts_.push_back(static_cast<int>(slot.index_count));
      first_vertices_.push_back(static_cast<int>(slot.vertices.first));
      first_indices_.push_back(reinterpret_cast<const void*>(slot.indices.first * indices_.element_bytes));
    }
    listed_ = true;
  }
  if (counts_.empty()) return;
  glBindVertexArray(layout_.get());
  glMultiDrawElementsBaseVertex(GL_TRIANGLES, counts_.data(), GL_UNSIGNED_SHORT, first_indices_.data(),
                                static_cast<GLsizei>(counts_.size()), first_vertices_.data());
}

}  // namespace render
