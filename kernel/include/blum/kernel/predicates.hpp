/// Exact predicates on sites. Each decides by a ball filter in double, then 128-bit balls, then
/// exact arithmetic; the answer never depends on which stage gave it.
#pragma once

#include <optional>

#include "blum/kernel/point.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "blum/kernel/stage.hpp"

namespace blum {

/// Not thread-safe (it counts stages): one object a thread.
///
/// Requires everywhere: finite coordinates in the working frame (|x| <= 4); sites that are
/// candidates of the medial axis where `SiteId`s are taken.
class Predicates {
 public:
  explicit Predicates(const SiteGeometry& geometry) : geometry_(&geometry) {}

  [[nodiscard]] const SiteGeometry& geometry() const { return *geometry_; }
  [[nodiscard]] const StageCounts& stages() const { return stages_; }

  /// Sign of d_a(x)^2 - d_b(x)^2 for the *carriers* of a and b: negative if a is strictly nearer,
  /// zero on an exact tie. Source: thesis section 5.4.1.
  [[nodiscard]] int compare_distance(const Point3& x, SiteId a, SiteId b);

  /// Is x in the closed domain of s (theory section 1)?
  [[nodiscard]] bool in_domain(const Point3& x, SiteId s);

  /// Sign of n.(x - a) for the outer normal n of a triangle: negative on the solid's side.
  [[nodiscard]] int plane_side(const Point3& x, std::uint32_t triangle);

  /// Does the line parallel to `axis` through (u, v) pierce the triangle? +1: leaves the solid in
  /// the direction of the axis, -1: enters it, 0: misses it; nullopt: meets its border or lies in
  /// its plane.
  [[nodiscard]] std::optional<int> pierces(std::uint32_t triangle, int axis, double u, double v);

  /// Order along the line of the points where it pierces two triangles (sign of first - second).
  /// Requires: pierces() is +-1 for both.
  [[nodiscard]] int compare_crossing(std::uint32_t first, std::uint32_t second, int axis, double u,
                                     double v);

  /// The point where a boundary edge crosses the plane x[axis] = level: sign of its coordinate
  /// `along` minus `value`. Requires: the edge's ends lie strictly on different sides.
  [[nodiscard]] int compare_edge_crossing(std::uint32_t edge, int axis, double level, int along,
                                          double value);

  /// Carriers equal or one contained in the other (theory section 1).
  [[nodiscard]] bool redundant(SiteId a, SiteId b);

  /// Ties of a and b are never essential: they are redundant, or one of them has all its incident
  /// supporting planes weakly separating it from the other, so that points that both govern have
  /// equal feet (docs/proofs.md, Lemma 1). Symmetric.
  [[nodiscard]] bool never_essential(SiteId a, SiteId b);

  /// Which points of the solid can have a boundary vertex as foot.
  enum class FootCone : std::uint8_t {
    kNone,  ///< none
    kRay,   ///< at most those on one ray
    kWide,  ///< perhaps more
  };
  /// By exact signs on the vertex' polar cone {x : x.e <= 0 for all incident edges e}.
  [[nodiscard]] FootCone foot_cone(std::uint32_t vertex) const;

  /// The axis near a boundary vertex: trees, each of which ends on some of its convex edges.
  struct AxisAtVertex {
    std::uint32_t trees = 0;
    std::vector<std::uint32_t> tree;  ///< of each of edges_at(vertex); of convex edges only
    /// A triangle of each chain of triangles beside the region of points whose foot is the vertex.
    /// These chains lie beside one region of the complement of the axis.
    std::vector<std::uint32_t> merged;
  };
  /// By exact signs; nullopt where points of a plane sector have the vertex as foot. See "Vertices
  /// in a boundary cell" in docs/proofs.md.
  [[nodiscard]] std::optional<AxisAtVertex> axis_at(std::uint32_t vertex) const;

