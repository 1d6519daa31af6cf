// The candidates of a leaf hold the exact governors of all its points inside the solid.

#include <gtest/gtest.h>

#include "blum/kernel/inside.hpp"
#include "blum/kernel/predicates.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

using test::Scene;
using test::Subdivided;

/// Points of the closed box: in it, on its faces, edges and corners, and on coarse dyadic grids,
/// where symmetric solids have their ties.
Point3 sample(const Box3& box, std::mt19937_64& random) {
  Point3 p;
  for (int k = 0; k < 3; ++k) {
    const double x = std::uniform_real_distribution(box.lo[k], box.hi[k])(random);
    switch (random() % 6) {
      case 0:
        p[k] = box.lo[k];
        break;
      case 1:
        p[k] = box.hi[k];
        break;
      case 2:
        p[k] = std::clamp(std::round(x * 64) / 64, box.lo[k], box.hi[k]);
        break;
      default:
        p[k] = x;
    }
  }
  return p;
}

/// Between two random points of the boundary: often inside, however thin the solid.
Point3 chord_point(const Solid& solid, std::mt19937_64& random) {
  const auto on_boundary = [&] {
    const auto& v = solid.triangle[random() % solid.triangle.size()].vertex;
    std::uniform_real_distribution<double> unit(0, 1);
    double s = unit(random), t = unit(random);
    if (s + t > 1) s = 1 - s, t = 1 - t;
    Point3 p;
    for (int k = 0; k < 3; ++k)
      p[k] =
          (1 - s - t) * solid.point[v[0]][k] + s * solid.point[v[1]][k] + t * solid.point[v[2]][k];
    return p;
  };
  const Point3 a = on_boundary(), b = on_boundary();
  return {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
}

const Leaf& leaf_at(const Subdivision& tree, const Point3& p) {
  std::uint32_t n = 0;
  while (tree.node[n].axis >= 0)
    n = tree.node[n].child + (p[tree.node[n].axis] > tree.node[n].cut ? 1 : 0);
  return tree.leaf[tree.node[n].leaf];
}

std::size_t check_candidates(const PolygonMesh& mesh, const SubdivisionOptions& options,
                             int samples) {
  Subdivided run(mesh, options);
  if (!run.result.ok()) {
    ADD_FAILURE() << run.result.error().message;
    return 0;
  }
  const InsideOracle inside(run.solid);
  Predicates predicates(run.geometry);
  std::mt19937_64 random(options.seed);
  std::vector<SiteId> governors;
  std::size_t checked = 0;
  for (int k = 0; k < samples; ++k) {
    const bool chord = k % 2 == 0;
    const Leaf& any = run.tree().leaf[random() % run.tree().leaf.size()];
    const Point3 p = chord ? chord_point(run.solid, random) : sample(any.box, random);
    const Leaf& leaf = chord ? leaf_at(run.tree(), p) : any;
    if (inside.locate(p) != InsideOracle::Where::kInside) continue;
    ++checked;
    predicates.governors(p, run.geometry.candidates(), governors);
    EXPECT_FALSE(governors.empty());
    for (const SiteId s : governors)
      EXPECT_TRUE(std::binary_search(leaf.candidates.begin(), leaf.candidates.end(), s))
          << "site " << s.value << " governs (" << p.x << ", " << p.y << ", " << p.z
          << ") of the working frame";
  }
  return checked;
}

TEST(LeafCandidates, PointsOfLeaf_AreGovernedByItsCandidates) {
  for (const Scene& scene : test::scenes())
    for (const double fineness : {0.0, 0.15}) {
      SCOPED_TRACE(scene.name);
      const double d = fineness * test::extent(scene.mesh.points);
      EXPECT_GT(check_candidates(scene.mesh, test::seeded(5, d), 300), 40u);
    }
}

TEST(SweepLeafCandidates, ManyPointsAndSeeds_AreGovernedByTheirCandidates) {
  for (const Scene& scene : test::scenes())
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
      for (const double fineness : {0.0, 0.2, 0.08}) {
        SCOPED_TRACE(scene.name);
        SubdivisionOptions o = test::seeded(seed, fineness * test::extent(scene.mesh.points));
        o.resolve = seed % 2 == 0;
        check_candidates(scene.mesh, o, 5000);
      }
}

}  // namespace
}  // namespace blum
