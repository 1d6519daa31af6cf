#include "leaf_surface.hpp"

#include <algorithm>
#include <set>

#include "blum/kernel/check.hpp"

namespace blum {

void LeafSurface::add(const FaceDiagram& diagram) {
  last_ = &diagram;
  base_ = piece_.size();
  for (const FaceRegion& r : diagram.region) {
    piece_.add();
    label_.push_back(r.labels);
  }
}

void LeafSurface::add_arc(const FaceArc& arc, const std::array<std::uint32_t, 2>& node) {
  SphereArc a;
  a.node = node;
  for (const std::size_t k : {0, 1})
    if (arc.region[k] != FaceArc::kUnknown) a.piece[k] = base_ + arc.region[k];
  arc_.push_back(a);
}

void LeafSurface::add_part(const Part& part, int side, std::size_t passed, std::size_t ties) {
  const auto& regions = last_->side_region[side];
  BLUM_REQUIRE(passed + ties < regions.size());
  auto [it, fresh] = part_.try_emplace(part);
  for (std::size_t k = 0; k <= ties; ++k) {
    const auto r = base_ + regions[passed + k];
    if (fresh)
      it->second.push_back(r);
    else
      piece_.unite(it->second[k], r);
  }
}

std::optional<std::vector<Crossing>> LeafSurface::tube(std::span<const SiteId> labels) {
  for (SphereArc& a : arc_)
    for (auto& p : a.piece)
      if (p != SphereArc::kUnknown) p = piece_.find(p);
  std::set<std::uint32_t> end;
  for (std::uint32_t r = 0; r < label_.size(); ++r)
    if (std::ranges::any_of(label_[r],
                            [&](SiteId s) { return std::ranges::find(labels, s) != labels.end(); }))
      end.insert(piece_.find(r));
  if (end.size() != 2) return std::nullopt;
  return tube_crossings(arc_, *end.begin(), *end.rbegin());
}

}  // namespace blum
