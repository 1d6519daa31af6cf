#include "blum/gpu/nearest_sites.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

#include "block_cull.hpp"
#include "blum/kernel/parallel.hpp"
#include "sample_box.hpp"

namespace blum {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Box of a primitive: a lower bound of distances; its first corner: an upper one.
struct Extent {
  Box3 box;
  Point3 corner;
};

class Search {
 public:
  Search(const SiteSet& sites, const FieldOptions& options, NearestSites& out)
      : sites_(sites), options_(options), out_(out) {
    const Box3 samples = out.grid.sample_box();
    double reach = 0;
    for (int axis = 0; axis < 3; ++axis) {
      reach += std::max(samples.hi[axis], sites.box().hi[axis]) -
               std::min(samples.lo[axis], sites.box().lo[axis]);
    }
    slack_ = 0x1p-40 * reach;
    for (std::uint32_t s = 0; s < sites.primitives(); ++s) {
      Extent e;
      e.corner = sites.points()[sites.pieces(s)[0][0]];
      e.box = {e.corner, e.corner};
      for (const auto& piece : sites.pieces(s)) {
        for (const std::uint32_t v : piece) {
          for (int axis = 0; axis < 3; ++axis) {
            e.box.lo[axis] = std::min(e.box.lo[axis], sites.points()[v][axis]);
            e.box.hi[axis] = std::max(e.box.hi[axis], sites.points()[v][axis]);
          }
        }
      }
      extent_.push_back(e);
    }
  }

  bool run() {
    std::vector<detail::CullNode> nodes = {{{0, 0, 0}, out_.grid.size, 0}};
    for (int level = 0; level < 2; ++level) {
      std::vector<detail::CullNode> parts;
      for (const auto& node : nodes) detail::BlockCull::split(node, parts);
      nodes = std::move(parts);
    }
    std::vector<std::uint32_t> all(extent_.size());
    std::iota(all.begin(), all.end(), 0u);
    std::vector<double> widest(nodes.size(), 0);
    std::atomic<std::size_t> done{0};
    std::atomic<bool> goes_on{true};
    for_each_in_parallel(options_.threads, nodes.size(), [&](int, std::size_t k) {
      if (!goes_on) return;
      descend(nodes[k], all, widest[k]);
      const auto part = static_cast<double>(++done) / static_cast<double>(nodes.size());
      if (options_.on_progress && !options_.on_progress(part)) goes_on = false;
    });
    out_.bound.below = out_.bound.above = *std::ranges::max_element(widest);
    out_.bound.relative = 0x1p-51;
    return goes_on;
  }

 private:
  /// Of the box's samples, whatever can be among the `order` nearest.
  [[nodiscard]] std::vector<std::uint32_t> filter(const detail::CullNode& node,
                                                  const std::vector<std::uint32_t>& list) const {
    const detail::SampleBox box = detail::sample_box(node.begin, node.end, out_.grid);
    double limit = options_.band;
    if (list.size() > out_.order) {
      std::vector<double> far;
      far.reserve(list.size());
      for (const std::uint32_t s : list) {
        far.push_back(detail::farthest_squared(box, extent_[s].corner));
      }
      std::ranges::nth_element(far, far.begin() + (out_.order - 1));
      limit = std::min(limit, std::sqrt(far[out_.order - 1]));
    }
    limit += slack_;
    std::vector<std::uint32_t> kept;
    for (const std::uint32_t s : list) {
      if (detail::between_squared(box, extent_[s].box) <= limit * limit) kept.push_back(s);
    }
    return kept;
  }

  void descend(const detail::CullNode& node, const std::vector<std::uint32_t>& list,
               double& widest) {
    const bool culls = options_.culling.blocks && options_.backend != FieldBackend::kBrute;
    const std::vector<std::uint32_t> kept = culls ? filter(node, list) : list;
    if (detail::BlockCull::is_block(node)) return search(node, kept, widest);
    std::vector<detail::CullNode> parts;
    detail::BlockCull::split(node, parts);
    for (const auto& part : parts) descend(part, kept, widest);
  }

  void search(const detail::CullNode& node, const std::vector<std::uint32_t>& list,
              double& widest) {
    std::vector<std::pair<double, std::uint32_t>> by_distance(list.size());
    for (std::uint32_t k = node.begin[2]; k < node.end[2]; ++k) {
      for (std::uint32_t j = node.begin[1]; j < node.end[1]; ++j) {
        for (std::uint32_t i = node.begin[0]; i < node.end[0]; ++i) {
          const Point3 q = out_.grid.point(i, j, k);
          for (std::size_t n = 0; n < list.size(); ++n) {
            const SquaredDistanceBounds d = sites_.primitive_squared_distance(q, list[n]);
            by_distance[n] = {std::sqrt(d.hi), list[n]};
            widest = std::max(widest, by_distance[n].first - std::sqrt(d.lo));
          }
          const std::size_t found = std::min<std::size_t>(out_.order, list.size());
          std::ranges::partial_sort(by_distance,
                                    by_distance.begin() + static_cast<std::ptrdiff_t>(found));
          const std::size_t at = out_.order * out_.grid.index(i, j, k);
          for (std::size_t n = 0; n < found && by_distance[n].first <= options_.band; ++n) {
            out_.distance[at + n] = by_distance[n].first;
            out_.site[at + n] = by_distance[n].second;
          }
        }
      }
    }
  }

  const SiteSet& sites_;
  const FieldOptions& options_;
  NearestSites& out_;
  std::vector<Extent> extent_;
  double slack_ = 0;
};

}  // namespace

Result<NearestSites> nearest_sites(const SiteSet& sites, const VoxelGrid& grid, std::uint32_t order,
                                   const FieldOptions& options) {
  const auto bad = [](std::string what) {
    return Error{ErrorCode::kBadArgument, std::move(what), {}, {}};
  };
  if (std::string problem = grid_problem(grid); !problem.empty()) return bad(std::move(problem));
  if (std::string problem = options_problem(options); !problem.empty()) {
    return bad(std::move(problem));
  }
  if (is_opengl(options.backend)) return bad("OpenGL backends find the nearest site alone");
  if (order == 0 || order > 64) return bad("the order is not between 1 and 64");
  NearestSites out;
  out.grid = grid;
  out.order = order;
  out.site.assign(order * grid.voxels(), kNoSite.value);
  out.distance.assign(order * grid.voxels(), kInfinity);
  if (!Search(sites, options, out).run()) {
    return Error{ErrorCode::kInterrupted, "interrupted", {}, {}};
  }
  return out;
}

}  // namespace blum
