#include "render/gpu/program.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <string>

#include "render/gpu/gpu_error.h"
#include "render/gpu/shader_library.h"

namespace render {
namespace {

void deleteShader(unsigned name) { glDeleteShader(name); }
void deleteProgram(unsigned name) { glDeleteProgram(name); }

[[noreturn]] void throwBuildError(const std::string& what, std::string log) {
  constexpr std::size_t kWords = 240;  // the driver's first complaint; the rest follows from it
  log.resize(std::min(log.find('\n'), std::min(log.size(), kWords)));
  throw GpuError(what + ", graphics driver: " + log);
}

GlName compiled(GLenum stage, std::string_view file) {
  const std::string_view text = shaderSource(file);
  GlName shader(glCreateShader(stage), &deleteShader);
  const GLchar* start = text.data();
  const GLint length = static_cast<GLint>(text.size());
  glShaderSource(shader.get(), 1, &start, &length);
  glCompileShader(shader.get());
  GLint good = GL_FALSE;
  glGetShaderiv(shader.get(), GL_COMPILE_STATUS, &good);
  if (good == GL_TRUE) return shader;
  std::string log(2000, '\0');
  GLsizei used = 0;
  glGetShaderInfoLog(shader.get(), static_cast<GLsizei>(log.size()), &used, log.data());
  log.resize(static_cast<std::size_t>(used));
  throwBuildError("shader " + std::string(file) + " does not compile", log);
}

}  // namespace

Program::Program(std::string_view vertex, std::string_view fragment) : name_(glCreateProgram(), &deleteProgram) {
  const GlName vertex_shader = compiled(GL_VERTEX_SHADER, vertex);
  const GlName fragment_shader = compiled(GL_FRAGMENT_SHADER, fragment);
  glAttachShader(name_.get(), vertex_shader.get());
  glAttachShader(name_.get(), fragment_shader.get());
  link("shaders " + std::string(vertex) + " and " + std::string(fragment) + " do not link");
  glDetachShader(name_.get(), vertex_shader.get());
  glDetachShader(name_.get(), fragment_shader.get());
}

Program::Program(std::string_view compute) : name_(glCreateProgram(), &deleteProgram) {
  const GlName shader = compiled(GL_COMPUTE_SHADER, compute);
  glAttachShader(name_.get(), shader.get());
  link("shader " + std::string(compute) + " does not link");
  glDetachShader(name_.get(), shader.get());
}

void Program::link(const std::string& what) {
  glLinkProgram(name_.get());
  GLint good = GL_FALSE;
  glGetProgramiv(name_.get(), GL_LINK_STATUS, &good);
  if (good == GL_TRUE) return;
  std::string log(2000, '\0');
  GLsizei used = 0;
  glGetProgramInfoLog(name_.get(), static_cast<GLsizei>(log.size()), &used, log.data());
  log.resize(static_cast<std::size_t>(used));
  throwBuildError(what, log);
}

void Program::use() const { glUseProgram(name_.get()); }

}  // namespace render
