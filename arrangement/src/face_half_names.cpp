#include "face_half.hpp"

namespace blum {
namespace {

constexpr auto kNone = Breakpoint::kNone;

}  // namespace

/// Of the sites that may govern in a region of the whole, those that may in the half.
void FaceEngine::HalfMap::find_labels() {
  std::vector<LocalForm> forms;
  prune(engine_.context_.geometry, root_.candidates, engine_.range_of(root_), forms,
        &engine_.context_);
  labels_.resize(whole_.region.size());
  for (std::uint32_t r = 0; r < whole_.region.size(); ++r)
    for (const LocalForm& f : forms)
      if (may_govern(f.site, r)) labels_[r].push_back(f.site);
}

/// A site that governs in the region of the run.
SiteId FaceEngine::HalfMap::governor_in(const Run& run) const {
  return run.elements.empty() ? engine_.context_.geometry.index().face(run.traces.front())
                              : witness_.at(run.elements.front());
}

/// A governor on each side of the arc. One that the whole's diagram names may govern beyond the cut
/// alone.
bool FaceEngine::HalfMap::name_sides(Arc& a) const {
  for (const auto n : {a.from, a.to})
    if (end_.contains(n) && id_[n] != kNone) {
      const auto& g = engine_.nodes_[id_[n]].node.governors;
      a.sites = {g.front(), g.back()};
      return true;
    }
  const auto& r = a.of->region;
  const bool as_named = may_govern(a.of->left, r[0]) && may_govern(a.of->right, r[1]);
  a.sites = {as_named ? a.of->left : a.of->right, as_named ? a.of->right : a.of->left};
  for (const std::size_t k : {0u, 1u}) {
    const auto& labels = labels_[r[k]];
    if (std::ranges::find(labels, a.sites[k]) != labels.end()) continue;
    if (a.run[k] == kNone) return false;
    a.sites[k] = governor_in(runs_[a.run[k]]);
  }
  return true;
}

}  // namespace blum
