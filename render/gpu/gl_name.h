// Owner of one OpenGL object name, deleted in the destructor. Move-only, 16 bytes. Thread: the context's, which must be
// current when the owner is destroyed.
#pragma once

#include <utility>

namespace render {

class GlName {
 public:
  using Delete = void (*)(unsigned name);

  GlName() = default;
  GlName(unsigned name, Delete remove) : name_(name), remove_(remove) {}
  GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)), remove_(other.remove_) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(remove_, other.remove_);
    return *this;
  }
  ~GlName() {
    if (name_ != 0) remove_(name_);
  }

  unsigned get() const { return name_; }

 private:
  unsigned name_ = 0;
  Delete remove_ = nullptr;
};

// New objects, without storage.
GlName newBuffer();
GlName newFramebuffer();
/// `target`: GL_TEXTURE_2D or GL_TEXTURE_3D.
GlName newTexture(unsigned target);
GlName newVertexArray();

}  // namespace render
