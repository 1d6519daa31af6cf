#include "blum/gpu/grid.hpp"

#include <cmath>

namespace blum {
namespace {

constexpr std::uint32_t kMostPerAxis = 1u << 20;
constexpr double kLargest = 0x1p200;

}  // namespace

double VoxelGrid::coordinate(int axis, std::uint32_t index) const {
  return origin[axis] + index * spacing[axis];
}

Point3 VoxelGrid::point(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
  return {coordinate(0, i), coordinate(1, j), coordinate(2, k)};
}

Point3 VoxelGrid::point(std::size_t voxel) const {
  const auto [i, j, k] = position(voxel);
  return point(i, j, k);
}

Box3 VoxelGrid::sample_box() const {
  return {point(0, 0, 0), point(size[0] - 1, size[1] - 1, size[2] - 1)};
}

std::string grid_problem(const VoxelGrid& grid) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    const std::uint32_t n = grid.size[axis];
    if (n == 0) return "the resolution along " + name + " is 0";
    if (n > kMostPerAxis) return "the resolution along " + name + " is above 2^20";
    if (!(grid.spacing[axis] > 0)) return "the box has no extent along " + name;
    const double first = grid.origin[axis], last = grid.coordinate(axis, n - 1);
    if (!(std::abs(first) <= kLargest && std::abs(last) <= kLargest)) {
      return "the box reaches beyond 2^200 along " + name;
    }
    // Samples are farthest apart, relative to their rounding, where they are smallest; so the ends
    // tell.
    if (n > 1 && (grid.coordinate(axis, 1) <= first || last <= grid.coordinate(axis, n - 2))) {
      return "neighbouring samples along " + name + " cannot be told apart";
    }
  }
  return {};
}

Result<VoxelGrid> make_grid(const Box3& box, std::array<std::uint32_t, 3> size) {
  VoxelGrid grid;
  grid.size = size;
  for (int axis = 0; axis < 3; ++axis) {
    grid.spacing[axis] = size[axis] == 0 ? 1 : (box.hi[axis] - box.lo[axis]) / size[axis];
    grid.origin[axis] = box.lo[axis] + 0.5 * grid.spacing[axis];
  }
  if (const std::string problem = grid_problem(grid); !problem.empty()) {
    return Error{ErrorCode::kBadArgument, problem, {}, {}};
  }
  return grid;
}

}  // namespace blum
