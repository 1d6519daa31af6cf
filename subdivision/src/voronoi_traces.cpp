#include "voronoi_traces.hpp"

#include "box_edges.hpp"
#include "voronoi_intervals.hpp"

namespace blum {

TraceChains::TraceChains(const SiteGeometry& geometry, VoronoiSurface& surface,
                         const VoronoiSurface::Faces& face, SiteId triangle,
                         const SitePlace& place) {
  chain_.resize(6);
  only_.fill(kNone);
  crossing_.fill(kNone);
  for (int f = 0; f < 6; ++f) {
    on_face_[f] = (place.crossed >> f & 1) != 0;
    for (std::uint32_t r = 0; r < face[f]->region.size(); ++r) {
      if (face[f]->region[r].labels.front() != triangle) continue;
      const auto piece = surface.piece(surface.region(f, r));
      only_[f] = only_[f] == kNone || only_[f] == piece ? piece : kSeveral;
    }
  }
  for (const EdgePair& p : edge_pairs()) {
    const FaceDiagram& d = *face[p.face[0]];
    for (const EdgeInterval& i : intervals(*d.side[p.side[0]])) {
      const auto region = d.side_region[p.side[0]][i.index];
      if (d.region[region].labels.front() != triangle || !crosses_plane(geometry, triangle, i))
        continue;
      chain_.unite(static_cast<std::uint32_t>(p.face[0]), static_cast<std::uint32_t>(p.face[1]));
      for (const int f : p.face) {
        on_face_[f] = true;
        crossing_[f] = surface.piece(surface.region(p.face[0], region));
      }
    }
  }
  // All chains end on faces that the border crosses, and no two were united: as many as there are
  // means that none is in parts.
  int n = 0;
  for (int f = 0; f < 6; ++f) n += on_face_[f] && first_of(f);
  known_ = n == place.traces;
}

bool TraceChains::first_of(int f) {
  for (int g = 0; g < f; ++g)
    if (on_face_[g] && chain(g) == chain(f)) return false;
  return true;
}

std::optional<std::uint32_t> TraceChains::piece(int f) {
  for (int g = 0; g < 6; ++g) {
    if (!on_face_[g] || chain(g) != chain(f)) continue;
    if (crossing_[g] != kNone) return crossing_[g];
    if (only_[g] != kNone && only_[g] != kSeveral) return only_[g];
  }
  return std::nullopt;
}

}  // namespace blum
