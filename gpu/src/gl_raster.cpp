#include "gl_raster.hpp"

#include <algorithm>
#include <cmath>

#include "gl_program.hpp"

namespace blum::detail {
namespace {

constexpr int kTexelsOfSite = 5, kSitesInRow = 400;

// Places are computed from pixels, not interpolated, so that a fragment's arithmetic is what the
// bounds in scan_sites.hpp count.
constexpr const char* kVertexShader = R"(#version 330 core
layout(location = 0) in vec2 place;
layout(location = 1) in uvec2 names;
layout(location = 2) in vec3 at;
layout(location = 3) in vec3 along_x;
layout(location = 4) in vec3 along_y;
uniform vec2 pixels;
flat out uvec2 site_id;
flat out vec3 vector_at;
flat out vec3 vector_x;
flat out vec3 vector_y;
void main() {
  site_id = names;
  vector_at = at;
  vector_x = along_x;
  vector_y = along_y;
  gl_Position = vec4(2.0 * place / pixels - 1.0, 0.0, 1.0);
})";

constexpr const char* kFragmentHead = R"(#version 330 core
flat in uvec2 site_id;
flat in vec3 vector_at;
flat in vec3 vector_x;
flat in vec3 vector_y;
uniform sampler2D sites;
uniform vec2 origin, spacing;
uniform float z, nearer;
layout(location = 0) out uint id;
void finish(float squared) {
  if (nearer > 0.0) {
    float d = max(0.0, sqrt(squared) - nearer);
    squared = d * d;
  }
  gl_FragDepth = min(squared, 0.9999999);
  id = site_id.y;
}
)";

constexpr const char* kEvaluated = R"(
vec4 texel(int k) {
  int site = int(site_id.x);
  return texelFetch(sites, ivec2(5 * (site % 400) + k, site / 400), 0);
}
void main() {
  vec3 x = vec3(origin + (gl_FragCoord.xy - 0.5) * spacing, z);
  vec4 base = texel(0), unit = texel(1);
  vec3 d = x - base.xyz;
  // Closed sites are drawn larger than their own conditions allow.
  if (nearer == 0.0) {
    for (int k = 0; k < int(unit.w); ++k) {
      vec4 c = texel(2 + k);
      if (dot(c.xyz, d) > c.w) discard;
    }
  }
  float along = dot(unit.xyz, d);
  vec3 off = base.w == 1.0 ? d - along * unit.xyz : d;
  finish(base.w == 2.0 ? along * along : dot(off, off));
})";

constexpr const char* kAffine = R"(
void main() {
  vec2 sample_at = gl_FragCoord.xy - 0.5;
  vec3 v = vector_at + (sample_at.x * vector_x + sample_at.y * vector_y);
  finish(dot(v, v));
})";

}  // namespace

GlRaster::GlRaster(const GladGLContext& gl, const VoxelGrid& grid, const ScanSites& sites,
                   const GlFrame& frame, FieldMethod method)
    : gl_(gl), grid_(grid), frame_(frame) {
  GLint most = 0, most_viewport[2] = {0, 0};
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, most_viewport);
  most = std::min({most, most_viewport[0], most_viewport[1]});
  gl.GetIntegerv(GL_SUBPIXEL_BITS, &subpixel_bits_);
  if (grid.size[0] > static_cast<std::uint32_t>(most) ||
      grid.size[1] > static_cast<std::uint32_t>(most)) {
    problem_ = "the grid is too large for the driver: at most " + std::to_string(most) +
               " samples along x and y";
    return;
  }
  const bool is_evaluated = method == FieldMethod::kFragments;
  if (is_evaluated && sites.site.size() / kSitesInRow >= static_cast<std::size_t>(most)) {
    problem_ = "too many sites for the driver: at most " + std::to_string(most * kSitesInRow);
    return;
  }
  const std::string fragment = std::string(kFragmentHead) + (is_evaluated ? kEvaluated : kAffine);
  program_ = link_program(gl, kVertexShader, fragment.c_str(), problem_);
  if (program_ == 0) return;
  const auto width = static_cast<GLsizei>(grid.size[0]),
             height = static_cast<GLsizei>(grid.size[1]);
  const auto target = [&](GLuint& texture, GLint format, GLenum data, GLenum type) {
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, data, type, nullptr);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  };
  target(ids_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT);
  target(depth_, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT);
  gl.GenFramebuffers(1, &framebuffer_);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, ids_, 0);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_, 0);
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    problem_ = "the driver has no framebuffer of 32-bit ids and depths";
    return;
  }
  gl.Viewport(0, 0, width, height);
  gl.Enable(GL_DEPTH_TEST);
  gl.Disable(GL_DITHER);
  gl.ClearDepth(1);
  sites_ = texel_texture(gl, is_evaluated ? site_texels(sites, frame, false) : std::vector<float>(),
                         kTexelsOfSite * kSitesInRow);
  gl.GenBuffers(1, &buffer_);
  gl.GenVertexArrays(1, &array_);
  gl.BindVertexArray(array_);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_);
  const auto stride = static_cast<GLsizei>(4 * PieceBuffer(method, frame).stride());
  const auto from = [](std::size_t word) { return reinterpret_cast<const void*>(4 * word); };
  gl.EnableVertexAttribArray(0);
  gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, stride, from(0));
  gl.EnableVertexAttribArray(1);
  gl.VertexAttribIPointer(1, 2, GL_UNSIGNED_INT, stride, from(2));
  for (GLuint k = 0; k < 3 && !is_evaluated; ++k) {
    gl.EnableVertexAttribArray(2 + k);
    gl.VertexAttribPointer(2 + k, 3, GL_FLOAT, GL_FALSE, stride, from(4 + 3 * k));
  }
  gl.UseProgram(program_);
  const auto place = [&](const char* name) { return gl.GetUniformLocation(program_, name); };
  gl.Uniform2f(place("pixels"), static_cast<float>(width), static_cast<float>(height));
  gl.Uniform2f(place("origin"), static_cast<float>(frame.scale * (grid.origin.x - frame.centre.x)),
               static_cast<float>(frame.scale * (grid.origin.y - frame.centre.y)));
  gl.Uniform2f(place("spacing"), static_cast<float>(frame.scale * grid.spacing.x),
               static_cast<float>(frame.scale * grid.spacing.y));
  gl.Uniform1i(place("sites"), 0);
  z_place_ = place("z");
  nearer_place_ = place("nearer");
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, sites_);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl.PixelStorei(GL_PACK_ROW_LENGTH, width);
  gl.Enable(GL_SCISSOR_TEST);
}

