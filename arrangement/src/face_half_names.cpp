#include "face_half.hpp"

namespace blum {

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

/// Sites that certainly govern in the parts of regions that show on the border.
void FaceEngine::HalfMap::find_governors() {
  governors_.resize(runs_.size());
  for (std::uint32_t k = 0; k < runs_.size(); ++k) {
    auto& own = governors_[same_.find(k)];
    for (const auto e : runs_[k].elements) own.push_back(witness_.at(e));
    for (const auto t : runs_[k].traces) own.push_back(engine_.context_.geometry.index().face(t));
  }
}

/// A governor on each side of the arc, not the same for both. One that the whole's diagram names
/// may govern beyond the cut alone, unless the region lies wholly in the half.
bool FaceEngine::HalfMap::name_sides(Arc& a) {
  for (const auto n : {a.from, a.to})
    if (end_.contains(n) && id_[n] != kNone) {
      const auto& g = engine_.nodes_[id_[n]].node.governors;
      a.sites = {g.front(), g.back()};
      return true;
    }
  const auto& r = a.of->region;
  const std::array named = {a.of->left, a.of->right};
  const auto fits = [&](std::size_t first) {  // may the first of the names be that of side 0?
    return may_govern(named[first], r[0]) && may_govern(named[1 - first], r[1]);
  };
  for (const std::size_t k : {0u, 1u}) {
    if (a.run[k] == kNone) {
      if (r[0] != r[1] && fits(0) == fits(1)) return false;
      a.sites[k] = named[r[0] == r[1] || fits(0) ? k : 1 - k];
      continue;
    }
    const auto& own = governors_[same_.find(a.run[k])];
    const auto certain = [&](SiteId s) { return std::ranges::find(own, s) != own.end(); };
    a.sites[k] = certain(named[k]) ? named[k] : certain(named[1 - k]) ? named[1 - k] : own.front();
  }
  return a.sites[0] != a.sites[1];
}

}  // namespace blum
