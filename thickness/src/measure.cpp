#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "blum/kernel/check.hpp"
#include "blum/kernel/parallel.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "blum/kernel/site_tree.hpp"
#include "blum/thickness/thickness.hpp"
#include "blum/thickness/touching_ball.hpp"
#include "partners.hpp"

namespace blum {
namespace {

constexpr double kMostSamples = 1e7;
/// Samples keep away from the borders of their parts by so much of their extent.
constexpr double kMargin = 0.05;

/// Numbers in (0, 1) that depend on nothing but their place (splitmix64).
double chance(std::uint64_t seed, std::uint64_t a, std::uint64_t b) {
  std::uint64_t z = seed * 0x9e3779b97f4a7c15U + a * 0xbf58476d1ce4e5b9U + b * 0x94d049bb133111ebU;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9U;
  z = (z ^ z >> 27) * 0x94d049bb133111ebU;
  z ^= z >> 31;
  return (static_cast<double>(z >> 11) + 0.5) * 0x1p-53;
}

/// A triangle in k^2 equal parts.
struct Lattice {
  std::array<Point3, 3> corner;  // working frame
  std::uint32_t k = 1;

  [[nodiscard]] Point3 at(std::uint32_t i, std::uint32_t j) const {
    const double u = static_cast<double>(i) / k, v = static_cast<double>(j) / k;
    return mixed(1 - u - v, u, v);
  }
  [[nodiscard]] Point3 mixed(double a, double b, double c) const {
    Point3 p;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = a * corner[0][axis] + b * corner[1][axis] + c * corner[2][axis];
    }
    return p;
  }
  [[nodiscard]] std::uint32_t index(std::uint32_t i, std::uint32_t j) const {
    return j * (k + 1) - j * (j - 1) / 2 + i;  // rows of k + 1, k, ... points
  }
};

Point3 inside(const std::array<Point3, 3>& part, std::uint64_t seed, std::uint64_t triangle,
              std::uint64_t number) {
  double u = chance(seed, triangle, 2 * number), v = chance(seed, triangle, 2 * number + 1);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  u = kMargin + (1 - 3 * kMargin) * u;
  v = kMargin + (1 - 3 * kMargin) * v;
  return part[0] + u * (part[1] - part[0]) + v * (part[2] - part[0]);
}

class Measurement {
 public:
  Measurement(const Solid& solid, const MedialResult& axis, const ThicknessOptions& options)
      : solid_(solid),
        axis_(axis),
        options_(options),
        unit_(solid.frame.length_to_model(1)),
        geometry_(solid),
        tree_(solid),
        partners_(solid, axis) {}

