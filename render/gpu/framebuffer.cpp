#include "render/gpu/framebuffer.h"

#include <epoxy/gl.h>

#include <array>
#include <string>

#include "render/gpu/gpu_error.h"

namespace render {
namespace {

template <class T>
std::vector<T> texels(const Texture& texture, GLenum format, GLenum type, std::size_t channels) {
  const glm::ivec3 size = texture.size();
  std::vector<T> values(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * channels);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureImage(texture.name(), 0, format, type, static_cast<GLsizei>(values.size() * sizeof(T)), values.data());
  return values;
}

}  // namespace

Framebuffer::Framebuffer(glm::ivec2 size, std::span<const TexelFormat> colours, bool depth)
    : name_(newFramebuffer()), size_(size) {
  std::vector<GLenum> buffers;
  for (const TexelFormat format : colours) {
    const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(colours_.size());
    colours_.push_back(Texture::image(size, format));
    glNamedFramebufferTexture(name_.get(), attachment, colours_.back().name(), 0);
    buffers.push_back(attachment);
  }
  if (depth) {
    depth_ = Texture::image(size, TexelFormat::depth32f);
    glNamedFramebufferTexture(name_.get(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
  }
  glNamedFramebufferDrawBuffers(name_.get(), static_cast<GLsizei>(buffers.size()), buffers.data());
  if (glCheckNamedFramebufferStatus(name_.get(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw GpuError("image of " + std::to_string(size.x) + "x" + std::to_string(size.y) +
                   " px, graphics driver: it cannot be rendered to; choose a smaller one");
}

void Framebuffer::fit(glm::ivec2 size, std::span<const TexelFormat> colours, bool depth) {
  if (size_ != size) *this = Framebuffer(size, colours, depth);
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, name_.get());
  glViewport(0, 0, size_.x, size_.y);
}

void Framebuffer::clear() {
  const std::array<float, 4> nothing{0.0f, 0.0f, 0.0f, 0.0f};
  const float far = 0.0f;
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  for (std::size_t i = 0; i < colours_.size(); ++i)
    glClearNamedFramebufferfv(name_.get(), GL_COLOR, static_cast<GLint>(i), nothing.data());
  if (depth_.name() != 0) {
    glDepthMask(GL_TRUE);
    glClearNamedFramebufferfv(name_.get(), GL_DEPTH, 0, &far);
  }
}

void Framebuffer::block() {
  const std::array<float, 4> touching{1e-6f, 0.0f, 0.0f, 0.0f};
  const float nearest = 1.0f;
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClearNamedFramebufferfv(name_.get(), GL_COLOR, static_cast<GLint>(colours_.size()) - 1, touching.data());
  glDepthMask(GL_TRUE);
  glClearNamedFramebufferfv(name_.get(), GL_DEPTH, 0, &nearest);
}

void Framebuffer::scaleInto(Framebuffer& to, bool turned_over) const {
  const GLint low = turned_over ? to.size_.y : 0, high = turned_over ? 0 : to.size_.y;
  glNamedFramebufferReadBuffer(name_.get(), GL_COLOR_ATTACHMENT0);
  glBlitNamedFramebuffer(name_.get(), to.name_.get(), 0, 0, size_.x, size_.y, 0, low, to.size_.x, high,
                         GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

void Framebuffer::readInto(unsigned buffer) const {
  const glm::ivec3 size = colour(0).size();
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
  glGetTextureImage(colour(0).name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, 4 * size.x * size.y, nullptr);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

std::vector<std::uint8_t> Framebuffer::readRgba8(int attachment) const {
  return texels<std::uint8_t>(colour(attachment), GL_RGBA, GL_UNSIGNED_BYTE, 4);
}

std::vector<float> Framebuffer::readFloat(int attachment) const {
  return texels<float>(colour(attachment), GL_RED, GL_FLOAT, 1);
}

}  // namespace render
