// A buffer on the GPU: uniform block, storage, vertices or indices. Move-only. Thread: the context's.
#pragma once

#include <cstddef>
#include <span>

#include "render/gpu/gl_name.h"

namespace render {

class Buffer {
 public:
  Buffer() = default;
  /// Fixed content.
  explicit Buffer(std::span<const std::byte> content);
  /// Uninitialised, to be filled with update().
  static Buffer ofSize(std::size_t bytes);

  void update(std::span<const std::byte> content, std::size_t first_byte = 0);
  /// `block`: the binding of the block.
  void bindUniform(int block) const;
  void bindStorage(int block) const;
  unsigned name() const { return name_.get(); }

 private:
  GlName name_;
};

/// A uniform block as one plain struct laid out by std140.
template <class Block>
class UniformBlock {
 public:
  UniformBlock() : buffer_(Buffer::ofSize(sizeof(Block))) {}
  void set(int binding, const Block& block) {
    buffer_.update(std::as_bytes(std::span(&block, 1)));
    buffer_.bindUniform(binding);
  }

 private:
  Buffer buffer_;
};

}  // namespace render
