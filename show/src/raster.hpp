/// A z-buffer for triangles, with translucent ones in order of depth.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace blum::detail {

/// Colours are linear mixes of sRGB values from 0 to 1, as browsers mix them.
struct Rgb {
  float r = 0, g = 0, b = 0;
};

struct RasterVertex {
  double x = 0, y = 0;       ///< pixels, y downwards
  double inverse_depth = 0;  ///< 1 / depth: linear on the screen; larger is nearer
  Rgb colour;
  double clip = 1;  ///< negative: cut away
};
using RasterTriangle = std::array<RasterVertex, 3>;

/// Samples kSide x kSide a pixel. Samples on a common edge of two triangles belong to one of them.
class Raster {
 public:
  static constexpr int kSide = 3;

  /// Rows [first_row, first_row + rows) of a picture.
  Raster(int width, int first_row, int rows);

  void opaque(const RasterTriangle& t);
  /// After all opaque ones. alpha in (0, 1).
  void translucent(const RasterTriangle& t, float alpha);
  /// Mixes what is translucent; returns width * rows colours, and how many samples were hit.
  std::vector<Rgb> finish(const Rgb& background, std::size_t& hit);

 private:
  struct Fragment {
    std::uint32_t sample;
    float depth;
    Rgb colour;
    float alpha;
  };
  template <class Take>
  void scan(const RasterTriangle& t, Take take) const;

  int width_, first_, rows_;
  std::vector<float> depth_;  ///< inverse: 0 is infinitely far
  std::vector<Rgb> colour_;
  std::vector<Fragment> fragment_;
};

}  // namespace blum::detail
