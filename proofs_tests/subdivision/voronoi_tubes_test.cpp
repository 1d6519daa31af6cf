// Accepted Voronoi cells against the flow, followed from points of their surfaces: pieces of one
// site between which it leads are one region's, so they are the ends of the cell's tube.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "blum/kernel/closest_point.hpp"
#include "blum/kernel/predicates.hpp"
#include "blum/subdivision/cell_test.hpp"
#include "blum/subdivision/run_watch.hpp"
#include "blum/subdivision/voronoi_surface.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// The one piece of a site on a face; kNone: none or several.
std::uint32_t piece_on(VoronoiSurface& surface, const Leaf& leaf, SiteId site, int f) {
  std::uint32_t only = kNone;
  const FaceDiagram& d = *leaf.face[f];
  for (std::uint32_t r = 0; r < d.region.size(); ++r) {
    if (d.region[r].labels.front() != site) continue;
    const auto piece = surface.piece(surface.region(f, r));
    if (only != kNone && only != piece) return kNone;
    only = piece;
  }
  return only;
}

/// Where the segment from x, on face `from`, to y leaves the box: a face, or 6 where it ends
/// inside; -1: at once, or near an edge of the box.
int exit_of(const Box3& box, const Point3& x, const Point3& y, int from) {
  double first = 1;
  int face = 6;
  for (int f = 0; f < 6; ++f) {
    const int k = f / 2;
    const double level = f % 2 == 0 ? box.lo[k] : box.hi[k], d = y[k] - x[k];
    if ((f % 2 == 0) != (d < 0) || d == 0) continue;
    if (f == from) return -1;
    const double t = (level - x[k]) / d;
    if (t < first) {
      first = t;
      face = f;
    }
  }
  if (face == 6) return 6;
  for (int k = 0; k < 3; ++k) {
    const double z = x[k] + first * (y[k] - x[k]), slack = 1e-9 * (box.hi[k] - box.lo[k]);
    if (k != face / 2 && !(z > box.lo[k] + slack && z < box.hi[k] - slack)) return -1;
  }
  return face;
}

/// A rectangle about the nodes beside a site's regions on a face.
Rect about(const FaceDiagram& d, SiteId site) {
  Rect r = d.rect;
  std::swap(r.u0, r.u1);
  std::swap(r.v0, r.v1);
  for (const FaceArc& a : d.arc)
    for (const auto region : a.region)
      if (d.region[region].labels.front() == site)
        for (const auto n : {a.from, a.to}) {
          r.u0 = std::min(r.u0, d.node[n].u0);
          r.u1 = std::max(r.u1, d.node[n].u1);
          r.v0 = std::min(r.v0, d.node[n].v0);
          r.v1 = std::max(r.v1, d.node[n].v1);
        }
  return r.u0 < r.u1 && r.v0 < r.v1 ? r : d.rect;
}

/// By the boxes about both.
bool may_meet(const SiteGeometry& geometry, SiteId site, const Box3& box) {
  int n = 0;
  const auto corner = geometry.corners(site, n);
  for (int k = 0; k < 3; ++k) {
    double lo = 1, hi = -1;
    for (int i = 0; i < n; ++i) {
      const double x = geometry.solid().point[corner[i]][k];
      lo = i == 0 ? x : std::min(lo, x);
      hi = i == 0 ? x : std::max(hi, x);
    }
    if (hi < box.lo[k] || lo > box.hi[k]) return false;
  }
  return true;
}

struct Count {
  int tubes = 0, apart = 0, seen = 0, flows = 0;
};

/// What the flow from a piece does.
struct Flow {
  int from = 0;     // starts here
  int onwards = 0;  // and goes to the site's part within the cell, or leaves through another piece
  bool leaves = false;  // through this piece
};