  Result<Thickness> run() {
    double wanted = 0;
    for (std::uint32_t t = 0; t < solid_.triangle.size(); ++t) {
      wanted += std::pow(side_count(t), 2);
    }
    if (!(wanted <= kMostSamples)) {
      return Error{ErrorCode::kBadArgument, "more than 10 million samples", "", std::nullopt};
    }
    for (std::uint32_t t = 0; t < solid_.triangle.size(); ++t) divide(t);
    const std::size_t count = result_.sample.size();
    constexpr std::size_t kBlock = 256;
    for_each_in_parallel(std::max(options_.threads, 1), (count + kBlock - 1) / kBlock,
                         [&](int, std::size_t block) {
                           const std::size_t end = std::min(count, (block + 1) * kBlock);
                           for (std::size_t i = block * kBlock; i < end; ++i) {
                             measure(result_.sample[i]);
                           }
                         });
    for (const ThicknessSample& s : result_.sample) {
      if (s.sheet < 0) ++result_.unknown_sheets;
      result_.largest_error = std::max(result_.largest_error, s.error);
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::array<Point3, 3> corners(std::uint32_t t) const {
    const auto& v = solid_.triangle[t].vertex;
    return {solid_.point[v[0]], solid_.point[v[1]], solid_.point[v[2]]};
  }
  [[nodiscard]] double area(std::uint32_t t) const {
    const auto c = corners(t);
    return length(cross(c[1] - c[0], c[2] - c[0])) / 2 * unit_ * unit_;
  }
  [[nodiscard]] double side_count(std::uint32_t t) const {
    return std::max(1.0, std::round(std::sqrt(area(t) * options_.density)));
  }

  void divide(std::uint32_t t) {
    const Lattice lattice{corners(t), static_cast<std::uint32_t>(side_count(t))};
    const std::uint32_t k = lattice.k;
    const auto first = static_cast<std::uint32_t>(result_.point.size());
    for (std::uint32_t j = 0; j <= k; ++j) {
      for (std::uint32_t i = 0; i + j <= k; ++i) {
        result_.point.push_back(solid_.frame.to_model(lattice.at(i, j)));
      }
    }
    const double share = area(t) / (static_cast<double>(k) * k);
    std::uint64_t number = 0;
    const auto add = [&](std::array<std::uint32_t, 2> a, std::array<std::uint32_t, 2> b,
                         std::array<std::uint32_t, 2> c) {
      ThicknessSample s;
      s.triangle = t;
      s.area = share;
      // In the working frame until it is measured.
      s.position = inside({lattice.at(a[0], a[1]), lattice.at(b[0], b[1]), lattice.at(c[0], c[1])},
                          options_.seed, t, number++);
      result_.sample.push_back(s);
      result_.part.push_back({first + lattice.index(a[0], a[1]), first + lattice.index(b[0], b[1]),
                              first + lattice.index(c[0], c[1])});
    };
    for (std::uint32_t j = 0; j < k; ++j) {
      for (std::uint32_t i = 0; i + j < k; ++i) {
        add({i, j}, {i + 1, j}, {i, j + 1});
        if (i + j + 2 <= k) add({i + 1, j}, {i + 1, j + 1}, {i, j + 1});
      }
    }
  }

  [[nodiscard]] bool counts(const ThicknessSample& s) const {
    const double theta = options_.theta_deg;
    if (s.sheet < 0) return s.angle_deg >= theta;
    const AngleInterval& angle = axis_.angles->sheet[static_cast<std::size_t>(s.sheet)];
    if (angle.lo >= theta) return true;
    // Where the interval does not decide, the ball itself is a point of the sheet.
    return angle.hi >= theta && s.angle_deg >= theta;
  }

  void measure(ThicknessSample& s) const {
    const TouchingBall ball =
        touching_ball(geometry_, tree_, s.triangle, s.position, partners_.of(s.triangle));
    const double lower = 2 * unit_ * ball.lower, upper = 2 * unit_ * ball.upper;
    s.thickness = 2 * unit_ * ball.radius;
    // unit_ is a power of two: only this subtraction and the sum in a reader's check round.
    s.error = std::max(upper - s.thickness, s.thickness - lower) * (1 + 0x1p-50);
    s.position = solid_.frame.to_model(s.position);
    s.opposite = solid_.frame.to_model(ball.foot);
    s.angle_deg = ball.angle_deg;
    s.sheet = partners_.sheet(s.triangle, ball.site, solid_.frame.to_model(ball.centre));
    s.counts = counts(s);
  }

  const Solid& solid_;
  const MedialResult& axis_;
  const ThicknessOptions& options_;
  double unit_;
  SiteGeometry geometry_;
  SiteTree tree_;
  detail::Partners partners_;
  Thickness result_;
};

}  // namespace

Result<Thickness> measure_thickness(const Solid& solid, const MedialResult& axis,
                                    const ThicknessOptions& options) {
  BLUM_CHECK(axis.angles.has_value());
  if (!(options.density > 0)) {
    return Error{ErrorCode::kBadArgument, "the density is not positive", "", std::nullopt};
  }
  if (!(options.theta_deg >= 0 && options.theta_deg <= 180)) {
    return Error{ErrorCode::kBadArgument, "theta is not in [0, 180]", "", std::nullopt};
  }
  return Measurement(solid, axis, options).run();
}

std::optional<std::size_t> thinnest(const Thickness& thickness) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < thickness.sample.size(); ++i) {
    const ThicknessSample& s = thickness.sample[i];
    if (s.counts && (!best || s.thickness < thickness.sample[*best].thickness)) best = i;
  }
  return best;
}

ThicknessHistogram histogram(const Thickness& thickness, std::size_t bins) {
  BLUM_REQUIRE(bins > 0);
  ThicknessHistogram result;
  result.area.assign(bins, 0);
  double most = 0;
  for (const ThicknessSample& s : thickness.sample) {
    if (s.counts) most = std::max(most, s.thickness);
  }
  result.bin_width = most / static_cast<double>(bins);
  if (!(result.bin_width > 0)) return result;
  for (const ThicknessSample& s : thickness.sample) {
    if (!s.counts) continue;
    const auto bin = static_cast<std::size_t>(s.thickness / result.bin_width);
    result.area[std::min(bin, bins - 1)] += s.area;
  }
  return result;
}

std::string histogram_csv(const ThicknessHistogram& histogram) {
  double all = 0;
  for (const double a : histogram.area) all += a;
  std::string text = "from,to,area,fraction\n";
  std::array<char, 160> line;
  for (std::size_t i = 0; i < histogram.area.size(); ++i) {
    const double a = histogram.area[i];
    std::snprintf(line.data(), line.size(), "%.9g,%.9g,%.9g,%.9g\n",
                  static_cast<double>(i) * histogram.bin_width,
                  static_cast<double>(i + 1) * histogram.bin_width, a, all > 0 ? a / all : 0);
    text += line.data();
  }
  return text;
}

}  // namespace blum
