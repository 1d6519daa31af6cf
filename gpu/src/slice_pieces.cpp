#include "slice_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "vector3.hpp"

namespace blum::detail {
namespace {

/// Two unit vectors across u.
std::array<Point3, 2> across(const Point3& u) {
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(u[k]) < std::abs(u[axis])) axis = k;
  }
  Point3 e{};
  e[axis] = 1;
  const Point3 first = unit(cross(u, e));
  return {first, unit(cross(u, first))};
}

double greatest_length(const ConvexPolygon& p, const PixelAffine& a, const PixelAffine& b) {
  double greatest = 0;
  for (int k = 0; k < p.size(); ++k) {
    greatest = std::max(greatest, std::hypot(a(p[k][0], p[k][1]), b(p[k][0], p[k][1])));
  }
  return greatest;
}

PixelAffine combine(double s, const PixelAffine& a, double t, const PixelAffine& b) {
  return {s * a.at + t * b.at, s * a.x + t * b.x, s * a.y + t * b.y};
}

/// Between two rays of the plane of r, and the affine function that replaces |r| there.
struct Sector {
  ConvexPolygon polygon;
  PixelAffine radius;
};

/// Sectors so narrow that |r| is exceeded by `error` at most.
template <class Use>
void for_each_sector(const ConvexPolygon& polygon, const PixelAffine& r1, const PixelAffine& r2,
                     double error, double dilation, const Use& use) {
  const double greatest = greatest_length(polygon, r1, r2);
  const double half = std::acos(greatest / (greatest + error));
  const int sectors =
      std::max(3, static_cast<int>(std::ceil(std::numbers::pi / std::max(half, 1e-4))));
  const double a = std::numbers::pi / sectors;
  for (int k = 0; k < sectors; ++k) {
    const double from = 2 * a * k, to = from + 2 * a;
    Sector sector{polygon, {}};
    // Left of the first ray, right of the second one.
    sector.polygon.clip(combine(std::sin(from), r1, -std::cos(from), r2).at_most(0, dilation));
    if (sector.polygon.size() == 0) continue;
    sector.polygon.clip(combine(-std::sin(to), r1, std::cos(to), r2).at_most(0, dilation));
    if (sector.polygon.size() == 0) continue;
    sector.radius =
        combine(std::cos(from + a) / std::cos(a), r1, std::sin(from + a) / std::cos(a), r2);
    use(sector);
  }
}

/// Rings of sqrt(height^2 + rho^2), rho >= 0, each replaced by its chord: at most `error` above.
template <class Use>
void for_each_ring(const Sector& sector, double height, double error, double dilation,
                   const Use& use) {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (int k = 0; k < sector.polygon.size(); ++k) {
    const double rho = sector.radius(sector.polygon[k][0], sector.polygon[k][1]);
    least = std::min(least, rho);
    greatest = std::max(greatest, rho);
  }
  const double h2 = height * height;
  for (double from = std::max(0.0, least); from <= greatest;) {
    // A chord over a width w is at most w^2 / 8 times the greatest second derivative too high.
    const double f2 = h2 + from * from;
    const double width = h2 > 0 ? std::sqrt(8 * error * f2 * std::sqrt(f2) / h2) : 2 * greatest;
    const double to = std::min(from + std::max(width, error), greatest + error);
    ConvexPolygon cell = sector.polygon;
    cell.clip(combine(-1, sector.radius, 0, {}).at_most(-from, dilation));
    if (cell.size() > 0) cell.clip(sector.radius.at_most(to, dilation));
    if (cell.size() > 0) {
      const double f0 = std::sqrt(f2), f1 = std::sqrt(h2 + to * to);
      const double slope = (f1 - f0) / (to - from);
      PixelAffine plane = combine(slope, sector.radius, 0, {});
      plane.at += f0 - slope * from;
      use(cell, plane);
    }
    from = to;
  }
}

}  // namespace

PixelAffine Slice::along(const Point3& w, const Point3& base) const {
  return {dot(w, {grid_.origin.x - base.x, grid_.origin.y - base.y, z_ - base.z}),
          w.x * grid_.spacing.x, w.y * grid_.spacing.y};
}

