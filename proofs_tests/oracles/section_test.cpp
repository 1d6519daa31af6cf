// Planes said to miss the axis: against the exact oracle on segments and rectangles in them, where
// planes are thrown at random, and where runs relied on them.

#include "blum/subdivision/section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "blum/arrangement/brute_engine.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

constexpr std::size_t kMostForOracle = 10;

struct Bench {
  explicit Bench(const PolygonMesh& mesh)
      : solid(test::solid_of(mesh)), geometry(solid), watch({}), engines(geometry, {}, watch) {
    for (std::uint32_t t = 0; t < solid.triangle.size(); ++t) triangles.push_back(t);
    box = {solid.point.front(), solid.point.front()};
    for (const Point3& p : solid.point)
      for (int k = 0; k < 3; ++k) {
        box.lo[k] = std::min(box.lo[k], p[k]);
        box.hi[k] = std::max(box.hi[k], p[k]);
      }
  }
  Bench(const Bench&) = delete;

  bool clear(const CutPlane& plane, const Box3& cell) {
    return section_misses_axis(geometry, engines.production(), engines.inside(), plane, cell,
                               geometry.candidates(), triangles)
        .clear;
  }
  /// Ties on a segment, by exact algebra; nullopt: bad position or too much for it.
  std::optional<int> ties(const Segment& s) {
    const auto near = engines.production().prune(
        geometry.candidates(), point_on(s.axis, s.t0, s.u, s.v), point_on(s.axis, s.t1, s.u, s.v));
    if (near.size() > kMostForOracle) return std::nullopt;
    const auto d = brute_segment(solid, s, near, triangles);
    if (!d) return std::nullopt;
    int n = 0;
    for (const Breakpoint& b : d->breakpoint) n += b.kind == Breakpoint::Kind::kTie;
    return n;
  }

  const Solid solid;
  const SiteGeometry geometry;
  RunWatch watch;
  EngineSet engines;
  std::vector<std::uint32_t> triangles;
  Box3 box;  // around the solid
};

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  int whole(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(engine_); }
  /// With few bits, so that a plane through it is known exactly.
  double between(double lo, double hi) {
    return std::ldexp(std::round(std::ldexp(lo + (hi - lo) * fraction(), 30)), -30);
  }
  double fraction() { return std::uniform_real_distribution<double>()(engine_); }
  Box3 box_in(const Box3& b, double largest) {
    Box3 r;
    for (int k = 0; k < 3; ++k) {
      const double size = (b.hi[k] - b.lo[k]) * largest * (0.1 + 0.9 * fraction());
      r.lo[k] = between(b.lo[k] - 0.3 * size, b.hi[k] - 0.7 * size);
      r.hi[k] = between(r.lo[k] + 0.5 * size, r.lo[k] + size);
    }
    return r;
  }

 private:
  std::mt19937 engine_;
};

std::vector<test::Scene> solids() {
  return {{"cuboid", shapes::cuboid(1, 1.25, 2)},
          {"lbracket", shapes::lbracket()},
          {"lpocket", shapes::lpocket()},
          {"plate", shapes::plate(1, 6)},
          {"voids", shapes::nested_voids(1)},
          {"torus", shapes::torus(6, 5, 2, 0.7)},
          {"turned", test::rotated(shapes::lbracket())},
          {"prism", shapes::prism(7)}};
}

/// A plane parallel to `axis` through (u, v), exactly.
CutPlane plane_along(int axis, double u, double v, int nu, int nv) {
  CutPlane plane;
  plane.normal[static_cast<std::size_t>(u_axis(axis))] = nu;
  plane.normal[static_cast<std::size_t>(v_axis(axis))] = nv;
  plane.offset = nu * u + nv * v;  // exact: 30 bits and 6
  return plane;
}

TEST(Section, PlaneThroughAnExactTie_IsNeverClear) {
  int planes = 0, oblique = 0;
  for (const test::Scene& scene : solids()) {
    SCOPED_TRACE(scene.name);
    Bench b(scene.mesh);
    Random random(5);
    for (int i = 0, met = 0; i < 400 && met < 12; ++i) {
      const Box3 cell = random.box_in(b.box, 0.5);
      const int axis = random.whole(0, 2);
      const double u = random.between(cell.lo[u_axis(axis)], cell.hi[u_axis(axis)]),
                   v = random.between(cell.lo[v_axis(axis)], cell.hi[v_axis(axis)]);
      const auto ties = b.ties({axis, u, v, cell.lo[axis], cell.hi[axis]});
      if (!ties || *ties == 0) continue;
      ++met;
      for (int k = 0; k < 6; ++k) {
        const int nu = k == 0 ? 0 : random.whole(-40, 40), nv = k == 1 ? 0 : random.whole(1, 40);
        if (nu == 0 && nv == 0) continue;
        ++planes;
        oblique += nu != 0 && nv != 0;
        EXPECT_FALSE(b.clear(plane_along(axis, u, v, nu, nv), cell));
      }
    }
  }
  EXPECT_GT(planes, 400);
  EXPECT_GT(oblique, 250);
}

