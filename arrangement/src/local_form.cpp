#include "local_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "blum/kernel/closest_point.hpp"
#include "engine_context.hpp"
#include "groups.hpp"

namespace blum {
namespace {

double up(double x) { return x * (1 + 0x1p-50) + 0x1p-1000; }

constexpr std::size_t kReferences = 6;
constexpr std::size_t kMeanReferences = 3;
/// Errors of values this many times smaller than the rest of a bound do not matter.
constexpr double kRoundingCounts = 1.0 / 16;
constexpr double kNearlyParallel = 1e-6;

/// Is d_a > (d_r + d_s) / 2 everywhere, for three faces, r and s covering the range with their
/// sides?
bool farther_than_mean(const SiteGeometry& geometry, const LocalForm& a, const LocalForm& r,
                       const LocalForm& s, const Range& range) {
  const Ball half(0.5);
  const BallVector &na = geometry.unit(a.site), &nr = geometry.unit(r.site),
                   &ns = geometry.unit(s.site);
  const int sa = a.side != 0 ? a.side : a.height.mid > 0 ? 1 : -1;
  BallVector d;
  for (int k = 0; k < 3; ++k)
    d[k] = with_sign(na[k], sa) - half * (with_sign(nr[k], r.side) + with_sign(ns[k], s.side));
  return (with_sign(a.height, sa) -
          half * (with_sign(r.height, r.side) + with_sign(s.height, s.side)))
                 .low() -
             spread(d, range) >
         0;
}

/// The range leaves triangle t's prism through prism condition `k` alone. If that edge is flat and
/// the range leaves the neighbour's prism through it alone too, the two together cover the range.
bool covered_with_neighbour(const SiteGeometry& geometry, std::uint32_t t, int k,
                            const Range& range) {
  const Solid& solid = geometry.solid();
  const auto e = solid.triangle[t].edge[k];
  if (solid.edge[e].kind != EdgeKind::kFlat) return false;
  const auto other = solid.edge[e].triangle[solid.edge[e].triangle[0] == t ? 1 : 0];
  const auto domain = geometry.domain(geometry.index().face(other));
  for (int j = 0; j < 3; ++j)
    if (solid.triangle[other].edge[j] != e && !holds_everywhere(geometry, domain[j], range))
      return false;
  return true;
}

/// Are all points of the site farther from x than `distance`? By a plane between them.
bool farther_than(const SiteGeometry& geometry, SiteId site, const Point3& x, double distance) {
  const BallVector g = difference(closest_point(geometry, site, x), x);
  const double reach = up(distance * std::sqrt(dot(g, g).high()));
  int n = 0;
  const auto corner = geometry.corners(site, n);
  for (int k = 0; k < n; ++k)
    if (!(dot(g, difference(geometry.solid().point[corner[k]], x)).low() > reach)) return false;
  return true;
}

}  // namespace

int sign_over(const BallVector& w, const Point3& p, const Range& range) {
  // A difference, a product and three sums err by at most 6 * 2^-53 of `size`, the terms of the
  // bound by at most 16 * 2^-53 of them.
  double value = 0, size = 0, bound = 0;
  for (int k = 0; k < 3; ++k) {
    const double d = range.center[k] - p[k], product = w[k].mid * d;
    value += product;
    size += std::abs(product);
    bound += w[k].rad * std::abs(d) + (std::abs(w[k].mid) + w[k].rad) * range.half[k];
  }
  bound = (bound + 0x1p-49 * size) * (1 + 0x1p-48) + 0x1p-1000;
  return value > bound ? 1 : value < -bound ? -1 : 0;
}

bool holds_everywhere(const SiteGeometry& geometry, const HalfSpace& h, const Range& range) {
  return sign_over(h.w, geometry.solid().point[h.base], range) < 0;
}

BallVector signed_difference(const BallVector& a, int side_a, const BallVector& b, int side_b) {
  BallVector d;
  for (int k = 0; k < 3; ++k) d[k] = with_sign(a[k], side_a) - with_sign(b[k], side_b);
  return d;
}

double spread(const BallVector& w, const Range& r) {
  return up(w[0].magnitude() * r.half[0] + w[1].magnitude() * r.half[1] +
            w[2].magnitude() * r.half[2]);
}

double length_above(const BallVector& x) { return std::sqrt(dot(x, x).high()) * (1 + 0x1p-40); }

namespace {

/// Does the range lie behind a face of an edge, seen from where the edge governs? Its region is the
/// wedge of the normals of its two faces, which lies in front of both if they are acute. The two
/// half-spaces of the domain tell nothing where the edge is nearly flat.
bool behind_a_face(const SiteGeometry& geometry, const SolidEdge& edge, const BallVector& from_edge,
                   const Range& range) {
  const auto unit = [&](std::size_t k) -> const BallVector& {
    return geometry.unit(geometry.index().face(edge.triangle[k]));
  };
  const int out = edge.kind == EdgeKind::kConvex ? 1 : -1;
  for (const std::size_t k : {0u, 1u})
    if (with_sign(dot(unit(k), from_edge), out).high() + spread(unit(k), range) < 0)
      return dot(unit(0), unit(1)).low() >= 0;
  return false;
}

}  // namespace

BallVector away_from(const SiteGeometry& geometry, std::uint32_t edge, std::uint32_t vertex) {
  const BallVector& u = geometry.unit(geometry.index().edge(edge));
  return geometry.solid().edge[edge].vertex[0] == vertex ? u : BallVector{-u[0], -u[1], -u[2]};
}

bool outside_polar_cone(const SiteGeometry& geometry, std::uint32_t vertex, const Range& range) {
  const Solid& solid = geometry.solid();
  const Point3& p = solid.point[vertex];
  const auto edges = solid.edges_at(vertex);
  const auto away = [&](std::uint32_t e) { return away_from(geometry, e, vertex); };
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const BallVector u = away(edges[i]);
    if (sign_over(u, p, range) > 0) return true;
    // Two conditions may fail together where neither fails alone: edges nearly in line.
    for (std::size_t j = 0; j < i; ++j) {
      const BallVector w = away(edges[j]), sum = {u[0] + w[0], u[1] + w[1], u[2] + w[2]};
      if (sign_over(sum, p, range) > 0) return true;
    }
  }
  return false;
}

