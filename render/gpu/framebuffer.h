// A render target that owns its colour attachments and depth. Move-only. Thread: the context's.
// Reading back waits for the GPU: for snapshots, recordings and tests, not for every frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/gpu/texture.h"

namespace render {

class Framebuffer {
 public:
  Framebuffer() = default;
  /// Colour attachments 0, 1, … in the order of `colours`; `depth`: a 32-bit float depth as well.
  Framebuffer(glm::ivec2 size, std::span<const TexelFormat> colours, bool depth);
  /// Recreates it unless it has that size.
  void fit(glm::ivec2 size, std::span<const TexelFormat> colours, bool depth);

  void bind() const;
  /// Colour 0, distances 0, depth far (reverse-Z).
  void clear();
  /// Nearest depth and distance everywhere, so that nothing is drawn there and no ray is cast.
  void block();
  const Texture& colour(int attachment) const { return colours_[static_cast<std::size_t>(attachment)]; }
  glm::ivec2 size() const { return size_; }

  /// Colour 0, filtered linearly; `turned_over`: bottom row to the top.
  void scaleInto(Framebuffer& to, bool turned_over) const;
  /// Colour 0 as RGBA8, bottom row first, into a buffer that is large enough; does not wait.
  void readInto(unsigned buffer) const;

  /// Bottom row first.
  std::vector<std::uint8_t> readRgba8(int attachment) const;
  std::vector<float> readFloat(int attachment) const;

 private:
  GlName name_;
  glm::ivec2 size_{0};
  std::vector<Texture> colours_;
  Texture depth_;
};

}  // namespace render