TEST(Section, ClearObliquePlane_HasNoTieOnItsLines) {
  int clear = 0, lines = 0;
  for (const test::Scene& scene : solids()) {
    SCOPED_TRACE(scene.name);
    Bench b(scene.mesh);
    Random random(6);
    for (int i = 0; i < 80; ++i) {
      const Box3 cell = random.box_in(b.box, 0.5);
      const int axis = random.whole(0, 2), ua = u_axis(axis), va = v_axis(axis);
      // Along lines at steps (nv, -nu) / 64 of the cell from each other, all exactly in the plane.
      const int nu = random.whole(-7, 7), nv = random.whole(1, 7);
      const double u0 = random.between(cell.lo[ua], cell.hi[ua]),
                   v0 = random.between(cell.lo[va], cell.hi[va]);
      if (!b.clear(plane_along(axis, u0, v0, nu, nv), cell)) continue;
      ++clear;
      const double step = std::ldexp(1.0, std::ilogb(cell.hi[ua] - cell.lo[ua]) - 4);
      for (int k = -8; k <= 8; ++k) {
        const double u = u0 + k * nv * step, v = v0 - k * nu * step;
        if (u < cell.lo[ua] || u > cell.hi[ua] || v < cell.lo[va] || v > cell.hi[va]) continue;
        const auto ties = b.ties({axis, u, v, cell.lo[axis], cell.hi[axis]});
        if (!ties) continue;
        ++lines;
        EXPECT_EQ(*ties, 0);
      }
    }
  }
  EXPECT_GT(clear, 60);
  EXPECT_GT(lines, 150);
}

TEST(Section, ClearAxisParallelPlane_HasNoArcInTheExactDiagram) {
  int clear = 0, empty = 0, compared = 0;
  for (const test::Scene& scene : solids()) {
    SCOPED_TRACE(scene.name);
    Bench b(scene.mesh);
    Random random(7);
    for (int i = 0; i < 12; ++i) {
      const Box3 cell = random.box_in(b.box, 0.4);
      const int axis = random.whole(0, 2), u = u_axis(axis), v = v_axis(axis);
      const double level = random.between(cell.lo[axis], cell.hi[axis]);
      FaceProblem problem;
      problem.solid = &b.solid;
      problem.rect = {axis, level, cell.lo[u], cell.hi[u], cell.lo[v], cell.hi[v]};
      const auto near = b.engines.production().prune(b.geometry.candidates(),
                                                     point_on(axis, level, cell.lo[u], cell.lo[v]),
                                                     point_on(axis, level, cell.hi[u], cell.hi[v]));
      if (near.size() > kMostForOracle) continue;
      problem.candidates = near;
      problem.triangles = b.triangles;
      const FaceDiagram d = brute_face(problem);
      if (d.status != FaceStatus::kDecided) continue;
      ++compared;
      CutPlane plane;
      plane.normal[static_cast<std::size_t>(axis)] = 1;
      plane.offset = level;
      const bool said = b.clear(plane, cell);
      clear += said;
      empty += d.arc.empty();
      if (said) EXPECT_TRUE(d.arc.empty());
    }
  }
  EXPECT_GT(compared, 25);
  // Nearly every empty section is found out.
  EXPECT_GT(clear, 5);
  EXPECT_GT(10 * clear, 7 * empty);
  EXPECT_LT(empty, compared);
}

TEST(Section, PlanesThatRunsReliedOn_HaveNoTie) {
  int leaves = 0, lines = 0;
  for (const auto& [name, mesh] : std::vector<test::Scene>{
           {"turned voids", shapes::rotate_rounded(shapes::nested_voids(3), 2)},
           {"turned pocket", shapes::rotate_rounded(shapes::lpocket(), 3)}})
    for (const std::uint64_t seed : {1}) {
      SCOPED_TRACE(name);
      const test::Subdivided run(mesh, test::seeded(seed));
      ASSERT_TRUE(run.result.ok());
      Bench b(mesh);
      for (const Leaf& leaf : run.tree().leaf) {
        if (leaf.cut.empty()) continue;
        EXPECT_EQ(leaf.theorem, LeafTheorem::kBoundary);
        EXPECT_TRUE(leaf.has_axis);
        ++leaves;
        for (const CutPlane& plane : leaf.cut) {
          EXPECT_TRUE(b.clear(plane, leaf.box));
          // Short segments across the plane: what they meet is as near to it as they are long.
          for (int axis = 0; axis < 3; ++axis) {
            const auto n = static_cast<double>(plane.normal[static_cast<std::size_t>(axis)]);
            if (n == 0) continue;
            const int ua = u_axis(axis), va = v_axis(axis);
            for (int k = 1; k < 36; k += 5) {
              const double u = leaf.box.lo[ua] + (leaf.box.hi[ua] - leaf.box.lo[ua]) * k / 36.0,
                           v = leaf.box.lo[va] +
                               (leaf.box.hi[va] - leaf.box.lo[va]) * (k * 7 % 36) / 36.0;
              const double t = (plane.offset - plane.normal[static_cast<std::size_t>(ua)] * u -
                                plane.normal[static_cast<std::size_t>(va)] * v) /
                               n;
              if (!(t - 1e-9 > leaf.box.lo[axis] && t + 1e-9 < leaf.box.hi[axis])) continue;
              const auto ties = b.ties({axis, u, v, t - 1e-9, t + 1e-9});
              if (!ties) continue;
              ++lines;
              EXPECT_EQ(*ties, 0);
            }
          }
        }
      }
    }
  EXPECT_GT(leaves, 4);
  EXPECT_GT(lines, 25);
}

}  // namespace
}  // namespace blum
