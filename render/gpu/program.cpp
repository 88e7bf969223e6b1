#include "render/gpu/program.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "render/gpu/gpu_error.h"

namespace render {
namespace {

// Name and GLSL text of every shader, with its includes resolved.
constexpr std::pair<std::string_view, std::string_view> kShaders[] = {
#include "shader_sources.inc"
};

std::string_view sourceOf(std::string_view file) {
  for (const auto& [name, text] : kShaders)
    if (name == file) return text;
  throw GpuError("unknown shader, " + std::string(file) + ": list it in render/CMakeLists.txt");
}

/// `get` and `read`: OpenGL's functions for the state and the log of a shader or of a program.
template <class Get, class Read>
void throwUnlessGood(GLuint name, GLenum state, Get get, Read read, const std::string& what) {
  GLint good = GL_FALSE;
  get(name, state, &good);
  if (good == GL_TRUE) return;
  constexpr std::size_t kLongestMessage = 240;  // of the driver's first error; the rest follows from it
  std::string log(2000, '\0');
  GLsizei used = 0;
  read(name, static_cast<GLsizei>(log.size()), &used, log.data());
  log.resize(std::min({log.find('\n'), static_cast<std::size_t>(used), kLongestMessage}));
  throw GpuError(what + ", graphics driver: " + log);
}

GlName compiled(std::string_view file) {
  const GLenum stage = file.ends_with(".vert")   ? GL_VERTEX_SHADER
                       : file.ends_with(".frag") ? GL_FRAGMENT_SHADER
                                                 : GL_COMPUTE_SHADER;
  const std::string_view text = sourceOf(file);
  GlName shader(glCreateShader(stage), [](unsigned name) { glDeleteShader(name); });
  const GLchar* start = text.data();
  const GLint length = static_cast<GLint>(text.size());
  glShaderSource(shader.get(), 1, &start, &length);
  glCompileShader(shader.get());
  throwUnlessGood(shader.get(), GL_COMPILE_STATUS, glGetShaderiv, glGetShaderInfoLog,
                  "shader " + std::string(file) + " does not compile");
  return shader;
}

}  // namespace

Program::Program(std::initializer_list<std::string_view> files)
    : name_(glCreateProgram(), [](unsigned name) { glDeleteProgram(name); }) {
  std::vector<GlName> shaders;
  std::string all;
  for (const std::string_view file : files) {
    glAttachShader(name_.get(), shaders.emplace_back(compiled(file)).get());
    all += (all.empty() ? "" : " and ") + std::string(file);
  }
  glLinkProgram(name_.get());
  throwUnlessGood(name_.get(), GL_LINK_STATUS, glGetProgramiv, glGetProgramInfoLog, "shaders " + all + " do not link");
  for (const GlName& shader : shaders) glDetachShader(name_.get(), shader.get());
}

void Program::use() const { glUseProgram(name_.get()); }

}  // namespace render
