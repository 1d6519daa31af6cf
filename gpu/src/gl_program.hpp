/// Programs and textures of an OpenGL context. All need it to be current.
#pragma once

#include <glad/gl.h>

#include <string>
#include <vector>

namespace blum::detail {

/// A program of a vertex and a fragment shader, or of one compute shader (`fragment` empty).
/// Returns 0, and says why, if the driver refuses.
[[nodiscard]] GLuint link_program(const GladGLContext& gl, const char* first, const char* fragment,
                                  std::string& problem);
/// A 2D texture of 4-float texels, `row` of them a row.
[[nodiscard]] GLuint texel_texture(const GladGLContext& gl, std::vector<float> texels, int row);

}  // namespace blum::detail