ConvexPolygon Slice::domain(const ScanSites& sites, std::uint32_t place, const PixelRect& rect,
                            const SliceStyle& style, double reach) const {
  const ScanSite& site = sites.site[place];
  PixelRect within = rect;
  if (reach < std::numeric_limits<double>::infinity()) {
    const Sphere& sphere = sites.sphere[place];
    const double far = sphere.radius + reach, height = z_ - sphere.centre.z;
    if (std::abs(height) > far) return ConvexPolygon({});
    const double radius = std::sqrt(far * far - height * height);
    const auto pixel = [this](double x, int axis) {
      return (x - grid_.origin[axis]) / grid_.spacing[axis] + 0.5;
    };
    within.x0 = std::max(within.x0, pixel(sphere.centre.x - radius, 0) - 1);
    within.y0 = std::max(within.y0, pixel(sphere.centre.y - radius, 1) - 1);
    within.x1 = std::min(within.x1, pixel(sphere.centre.x + radius, 0) + 1);
    within.y1 = std::min(within.y1, pixel(sphere.centre.y + radius, 1) + 1);
  }
  ConvexPolygon polygon(within);
  for (const Condition& c : sites.conditions(site)) {
    if (polygon.size() == 0) break;
    polygon.clip(
        along(c.w, site.base).at_most(c.limit + style.depth * std::abs(c.w.z), style.dilation));
  }
  if (site.shape != SiteKind::kFace || style.method == FieldMethod::kFragments) return polygon;
  // Enlarged sides meet far from a sharp corner: cut across, at the same distance from it.
  const auto own = sites.conditions(site).first(3);
  for (int k = 0; k < 3 && polygon.size() > 0; ++k) {
    const Condition &c = own[k], &d = own[(k + 1) % 3];
    if (dot(c.w, d.w) >= 0) continue;  // not an acute corner
    const Point3 sum = {c.w.x + d.w.x, c.w.y + d.w.y, c.w.z + d.w.z};
    const double size = length(sum);
    if (size < kSharpCorner) return ConvexPolygon({});
    // Both limits hold at the corner, so does their sum.
    polygon.clip(along(scaled(1 / size, sum), site.base)
                     .at_most((c.limit + d.limit) / size + style.depth, style.dilation));
  }
  return polygon;
}

void Slice::add_pieces(const ScanSites& sites, std::uint32_t place, const PixelRect& rect,
                       const SliceStyle& style, double reach, std::vector<SlicePiece>& out) const {
  const ConvexPolygon polygon = domain(sites, place, rect, style, reach);
  if (polygon.size() == 0) return;
  const ScanSite& site = sites.site[place];
  const auto axis = [](int k) {
    Point3 e{};
    e[k] = 1;
    return e;
  };
  if (style.method == FieldMethod::kFragments) {
    out.push_back({polygon, {}});
  } else if (site.shape == SiteKind::kFace) {
    out.push_back({polygon, {along(site.unit, site.base), {}, {}}});
  } else if (site.shape == SiteKind::kEdge) {
    const auto e = across(site.unit);
    const PixelAffine r1 = along(e[0], site.base), r2 = along(e[1], site.base);
    if (style.method == FieldMethod::kLinearFactorization) {
      out.push_back({polygon, {r1, r2, {}}});
      return;
    }
    for_each_sector(polygon, r1, r2, style.mesh_error, style.dilation, [&](const Sector& s) {
      out.push_back({s.polygon, {s.radius, {}, {}}});
    });
  } else {
    const PixelAffine rx = along(axis(0), site.base), ry = along(axis(1), site.base);
    const double height = z_ - site.base.z;
    if (style.method == FieldMethod::kLinearFactorization) {
      out.push_back({polygon, {rx, ry, {height, 0, 0}}});
      return;
    }
    for_each_sector(polygon, rx, ry, 0.5 * style.mesh_error, style.dilation, [&](const Sector& s) {
      for_each_ring(s, height, 0.5 * style.mesh_error, style.dilation,
                    [&](const ConvexPolygon& cell, const PixelAffine& plane) {
                      out.push_back({cell, {plane, {}, {}}});
                    });
    });
  }
}

}  // namespace blum::detail
