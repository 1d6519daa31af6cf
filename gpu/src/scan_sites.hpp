/// Sites as the scan conversion wants them: carriers, and domains as half-spaces.
///
/// Bounds. Let u = 2^-53 (2^-24 where floats do the work) and R = `reach`, the 1-norm diameter of
/// the box of all samples and sites. A difference of a sample and a point errs by u R (1-norm).
/// Unit vectors of edges err by 6u, of faces by 8u (see unit_normal), their products by 20u. So a
/// value w.(x - p), with its three products and sums, errs by at most 29 u R, a limit w.(b - p) by
/// 24 u R: 53 u R together.
///   contraction = 64 u R: a site's own conditions (the foot on the carrier is in the site) are
///     tightened by it, so no sample is ever given a distance to a carrier outside of the site.
///   margin = 128 u R > (64 + 53) u R: who fails a tightened condition has its foot within `margin`
///     of the site's border, so that a side or end is within sqrt(d^2 + margin^2).
///   Conditions from incident sites are loosened by 8 margins, those from a triangle of height h
///     over the edge and longest side L by 8 margins times L / h.
/// Why nothing is missed: docs/fields.md.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "blum/gpu/site_set.hpp"
#include "blum/kernel/point.hpp"

namespace blum::detail {

/// w.(x - base) <= limit, w of length 1 up to rounding.
struct Condition {
  Point3 w;
  double limit = 0;
};

struct ScanSite {
  Point3 base;  ///< a point of the carrier
  Point3 unit;  ///< direction of an edge, normal of a face
  std::uint32_t id = 0;
  std::uint32_t first = 0, count = 0;  ///< conditions, its own first
  SiteKind shape = SiteKind::kVertex;  ///< of the carrier: a polygon's diagonals are edges
};

/// A sphere around a site, and the site's place in ScanSites::site: lists are made of these, so
/// that most sites are left out without being looked at.
struct Sphere {
  Point3 centre;  ///< a point of the site
  double radius = 0;
  std::uint32_t site = 0;
  std::uint32_t rank = 0;  ///< by ids: of equally near sites the one of lowest rank comes first
};

inline constexpr std::uint32_t kMostConditions = 8;

struct ScanSites {
  std::vector<ScanSite> site;  ///< neighbours in space beside each other, for the caches' sake
  std::vector<Sphere> sphere;  ///< of each
  std::vector<Condition> condition;
  double reach = 0, margin = 0;
  double dropped = 0;  ///< bound on what leaving out triangles thin as rounding costs

  [[nodiscard]] std::span<const Condition> conditions(const ScanSite& s) const {
    return std::span(condition).subspan(s.first, s.count);
  }
};

/// How many of a site's conditions are its own.
[[nodiscard]] inline std::uint32_t own_conditions(SiteKind shape) {
  return shape == SiteKind::kVertex ? 0 : shape == SiteKind::kEdge ? 2 : 3;
}

inline constexpr double kDoubleUnit = 0x1p-53, kFloatUnit = 0x1p-24;

/// `samples` is the box of the grid. Without `domains` only the sites' own conditions are there.
/// `unit`: the rounding of the arithmetic that will evaluate the sites.
[[nodiscard]] ScanSites make_scan_sites(const SiteSet& set, const Box3& samples, bool domains,
                                        double unit);

}  // namespace blum::detail
