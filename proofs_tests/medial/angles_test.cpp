// Separation angles against plain computations at exact points of the axis; the closed forms of the
// thesis (section 5.6.1) where they hold, and what happens where they do not.

#include "blum/medial/angles.hpp"

#include <gtest/gtest.h>

#include "blum/medial/medial_axis.hpp"
#include "blum/medial/simplify.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

constexpr double kDegrees = 180 / M_PI;

MedialResult angled(const PolygonMesh& mesh, double epsilon = 0, std::uint64_t seed = 1,
                    double tolerance = 1, bool resolve = false) {
  MedialOptions o = test::seeded(seed, epsilon * test::extent(mesh.points));
  o.resolve = resolve;
  AngleOptions a;
  a.wanted = true;
  a.tolerance_deg = tolerance;
  auto r = compute_medial_axis(test::solid_of(mesh), o, a);
  if (!r) throw std::runtime_error(r.error().message);
  return std::move(r).value();
}

using test::LongPoint;

/// Unit directions to the feet of q: nearest points of all triangles as far as the nearest, to
/// `slack` of the distance.
std::vector<LongPoint> feet(const Solid& solid, const std::vector<Point3>& points, const Point3& q,
                            double slack) {
  std::vector<std::pair<long double, LongPoint>> all;
  long double least = std::numeric_limits<long double>::infinity();
  for (const SolidTriangle& t : solid.triangle) {
    const LongPoint y = test::nearest_on_triangle(
        test::wide(q), {test::wide(points[t.vertex[0]]), test::wide(points[t.vertex[1]]),
                        test::wide(points[t.vertex[2]])});
    const LongPoint w = test::minus(y, test::wide(q));
    const long double d = std::sqrt(test::dot(w, w));
    least = std::min(least, d);
    all.push_back({d, {w[0] / d, w[1] / d, w[2] / d}});
  }
  std::vector<LongPoint> near;
  for (const auto& [d, w] : all)
    if (d <= least * (1 + slack)) near.push_back(w);
  return near;
}

double widest(const std::vector<LongPoint>& directions) {
  double most = 0;
  for (const auto& a : directions)
    for (const auto& b : directions) {
      const LongPoint d = test::minus(a, b);
      most = std::max(
          most, 2 * static_cast<double>(std::asin(std::min(1.0L, std::sqrt(test::dot(d, d)) / 2))));
    }
  return most * kDegrees;
}

double angle_at(const Solid& solid, const std::vector<Point3>& points, const Point3& q) {
  return widest(feet(solid, points, q, 1e-10));
}

std::vector<test::Scene> angle_scenes() {
  std::vector<test::Scene> list;
  const std::set<std::string> slow{"torus_8_4", "voids_2",       "star_void_4", "plate_2",
                                   "plate_1",   "rotated_plate", "lpocket"};
  for (auto& s : test::scenes())
    if (!slow.contains(s.name)) list.push_back(std::move(s));
  return list;
}

TEST(SeparationAngles, PointsOfEachPart_AreWithinItsBounds) {
  std::size_t sheets = 0, seams = 0, tight = 0;
  for (const auto& scene : angle_scenes()) {
    SCOPED_TRACE(scene.name);
    const Solid solid = test::solid_of(scene.mesh);
    const auto points = test::model_points(solid);
    const MedialResult r = angled(scene.mesh, 0.3);
    const PartAngles& a = *r.angles;
    std::vector<double> seen(a.sheet.size(), 0);
    std::vector<bool> seam_end(r.complex.vertex.size(), false);
    for (std::size_t e = 0; e < r.complex.edge.size(); ++e) {
      if (r.parts.edge_seam[e] == Parts::kNoSeam) continue;
      for (const auto v : r.complex.edge[e].vertex) {
        seam_end[v] = true;
        const ComplexVertex& x = r.complex.vertex[v];
        if (x.kind != ComplexVertex::Kind::kEvent || !x.on_axis) continue;
        const AngleInterval& i = a.seam[r.parts.edge_seam[e]];
        EXPECT_LE(angle_at(solid, points, x.position), i.hi + 2e-3);
        ++seams;
      }
    }
    for (std::size_t t = 0; t < r.complex.triangle.size(); ++t)
      for (const auto v : r.complex.edge[r.complex.triangle[t].edge[0]].vertex) {
        const ComplexVertex& x = r.complex.vertex[v];
        if (x.kind != ComplexVertex::Kind::kArcPoint || !x.on_axis || seam_end[v]) continue;
        const double angle = angle_at(solid, points, x.position);
        const auto s = r.parts.triangle_sheet[t];
        EXPECT_LE(angle, a.sheet[s].hi + 2e-3) << "sheet " << s;
        seen[s] = std::max(seen[s], angle);
        ++sheets;
      }
    for (std::size_t s = 0; s < a.sheet.size(); ++s) {
      EXPECT_LE(a.sheet[s].lo, a.sheet[s].hi);
      tight += a.sheet[s].width() <= 1 && seen[s] > 0;
      // Where the angle is the same everywhere, the lower bound can be no larger.
      if (seen[s] > 0 && a.sheet[s].lo > 0) EXPECT_GE(a.sheet[s].hi, seen[s] - 1e-3);
    }
    for (const AngleInterval& i : a.seam) EXPECT_LE(i.lo, i.hi);
  }
  EXPECT_GT(sheets, 1000u);
  EXPECT_GT(seams, 150u);
  EXPECT_GT(tight, 80u);
}