GlRaster::~GlRaster() {
  if (!queries_.empty()) {
    gl_.DeleteQueries(static_cast<GLsizei>(queries_.size()), queries_.data());
  }
  gl_.DeleteFramebuffers(1, &framebuffer_);
  for (const GLuint texture : {ids_, depth_, sites_}) gl_.DeleteTextures(1, &texture);
  gl_.DeleteBuffers(1, &buffer_);
  gl_.DeleteVertexArrays(1, &array_);
  gl_.DeleteProgram(program_);
}

void GlRaster::begin_slice(double z) { begin_part(z, {0, 0}, {grid_.size[0], grid_.size[1]}); }

void GlRaster::begin_part(double z, const std::array<std::uint32_t, 2>& begin,
                          const std::array<std::uint32_t, 2>& end) {
  for (int axis = 0; axis < 2; ++axis) {
    begin_[axis] = static_cast<GLint>(begin[axis]);
    extent_[axis] = static_cast<GLsizei>(end[axis] - begin[axis]);
  }
  gl_.Scissor(begin_[0], begin_[1], extent_[0], extent_[1]);
  gl_.DepthMask(GL_TRUE);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  const GLuint none[4] = {kNoSite.value, 0, 0, 0};
  const GLfloat far = 1;
  gl_.ClearBufferuiv(GL_COLOR, 0, none);
  gl_.ClearBufferfv(GL_DEPTH, 0, &far);
  gl_.Uniform1f(z_place_, static_cast<float>(frame_.scale * (z - frame_.centre.z)));
}

void GlRaster::upload(const PieceBuffer& pieces) {
  const auto words = pieces.words();
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(4 * words.size()), words.data(),
                 GL_STREAM_DRAW);
}

void GlRaster::draw(const PieceBuffer& pieces) {
  if (pieces.corners() == 0) return;
  upload(pieces);
  gl_.DepthFunc(GL_LESS);
  gl_.Uniform1f(nearer_place_, 0);
  gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(pieces.corners()));
}

std::vector<std::uint8_t> GlRaster::visible(const PieceBuffer& pieces,
                                            std::span<const std::size_t> ends, double nearer,
                                            bool writes) {
  std::vector<std::uint8_t> out(ends.size(), 0);
  if (pieces.corners() == 0) return out;
  upload(pieces);
  gl_.DepthFunc(writes ? GL_LESS : GL_LEQUAL);
  gl_.DepthMask(writes ? GL_TRUE : GL_FALSE);
  const GLboolean colours = writes ? GL_TRUE : GL_FALSE;
  gl_.ColorMask(colours, colours, colours, colours);
  gl_.Uniform1f(nearer_place_, static_cast<float>(frame_.scale * nearer));
  const std::size_t known = queries_.size();
  if (known < ends.size()) {
    queries_.resize(ends.size());
    gl_.GenQueries(static_cast<GLsizei>(ends.size() - known), queries_.data() + known);
  }
  std::size_t begin = 0;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    if (ends[k] > begin) {
      gl_.BeginQuery(GL_ANY_SAMPLES_PASSED, queries_[k]);
      gl_.DrawArrays(GL_TRIANGLES, static_cast<GLint>(begin),
                     static_cast<GLsizei>(ends[k] - begin));
      gl_.EndQuery(GL_ANY_SAMPLES_PASSED);
    }
    begin = ends[k];
  }
  begin = 0;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    if (ends[k] > begin) {
      GLuint any = 0;
      gl_.GetQueryObjectuiv(queries_[k], GL_QUERY_RESULT, &any);
      out[k] = any != 0;
    }
    begin = ends[k];
  }
  return out;
}

void GlRaster::read_ids(std::span<std::uint32_t> ids) {
  gl_.ReadPixels(begin_[0], begin_[1], extent_[0], extent_[1], GL_RED_INTEGER, GL_UNSIGNED_INT,
                 ids.data() + begin_[0] + std::size_t{grid_.size[0]} * begin_[1]);
}

void GlRaster::read_distances(std::span<double> distances) {
  std::vector<float> depth(distances.size());
  gl_.ReadPixels(0, 0, static_cast<GLsizei>(grid_.size[0]), static_cast<GLsizei>(grid_.size[1]),
                 GL_DEPTH_COMPONENT, GL_FLOAT, depth.data());
  for (std::size_t k = 0; k < depth.size(); ++k) {
    distances[k] = depth[k] >= 1 ? std::numeric_limits<double>::infinity()
                                 : std::sqrt(static_cast<double>(depth[k])) / frame_.scale;
  }
}

bool GlRaster::has_failed() const { return gl_.GetError() != GL_NO_ERROR; }

}  // namespace blum::detail
