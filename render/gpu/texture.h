// An immutable-storage texture, 2-D or 3-D, one level. Move-only. Thread: the context's.
// Volume textures are 0 outside (border colour); 2-D textures clamp to the edge.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "render/gpu/gl_name.h"

namespace render {

enum class TexelFormat { r8ui, r32ui, rg16, r16, rgba8, rgba16f, r32f, depth32f };

class Texture {
 public:
  Texture() = default;
  static Texture image(glm::ivec2 size, TexelFormat format);
  /// Filtered linearly, except integers.
  static Texture volume(glm::ivec3 size, TexelFormat format);

  /// Copies texels into a box; `texels` tightly packed, x fastest, of the format's type (r8ui: u8, r16: u16).
  void upload(glm::ivec3 offset, glm::ivec3 extent, std::span<const std::byte> texels);
  /// From a larger array: `row_texels` from one row to the next, `slice_rows` from one slice to the next.
  void upload(glm::ivec3 offset, glm::ivec3 extent, const std::byte* first, int row_texels, int slice_rows);
  /// A whole image, bottom row first, tightly packed.
  void uploadImage(std::span<const std::byte> texels);
  void bind(int unit) const;
  /// As an image of a shader.
  void bindForWriting(int image_unit) const;
  void bindForReadingAndWriting(int image_unit) const;
  /// Sets every texel; r32ui only.
  void fill(std::uint32_t value);

  glm::ivec3 size() const { return size_; }
  unsigned name() const { return name_.get(); }

 private:
  Texture(unsigned target, glm::ivec3 size, TexelFormat format);
  void setSampling(int filter, int wrap);

  GlName name_;
  glm::ivec3 size_{0};
  TexelFormat format_ = TexelFormat::rgba8;
};

}  // namespace render