  /// The boundary near a vertex as points see it that are near to nothing else: chains of triangles
  /// between convex edges, and the cone of points whose foot is the vertex. See "The cone of a
  /// vertex" in docs/proofs.md.
  struct VertexLink {
    std::uint32_t chains = 0;
    std::vector<std::uint32_t> chain;  ///< of each of triangles_at(vertex)
    std::vector<bool> merged;          ///< of each chain: does it bound the cone?
    /// An extreme ray of the cone: the cross product of the directions of two edges at the vertex,
    /// away from it.
    struct Ray {
      std::array<std::uint32_t, 2> edge{};
      bool ends_axis = false;  ///< Does a sheet of the axis end there (else none does)?
    };
    std::vector<Ray> ray;
  };
  /// By exact signs. Without `merged` and `ray` if no point has the vertex as foot; nullopt if all
  /// that have lie on a ray or in a plane, or if several sheets end on one ray.
  [[nodiscard]] std::optional<VertexLink> vertex_link(std::uint32_t vertex) const;
  /// Does the ray pass through the open rectangle x[axis] = level, lo < x < hi on the other axes?
  /// Nullopt: through its border. Requires: the vertex is not in the plane.
  [[nodiscard]] std::optional<bool> passes(std::uint32_t vertex, const VertexLink::Ray& ray,
                                           int axis, double level, const Point3& lo,
                                           const Point3& hi);

  /// Side of the projection of point p of the solid, along `axis`, of the projected directed line
  /// from point a to point b: positive on the left, in coordinates (u_axis, v_axis).
  [[nodiscard]] int side_of_line(int axis, std::uint32_t a, std::uint32_t b, std::uint32_t p) const;

  /// All governors of x among `candidates` (sorted): those whose closed domain contains x and whose
  /// distance is minimal. Empty if no domain contains x.
  void governors(const Point3& x, std::span<const SiteId> candidates, std::vector<SiteId>& out);

  /// Rim test (theory section 1). r(t) = v + t (a x b), a and b the directions of two edges at v.
  /// Does every site of `sites` (all incident to v) project r(t) to v for all t?
  [[nodiscard]] bool rim_common(std::uint32_t v, std::uint32_t edge_a, std::uint32_t edge_b,
                                std::span<const SiteId> sites);
  /// Where r meets the plane x[axis] = level: sign of its coordinate `along` minus `value`;
  /// nullopt if r is parallel to the plane.
  [[nodiscard]] std::optional<int> compare_rim(std::uint32_t v, std::uint32_t edge_a,
                                               std::uint32_t edge_b, int axis, double level,
                                               int along, double value);

  /// Enclosure of unit(a) - unit(b) for two faces, with small *relative* error however close the
  /// normals are; all components zero iff the normals are equal.
  [[nodiscard]] BallVector unit_difference(SiteId face_a, SiteId face_b);

  /// Enclosure of the signed distance of a point of the solid to the plane of a triangle (negative
  /// on the solid's side), with small *relative* error; zero iff it is.
  [[nodiscard]] Ball height(std::uint32_t point, std::uint32_t triangle);

  /// Enclosure of d_a(x)^2 - d_b(x)^2 for the carriers, from 128-bit arithmetic: for a and b that
  /// balls in double do not tell apart.
  [[nodiscard]] Ball squared_difference(const Point3& x, SiteId a, SiteId b);

  /// d_a^2 - d_b^2 of two carriers as a polynomial about a point of the solid: with
  /// y = x - origin, value + 2 linear.y + y.M y.
  struct CarrierDifference {
    Point3 origin;  ///< of a
    Ball value;
    BallVector linear;
    std::array<Ball, 6> matrix;  ///< M: xx, yy, zz, xy, yz, zx
  };
  /// Its coefficients enclosed by 128-bit arithmetic: precise even where the carriers are so near
  /// to each other that differences of their own coefficients are all error.
  [[nodiscard]] CarrierDifference carrier_difference(SiteId a, SiteId b);

 private:
  [[nodiscard]] bool behind(SiteId site, SiteId other);
  template <class F>
  [[nodiscard]] int decide(F&& expression);

  const SiteGeometry* geometry_;
  StageCounts stages_;
  struct Near;
  std::vector<std::pair<Ball, SiteId>> scratch_;
};

}  // namespace blum