Range Range::of(const Point3& lo, const Point3& hi) {
  Range r;
  for (int k = 0; k < 3; ++k) {
    if (lo[k] == hi[k]) {
      r.center[k] = lo[k];
      continue;
    }
    const double c = 0.5 * lo[k] + 0.5 * hi[k];
    r.center[k] = c;
    r.half[k] = up(std::max(hi[k] - c, c - lo[k]));
  }
  return r;
}

double Range::radius() const {
  return up(std::sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2]));
}

bool local_form(const SiteGeometry& geometry, SiteId site, const Range& range, LocalForm& out) {
  const Point3& c = range.center;
  const Solid& solid = geometry.solid();
  out.site = site;
  out.kind = geometry.index().kind(site);
  const auto domain = geometry.domain(site);
  const std::uint32_t own = geometry.own_conditions(site);
  out.side = 0;
  out.covers = true;
  out.crossed = 0;
  bool incidence = true;
  int violated = 0, last_violated = 0;
  for (std::uint32_t k = 0; k < domain.size(); ++k) {
    const HalfSpace& h = domain[k];
    const int sign = sign_over(h.w, solid.point[h.base], range);
    if (sign > 0) return false;
    if (sign == 0) {
      if (k < 32) out.crossed |= 1u << k;
      if (k < own) {
        ++violated;
        last_violated = static_cast<int>(k);
      } else {
        incidence = false;
      }
    }
  }
  if (out.kind == SiteKind::kVertex &&
      outside_polar_cone(geometry, geometry.index().element(site), range))
    return false;
  if (violated > 0)
    out.covers =
        violated == 1 && out.kind == SiteKind::kFace &&
        covered_with_neighbour(geometry, geometry.index().element(site), last_violated, range);
  const BallVector d = difference(c, geometry.base(site));
  const auto two = Ball(2.0);
  switch (out.kind) {
    case SiteKind::kVertex:
      out.value = dot(d, d);
      for (int k = 0; k < 3; ++k) out.gradient[k] = two * d[k];
      out.a = {Ball(1.0), Ball(1.0), Ball(1.0), Ball(0.0), Ball(0.0), Ball(0.0)};
      break;
    case SiteKind::kEdge: {
      if (geometry.kind() == DiagramKind::kVoronoi &&
          behind_a_face(geometry, solid.edge[geometry.index().element(site)], d, range))
        return false;
      const BallVector& u = geometry.unit(site);
      const Ball along = dot(d, u);
      const BallVector m = {d[0] - u[0] * along, d[1] - u[1] * along, d[2] - u[2] * along};
      out.value = dot(m, m);
      for (int k = 0; k < 3; ++k) out.gradient[k] = two * m[k];
      const Ball one(1.0);
      out.a = {one - u[0] * u[0], one - u[1] * u[1], one - u[2] * u[2],
               -(u[0] * u[1]),    -(u[1] * u[2]),    -(u[2] * u[0])};
      break;
    }
    case SiteKind::kFace: {
      const BallVector& n = geometry.unit(site);
      out.height = dot(d, n);
      out.value = square(out.height);
      for (int k = 0; k < 3; ++k) out.gradient[k] = two * n[k] * out.height;
      out.a = {n[0] * n[0], n[1] * n[1], n[2] * n[2], n[0] * n[1], n[1] * n[2], n[2] * n[0]};
      if (geometry.kind() == DiagramKind::kMedial) {
        out.side = -1;
      } else {
        const double s = spread(n, range);
        out.side = out.height.low() > s ? 1 : out.height.high() < -s ? -1 : 0;
        incidence = out.side != 0;
      }
      break;
    }
  }
  out.covers_side = out.covers && incidence;
  return true;
}

