/// Random and degenerate soups, and the comparison of a field with its brute-force twin.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "blum/gpu/field.hpp"
#include "blum/kernel/mesh.hpp"

namespace blum::test {

inline SiteSet sites_of(const Soup& soup) {
  auto sites = SiteSet::build(soup);
  EXPECT_TRUE(sites.ok()) << (sites.ok() ? "" : sites.error().message);
  return sites.value();
}

/// The box of the sites, larger by the fraction `border` on every side (and at least 1 wide).
inline VoxelGrid grid_around(const SiteSet& sites, std::array<std::uint32_t, 3> size,
                             double border = 0.25) {
  Box3 box = sites.box();
  for (int axis = 0; axis < 3; ++axis) {
    double more = border * (box.hi[axis] - box.lo[axis]);
    if (!(more > 0)) more = 0.5 * std::max(1.0, std::abs(box.lo[axis]));
    box.lo[axis] -= more;
    box.hi[axis] += more;
  }
  return make_grid(box, size).value();
}

inline DistanceField field_of(const SiteSet& sites, const VoxelGrid& grid,
                              FieldOptions options = {}) {
  auto field = compute_field(sites, grid, options);
  EXPECT_TRUE(field.ok()) << (field.ok() ? "" : field.error().message);
  return std::move(field).value();
}

inline DistanceField brute_of(const SiteSet& sites, const VoxelGrid& grid) {
  FieldOptions options;
  options.backend = FieldBackend::kBrute;
  return field_of(sites, grid, options);
}

/// What is wrong with `field`, given the brute-force twin: certified intervals that exclude each
/// other, owners that are certainly not nearest, samples without owner.
inline std::string difference(const SiteSet& sites, const DistanceField& field,
                              const DistanceField& brute) {
  for (std::size_t voxel = 0; voxel < field.site.size(); ++voxel) {
    const std::string at = "voxel " + std::to_string(voxel) + ": ";
    const DistanceInterval truth = brute.interval(voxel);
    const DistanceInterval interval = field.interval(voxel);
    if (interval.lo > truth.hi || truth.lo > interval.hi) {
      return at + "distance " + std::to_string(field.distance[voxel]) + " instead of " +
             std::to_string(brute.distance[voxel]);
    }
    if (field.site[voxel] == kNoSite.value) return at + "no owner";
    const double nearest =
        std::sqrt(sites.squared_distance(field.grid.point(voxel), field.site_at(voxel)).lo);
    if (nearest > interval.hi || nearest > truth.hi + field.bound.below + field.bound.above) {
      return at + "owner " + std::to_string(field.site[voxel]) + " instead of " +
             std::to_string(brute.site[voxel]);
    }
  }
  return {};
}

class RandomSoup {
 public:
  explicit RandomSoup(std::uint64_t seed) : random_(seed) {}

  /// In general position, or on a small integer lattice, where almost everything is degenerate.
  bool on_lattice = false;
  bool shares_points = true;  ///< half of the corners are points that are there already
  double sliver = 0;  ///< > 0: the third corners of triangles are that far from the first side

  Soup make(int points, int segments, int triangles) {
    Soup soup;
    for (int i = 0; i < points; ++i) soup.isolated.push_back(add(soup, any()));
    for (int i = 0; i < segments; ++i) {
      soup.segments.push_back({add(soup, any()), add(soup, any())});
    }
    for (int i = 0; i < triangles; ++i) {
      const Point3 a = any(), b = any();
      Point3 c = any();
      if (sliver > 0) {
        const double t = unit();
        for (int k = 0; k < 3; ++k) c[k] = a[k] + t * (b[k] - a[k]) + sliver * (c[k] - a[k]);
      }
      soup.polygons.push_back({add(soup, a), add(soup, b), add(soup, c)});
    }
    return soup;
  }

 private:
  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  Point3 any() {
    const auto one = [&] {
      return on_lattice ? static_cast<double>(std::uniform_int_distribution<int>(0, 3)(random_))
                        : 4 * unit();
    };
    const double x = one(), y = one(), z = one();
    return {x, y, z};
  }
  std::uint32_t add(Soup& soup, const Point3& p) {
    if (shares_points && sliver == 0 && !soup.points.empty() && unit() < 0.5) {
      return std::uniform_int_distribution<std::uint32_t>(
          0, static_cast<std::uint32_t>(soup.points.size()) - 1)(random_);
    }
    soup.points.push_back(p);
    return static_cast<std::uint32_t>(soup.points.size() - 1);
  }
  std::mt19937_64 random_;
};

}  // namespace blum::test
