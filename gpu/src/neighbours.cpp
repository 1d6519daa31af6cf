#include "blum/gpu/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace blum {
namespace {

/// Calls visit(neighbour) for each of the up to 26 neighbours, or for those numbered higher.
template <class Visit>
void for_neighbours(const VoxelGrid& grid, std::size_t voxel, bool only_higher, Visit&& visit) {
  const auto p = grid.position(voxel);
  const auto begin = [&](int axis) { return p[axis] == 0 ? 0u : p[axis] - 1; };
  const auto end = [&](int axis) { return std::min(p[axis] + 2, grid.size[axis]); };
  for (std::uint32_t k = only_higher ? p[2] : begin(2); k < end(2); ++k) {
    for (std::uint32_t j = begin(1); j < end(1); ++j) {
      for (std::uint32_t i = begin(0); i < end(0); ++i) {
        const std::size_t other = grid.index(i, j, k);
        if (other != voxel && !(only_higher && other < voxel)) visit(other);
      }
    }
  }
}

class PairSet {
 public:
  void add(std::uint32_t a, std::uint32_t b) {
    if (a == b || a == kNoSite.value || b == kNoSite.value) return;
    if (a > b) std::swap(a, b);
    const std::uint64_t key = std::uint64_t{a} << 32 | b;
    if (key == last_) return;  // one after the other, mostly
    last_ = key;
    pairs_.insert(key);
  }
  [[nodiscard]] std::vector<SitePair> sorted() const {
    std::vector<SitePair> out;
    out.reserve(pairs_.size());
    for (const std::uint64_t key : pairs_) {
      out.push_back({static_cast<std::uint32_t>(key >> 32), static_cast<std::uint32_t>(key)});
    }
    std::ranges::sort(out);
    return out;
  }

 private:
  std::unordered_set<std::uint64_t> pairs_;
  std::uint64_t last_ = 0;
};

bool is_boundary(const DistanceField& field, std::size_t voxel) {
  bool differs = false;
  for_neighbours(field.grid, voxel, false,
                 [&](std::size_t other) { differs |= field.site[other] != field.site[voxel]; });
  return differs;
}

}  // namespace

std::vector<std::size_t> boundary_voxels(const DistanceField& field) {
  std::vector<std::size_t> out;
  for (std::size_t v = 0; v < field.site.size(); ++v) {
    if (is_boundary(field, v)) out.push_back(v);
  }
  return out;
}

std::vector<SitePair> neighbour_pairs(const DistanceField& field) {
  PairSet pairs;
  for (std::size_t v = 0; v < field.site.size(); ++v) {
    for_neighbours(field.grid, v, true,
                   [&](std::size_t other) { pairs.add(field.site[v], field.site[other]); });
  }
  return pairs.sorted();
}

BoundaryWalk walk_boundary(const DistanceField& field, std::span<const std::size_t> seeds) {
  BoundaryWalk walk;
  PairSet pairs;
  std::vector<bool> is_seen(field.site.size(), false);
  std::vector<std::size_t> waiting;
  const auto see = [&](std::size_t voxel) {
    if (is_seen[voxel]) return;
    is_seen[voxel] = true;
    waiting.push_back(voxel);
  };
  for (const std::size_t seed : seeds) see(seed);
  while (!waiting.empty()) {
    const std::size_t v = waiting.back();
    waiting.pop_back();
    ++walk.visited;
    if (!is_boundary(field, v)) continue;
    walk.boundary.push_back(v);
    for_neighbours(field.grid, v, false, [&](std::size_t other) {
      pairs.add(field.site[v], field.site[other]);
      see(other);
    });
  }
  std::ranges::sort(walk.boundary);
  walk.pairs = pairs.sorted();
  return walk;
}

}  // namespace blum