/// A point of the axis between p and q, by bisection on the nearest triangle's direction.
std::optional<Point3> axis_point(const Solid& solid, const std::vector<Point3>& points, Point3 p,
                                 Point3 q) {
  const auto foot = [&](const Point3& x) { return feet(solid, points, x, 1e-12).front(); };
  const auto differ = [](const LongPoint& a, const LongPoint& b) {
    const LongPoint d = test::minus(a, b);
    return std::sqrt(test::dot(d, d)) > 0.05L;
  };
  LongPoint a = foot(p);
  if (!differ(a, foot(q))) return std::nullopt;
  for (int k = 0; k < 60; ++k) {
    const Point3 m{0.5 * (p.x + q.x), 0.5 * (p.y + q.y), 0.5 * (p.z + q.z)};
    if (m == p || m == q) break;
    const LongPoint f = foot(m);
    if (differ(a, f)) {
      q = m;
    } else {
      p = m;
      a = f;
    }
  }
  if (!differ(foot(p), foot(q))) return std::nullopt;  // the direction turned slowly
  return p;
}

TEST(SeparationAngles, EveryPointOfLargeAngle_IsNearWhatIsKept) {
  std::size_t found = 0;
  std::mt19937 random(5);
  for (const auto& scene : angle_scenes()) {
    SCOPED_TRACE(scene.name);
    const Solid solid = test::solid_of(scene.mesh);
    const InsideOracle inside(solid);
    const auto points = test::model_points(solid);
    const MedialResult r = angled(scene.mesh, 0.3);
    Point3 lo = points.front(), hi = lo;
    for (const Point3& p : points)
      for (int k = 0; k < 3; ++k) {
        lo[k] = std::min(lo[k], p[k]);
        hi[k] = std::max(hi[k], p[k]);
      }
    const auto draw = [&] {
      Point3 p;
      for (int k = 0; k < 3; ++k) p[k] = std::uniform_real_distribution(lo[k], hi[k])(random);
      return p;
    };
    const auto within = [&](const Point3& p) {
      Point3 w;
      for (int k = 0; k < 3; ++k)
        w[k] = std::ldexp(p[k] - solid.frame.origin[k], -solid.frame.exponent);
      return inside.locate(w) == InsideOracle::Where::kInside;
    };
    const CellValues cost = cell_costs(r.complex, r.parts, *r.angles);
    for (int trial = 0; trial < 40; ++trial) {
      const Point3 p = draw(), q0 = draw();
      Point3 q;
      for (int k = 0; k < 3; ++k) q[k] = p[k] + 0.2 * (q0[k] - p[k]);
      if (!within(p) || !within(q)) continue;
      const auto x = axis_point(solid, points, p, q);
      if (!x || !within(*x)) continue;
      const double angle = widest(feet(solid, points, *x, 1e-9)) - 1e-3;
      ++found;
      for (const CellValues* value : {&cost, &r.filtration->value}) {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t v = 0; v < r.complex.vertex.size(); ++v) {
          if ((*value).vertex[v] < angle) continue;
          const Point3& y = r.complex.vertex[v].position;
          nearest = std::min(nearest, std::hypot(y.x - x->x, y.y - x->y, y.z - x->z));
        }
        EXPECT_LE(nearest, r.hausdorff_bound * (1 + 1e-9)) << "angle " << angle;
      }
    }
  }
  EXPECT_GT(found, 100u);
}

