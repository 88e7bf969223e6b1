#include "render/gpu/texture.h"

#include <epoxy/gl.h>

#include <array>
#include <cassert>
#include <string>

#include "render/gpu/gpu_error.h"

namespace render {
namespace {

struct FormatInfo {
  GLenum internal, external, type;
  std::size_t bytes;
};

// In the order of TexelFormat.
constexpr std::array<FormatInfo, 8> kInfo{{{GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, 1},
                                           {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 4},
                                           {GL_RG16, GL_RG, GL_UNSIGNED_SHORT, 4},
                                           {GL_R16, GL_RED, GL_UNSIGNED_SHORT, 2},
                                           {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4},
                                           {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 8},
                                           {GL_R32F, GL_RED, GL_FLOAT, 4},
                                           {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 4}}};

const FormatInfo& infoOf(TexelFormat format) { return kInfo[static_cast<std::size_t>(format)]; }

void checkEdge(GLenum limit, int edge, const char* what, const char* unit, const char* to_do) {
  GLint largest = 0;
  glGetIntegerv(limit, &largest);
  if (edge > largest)
    throw GpuError(std::string(what) + " of " + std::to_string(edge) + " " + unit +
                   " along an edge, graphics driver: the largest is " + std::to_string(largest) + "; " + to_do);
}

}  // namespace

Texture::Texture(unsigned target, glm::ivec3 size, TexelFormat format)
    : name_(newTexture(target)), size_(size), format_(format) {
  assert(size.x > 0 && size.y > 0 && size.z > 0);
}

Texture Texture::image(glm::ivec2 size, TexelFormat format) {
  checkEdge(GL_MAX_TEXTURE_SIZE, glm::max(size.x, size.y), "image", "px", "choose a smaller size or fewer samples");
  Texture texture(GL_TEXTURE_2D, glm::ivec3(size, 1), format);
  glTextureStorage2D(texture.name(), 1, infoOf(format).internal, size.x, size.y);
  texture.setSampling(GL_NEAREST, GL_CLAMP_TO_EDGE);
  return texture;
}

Texture Texture::volume(glm::ivec3 size, TexelFormat format) {
  checkEdge(GL_MAX_3D_TEXTURE_SIZE, glm::max(size.x, glm::max(size.y, size.z)), "volume", "voxels", "crop the scan");
  Texture texture(GL_TEXTURE_3D, size, format);
  glTextureStorage3D(texture.name(), 1, infoOf(format).internal, size.x, size.y, size.z);
  texture.setSampling(format == TexelFormat::r8ui ? GL_NEAREST : GL_LINEAR, GL_CLAMP_TO_BORDER);
  return texture;
}

void Texture::setSampling(int filter, int wrap) {
  for (const GLenum side : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) glTextureParameteri(name(), side, filter);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTextureParameteri(name(), axis, wrap);
}

void Texture::upload(glm::ivec3 offset, glm::ivec3 extent, std::span<const std::byte> texels) {
  assert(texels.size() == infoOf(format_).bytes * static_cast<std::size_t>(extent.x) *
                              static_cast<std::size_t>(extent.y) * static_cast<std::size_t>(extent.z));
  upload(offset, extent, texels.data(), extent.x, extent.y);
}

void Texture::upload(glm::ivec3 offset, glm::ivec3 extent, const std::byte* first, int row_texels, int slice_rows) {
  const FormatInfo info = infoOf(format_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, row_texels);
  glPixelStorei(GL_UNPACK_IMAGE_HEIGHT, slice_rows);
  glTextureSubImage3D(name(), 0, offset.x, offset.y, offset.z, extent.x, extent.y, extent.z, info.external, info.type,
                      first);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glPixelStorei(GL_UNPACK_IMAGE_HEIGHT, 0);
}

void Texture::uploadImage(std::span<const std::byte> texels) {
  const FormatInfo info = infoOf(format_);
  assert(texels.size() == info.bytes * static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y));
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(name(), 0, 0, 0, size_.x, size_.y, info.external, info.type, texels.data());
}

void Texture::bind(int unit) const { glBindTextureUnit(static_cast<GLuint>(unit), name()); }

void Texture::bindForWriting(int image_unit) const {
  glBindImageTexture(static_cast<GLuint>(image_unit), name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, infoOf(format_).internal);
}

void Texture::bindForReadingAndWriting(int image_unit) const {
  glBindImageTexture(static_cast<GLuint>(image_unit), name(), 0, GL_FALSE, 0, GL_READ_WRITE, infoOf(format_).internal);
}

void Texture::fill(std::uint32_t value) {
  assert(format_ == TexelFormat::r32ui);
  glClearTexImage(name(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &value);
}

}  // namespace render