namespace {

PairForm difference_of(const LocalForm& a, const LocalForm& b) {
  PairForm r;
  r.value = a.value - b.value;
  for (std::size_t k = 0; k < 3; ++k) r.gradient[k] = a.gradient[k] - b.gradient[k];
  for (std::size_t k = 0; k < 6; ++k) r.a[k] = a.a[k] - b.a[k];
  return r;
}

PairForm precise_difference(EngineContext& context, const LocalForm& a, const LocalForm& b,
                            const Range& range) {
  const Predicates::CarrierDifference& d = context.carrier_difference(a.site, b.site);
  const BallVector y = difference(range.center, d.origin);
  PairForm r;
  r.a = d.matrix;
  BallVector half;
  for (int i = 0; i < 3; ++i)
    half[i] = d.linear[i] + r.matrix(i, 0) * y[0] + r.matrix(i, 1) * y[1] + r.matrix(i, 2) * y[2];
  for (std::size_t i = 0; i < 3; ++i) r.gradient[i] = Ball(2.0) * half[i];
  r.value = d.value + dot(d.linear, y) + dot(half, y);
  return r;
}

/// Is the form positive wherever in the range the conditions of the site's domain hold? With a
/// multiple of one of them, which is not positive there, that leaves the least slope.
bool farther_in_domain(const SiteGeometry& geometry, SiteId site, const PairForm& form,
                       const Range& range) {
  const Solid& solid = geometry.solid();
  const auto domain = geometry.domain(site);
  for (std::uint32_t k = 0; k < domain.size(); ++k) {
    const HalfSpace& h = domain[k];
    double up = 0, down = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double weight = range.half[i] * range.half[i];
      up -= weight * form.gradient[i].mid * h.w[i].mid;
      down += weight * h.w[i].mid * h.w[i].mid;
    }
    if (!(up > 0 && down > 0)) continue;
    const Ball times(up / down);
    PairForm rest = form;
    rest.value = rest.value + times * dot(h.w, difference(range.center, solid.point[h.base]));
    for (std::size_t i = 0; i < 3; ++i) rest.gradient[i] = rest.gradient[i] + times * h.w[i];
    if (rest.value.low() - rest.slack(range) > 0) return true;
  }
  return false;
}

}  // namespace