TEST(SeparationAngles, FacePairs_AreConstantAndExact) {
  // Between the sides of a triangular prism 120 degrees, between sides and ends 90 (5.6.1).
  const MedialResult r = angled(shapes::prism(3, 1, 3));
  std::size_t sides = 0, ends = 0;
  for (const AngleInterval& i : r.angles->sheet) {
    EXPECT_LT(i.width(), 1e-6);
    sides += std::abs(i.hi - 120) < 1e-6;
    ends += std::abs(i.hi - 90) < 1e-6;
  }
  EXPECT_GE(sides, 3u);
  EXPECT_GE(ends, 6u);
  EXPECT_EQ(sides + ends, r.angles->sheet.size());
}

TEST(SeparationAngles, SquareCrossSection_HasASeamOfTwiceTheAngleOfItsSheets) {
  // Lemma 5.4 of the thesis does not hold at degenerate seams: all sheets have 90 degrees.
  const MedialResult r = angled(shapes::cuboid(1, 1, 2));
  for (const AngleInterval& i : r.angles->sheet) {
    EXPECT_GT(i.lo, 90 - 1e-6);
    EXPECT_LT(i.hi, 90 + 1e-6);
  }
  std::size_t opposite = 0;
  for (const AngleInterval& i : r.angles->seam) {
    EXPECT_LT(i.width(), 1e-4);
    opposite += i.lo > 180 - 1e-4;
  }
  EXPECT_EQ(opposite, 1u);
  // And stays as a curve when all sheets go.
  const ShapeCounts left = count_shapes(simplified(r, 120, Simplify::kHomotopy).complex);
  EXPECT_EQ(left.sheets, 0u);
  EXPECT_EQ(left.curves, 1u);
}

PolygonMesh sheared(PolygonMesh m, double x_by_y, double x_by_z) {
  for (Point3& p : m.points) p.x += x_by_y * p.y + x_by_z * p.z;
  return m;
}

/// Angles seen at the arc points of the sheets between two sites of the given kinds that share a
/// vertex, and the largest upper bound of these sheets.
struct Seen {
  double least = 180, most = 0, hi = 0;
  std::size_t points = 0;
};
Seen look(const PolygonMesh& mesh, SiteKind first, SiteKind second,
          const std::function<bool(const Solid&, SiteId, SiteId)>& wanted) {
  const Solid solid = test::solid_of(mesh);
  const SiteGeometry geometry(solid);
  const SiteIndex& index = geometry.index();
  const auto points = test::model_points(solid);
  const MedialResult r = angled(mesh, 0.06);
  Seen seen;
  for (std::size_t t = 0; t < r.complex.triangle.size(); ++t) {
    auto [a, b] = r.complex.triangle[t].governors;
    if (index.kind(a) != first) std::swap(a, b);
    if (index.kind(a) != first || index.kind(b) != second) continue;
    int count = 0;
    bool meet = false;
    const auto corner = geometry.corners(a, count);
    for (int k = 0; k < count; ++k)
      meet |= geometry.has_corner(b, corner[static_cast<std::size_t>(k)]);
    if (!meet || !wanted(solid, a, b)) continue;
    seen.hi = std::max(seen.hi, r.angles->sheet[r.parts.triangle_sheet[t]].hi);
    for (const auto v : r.complex.edge[r.complex.triangle[t].edge[0]].vertex) {
      const ComplexVertex& x = r.complex.vertex[v];
      if (x.kind != ComplexVertex::Kind::kArcPoint || !x.on_axis) continue;
      const double angle = angle_at(solid, points, x.position);
      seen.least = std::min(seen.least, angle);
      seen.most = std::max(seen.most, angle);
      ++seen.points;
    }
  }
  return seen;
}

TEST(SeparationAngles, TwoEdgesThatMeet_RunFromZeroToPiMinusTheirAngle) {
  // The thesis gives the angle between the two lines. At the inner corner of the sheared L-shaped
  // floor two reflex edges meet; their sheet ends on the ray where both feet are the corner.
  const PolygonMesh mesh = sheared(shapes::lpocket(1, 2, 1), 0.5, 0);
  const Seen seen = look(mesh, SiteKind::kEdge, SiteKind::kEdge,
                         [](const Solid& s, SiteId, SiteId) { return !s.edge.empty(); });
  ASSERT_GT(seen.points, 20u);
  EXPECT_LT(seen.least, 25);
  EXPECT_GT(seen.most, 40);
  EXPECT_GE(seen.hi, seen.most - 1e-3);
}

