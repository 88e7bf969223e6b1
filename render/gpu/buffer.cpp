#include "render/gpu/buffer.h"

#include <epoxy/gl.h>

namespace render {
namespace {

void deleteBuffer(unsigned name) { glDeleteBuffers(1, &name); }

unsigned newBuffer() {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  return name;
}

}  // namespace

Buffer::Buffer(std::span<const std::byte> content) : name_(newBuffer(), &deleteBuffer) {
  if (!content.empty()) glNamedBufferStorage(name(), static_cast<GLsizeiptr>(content.size()), content.data(), 0);
}

Buffer Buffer::ofSize(std::size_t bytes) {
  Buffer buffer;
  buffer.name_ = GlName(newBuffer(), &deleteBuffer);
  glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
  return buffer;
}

void Buffer::update(std::span<const std::byte> content) {
  glNamedBufferSubData(name(), 0, static_cast<GLsizeiptr>(content.size()), content.data());
}

void Buffer::bindUniform(int block) const { glBindBufferBase(GL_UNIFORM_BUFFER, static_cast<GLuint>(block), name()); }

void Buffer::bindStorage(int block) const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(block), name());
}

}  // namespace render
