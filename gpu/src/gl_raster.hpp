/// One slice of a field on a framebuffer: ids behind a depth test.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gl_context.hpp"
#include "gl_data.hpp"

namespace blum::detail {

/// Requires the context to be current, at construction, calls and destruction.
class GlRaster {
 public:
  GlRaster(const GladGLContext& gl, const VoxelGrid& grid, const ScanSites& sites,
           const GlFrame& frame, FieldMethod method);
  ~GlRaster();
  GlRaster(const GlRaster&) = delete;
  GlRaster& operator=(const GlRaster&) = delete;

  /// What is wrong with the driver for this grid; empty if nothing.
  [[nodiscard]] const std::string& problem() const { return problem_; }
  /// GL_SUBPIXEL_BITS: corners move by at most half of 2^-bits pixels.
  [[nodiscard]] int subpixel_bits() const { return subpixel_bits_; }

  void begin_slice(double z);
  /// The same for a part of it: nothing else is touched until the next begin.
  void begin_part(double z, const std::array<std::uint32_t, 2>& begin,
                  const std::array<std::uint32_t, 2>& end);
  /// In the order of the buffer; of equally near ones the first stays.
  void draw(const PieceBuffer& pieces);
  /// The same one range of corners after the other, each with an occlusion query: was any sample
  /// nearer than all before? `nearer` (model units) is taken off every distance; `writes` false
  /// leaves the slice as it is and counts equal distances as visible.
  [[nodiscard]] std::vector<std::uint8_t> visible(const PieceBuffer& pieces,
                                                  std::span<const std::size_t> ends, double nearer,
                                                  bool writes);
  /// Of the slice, or the part of it: `ids` is the whole slice either way.
  void read_ids(std::span<std::uint32_t> ids);
  /// Model units, as the shaders computed them; infinity where nothing was drawn.
  void read_distances(std::span<double> distances);
  /// Anything that OpenGL complained of.
  [[nodiscard]] bool has_failed() const;

 private:
  void upload(const PieceBuffer& pieces);

  const GladGLContext& gl_;
  VoxelGrid grid_;
  GlFrame frame_;
  std::string problem_;
  int subpixel_bits_ = 0;
  std::array<GLint, 2> begin_{};
  std::array<GLsizei, 2> extent_{};
  GLuint program_ = 0, framebuffer_ = 0, ids_ = 0, depth_ = 0, sites_ = 0, buffer_ = 0, array_ = 0;
  GLint z_place_ = -1, nearer_place_ = -1;
  std::vector<GLuint> queries_;
};

}  // namespace blum::detail