TEST(SeparationAngles, EdgeThatMeetsAPlane_RunsOverAnInterval) {
  // The thesis gives one angle. A reflex edge inclined by alpha to a face: [alpha, 180 - alpha].
  const PolygonMesh mesh = sheared(shapes::lbracket(4, 3, 1, 2), 0, 0.5);
  const double alpha = std::atan(2.0) * kDegrees;
  const Seen seen =
      look(mesh, SiteKind::kEdge, SiteKind::kFace, [](const Solid& s, SiteId, SiteId face) {
        const SiteIndex index(s);
        const auto& t = s.triangle[index.element(face)].vertex;
        // The ends of the bracket, which the inclined edge meets.
        return s.point[t[0]].z == s.point[t[1]].z && s.point[t[1]].z == s.point[t[2]].z;
      });
  ASSERT_GT(seen.points, 20u);
  EXPECT_GT(seen.least, alpha - 1e-3);
  EXPECT_LT(seen.most, 180 - alpha + 1e-3);
  EXPECT_GT(seen.most - seen.least, 10);
  EXPECT_GE(seen.hi, seen.most - 1e-3);
}

TEST(SeparationAngles, Junctions_HaveLowerBoundsToo) {
  const MedialResult r = angled(shapes::cuboid(1, 1.25, 2), 0, 1, 1, true);
  ASSERT_GT(r.parts.junctions, 0u);
  const Solid solid = test::solid_of(shapes::cuboid(1, 1.25, 2));
  std::size_t bounded = 0;
  for (std::size_t c = 0; c < r.complex.cone.size(); ++c) {
    if (r.parts.cone_shape[c] != ConeShape::kJunction) continue;
    const auto apex = r.complex.cone[c].apex;
    EXPECT_TRUE(r.angles->is_node[apex]);
    const AngleInterval& i = r.angles->vertex[apex];
    // At a corner of the middle sheet of a box two of four feet are opposite.
    if (i.lo > 0) EXPECT_GT(i.hi, 180 - 1e-6);
    bounded += i.lo > 179;
  }
  EXPECT_GT(bounded, 0u);
}

TEST(SeparationAngles, Tolerance_IsReachedOrReported) {
  for (const double tolerance : {5.0, 0.25}) {
    const MedialResult r = angled(shapes::lbracket(), 0, 3, tolerance);
    std::size_t wide = 0;
    for (const auto* list : {&r.angles->sheet, &r.angles->seam})
      for (const AngleInterval& i : *list) wide += i.width() > tolerance;
    EXPECT_LE(wide, r.angles->wide);
    if (r.angles->wide == 0) EXPECT_LE(r.angles->widest_deg, tolerance);
  }
}

/// The largest angle between the normals of the governors that are faces.
double angle_of_faces(const Solid& solid, const std::vector<SiteId>& governors) {
  const SiteGeometry geometry(solid);
  std::vector<LongPoint> normal;
  for (const SiteId s : governors)
    if (geometry.index().kind(s) == SiteKind::kFace) {
      const BallVector& n = geometry.unit(s);
      normal.push_back({n[0].mid, n[1].mid, n[2].mid});
    }
  return widest(normal);
}

// A box has angles of 0 (between parts of a facet), 90 and 180 degrees only. Turned and
// triangulated its facets are parts that are no longer in a plane: seams begin at its corners with
// many arcs, and sites of no width are there that label nothing.
TEST(SeparationAngles, TurnedBox_HasTheAnglesOfItsFacets) {
  std::size_t corners = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    const PolygonMesh mesh = shapes::rotate_rounded(
        shapes::triangulate_facets(shapes::split_edges(shapes::cuboid(1, 1.25, 2), seed), seed),
        seed);
    const Solid solid = test::solid_of(mesh);
    const MedialResult r = angled(mesh, 0, seed);
    EXPECT_EQ(r.angles->wide, 0u);
    std::vector<double> sheet(r.angles->sheet.size(), 0), seam(r.angles->seam.size(), 0);
    for (std::size_t t = 0; t < r.complex.triangle.size(); ++t) {
      const auto& g = r.complex.triangle[t].governors;
      double& most = sheet[r.parts.triangle_sheet[t]];
      most = std::max(most, angle_of_faces(solid, {g[0], g[1]}));
    }
    for (std::size_t e = 0; e < r.complex.edge.size(); ++e) {
      if (r.parts.edge_seam[e] == Parts::kNoSeam) continue;
      for (const auto v : r.complex.edge[e].vertex) {
        const ComplexVertex& x = r.complex.vertex[v];
        double& most = seam[r.parts.edge_seam[e]];
        if (x.kind == ComplexVertex::Kind::kEvent)
          most = std::max(most, angle_of_faces(solid, x.governors));
        corners += x.kind == ComplexVertex::Kind::kBoundary;
      }
    }
    const auto is_one = [](double x, double below, double above) {
      return std::ranges::any_of(std::array{0.0, 90.0, 180.0},
                                 [&](double v) { return x >= v - below && x <= v + above; });
    };
    constexpr double kSlack = 1e-4;  // of the plain computation, near 180 degrees
    for (std::size_t s = 0; s < sheet.size(); ++s) {
      EXPECT_GE(r.angles->sheet[s].hi, sheet[s] - kSlack);
      EXPECT_LE(r.angles->sheet[s].lo, sheet[s] + kSlack);
    }
    for (std::size_t s = 0; s < seam.size(); ++s) {
      EXPECT_GE(r.angles->seam[s].hi, seam[s] - kSlack);
      EXPECT_TRUE(is_one(r.angles->seam[s].lo, 1, 1e-6)) << r.angles->seam[s].lo;
      EXPECT_TRUE(is_one(r.angles->seam[s].hi, 1e-6, 1)) << r.angles->seam[s].hi;
      // Seams from corners have no face of a leaf on them.
      if (seam[s] > 0) EXPECT_LE(r.angles->seam[s].lo, seam[s] + kSlack);
    }
  }
  EXPECT_GT(corners, 20u);
}

