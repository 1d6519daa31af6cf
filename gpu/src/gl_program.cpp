#include "gl_program.hpp"

#include <algorithm>

namespace blum::detail {
namespace {

std::string log_of(const GladGLContext& gl, GLuint object, bool is_program) {
  char text[2000] = "";
  if (is_program) {
    gl.GetProgramInfoLog(object, sizeof text, nullptr, text);
  } else {
    gl.GetShaderInfoLog(object, sizeof text, nullptr, text);
  }
  return text;
}

}  // namespace

GLuint link_program(const GladGLContext& gl, const char* first, const char* fragment,
                    std::string& problem) {
  const GLuint program = gl.CreateProgram();
  const auto add = [&](GLenum kind, const char* source) {
    const GLuint shader = gl.CreateShader(kind);
    gl.ShaderSource(shader, 1, &source, nullptr);
    gl.CompileShader(shader);
    GLint is_good = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &is_good);
    if (is_good == 0) problem = "the driver refuses a shader: " + log_of(gl, shader, false);
    gl.AttachShader(program, shader);
    gl.DeleteShader(shader);
  };
  add(fragment == nullptr ? GL_COMPUTE_SHADER : GL_VERTEX_SHADER, first);
  if (fragment != nullptr) add(GL_FRAGMENT_SHADER, fragment);
  gl.LinkProgram(program);
  GLint is_good = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &is_good);
  if (is_good == 0 && problem.empty()) {
    problem = "the driver refuses a program: " + log_of(gl, program, true);
  }
  if (problem.empty()) return program;
  gl.DeleteProgram(program);
  return 0;
}

GLuint texel_texture(const GladGLContext& gl, std::vector<float> texels, int row) {
  const std::size_t words = 4 * static_cast<std::size_t>(row);
  const std::size_t rows = std::max<std::size_t>(1, (texels.size() + words - 1) / words);
  texels.resize(rows * words);
  GLuint texture = 0;
  gl.GenTextures(1, &texture);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, row, static_cast<GLsizei>(rows), 0, GL_RGBA, GL_FLOAT,
                texels.data());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

}  // namespace blum::detail
