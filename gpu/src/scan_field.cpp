#include "scan_field.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "block_cull.hpp"
#include "blum/kernel/parallel.hpp"
#include "scan_block.hpp"
#include "scan_sites.hpp"

namespace blum::detail {
namespace {

struct Task {
  CullNode node;
  std::vector<std::uint32_t> list;  // places in ScanSites; lists of many tasks exist at once
};

std::vector<Sphere> spheres_of(const ScanSites& sites, const std::vector<std::uint32_t>& list) {
  std::vector<Sphere> spheres;
  spheres.reserve(list.size());
  for (const std::uint32_t s : list) spheres.push_back(sites.sphere[s]);
  return spheres;
}

/// One thread's work on one task: down to blocks, depth first.
class Descent {
 public:
  Descent(const ScanSites& sites, const BlockCull& cull, bool culls, DistanceField& field)
      : sites_(sites), cull_(cull), culls_(culls), field_(field) {}

  void go(const Task& task) { descend(task.node, spheres_of(sites_, task.list), 0); }
  [[nodiscard]] const FieldStatistics& statistics() const { return statistics_; }

 private:
  void descend(const CullNode& node, const std::vector<Sphere>& list, std::size_t depth) {
    if (list.empty()) {
      statistics_.blocks += BlockCull::blocks_in(node);
      return;
    }
    if (BlockCull::is_block(node)) return scan(node, list);
    std::vector<CullNode> parts;
    BlockCull::split(node, parts);
    for (CullNode& part : parts) {
      // Nothing to gain from a single site.
      if (!culls_ || list.size() <= 1) {
        descend(part, list, depth);
        continue;
      }
      if (lists_.size() <= depth) lists_.emplace_back();
      std::vector<Sphere> kept = std::move(lists_[depth]);
      cull_.filter(part, list, kept, scratch_);
      statistics_.tree_tests += list.size();
      descend(part, kept, depth + 1);
      lists_[depth] = std::move(kept);
    }
  }

  void scan(const CullNode& node, const std::vector<Sphere>& unordered) {
    std::vector<Sphere>& list = ordered_;
    list = unordered;
    std::ranges::sort(list, {}, &Sphere::rank);
    const VoxelGrid& grid = field_.grid;
    const std::uint32_t nx = node.end[0] - node.begin[0];
    block_.ny = static_cast<int>(node.end[1] - node.begin[1]);
    block_.nz = static_cast<int>(node.end[2] - node.begin[2]);
    for (std::uint32_t i = 0; i < kBlock; ++i) {
      block_.x[i] = grid.coordinate(0, node.begin[0] + std::min(i, nx - 1));
    }
    for (int j = 0; j < block_.ny; ++j) block_.y[j] = grid.coordinate(1, node.begin[1] + j);
    for (int k = 0; k < block_.nz; ++k) block_.z[k] = grid.coordinate(2, node.begin[2] + k);
    std::fill_n(block_.squared, kBlock * kBlock * kBlock, std::numeric_limits<double>::infinity());
    scan_block(block_, sites_, list);

    is_owner_.assign(list.size(), 0);
    for (int k = 0; k < block_.nz; ++k) {
      for (int j = 0; j < block_.ny; ++j) {
        const std::size_t voxel = grid.index(node.begin[0], node.begin[1] + j, node.begin[2] + k);
        const int row = kBlock * (j + kBlock * k);
        for (std::uint32_t i = 0; i < nx; ++i) {
          const double distance = std::sqrt(block_.squared[row + i]);
          if (distance <= field_.band && distance < std::numeric_limits<double>::infinity()) {
            const auto place = static_cast<std::uint32_t>(block_.owner[row + i]);
            field_.distance[voxel + i] = distance;
            field_.site[voxel + i] = sites_.site[list[place].site].id;
            is_owner_[place] = 1;
          }
        }
      }
    }
    for (const std::uint8_t owns : is_owner_) statistics_.owner_sites += owns;
    ++statistics_.blocks;
    statistics_.block_sites += list.size();
    statistics_.fragments += std::uint64_t{nx} * block_.ny * block_.nz * list.size();
  }

  const ScanSites& sites_;
  const BlockCull& cull_;
  bool culls_;
  DistanceField& field_;
  FieldStatistics statistics_;
  std::vector<std::vector<Sphere>> lists_;
  std::vector<std::uint8_t> is_owner_;
  std::vector<Sphere> ordered_;
  std::vector<double> scratch_;
  Block block_;
};

/// Enough tasks for any number of threads; which they are depends on the grid alone.
std::vector<Task> make_tasks(const ScanSites& sites, const BlockCull& cull,
                             const FieldOptions& options, FieldStatistics& statistics) {
  constexpr std::size_t kTasks = 256;
  std::vector<Task> tasks(1);
  tasks[0].node = cull.root();
  tasks[0].list.resize(sites.site.size());
  std::iota(tasks[0].list.begin(), tasks[0].list.end(), 0u);
  while (tasks.size() < kTasks) {
    std::vector<Task> next;
    std::vector<std::size_t> parent;
    for (std::size_t t = 0; t < tasks.size(); ++t) {
      std::vector<CullNode> parts;
      BlockCull::split(tasks[t].node, parts);
      for (const CullNode& part : parts) {
        next.push_back({part, {}});
        parent.push_back(t);
      }
    }
    if (next.size() == tasks.size()) break;  // all are blocks
    for_each_in_parallel(options.threads, next.size(), [&](int, std::size_t k) {
      if (options.culling.blocks) {
        std::vector<double> scratch;
        std::vector<Sphere> kept;
        cull.filter(next[k].node, spheres_of(sites, tasks[parent[k]].list), kept, scratch);
        for (const Sphere& s : kept) next[k].list.push_back(s.site);
      } else {
        next[k].list = tasks[parent[k]].list;
      }
    });
    for (const std::size_t t : parent) statistics.tree_tests += tasks[t].list.size();
    tasks = std::move(next);
  }
  return tasks;
}

}  // namespace

bool scan_field(const SiteSet& set, const FieldOptions& options, DistanceField& field) {
  const ScanSites sites =
      make_scan_sites(set, field.grid.sample_box(), options.culling.domains, kDoubleUnit);
  const BlockCull cull(sites, field.grid, field.band);
  std::vector<Task> tasks = make_tasks(sites, cull, options, field.statistics);
  std::vector<FieldStatistics> statistics(tasks.size());
  std::atomic<std::size_t> done{0};
  std::atomic<bool> goes_on{true};
  for_each_in_parallel(options.threads, tasks.size(), [&](int, std::size_t k) {
    if (!goes_on) return;
    Descent descent(sites, cull, options.culling.blocks, field);
    descent.go(tasks[k]);
    statistics[k] = descent.statistics();
    tasks[k].list = {};
    const auto part = static_cast<double>(++done) / static_cast<double>(tasks.size());
    if (options.on_progress && !options.on_progress(part)) goes_on = false;
  });
  for (const FieldStatistics& s : statistics) field.statistics += s;
  // docs/fields.md: rounding of an evaluated distance, and what tightened conditions and thin
  // triangles left out can add. u = 2^-53.
  field.bound.above = 0x1p-48 * sites.reach;
  field.bound.below = 0x1p-45 * sites.reach + sites.dropped;
  field.bound.relative = 0x1p-51;
  field.bound.regret = field.bound.below + field.bound.above;
  return goes_on;
}

}  // namespace blum::detail
