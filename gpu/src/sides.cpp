#include "blum/gpu/sides.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "blum/kernel/inside.hpp"
#include "blum/kernel/parallel.hpp"

namespace blum {
namespace {

/// The solid's surface in model coordinates, which hold the samples exactly; the working frame may
/// not. (The oracle's arithmetic is exact in either.)
InsideOracle oracle_in_model_units(const Solid& solid) {
  Solid model;
  model.triangle = solid.triangle;
  model.point.reserve(solid.point.size());
  for (const Point3& p : solid.point) model.point.push_back(solid.frame.to_model(p));
  return InsideOracle(model);
}

FieldSide side_of(InsideOracle::Where where) {
  switch (where) {
    case InsideOracle::Where::kInside:
      return FieldSide::kInside;
    case InsideOracle::Where::kBoundary:
      return FieldSide::kBoundary;
    case InsideOracle::Where::kOutside:
      break;
  }
  return FieldSide::kOutside;
}

}  // namespace

FieldSides sides_of(const Solid& solid, const DistanceField& field, int threads) {
  const VoxelGrid& grid = field.grid;
  const InsideOracle oracle = oracle_in_model_units(solid);
  FieldSides sides;
  sides.side.resize(grid.voxels());
  std::vector<std::uint64_t> tests(grid.size[2], 0);
  for_each_in_parallel(threads, grid.size[2], [&](int, std::size_t k) {
    for (std::uint32_t j = 0; j < grid.size[1]; ++j) {
      const std::size_t row = grid.index(0, j, static_cast<std::uint32_t>(k));
      std::size_t known = row;
      for (std::size_t v = row; v < row + grid.size[0]; ++v) {
        // Both coordinates are doubles of one row: their difference is rounded once.
        const double apart = (grid.point(v).x - grid.point(known).x) * (1 + 0x1p-50);
        const bool is_same = v != row && sides.side[known] != FieldSide::kBoundary &&
                             std::max(field.interval(known).lo, field.interval(v).lo) > apart;
        if (is_same) {
          sides.side[v] = sides.side[known];
          // The sample that reaches farthest along the row is the one to go on from.
          if (field.interval(v).lo + apart > field.interval(known).lo) known = v;
          continue;
        }
        sides.side[v] = side_of(oracle.locate(grid.point(v)));
        ++tests[k];
        known = v;
      }
    }
  });
  sides.exact_tests = std::accumulate(tests.begin(), tests.end(), std::uint64_t{0});
  return sides;
}

FieldSides sides_of(const Result<Solid>& solid, const DistanceField& field, int threads) {
  if (solid) return sides_of(solid.value(), field, threads);
  FieldSides sides;
  sides.side.assign(field.grid.voxels(), FieldSide::kUndefined);
  sides.reason = solid.error().message;
  return sides;
}

double signed_distance(const DistanceField& field, const FieldSides& sides, std::size_t voxel) {
  switch (sides.side[voxel]) {
    case FieldSide::kOutside:
      return field.distance[voxel];
    case FieldSide::kInside:
      return -field.distance[voxel];
    case FieldSide::kBoundary:
      return 0;
    case FieldSide::kUndefined:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace blum
