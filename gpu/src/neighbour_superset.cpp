#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "block_cull.hpp"
#include "blum/gpu/neighbours.hpp"
#include "blum/kernel/parallel.hpp"
#include "sample_box.hpp"

namespace blum {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Sites with their boxes, filtered down a hierarchy of blocks by d(s, site) <= d(s) + 2h.
class Collector {
 public:
  Collector(const SiteSet& sites, const VoxelGrid& grid) : sites_(sites), grid_(grid) {
    const Point3& w = grid.spacing;
    const Box3 samples = grid.sample_box();
    double reach = 0;
    for (int axis = 0; axis < 3; ++axis) {
      reach += std::max(samples.hi[axis], sites.box().hi[axis]) -
               std::min(samples.lo[axis], sites.box().lo[axis]);
    }
    // A voxel's diagonal, 2h; samples err by rounding, far below 2^-40 of everything's extent.
    reach_more_ = detail::length(w) * (1 + 0x1p-40) + 0x1p-40 * reach;
    for (std::uint32_t s = 0; s < sites.size(); ++s) add(s);
  }

  [[nodiscard]] std::vector<std::uint32_t> all() const {
    std::vector<std::uint32_t> list;
    for (std::uint32_t s = 0; s < sites_.size(); ++s) {
      if (box_[s].lo.x <= box_[s].hi.x) list.push_back(s);
    }
    return list;
  }

  void descend(const detail::CullNode& node, const std::vector<std::uint32_t>& list,
               std::vector<SitePair>& pairs) const {
    const detail::SampleBox box = detail::sample_box(node.begin, node.end, grid_);
    double limit = kInfinity;
    for (const std::uint32_t s : list) {
      limit = std::min(limit, detail::farthest_squared(box, point_[s]));
    }
    limit = std::sqrt(limit) + reach_more_;
    std::vector<std::uint32_t> kept;
    for (const std::uint32_t s : list) {
      if (detail::between_squared(box, box_[s]) <= limit * limit) kept.push_back(s);
    }
    if (detail::BlockCull::is_block(node)) return collect(node, kept, pairs);
    std::vector<detail::CullNode> parts;
    detail::BlockCull::split(node, parts);
    for (const detail::CullNode& part : parts) descend(part, kept, pairs);
  }

 private:
  void add(std::uint32_t s) {
    Box3 box = {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
    const auto include = [&](std::uint32_t v) {
      const Point3& p = sites_.points()[v];
      for (int axis = 0; axis < 3; ++axis) {
        box.lo[axis] = std::min(box.lo[axis], p[axis]);
        box.hi[axis] = std::max(box.hi[axis], p[axis]);
      }
      point_.back() = p;
    };
    point_.push_back({kInfinity, kInfinity, kInfinity});
    const std::uint32_t e = sites_.element({s});
    switch (sites_.kind({s})) {
      case SiteKind::kVertex:
        if (sites_.is_used(e)) include(e);
        break;
      case SiteKind::kEdge:
        for (const std::uint32_t v : sites_.edges()[e]) include(v);
        break;
      case SiteKind::kFace:
        for (const SiteSet::Triangle& t : sites_.triangles_of(e)) {
          for (const std::uint32_t v : t.point) include(v);
        }
        break;
    }
    box_.push_back(box);
  }

  void collect(const detail::CullNode& node, const std::vector<std::uint32_t>& list,
               std::vector<SitePair>& pairs) const {
    std::vector<SquaredDistanceBounds> d(list.size());
    std::vector<std::uint32_t> near, before;
    for (std::uint32_t k = node.begin[2]; k < node.end[2]; ++k) {
      for (std::uint32_t j = node.begin[1]; j < node.end[1]; ++j) {
        for (std::uint32_t i = node.begin[0]; i < node.end[0]; ++i) {
          const Point3 q = grid_.point(i, j, k);
          double least = kInfinity;
          for (std::size_t n = 0; n < list.size(); ++n) {
            d[n] = sites_.squared_distance(q, {list[n]});
            least = std::min(least, d[n].hi);
          }
          const double limit = std::sqrt(least) + reach_more_;
          near.clear();
          for (std::size_t n = 0; n < list.size(); ++n) {
            if (d[n].lo <= limit * limit) near.push_back(list[n]);
          }
          if (near == before) continue;  // as at the sample before
          for (std::size_t a = 0; a < near.size(); ++a) {
            for (std::size_t b = a + 1; b < near.size(); ++b) pairs.push_back({near[a], near[b]});
          }
          before = near;
        }
      }
    }
    std::ranges::sort(pairs);
    pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
  }

  const SiteSet& sites_;
  const VoxelGrid& grid_;
  double reach_more_ = 0;
  std::vector<Box3> box_;      // empty: no site
  std::vector<Point3> point_;  // one of each
};

}  // namespace

Result<std::vector<SitePair>> neighbour_superset(const SiteSet& sites, const VoxelGrid& grid,
                                                 int threads) {
  if (std::string problem = grid_problem(grid); !problem.empty()) {
    return Error{ErrorCode::kBadArgument, std::move(problem), {}, {}};
  }
  if (threads < 1) return Error{ErrorCode::kBadArgument, "fewer than one thread", {}, {}};
  const Collector collector(sites, grid);
  const std::vector<std::uint32_t> all = collector.all();
  std::vector<detail::CullNode> nodes = {{{0, 0, 0}, grid.size, kInfinity}};
  for (int level = 0; level < 2; ++level) {
    std::vector<detail::CullNode> parts;
    for (const auto& node : nodes) detail::BlockCull::split(node, parts);
    nodes = std::move(parts);
  }
  std::mutex mutex;
  std::vector<SitePair> pairs;
  for_each_in_parallel(threads, nodes.size(), [&](int, std::size_t k) {
    std::vector<SitePair> found;
    collector.descend(nodes[k], all, found);
    const std::lock_guard lock(mutex);
    pairs.insert(pairs.end(), found.begin(), found.end());
  });
  std::ranges::sort(pairs);
  pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
  return pairs;
}

}  // namespace blum
