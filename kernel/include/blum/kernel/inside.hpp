/// Is a point inside the solid? Exact for every point with double coordinates.
#pragma once

#include <cstdint>
#include <memory>

#include "blum/kernel/point.hpp"
#include "blum/kernel/solid.hpp"

namespace blum {

/// Casts a ray in +z through a grid over the (x, y) plane that lists the triangles of each column.
/// A ray through a projected vertex or edge is decided by symbolic perturbation: (x, y) stands for
/// (x + t, y + t^2) with t infinitesimal, after the exact test that the point is not on the
/// boundary. Copies what it needs of the solid; cheap to copy; queries
/// are const and safe from many threads.
class InsideOracle {
 public:
  enum class Where : std::uint8_t { kOutside, kInside, kBoundary };

  explicit InsideOracle(const Solid& solid);

  /// Requires: finite coordinates, in the solid's working frame.
  [[nodiscard]] Where locate(const Point3& working_point) const;

  /// Brute-force twin: all triangles, no grid, exact arithmetic alone.
  [[nodiscard]] Where locate_brute_force(const Point3& working_point) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace blum
