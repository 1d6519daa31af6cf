// Two edges at a vertex: what the checker says of their ties, at ties.
#include "gains.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "certificates.hpp"

namespace blum::test {
namespace {

using verify::Vec;
using Real = long double;
using Vector = std::array<Real, 3>;

Vector unit(const Vector& a) {
  const Real n = std::sqrt(verify::inner(a, a));
  return {a[0] / n, a[1] / n, a[2] / n};
}

/// A vertex with two of its edges, and unit directions along them.
struct Fork {
  verify::Site a, b;
  Vector v, along_a, along_b;
};

std::vector<Fork> forks(const verify::Shape& shape) {
  std::vector<Fork> found;
  for (std::uint32_t v = 0; v < shape.point.size(); ++v) {
    const Point3& o = shape.point[v];
    const auto away = [&](std::uint32_t e) {
      const auto& ends = shape.edge[e].vertex;
      const Point3& p = shape.point[ends[ends[0] == v ? 1 : 0]];
      return unit({Real(p.x) - o.x, Real(p.y) - o.y, Real(p.z) - o.z});
    };
    for (const auto e : shape.edges_at[v])
      for (const auto f : shape.edges_at[v])
        if (e != f)
          found.push_back(
              {shape.edge_site(e), shape.edge_site(f), {o.x, o.y, o.z}, away(e), away(f)});
  }
  return found;
}

/// Boxes about ties, mostly close to the rim, and boxes beside them.
TEST(VerifyGains, OfEdgesAtAVertex_NeverTieIsFalseAboutTies) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> signed_one(-1, 1);
  std::size_t boxes = 0, apart = 0;
  for (const PolygonMesh& mesh : {shapes::lpocket(), shapes::rotate_rounded(shapes::lpocket(), 3),
                                  shapes::rotate_rounded(shapes::torus(8, 4, 2, 0.75), 1)}) {
    const Solid solid = build_solid(mesh).value();
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const SolidTriangle& t : solid.triangle) triangles.push_back(t.vertex);
    const verify::Shape shape(solid.point, triangles);
    for (const Fork& f : forks(shape)) {
      const Vector across = unit(verify::outer(f.along_a, f.along_b)),
                   middle = unit(verify::plus(f.along_a, f.along_b));
      const double size = std::exp2(-10 * (1 + signed_one(random)));
      const Real height = 0.3L * signed_one(random);
      const auto tie = [&](Real s) {
        return verify::plus(f.v,
                            verify::plus(verify::times(middle, s), verify::times(across, height)));
      };
      const Vector center = tie(0.3L * size);
      Box3 box;
      for (int k = 0; k < 3; ++k) {
        box.lo[k] = static_cast<double>(center[k]) - size;
        box.hi[k] = static_cast<double>(center[k]) + size;
      }
      ++boxes;
      EXPECT_FALSE(verify::never_tie_from_vertex(shape, box, f.a, f.b));
      // Beside the plane of ties they do not tie; the box reaches 2 size from its centre.
      Box3 beside = box;
      for (int k = 0; k < 3; ++k) {
        const double by =
            static_cast<double>(4 * size * unit(verify::minus(f.along_a, f.along_b))[k]);
        beside.lo[k] += by;
        beside.hi[k] += by;
      }
      apart += verify::never_tie_from_vertex(shape, beside, f.a, f.b) ? 1 : 0;
    }
  }
  EXPECT_GT(apart, boxes / 4);
}

/// A line passes the rim of two edges inside the solid at a distance of 1e-17.
TEST(SweepVerifyGains, LineBesideARim_Verified) {
  MedialOptions resolve;
  resolve.resolve = true;
  const Certified c("lpocket", shapes::rotate_rounded(shapes::lpocket(), 3), resolve);
  const verify::Answer answer = check(c, c.record);
  EXPECT_EQ(answer.outcome, verify::Answer::Outcome::kVerified) << answer.statement;
}

}  // namespace
}  // namespace blum::test
