#include "parts_cone_shape.hpp"

#include <algorithm>
#include <cstddef>

#include "blum/kernel/check.hpp"
#include "blum/kernel/union_find.hpp"

namespace blum::detail {

std::uint32_t BaseGraph::local_node(std::uint32_t vertex) {
  if (local_[vertex] == kNone) {
    local_[vertex] = static_cast<std::uint32_t>(node_.size());
    node_.push_back(vertex);
    degree_.push_back(0);
    half_xor_.push_back(0);
  }
  return local_[vertex];
}

void BaseGraph::read(std::span<const std::uint32_t> triangles) {
  for (const std::uint32_t vertex : node_) local_[vertex] = kNone;
  node_.clear();
  degree_.clear();
  half_xor_.clear();
  arc_.clear();
  for (const std::uint32_t t : triangles) {
    const auto& ends = complex_.edge[complex_.triangle[t].edge[0]].vertex;
    arc_.push_back({local_node(ends[0]), local_node(ends[1])});
    for (Half side = 0; side < 2; ++side) {
      const Half h = static_cast<Half>(2 * (arc_.size() - 1)) + side;
      ++degree_[tail(h)];
      half_xor_[tail(h)] ^= h;
    }
  }
}

bool BaseGraph::is_connected() const {
  UnionFind sets;
  sets.resize(static_cast<std::uint32_t>(node_.size()));
  for (const auto& ends : arc_) sets.unite(ends[0], ends[1]);
  for (std::uint32_t n = 1; n < node_.size(); ++n) {
    if (sets.find(n) != 0) return false;
  }
  return true;
}

void BaseGraph::suppress_degree_two() {
  long_arc_.clear();
  walked_.assign(2 * arc_.size(), false);
  for (Half start = 0; start < 2 * arc_.size(); ++start) {
    if (walked_[start] || degree_[tail(start)] == 2) continue;
    Half h = start;
    while (degree_[tail(h ^ 1)] == 2) h = half_xor_[tail(h ^ 1)] ^ (h ^ 1);
    walked_[start] = walked_[h ^ 1] = true;
    long_arc_.push_back({tail(start), tail(h ^ 1)});
  }
}

ConeShape BaseGraph::shape(bool at_boundary_vertex) {
  BLUM_CHECK(is_connected());
  suppress_degree_two();

  std::array<std::uint32_t, 4> branch{};  // the first nodes of degree other than 2
  std::size_t branches = 0;
  std::uint32_t lowest = kNone, highest = 0;  // their degrees
  for (std::uint32_t n = 0; n < node_.size(); ++n) {
    if (degree_[n] == 2) continue;
    if (branches < branch.size()) branch[branches] = n;
    ++branches;
    lowest = std::min(lowest, degree_[n]);
    highest = std::max(highest, degree_[n]);
  }

  const bool is_path = branches == 2 && highest == 1;
  if (is_path || node_.empty()) return ConeShape::kPath;
  if (at_boundary_vertex) return ConeShape::kBoundaryEnd;
  if (branches == 0) return ConeShape::kLoop;

  const bool has_loop = std::any_of(long_arc_.begin(), long_arc_.end(),
                                    [](const auto& ends) { return ends[0] == ends[1]; });
  if (branches == 2 && lowest >= 3 && !has_loop) return ConeShape::kSeam;

  if (branches == 4 && lowest == 3 && highest == 3 && !has_loop) {
    // Six arcs without loops that join six different pairs of four nodes: K4.
    std::array<bool, 16> joined{};
    std::size_t pairs = 0;
    for (const auto& ends : long_arc_) {
      const auto place = [&](std::uint32_t n) {
        return static_cast<std::size_t>(std::find(branch.begin(), branch.end(), n) -
                                        branch.begin());
      };
      const std::size_t a = place(ends[0]), b = place(ends[1]);
      bool& seen = joined[4 * std::min(a, b) + std::max(a, b)];
      pairs += seen ? 0 : 1;
      seen = true;
    }
    if (pairs == 6) return ConeShape::kJunction;
  }
  return ConeShape::kCluster;
}

}  // namespace blum::detail
