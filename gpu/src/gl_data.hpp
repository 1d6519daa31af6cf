/// What shaders are given: sites and pieces, in floats.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "slice_pieces.hpp"

namespace blum::detail {

/// Model units to those of shaders: about the middle of everything, and at most 1/2 long.
struct GlFrame {
  Point3 centre;
  double scale = 1;  ///< a power of two
};
[[nodiscard]] GlFrame gl_frame(const ScanSites& sites, const SiteSet& set, const VoxelGrid& grid);

/// Carriers and own conditions as four floats each, 5 a site; `all`: all conditions, 2 + 8 a site.
[[nodiscard]] std::vector<float> site_texels(const ScanSites& sites, const GlFrame& frame,
                                             bool all);

/// Corners of the triangles of pieces, as the raster's shaders want them.
class PieceBuffer {
 public:
  PieceBuffer(FieldMethod method, const GlFrame& frame) : method_(method), frame_(frame) {}
  void clear() { words_.clear(), area_ = 0; }
  void add(const SlicePiece& piece, std::uint32_t place, std::uint32_t id);
  [[nodiscard]] std::span<const std::uint32_t> words() const { return words_; }
  [[nodiscard]] std::size_t corners() const { return words_.size() / stride(); }
  [[nodiscard]] std::size_t stride() const {  // words a corner
    return method_ == FieldMethod::kFragments ? 4 : 13;
  }
  [[nodiscard]] double area() const { return area_; }  ///< in pixels

 private:
  FieldMethod method_;
  GlFrame frame_;
  std::vector<std::uint32_t> words_;
  double area_ = 0;
};

}  // namespace blum::detail
