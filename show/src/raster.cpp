#include "raster.hpp"

#include <algorithm>
#include <cmath>

namespace blum::detail {
namespace {

Rgb mixed(const Rgb& a, const Rgb& b, float t) {
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

/// Twice the signed area of (a, b, p).
double side(const RasterVertex& a, const RasterVertex& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

/// Whether samples exactly on the edge from a to b are the triangle's (top-left rule).
bool owns(const RasterVertex& a, const RasterVertex& b) {
  return a.y == b.y ? b.x > a.x : b.y < a.y;
}

}  // namespace

Raster::Raster(int width, int first_row, int rows)
    : width_(width * kSide), first_(first_row * kSide), rows_(rows * kSide) {
  const std::size_t samples = static_cast<std::size_t>(width_) * static_cast<std::size_t>(rows_);
  depth_.assign(samples, 0);
  colour_.assign(samples, {});
}

template <class Take>
void Raster::scan(const RasterTriangle& given, Take take) const {
  RasterTriangle t = given;
  for (RasterVertex& v : t) {
    v.x *= kSide;
    v.y = v.y * kSide - first_;
  }
  double area = side(t[0], t[1], t[2].x, t[2].y);
  if (area < 0) {
    std::swap(t[1], t[2]);
    area = -area;
  }
  if (!(area > 0)) return;
  const auto [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [top, bottom] = std::minmax({t[0].y, t[1].y, t[2].y});
  if (!(right >= 0 && left <= width_ && bottom >= 0 && top <= rows_)) return;
  const int x0 = static_cast<int>(std::max(0.0, std::floor(left - 0.5)));
  const int x1 = static_cast<int>(std::min<double>(width_ - 1, std::ceil(right - 0.5)));
  const int y0 = static_cast<int>(std::max(0.0, std::floor(top - 0.5)));
  const int y1 = static_cast<int>(std::min<double>(rows_ - 1, std::ceil(bottom - 0.5)));
  const std::array<bool, 3> owned = {owns(t[1], t[2]), owns(t[2], t[0]), owns(t[0], t[1])};
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      std::array<double, 3> w = {side(t[1], t[2], px, py), side(t[2], t[0], px, py),
                                 side(t[0], t[1], px, py)};
      bool is_inside = true;
      for (int k = 0; k < 3; ++k) is_inside &= w[k] > 0 || (w[k] == 0 && owned[k]);
      if (!is_inside) continue;
      double inverse = 0, clip = 0;
      for (int k = 0; k < 3; ++k) {
        w[k] *= t[k].inverse_depth / area;  // weights in space, up to a factor
        inverse += w[k];
        clip += w[k] * t[k].clip;
      }
      if (clip < 0) continue;
      Rgb c;
      for (int k = 0; k < 3; ++k) {
        const auto share = static_cast<float>(w[k] / inverse);
        c.r += share * t[k].colour.r;
        c.g += share * t[k].colour.g;
        c.b += share * t[k].colour.b;
      }
      take(static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x),
           static_cast<float>(inverse), c);
    }
  }
}

void Raster::opaque(const RasterTriangle& t) {
  scan(t, [this](std::size_t sample, float depth, const Rgb& colour) {
    if (depth <= depth_[sample]) return;
    depth_[sample] = depth;
    colour_[sample] = colour;
  });
}

void Raster::translucent(const RasterTriangle& t, float alpha) {
  scan(t, [this, alpha](std::size_t sample, float depth, const Rgb& colour) {
    if (depth <= depth_[sample]) return;
    fragment_.push_back({static_cast<std::uint32_t>(sample), depth, colour, alpha});
  });
}

std::vector<Rgb> Raster::finish(const Rgb& background, std::size_t& hit) {
  std::vector<bool> is_hit(depth_.size());
  for (std::size_t i = 0; i < depth_.size(); ++i) {
    is_hit[i] = depth_[i] > 0;
    if (!is_hit[i]) colour_[i] = background;
  }
  std::stable_sort(fragment_.begin(), fragment_.end(), [](const Fragment& a, const Fragment& b) {
    return a.sample != b.sample ? a.sample < b.sample : a.depth < b.depth;
  });
  for (const Fragment& f : fragment_) {
    colour_[f.sample] = mixed(colour_[f.sample], f.colour, f.alpha);
    is_hit[f.sample] = true;
  }
  hit += static_cast<std::size_t>(std::count(is_hit.begin(), is_hit.end(), true));
  const std::size_t width = static_cast<std::size_t>(width_) / kSide,
                    rows = static_cast<std::size_t>(rows_) / kSide;
  std::vector<Rgb> pixel(width * rows);
  constexpr float kShare = 1.0F / (kSide * kSide);
  for (std::size_t i = 0; i < colour_.size(); ++i) {
    const std::size_t y = i / static_cast<std::size_t>(width_) / kSide,
                      x = i % static_cast<std::size_t>(width_) / kSide;
    Rgb& p = pixel[y * width + x];
    p = {p.r + kShare * colour_[i].r, p.g + kShare * colour_[i].g, p.b + kShare * colour_[i].b};
  }
  return pixel;
}

}  // namespace blum::detail