double PairForm::slack(const Range& range) const {
  double second = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) second += matrix(i, j).magnitude() * range.half[i] * range.half[j];
  return up(spread(gradient, range) + up(second));
}

bool nearly_parallel_edges(const SiteGeometry& geometry, const LocalForm& a, const LocalForm& b) {
  if (a.kind != SiteKind::kEdge || b.kind != SiteKind::kEdge) return false;
  const BallVector &u = geometry.unit(a.site), &v = geometry.unit(b.site);
  double square = 0;
  for (int k = 0; k < 3; ++k) {
    const double c =
        u[(k + 1) % 3].mid * v[(k + 2) % 3].mid - u[(k + 2) % 3].mid * v[(k + 1) % 3].mid;
    square += c * c;
  }
  return square < kNearlyParallel * kNearlyParallel;
}

PairForm pair_form(EngineContext& context, const LocalForm& a, const LocalForm& b,
                   const Range& range) {
  return !context.plain && nearly_parallel_edges(context.geometry, a, b)
             ? precise_difference(context, a, b, range)
             : difference_of(a, b);
}

bool certainly_farther(const SiteGeometry& geometry, const LocalForm& a, const LocalForm& b,
                       const Range& range, EngineContext* context) {
  if (a.kind == SiteKind::kFace && b.kind == SiteKind::kFace && b.covers_side) {
    // The distances are the heights times their signs: linear, no second-order loss. (With any
    // sign for a, its distance is at least that.)
    const int side = a.side != 0 ? a.side : a.height.mid > 0 ? 1 : -1;
    const BallVector &na = geometry.unit(a.site), &nb = geometry.unit(b.site);
    const BallVector d = signed_difference(na, side, nb, b.side);
    const Ball h = with_sign(a.height, side) - with_sign(b.height, b.side);
    if (h.low() - spread(d, range) > 0) return true;
    return context != nullptr && side == b.side &&
           heights_compared(*context, a.site, b.site, range) == side;
  }
  const PairForm form = difference_of(a, b);
  const Ball& value = form.value;
  const double slack = form.slack(range);
  if (value.low() - slack > 0) return true;
  if (context != nullptr && !context->plain && value.high() > 0 &&
      nearly_parallel_edges(geometry, a, b)) {
    const PairForm precise = precise_difference(*context, a, b, range);
    return precise.value.low() - precise.slack(range) > 0 ||
           farther_in_domain(geometry, a.site, precise, range);
  }
  // In ranges so small that the error of the values decides, they are taken more precisely.
  return context != nullptr && value.rad > slack * kRoundingCounts && value.high() - slack > 0 &&
         context->predicates.squared_difference(range.center, a.site, b.site).low() - slack > 0;
}

int heights_compared(EngineContext& context, SiteId a, SiteId b, const Range& range) {
  const SiteGeometry& geometry = context.geometry;
  const CommonCorners common = common_corners(geometry, a, b);
  const BallVector& d = context.unit_difference(a, b);
  // For p in the plane of a: height(a) - height(b) at x is d.(x - p) less the height of p in b.
  const Solid& solid = geometry.solid();
  const bool meet = common.count > 0;
  const auto p = meet ? common.vertex[0] : solid.triangle[geometry.index().element(a)].vertex[0];
  Ball h = dot(d, difference(range.center, solid.point[p]));
  if (!meet) {
    // Planes at an angle are told apart by bisecting, well above the error of their heights.
    if (std::max({d[0].magnitude(), d[1].magnitude(), d[2].magnitude()}) > kNearlyParallel)
      return 0;
    h = h - context.height(p, b);
  }
  const double s = spread(d, range);
  return h.low() > s ? 1 : h.high() < -s ? -1 : 0;
}

