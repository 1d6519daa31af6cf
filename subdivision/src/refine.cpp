#include "blum/subdivision/refine.hpp"

#include "blum/kernel/check.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "subdivider.hpp"

namespace blum {

Cell Subdivider::cell_of(const Leaf& leaf, std::uint32_t node, int depth, double fraction) {
  Cell cell;
  cell.node = node;
  cell.box = leaf.box;
  cell.depth = depth;
  cell.to_divide = true;
  cell.largest_diameter = fraction * diameter(leaf.box);
  cell.candidates = leaf.candidates;
  cell.triangles = leaf.triangles;
  cell.face = leaf.face;
  return cell;
}

std::optional<Cell> Subdivider::to_divide(const Cell& cell, const CellOutcome& outcome,
                                          int thread) const {
  const auto* leaf = std::get_if<Leaf>(&outcome);
  if (refinement_ == nullptr || !refinement_->fine_enough || leaf == nullptr || !leaf->has_axis ||
      leaf->theorem == LeafTheorem::kUndecided || cell.depth >= work_.options.max_depth)
    return std::nullopt;
  Leaf part = *leaf;
  part.box = cell.box;
  if (refinement_->fine_enough(part, thread)) return std::nullopt;
  return cell_of(part, cell.node, cell.depth, refinement_->next_fraction);
}

std::size_t Subdivider::undo_unfinished(const Subdivision& coarse,
                                        const std::vector<std::uint32_t>& roots) {
  std::vector<bool> waits(result_.node.size(), false);
  for (const Cell& cell : stack_) waits[cell.node] = true;
  std::size_t divided = 0;
  for (const auto root : roots) {
    bool finished = true;
    for (std::vector<std::uint32_t> nodes{root}; finished && !nodes.empty();) {
      const auto n = nodes.back();
      nodes.pop_back();
      const CellNode& node = result_.node[n];
      if (node.axis < 0) {
        finished = !waits[n] && result_.leaf[node.leaf].theorem != LeafTheorem::kUndecided;
        continue;
      }
      nodes.push_back(node.child);
      nodes.push_back(node.child + 1);
    }
    if (!finished) result_.node[root] = coarse.node[root];
    divided += result_.node[root].axis >= 0 ? 1 : 0;
  }
  return divided;
}

Result<Refined> Subdivider::run(const Subdivision& coarse, const Refinement& refinement) {
  BLUM_REQUIRE(refinement.fraction > 0 && refinement.fraction < 1 && refinement.next_fraction > 0 &&
               refinement.next_fraction < 1);
  add_root();
  stack_.clear();
  result_ = coarse;
  refinement_ = &refinement;
  work_.nodes = coarse.node.size();
  std::vector<std::uint32_t> node_of(coarse.leaf.size());
  for (std::uint32_t n = 0; n < coarse.node.size(); ++n)
    if (coarse.node[n].axis < 0) node_of[coarse.node[n].leaf] = n;
  double again = 0;
  std::vector<std::uint32_t> roots;
  for (const auto l : refinement.leaves) roots.push_back(node_of[l]);
  for (std::size_t k = roots.size(); k-- > 0;) {
    const CellNode& node = coarse.node[roots[k]];
    stack_.push_back(cell_of(coarse.leaf[node.leaf], roots[k], node.depth, refinement.fraction));
    again += volume(node.box) / root_volume_;
  }
  done_ = 1 - again;
  if (auto stopped = work_on_all()) return *stopped;
  Refined refined;
  refined.divided = undo_unfinished(coarse, roots);
  refined.subdivision = finished();
  return refined;
}

Result<Refined> refine(const SiteGeometry& geometry, const SubdivisionOptions& options,
                       EngineSet& engines, const Subdivision& coarse,
                       const Refinement& refinement) {
  return Subdivider(geometry, options, engines).run(coarse, refinement);
}

}  // namespace blum
