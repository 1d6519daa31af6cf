#include "voronoi_traces.hpp"

#include "box_edges.hpp"
#include "voronoi_intervals.hpp"

namespace blum {

std::optional<std::uint32_t> piece_on_face(VoronoiSurface& surface,
                                           const VoronoiSurface::Faces& face, SiteId site, int f) {
  std::optional<std::uint32_t> only;
  for (std::uint32_t r = 0; r < face[f]->region.size(); ++r) {
    if (face[f]->region[r].labels.front() != site) continue;
    const auto piece = surface.piece(surface.region(f, r));
    if (only && *only != piece) return std::nullopt;
    only = piece;
  }
  return only;
}

TraceChains::TraceChains(const SiteGeometry& geometry, VoronoiSurface& surface,
                         const VoronoiSurface::Faces& face, SiteId triangle,
                         const SitePlace& place) {
  chain_.resize(6);
  for (int f = 0; f < 6; ++f) {
    on_face_[f] = (place.crossed >> f & 1) != 0;
    piece_[f] = piece_on_face(surface, face, triangle, f);
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
        piece_[f] = surface.piece(surface.region(p.face[0], region));
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
    if (piece_[g]) return piece_[g];
  }
  return std::nullopt;
}

}  // namespace blum