void follow(const Solid& solid, std::uint64_t seed, Count& count) {
  const SiteGeometry geometry(solid, DiagramKind::kVoronoi);
  SubdivisionOptions options;
  options.seed = seed;
  RunWatch watch(options);
  EngineSet engines(geometry, options, watch);
  const auto subdivision = subdivide(geometry, options, engines);
  ASSERT_TRUE(subdivision.ok());
  Predicates predicates(geometry);
  std::mt19937 random(static_cast<unsigned>(seed));
  std::uniform_real_distribution<> part(0.001, 0.999);
  for (const Leaf& leaf : subdivision.value().leaf) {
    ASSERT_EQ(leaf.theorem, LeafTheorem::kVoronoi);
    VoronoiSurface surface(leaf.face);
    // Pieces, the sites' parts within the cell, and which of them the flow has joined.
    UnionFind joined;
    joined.resize(surface.regions());
    std::map<std::uint32_t, std::uint32_t> within;
    std::map<std::uint32_t, Flow> flow;
    std::map<std::uint32_t, std::set<std::uint32_t>> pieces;
    for (std::uint32_t r = 0; r < surface.regions(); ++r)
      pieces[surface.site(r).value].insert(surface.piece(r));
    for (int k = 0; k < (leaf.tube.empty() ? 600 : 6000); ++k) {
      const int f = k % 6;
      const Rect r = k < 600 ? box_face(leaf.box, f)
                             : about(*leaf.face[static_cast<std::size_t>(f)], leaf.tube.front());
      const Point3 x = point_on(r.axis, r.level, std::lerp(r.u0, r.u1, part(random)),
                                std::lerp(r.v0, r.v1, part(random)));
      std::vector<SiteId> governors;
      predicates.governors(x, leaf.candidates, governors);
      if (governors.size() != 1) continue;
      const SiteId site = governors.front();
      const auto start = piece_on(surface, leaf, site, f);
      const int out = exit_of(leaf.box, x, closest_point(geometry, site, x), f);
      if (start == kNone || out < 0) continue;
      ++count.flows;
      ++flow[start].from;
      if (out == 6) {
        ++flow[start].onwards;
        const auto [it, fresh] = within.try_emplace(site.value, 0);
        if (fresh) it->second = joined.add();
        joined.unite(start, it->second);
      } else if (const auto end = piece_on(surface, leaf, site, out); end != kNone) {
        flow[start].onwards += end != start;
        flow[end].leaves = true;
        joined.unite(start, end);
      }
    }
    for (const auto& [site, of] : pieces) {
      std::set<std::uint32_t> apart;
      for (const auto p : of) apart.insert(joined.find(p));
      if (leaf.tube.empty() || leaf.tube.front().value != site) {
        EXPECT_EQ(apart.size(), of.size()) << "a tube taken for separate pieces";
        continue;
      }
      EXPECT_EQ(of.size(), 2u);
      ++count.tubes;
      count.seen += apart.size() == 1;
      int leaves = 0, ends = 0;
      for (const auto p : of) {
        leaves += flow[p].leaves;
        ends += flow[p].from > 100 && flow[p].onwards == 0;
      }
      // Past a site that misses the cell the flow goes one way.
      if (may_meet(geometry, SiteId{site}, leaf.box)) continue;
      ++count.apart;
      EXPECT_LE(ends, 1) << "separate pieces taken for a tube";
      EXPECT_LE(leaves, 1) << "separate pieces taken for a tube";
    }
  }
}

TEST(VoronoiTubes, FlowFromTheSurface_JoinsTheEndsOfTubesAndNoOtherPieces) {
  Count count;
  const std::vector<PolygonMesh> meshes{shapes::spoon(), shapes::planar_torus(8, 4, 2, 0.75),
                                        shapes::nested_voids(1), shapes::lbracket()};
  for (const PolygonMesh& mesh : meshes)
    for (const std::uint64_t seed : {1, 2}) follow(test::solid_of(mesh), seed, count);
  std::cout << count.seen << " of " << count.tubes << " tubes seen, " << count.apart
            << " past sites that miss the cell, " << count.flows << " flows\n";
  EXPECT_GT(count.tubes, 100);
  EXPECT_GT(count.apart, 5);
  // The others have ends too small to be hit, or both on one face.
  EXPECT_GT(count.seen, 2 * count.tubes / 5);
}

}  // namespace
}  // namespace blum
