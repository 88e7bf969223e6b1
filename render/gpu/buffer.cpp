#include "render/gpu/buffer.h"

#include <epoxy/gl.h>

namespace render {

Buffer::Buffer(std::span<const std::byte> content) : name_(newBuffer()) {
  if (!content.empty()) glNamedBufferStorage(name(), static_cast<GLsizeiptr>(content.size()), content.data(), 0);
}

Buffer Buffer::ofSize(std::size_t bytes) {
  Buffer buffer;
  buffer.name_ = newBuffer();
  glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
  return buffer;
}

void Buffer::update(std::span<const std::byte> content, std::size_t first_byte) {
  glNamedBufferSubData(name(), static_cast<GLintptr>(first_byte), static_cast<GLsizeiptr>(content.size()),
                       content.data());
}

void Buffer::bindUniform(int block) const { glBindBufferBase(GL_UNIFORM_BUFFER, static_cast<GLuint>(block), name()); }

void Buffer::bindStorage(int block) const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(block), name());
}

}  // namespace render
