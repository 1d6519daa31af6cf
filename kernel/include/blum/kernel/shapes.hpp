/// Test and demonstration solids, and changes of a mesh that leave its solid as it is.
///
/// Every generator returns a valid solid (build_solid accepts it) with outward faces. Faces of the
/// CAD shapes are *exactly* planar polygons: coordinates are sums of the parameters, so integer or
/// short dyadic parameters give exact facets. Facets with holes are cut into two simple polygons by
/// edges from hole to hole and to two outer corners, because PolygonMesh has no holes.
/// Parameters outside the stated ranges break an invariant (BLUM_CHECK); apps/ checks them first.
#pragma once

#include <array>
#include <cstdint>

#include "blum/kernel/mesh.hpp"

namespace blum::shapes {

/// The box [0,a] x [0,b] x [0,c]. Requires a, b, c > 0. Betti numbers 1 0 0.
[[nodiscard]] PolygonMesh cuboid(double a, double b, double c);

/// An L profile with arms `a` (along x) and `b` (along y), both `t` thick, `depth` deep along z.
/// Requires 0 < t < min(a, b) and depth > 0. Betti numbers 1 0 0.
[[nodiscard]] PolygonMesh lbracket(double a = 4, double b = 3, double t = 1, double depth = 2);

/// The box [0,4w] x [0,4w] x [0,depth+floor] with a blind L-shaped pocket in its top: walls and
/// arms are w wide, the floor lies at z = floor. At the reflex corner of the L-shaped floor the
/// medial axis has a rim inside the solid (theory.md section 1). Requires w, depth, floor > 0.
/// Betti numbers 1 0 0.
[[nodiscard]] PolygonMesh lpocket(double w = 1, double depth = 2, double floor = 1);

/// How far prism() moves corner 0 of its top, along x and z both: by a length, then by ulps.
struct Move {
  double amount = 0;
  int ulps = 0;
};

/// The right prism over the regular n-gon with circumradius `radius`, z in [0, height]. Corner 0 of
/// the top is moved by `move`; the three faces there are then cut beside it so that all others stay
/// exactly planar. Requires n >= 3, radius, height > 0, a move much smaller than an edge.
/// Betti numbers 1 0 0.
[[nodiscard]] PolygonMesh prism(int n, double radius = 1, double height = 1, Move move = {});

/// A plate `pitch * count` long, `pitch` wide and `thickness` thick with a row of `count` through
/// holes, each a regular polygon of `sides` sides inscribed in a circle of diameter pitch / 2.
/// Requires count >= 0, sides >= 3. Betti numbers 1 count 0.
[[nodiscard]] PolygonMesh plate(int count, int sides, double pitch = 2, double thickness = 0.5);

/// k hollow boxes, one inside the void of the other: 2k nested boxes, their shells alternately
/// outer boundary and void, 1 apart on every side. Requires k >= 1. Betti numbers k 0 k.
[[nodiscard]] PolygonMesh nested_voids(int k);

/// A torus about the z axis, n facets around the axis and m around the tube; each trapezoid, which
/// rounding makes non-planar, is cut in two triangles. Requires n, m >= 3, R > r > 0.
/// Betti numbers 1 1 0.
[[nodiscard]] PolygonMesh torus(int n, int m, double R, double r);

/// The same with exactly planar trapezoids: directions, radii and heights are rounded to 20 bits
/// first. Betti numbers 1 1 0.
[[nodiscard]] PolygonMesh planar_torus(int n, int m, double R, double r);

/// A spoon of 84 triangles, 126 edges and 44 vertices, none of the 254 degenerate: seven rings of six
/// points from a tip to the end of the handle, the first of them hollow on top. After figure 5.14 of
/// Sud's thesis, whose model has these counts. Betti numbers 1 0 0.
[[nodiscard]] PolygonMesh spoon();

/// A chisel of 632 triangles (after triangulation) and 318 vertices: a flattened handle, radially
/// symmetric up to random perturbations of `noise` (relative to its radius), a shank and a tapering
/// blade with exactly planar facets. After figure 5.15 of Sud's thesis, whose model has these
/// counts. Requires 0 <= noise <= 0.05. Betti numbers 1 0 0.
[[nodiscard]] PolygonMesh chisel(double noise = 0.01, std::uint64_t seed = 1);

/// A tube of `sides` sides and radius `tube` around the (p, q) torus knot on the torus (R, r), in
/// `n` pieces. Requires n, sides >= 3, coprime p, q >= 1; a tube so thick that it meets itself
/// gives an invalid solid. Betti numbers 1 1 0.
struct KnotShape {
  int p = 2, q = 3;
  int n = 48, sides = 6;
  double R = 2, r = 1, tube = 0.375;
};
[[nodiscard]] PolygonMesh knot(const KnotShape& shape = {});

/// Adds the midpoint of about half of the edges as a collinear vertex, where the midpoint is
/// exactly representable. The solid is exactly the same.
[[nodiscard]] PolygonMesh split_edges(const PolygonMesh& mesh, std::uint64_t seed);

/// Replaces the polygons by a random triangulation without new vertices: ears in random order,
/// then random flips of edges between exactly coplanar triangles. The solid is exactly the same.
/// Requires exactly planar simple polygons.
[[nodiscard]] PolygonMesh triangulate_facets(const PolygonMesh& mesh, std::uint64_t seed);

/// A uniformly random rotation about the origin, every coordinate rounded to double. Polygons are
/// triangulated before (rounding makes them non-planar), with the same seed. Facets are then
/// coplanar up to about 1e-16 only, as in every rotated CAD model.
[[nodiscard]] PolygonMesh rotate_rounded(const PolygonMesh& mesh, std::uint64_t seed);

/// Random order of vertices and faces, random first corner in each face.
[[nodiscard]] PolygonMesh shuffle(const PolygonMesh& mesh, std::uint64_t seed);

}  // namespace blum::shapes
