// The z-buffer against a plain computation for every sample.

#include "raster.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace blum::detail {
namespace {

constexpr int kWidth = 24, kRows = 18;

RasterVertex vertex(double x, double y, double depth, float grey) {
  RasterVertex v;
  v.x = x;
  v.y = y;
  v.inverse_depth = 1 / depth;
  v.colour = {grey, grey, grey};
  return v;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(engine_);
  }

 private:
  std::mt19937 engine_;
};

RasterTriangle random_triangle(Random& random, float grey) {
  RasterTriangle t;
  const double margin = 8;
  for (RasterVertex& v : t) {
    v = vertex(random(-margin, kWidth + margin), random(-margin, kRows + margin), random(1, 9),
               grey);
  }
  return t;
}

/// 1 / depth at a point, 0 where the triangle is not.
double inverse_depth_at(const RasterTriangle& t, double x, double y) {
  const auto side = [&](int i, int j) {
    return (t[j].x - t[i].x) * (y - t[i].y) - (t[j].y - t[i].y) * (x - t[i].x);
  };
  const double a = side(1, 2), b = side(2, 0), c = side(0, 1), sum = a + b + c;
  if (sum == 0 || a / sum <= 0 || b / sum <= 0 || c / sum <= 0) return 0;
  return (a * t[0].inverse_depth + b * t[1].inverse_depth + c * t[2].inverse_depth) / sum;
}

TEST(Raster, RandomTriangles_TheNearestIsSeenAndTranslucentOnesMixInOrder) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    Random random(seed);
    std::vector<RasterTriangle> opaque, clear;
    for (int i = 0; i < 4; ++i) {
      opaque.push_back(random_triangle(random, static_cast<float>(random(0, 1))));
      clear.push_back(random_triangle(random, static_cast<float>(random(0, 1))));
    }
    Raster raster(kWidth, 0, kRows);
    for (const auto& t : opaque) raster.opaque(t);
    for (const auto& t : clear) raster.translucent(t, 0.25F);
    std::size_t hit = 0;
    const std::vector<Rgb> pixel = raster.finish({1, 1, 1}, hit);

    std::size_t expected_hit = 0;
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        double sum = 0;
        for (int s = 0; s < Raster::kSide * Raster::kSide; ++s) {
          const double px = x + (s % Raster::kSide + 0.5) / Raster::kSide;
          const double py = y + (s / Raster::kSide + 0.5) / Raster::kSide;
          double grey = 1, nearest = 0;
          for (const auto& t : opaque) {
            const double d = inverse_depth_at(t, px, py);
            if (d > nearest) {
              nearest = d;
              grey = t[0].colour.r;
            }
          }
          std::vector<std::pair<double, float>> over;
          for (const auto& t : clear) {
            const double d = inverse_depth_at(t, px, py);
            if (d > nearest) over.emplace_back(d, t[0].colour.r);
          }
          std::sort(over.begin(), over.end());
          for (const auto& [depth, colour] : over) grey += 0.25 * (colour - grey);
          if (nearest > 0 || !over.empty()) ++expected_hit;
          sum += grey;
        }
        EXPECT_NEAR(pixel[y * kWidth + x].r, sum / (Raster::kSide * Raster::kSide), 1e-4)
            << seed << ": " << x << ' ' << y;
      }
    }
    EXPECT_EQ(hit, expected_hit);
  }
}

/// Corners on samples, edges through samples: every sample is covered once.
TEST(Raster, FanOfTrianglesOnSamples_NoSampleTwiceOrMissed) {
  const auto at = [](int i, int j) {  // the middle of a sample
    return vertex((i + 0.5) / Raster::kSide, (j + 0.5) / Raster::kSide, 2, 0);
  };
  const int n = 24;
  const std::vector<RasterVertex> ring = {at(0, 0), at(12, 0), at(n, 0), at(n, 12),
                                          at(n, n), at(12, n), at(0, n), at(0, 12)};
  Raster raster(kWidth, 0, kRows);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    // Both orientations.
    const auto& a = ring[i];
    const auto& b = ring[(i + 1) % ring.size()];
    if (i % 2 == 0) raster.translucent({at(10, 7), a, b}, 0.5F);
    if (i % 2 == 1) raster.translucent({at(10, 7), b, a}, 0.5F);
  }
  std::size_t hit = 0;
  const std::vector<Rgb> pixel = raster.finish({1, 1, 1}, hit);
  EXPECT_EQ(hit, static_cast<std::size_t>(n) * n);  // top and left borders are the square's
  for (int y = 0; y + 1 < n / Raster::kSide; ++y) {
    for (int x = 0; x + 1 < n / Raster::kSide; ++x) {
      EXPECT_FLOAT_EQ(pixel[y * kWidth + x].r, 0.5F) << x << ' ' << y;
    }
  }
}

TEST(Raster, Bands_AreTheWhole) {
  Random random(5);
  std::vector<RasterTriangle> list;
  for (int i = 0; i < 12; ++i)
    list.push_back(random_triangle(random, 0.1F * static_cast<float>(i)));
  const auto drawn = [&](int first, int rows) {
    Raster raster(kWidth, first, rows);
    for (const auto& t : list) raster.opaque(t);
    std::size_t hit = 0;
    return raster.finish({1, 1, 1}, hit);
  };
  const std::vector<Rgb> whole = drawn(0, kRows);
  for (const auto& [first, rows] : {std::pair(0, 7), std::pair(7, 11)}) {
    const std::vector<Rgb> band = drawn(first, rows);
    for (std::size_t i = 0; i < band.size(); ++i) {
      EXPECT_EQ(band[i].r, whole[static_cast<std::size_t>(first) * kWidth + i].r);
    }
  }
}

}  // namespace
}  // namespace blum::detail