void prune(const SiteGeometry& geometry, std::span<const SiteId> candidates, const Range& range,
           std::vector<LocalForm>& out, EngineContext* context, double hint) {
  out.clear();
  out.reserve(candidates.size());
  const double radius = range.radius();
  // Upper bound on the distance at the centre: from carriers whose foot is certainly in the site,
  // else from a point of the site.
  double nearest = hint;
  LocalForm form;
  for (const SiteId s : candidates) {
    if (!local_form(geometry, s, range, form)) continue;
    out.push_back(form);
    double upper;
    if (form.covers) {
      upper = std::sqrt(std::max(0.0, form.value.high()));
    } else if (form.value.low() > nearest * nearest) {
      continue;  // its carrier is farther than the bound already found
    } else {
      const BallVector d = difference(range.center, closest_point(geometry, s, range.center));
      upper = std::sqrt(dot(d, d).high()) + kOnSite;
    }
    nearest = std::min(nearest, up(upper));
  }
  const double limit = up(nearest + 2 * radius);
  const bool two_sided = geometry.kind() == DiagramKind::kVoronoi;
  const auto too_far = [&](const LocalForm& f) {
    if (f.kind == SiteKind::kFace) {
      const double s = spread(geometry.unit(f.site), range), allowed = up(limit - radius);
      return -f.height.high() - s > allowed || (two_sided && f.height.low() - s > allowed);
    }
    return f.value.low() > up(limit * limit);
  };
  // What does not cover the range may have a carrier near by while the site itself is far: slivers
  // above all, whose prism is too thin for its half-spaces to tell.
  const auto site_too_far = [&](const LocalForm& f) {
    return !f.covers && farther_than(geometry, f.site, range.center, limit);
  };
  std::erase_if(out, [&](const LocalForm& f) { return too_far(f) || site_too_far(f); });
  if (out.size() < 2) return;

  std::array<std::uint32_t, kReferences> reference{};
  std::size_t references = 0;
  for (std::uint32_t i = 0; i < out.size(); ++i) {
    if (!out[i].covers) continue;
    // The few nearest covering candidates, by insertion.
    std::size_t at = references;
    if (references < kReferences) {
      ++references;
    } else if (out[i].value.mid >= out[reference[kReferences - 1]].value.mid) {
      continue;
    } else {
      at = kReferences - 1;
    }
    while (at > 0 && out[reference[at - 1]].value.mid > out[i].value.mid) {
      reference[at] = reference[at - 1];
      --at;
    }
    reference[at] = i;
  }
  std::vector<LocalForm> ref;
  for (std::size_t r = 0; r < references; ++r) ref.push_back(out[reference[r]]);
  std::erase_if(out, [&](const LocalForm& f) {
    for (const LocalForm& r : ref)
      if (r.site != f.site && certainly_farther(geometry, f, r, range, context)) return true;
    return false;
  });
  // What is farther than the mean of two is farther than one of them at every point. That drops a
  // face whose distance nowhere reaches a seam between two others (a seam along the range).
  std::erase_if(ref,
                [](const LocalForm& f) { return f.kind != SiteKind::kFace || !f.covers_side; });
  if (ref.size() < 2 || out.size() < 3) return;
  if (ref.size() > kMeanReferences) ref.resize(kMeanReferences);
  std::erase_if(out, [&](const LocalForm& f) {
    if (f.kind != SiteKind::kFace) return false;
    for (std::size_t r = 0; r < ref.size(); ++r)
      for (std::size_t s = r + 1; s < ref.size(); ++s)
        if (f.site != ref[r].site && f.site != ref[s].site &&
            farther_than_mean(geometry, f, ref[r], ref[s], range))
          return true;
    return false;
  });
}

}  // namespace blum
