#include "blum/gpu/feature_transform.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>

#include "blum/kernel/parallel.hpp"

namespace blum {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Squared distance to a feature and its number; compares as "is nearer, or as near and lower".
struct Candidate {
  double squared = kInfinity;
  std::uint64_t feature = kNoVoxel;
  friend bool operator<(const Candidate& a, const Candidate& b) {
    return a.squared < b.squared || (a.squared == b.squared && a.feature < b.feature);
  }
};

/// One row of one pass: from[p] + ((q - p) spacing)^2, minimised over p for every q.
class Envelope {
 public:
  void run(std::vector<Candidate>& row, double spacing) {
    spacing_ = spacing;
    from_ = row;
    place_.clear();
    start_.clear();
    const auto n = static_cast<std::int64_t>(row.size());
    for (std::int64_t p = 0; p < n; ++p) {
      if (from_[p].feature == kNoVoxel) continue;
      while (!place_.empty() && overtakes(p, place_.back(), n) <= start_.back()) {
        place_.pop_back();
        start_.pop_back();
      }
      const std::int64_t start = place_.empty() ? 0 : overtakes(p, place_.back(), n);
      if (start < n) {
        place_.push_back(p);
        start_.push_back(start);
      }
    }
    std::size_t k = 0;
    for (std::int64_t q = 0; q < n && !place_.empty(); ++q) {
      while (k + 1 < place_.size() && start_[k + 1] <= q) ++k;
      row[q] = at(place_[k], q);
    }
  }

 private:
  [[nodiscard]] Candidate at(std::int64_t p, std::int64_t q) const {
    const double d = static_cast<double>(q - p) * spacing_;
    return {from_[p].squared + d * d, from_[p].feature};
  }
  /// First q in [0, n] from which on p is better than the earlier p0: their difference is monotone.
  [[nodiscard]] std::int64_t overtakes(std::int64_t p, std::int64_t p0, std::int64_t n) const {
    std::int64_t lo = 0, hi = n;
    const double guess = 0.5 * static_cast<double>(p + p0) +
                         (from_[p].squared - from_[p0].squared) /
                             (2 * spacing_ * spacing_ * static_cast<double>(p - p0));
    // The guess is nearly always right to one place; bisection covers the rest.
    if (guess > 2 && guess < static_cast<double>(n) - 2) {
      const auto near = static_cast<std::int64_t>(guess);
      if (!(at(p, near - 1) < at(p0, near - 1))) lo = near;
      if (at(p, near + 2) < at(p0, near + 2)) hi = near + 2;
    }
    while (lo < hi) {
      const std::int64_t middle = lo + (hi - lo) / 2;
      if (at(p, middle) < at(p0, middle)) {
        hi = middle;
      } else {
        lo = middle + 1;
      }
    }
    return lo;
  }

  double spacing_ = 1;
  std::vector<Candidate> from_;
  std::vector<std::int64_t> place_, start_;
};

}  // namespace

Result<FeatureTransform> feature_transform(const VoxelGrid& grid,
                                           std::span<const std::uint8_t> is_feature, int threads,
                                           const std::function<bool(double)>& on_progress) {
  const auto bad = [](std::string what) {
    return Error{ErrorCode::kBadArgument, std::move(what), {}, {}};
  };
  if (std::string problem = grid_problem(grid); !problem.empty()) return bad(std::move(problem));
  if (threads < 1) return bad("fewer than one thread");
  // Squares of smaller ones would lose digits; grid_problem has refused the great ones.
  if (std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z}) < 0x1p-400) {
    return bad("a spacing below 2^-400");
  }
  if (is_feature.size() != grid.voxels()) return bad("the image has another size than the grid");
  if (std::ranges::all_of(is_feature, [](std::uint8_t f) { return f == 0; })) {
    return bad("the image has no feature");
  }
  std::vector<Candidate> best(grid.voxels());
  for (std::size_t v = 0; v < best.size(); ++v) {
    if (is_feature[v] != 0) best[v] = {0, v};
  }
  const std::array<std::size_t, 3> stride = {1, grid.size[0],
                                             std::size_t{grid.size[0]} * grid.size[1]};
  const std::size_t slabs = std::size_t{grid.size[2]} + grid.size[2] + grid.size[1];
  std::atomic<std::size_t> done{0};
  std::atomic<bool> goes_on{true};
  for (int axis = 0; axis < 3; ++axis) {
    const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    for_each_in_parallel(threads, grid.size[v], [&](int, std::size_t b) {
      if (!goes_on) return;
      Envelope envelope;
      std::vector<Candidate> row(grid.size[axis]);
      for (std::size_t a = 0; a < grid.size[u]; ++a) {
        const std::size_t first = a * stride[u] + b * stride[v];
        for (std::size_t q = 0; q < row.size(); ++q) row[q] = best[first + q * stride[axis]];
        envelope.run(row, grid.spacing[axis]);
        for (std::size_t q = 0; q < row.size(); ++q) best[first + q * stride[axis]] = row[q];
      }
      const auto part = static_cast<double>(++done) / static_cast<double>(slabs);
      if (on_progress && !on_progress(part)) goes_on = false;
    });
  }
  if (!goes_on) return Error{ErrorCode::kInterrupted, "interrupted", {}, {}};
  FeatureTransform out;
  out.feature.reserve(best.size());
  out.distance.reserve(best.size());
  for (const Candidate& c : best) {
    out.feature.push_back(c.feature);
    out.distance.push_back(std::sqrt(c.squared));
  }
  return out;
}

std::uint64_t feature_transform_bytes(const VoxelGrid& grid) {
  return (sizeof(Candidate) + sizeof(std::uint64_t) + sizeof(double)) * grid.voxels();
}

}  // namespace blum