// Leaves that are too coarse to say which part a point belongs to are divided.
TEST(SeparationAngles, CoarseLeaves_AreDivided) {
  const PolygonMesh mesh = shapes::lpocket();
  AngleOptions a;
  a.wanted = true;
  std::array<std::size_t, 2> wide{}, leaves{};
  for (const int rounds : {0, AngleOptions().refinements}) {
    a.refinements = rounds;
    const auto r = compute_medial_axis(test::solid_of(mesh), test::seeded(1), a);
    ASSERT_TRUE(r && r.value().certified);
    wide[rounds > 0 ? 1 : 0] = r.value().angles->wide;
    leaves[rounds > 0 ? 1 : 0] = r.value().leaves;
  }
  EXPECT_GT(wide[0], 0u);
  EXPECT_EQ(wide[1], 0u);
  EXPECT_GT(leaves[1], leaves[0]);
}

std::vector<std::pair<std::string, PolygonMesh>> angle_sweep() {
  std::vector<std::pair<std::string, PolygonMesh>> list;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const auto turned = [&](const PolygonMesh& m) {
      return shapes::rotate_rounded(shapes::triangulate_facets(m, seed), seed);
    };
    list.emplace_back("plate_2_6", turned(shapes::plate(2, 6)));
    list.emplace_back("plate_4", turned(shapes::plate(4, 4)));
    list.emplace_back("lpocket", turned(shapes::lpocket()));
    list.emplace_back("prism_8", turned(shapes::prism(8)));
  }
  list.emplace_back("voids_2", shapes::nested_voids(2));
  list.emplace_back("torus_8_4", shapes::torus(8, 4, 3, 1));
  list.emplace_back("torus_16_8", shapes::torus(16, 8, 3, 1));
  return list;
}

// What is asked for is reached on all parts, with the geometry of 3 % and without.
TEST(SweepSeparationAngles, Tolerance_IsReached) {
  for (const auto& [name, mesh] : angle_sweep())
    for (const double epsilon : {0.0, 0.03}) {
      SCOPED_TRACE(name + " " + std::to_string(epsilon));
      const MedialResult r = angled(mesh, epsilon);
      const std::size_t parts = r.angles->sheet.size() + r.angles->seam.size();
      std::cout << name << " epsilon " << epsilon << ": " << r.angles->wide << " of " << parts
                << " parts wider, the widest " << r.angles->widest_deg << std::endl;
      EXPECT_EQ(r.angles->wide, 0u);
    }
}

TEST(SeparationAngles, Threads_DoNotMatter) {
  MedialOptions o = test::seeded(1);
  AngleOptions a;
  a.wanted = true;
  const Solid solid = test::solid_of(shapes::lpocket());
  const auto one = compute_medial_axis(solid, o, a);
  o.threads = 3;
  const auto three = compute_medial_axis(solid, o, a);
  const auto same = [](const std::vector<AngleInterval>& x, const std::vector<AngleInterval>& y) {
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t k = 0; k < x.size(); ++k) {
      EXPECT_EQ(x[k].lo, y[k].lo);
      EXPECT_EQ(x[k].hi, y[k].hi);
    }
  };
  same(one.value().angles->sheet, three.value().angles->sheet);
  same(one.value().angles->seam, three.value().angles->seam);
  same(one.value().angles->vertex, three.value().angles->vertex);
}

}  // namespace
}  // namespace blum
