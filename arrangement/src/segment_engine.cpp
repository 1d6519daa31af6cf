#include "segment_engine.hpp"

#include <algorithm>
#include <cmath>

#include "blum/arrangement/brute_engine.hpp"
#include "blum/arrangement/polar_cone.hpp"
#include "blum/kernel/check.hpp"
#include "group_changes.hpp"
#include "slope.hpp"

namespace blum {
namespace {

constexpr int kMaxDepth = 120;
/// A stretch this many bisections deep is asked of exact algebra, once.
constexpr int kExactDepth = 40;
constexpr std::size_t kMaxExactCandidates = 12;
constexpr std::uint32_t kMaxExactStretches = 24;  // of one segment, or of all cuts of a face
/// Bisections for all segments of one face: see kMaxBoxes of the face engine.
constexpr std::uint32_t kMaxSteps = 500'000;
constexpr int kSplitAttempts = 8;
constexpr std::size_t kMaxGroups = 16;  // more: bisecting is cheaper

Point3 at(const Segment& s, double t) { return point_on(s.axis, t, s.u, s.v); }

struct Crossing {
  std::uint32_t triangle;
  double lo, hi;
};

/// Enclosure of the parameter in [t0, t1] where the line pierces a triangle's plane.
std::array<double, 2> crossing_parameter(const SiteGeometry& g, const Segment& s,
                                         std::uint32_t triangle) {
  const SiteId face = g.index().face(triangle);
  const BallVector& n = g.unit(face);
  const Ball h = dot(n, difference(at(s, s.t0), g.base(face)));
  if (n[s.axis].sign() == 2 || n[s.axis].sign() == 0) return {s.t0, s.t1};
  const Ball t = Ball(s.t0) - divide(h, n[s.axis]);
  return {std::max(s.t0, t.low()), std::min(s.t1, t.high())};
}

}  // namespace

std::optional<SiteId> SegmentEngine::governor(const Point3& x, std::span<const SiteId> candidates) {
  context_.predicates.governors(x, candidates, governors_);
  BLUM_CHECK(!governors_.empty());
  for (std::size_t i = 0; i < governors_.size(); ++i)
    for (std::size_t j = i + 1; j < governors_.size(); ++j)
      if (!context_.never_essential(governors_[i], governors_[j])) return std::nullopt;
  return governors_.front();
}

bool SegmentEngine::isolate_exactly(const Segment& line, const StretchEnd& a, const StretchEnd& b,
                                    std::span<const LocalForm> forms,
                                    std::vector<Breakpoint>& out) {
  if (a.triangle != Breakpoint::kNone || b.triangle != Breakpoint::kNone ||
      forms.size() > kMaxExactCandidates || ++exact_stretches_ > kMaxExactStretches)
    return false;
  std::vector<SiteId> sites;
  for (const LocalForm& f : forms) sites.push_back(f.site);
  std::sort(sites.begin(), sites.end());
  const auto d = brute_segment(context_.geometry.solid(), {line.axis, line.u, line.v, a.t, b.t},
                               sites, {}, true, context_.geometry.kind());
  if (!d) return false;
  ++context_.counts.exact_stretches;
  out.insert(out.end(), d->breakpoint.begin(), d->breakpoint.end());
  return true;
}

bool SegmentEngine::change_at_most_once(const Segment& line, const StretchEnd& a,
                                        const StretchEnd& b, std::span<const LocalForm> forms,
                                        const Groups& groups, const Range& range,
                                        std::vector<Breakpoint>& out) {
  const auto ga = groups.find(forms, a.label), gb = groups.find(forms, b.label);
  BLUM_CHECK(ga < groups.count && gb < groups.count);
  if (groups.count > kMaxGroups ||
      !GroupChanges(context_, line.axis, forms, groups, range).direct(ga, gb))
    return false;
  if (ga != gb) out.push_back(tie_between(a, b));
  return true;
}

Breakpoint SegmentEngine::tie_between(const StretchEnd& a, const StretchEnd& b) {
  Breakpoint p;
  p.kind = Breakpoint::Kind::kTie;
  p.lo = a.t;
  p.hi = b.t;
  p.lo_triangle = a.triangle;
  p.hi_triangle = b.triangle;
  p.below = a.label;
  p.above = b.label;
  return p;
}

bool SegmentEngine::edge_between_ends(const StretchEnd& a, const StretchEnd& b,
                                      std::span<const LocalForm> forms,
                                      std::vector<Breakpoint>& out) {
  if (!context_.voronoi() || forms.size() != 3 || b.t != std::nextafter(a.t, b.t)) return false;
  const auto form_of = [&](SiteId s) {
    return std::ranges::find_if(forms, [s](const LocalForm& f) { return f.site == s; });
  };
  const auto first = form_of(a.label), last = form_of(b.label);
  if (first == forms.end() || last == forms.end() || first == last ||
      !edge_is_between(context_.geometry, *first, *last))
    return false;
  const auto middle = std::ranges::find_if(
      forms, [&](const LocalForm& f) { return f.site != first->site && f.site != last->site; });
  const SiteIndex& index = context_.geometry.index();
  if (middle->kind != SiteKind::kEdge) return false;
  const auto& faces = context_.geometry.solid().edge[index.element(middle->site)].triangle;
  for (const auto& face : {first, last})
    if (index.face(faces[0]) != face->site && index.face(faces[1]) != face->site) return false;
  out.push_back(tie_between(a, {b.t, b.triangle, middle->site}));
  out.push_back(tie_between({a.t, a.triangle, middle->site}, b));
  return true;
}

bool SegmentEngine::merge_at_most_once(const Segment& line, const StretchEnd& a,
                                       const StretchEnd& b, std::span<const LocalForm> forms,
                                       const Range& range, std::vector<Breakpoint>& out) {
  // Theorem F on a line: feet move forward, so they come from one side of a plane across the line
  // to the other, through the only point v on it or by one tie.
  const SiteGeometry& geometry = context_.geometry;
  Direction along;
  along.w[line.axis] = Ball(1.0);
  std::vector<std::uint32_t> tried;
  for (const LocalForm& f : forms) {
    int n = 0;
    const auto corner = geometry.corners(f.site, n);
    for (int k = 0; k < n; ++k) {
      const auto v = corner[k];
      if (std::find(tried.begin(), tried.end(), v) != tried.end()) continue;
      tried.push_back(v);
      if (!may_be_foot(context_, v, forms, range)) continue;
      const auto of = sides_of(context_, forms, v, along, range);
      if (!of) continue;
      const auto side_of = [&](SiteId s) {
        for (std::size_t i = 0; i < forms.size(); ++i)
          if (forms[i].site == s) return (*of)[i];
        broken_invariant("governor not among the candidates", __FILE__, __LINE__);
      };
      const int sa = side_of(a.label), sb = side_of(b.label);
      if (sa > sb) continue;  // both ends have their foot in v
      if (sa == -1 && sb == 1) {
        // Where all sites meet in v, it is a foot in its whole polar cone.
        const bool star = std::all_of(forms.begin(), forms.end(), [&](const LocalForm& g) {
          return geometry.has_corner(g.site, v);
        });
        const bool meets = meets_polar_cone(geometry.solid(), v, at(line, std::min(a.t, b.t)),
                                            at(line, std::max(a.t, b.t)));
        if (meets && !star) continue;
        if (!meets) out.push_back(tie_between(a, b));
      }
      return true;
    }
  }
  return false;
}

Trouble SegmentEngine::isolate(const Segment& line, const StretchEnd& a, const StretchEnd& b,
                               std::span<const SiteId> candidates, std::vector<Breakpoint>& out,
                               int depth) {
  const Range range = Range::of(at(line, std::min(a.t, b.t)), at(line, std::max(a.t, b.t)));
  std::vector<LocalForm> forms;
  prune(context_.geometry, candidates, range, forms, &context_);
  const Groups ties = Groups::by_ties(context_, forms);
  if (ties.cliques && change_at_most_once(line, a, b, forms, ties, range, out)) return {};
  const Groups feet = Groups::by_feet(context_, forms, range);
  if (feet.cliques && feet != ties && change_at_most_once(line, a, b, forms, feet, range, out))
    return {};
  if (!feet.cliques && merge_at_most_once(line, a, b, forms, range, out)) return {};
  if (depth == kExactDepth && isolate_exactly(line, a, b, forms, out)) return {};
  if (context_.stopped()) return {FaceStatus::kUndecided, "stopped"};
  if (++steps_ > kMaxSteps) return {FaceStatus::kUndecided, "segment: steps spent"};
  if (depth >= kMaxDepth) return {FaceStatus::kUndecided, "segment: depth spent"};
  std::vector<SiteId> kept;
  kept.reserve(forms.size());
  for (const LocalForm& f : forms) kept.push_back(f.site);
  for (int attempt = 0; attempt < kSplitAttempts; ++attempt) {
    const double m = context_.split(a.t, b.t, attempt);
    if (!(m > a.t && m < b.t)) {
      if (depth < kExactDepth && isolate_exactly(line, a, b, forms, out)) return {};
      if (edge_between_ends(a, b, forms, out)) return {};
      return {FaceStatus::kUndecided, "segment: resolution spent"};
    }
    const Point3 x = at(line, m);
    // A stretch that ends on ∂O is only known up to the enclosure of the crossing: m must be
    // exactly on the solid's side of it.
    // Else m bounds the crossing, and the stretch is shorter than it was thought.
    if (a.triangle != Breakpoint::kNone && context_.predicates.plane_side(x, a.triangle) >= 0)
      return isolate(line, {m, a.triangle, a.label}, b, kept, out, depth + 1);
    if (b.triangle != Breakpoint::kNone && context_.predicates.plane_side(x, b.triangle) >= 0)
      return isolate(line, a, {m, b.triangle, b.label}, kept, out, depth + 1);
    const auto label = governor(x, kept);
    if (!label) continue;
    const StretchEnd middle{m, Breakpoint::kNone, *label};
    if (const Trouble t = isolate(line, a, middle, kept, out, depth + 1)) return t;
    return isolate(line, middle, b, kept, out, depth + 1);
  }
  return {FaceStatus::kUndecided, "segment: no split point in general position"};
}

Trouble SegmentEngine::solve(const Segment& segment, std::span<const SiteId> candidates,
                             std::span<const std::uint32_t> triangles, SegmentDiagram& out) {
  ++context_.counts.segments;
  Predicates& predicates = context_.predicates;
  const Solid& solid = context_.geometry.solid();
  const int ua = u_axis(segment.axis), va = v_axis(segment.axis);
  out.segment = segment;
  out.breakpoint.clear();
  out.interval.clear();

  if (context_.voronoi()) triangles = {};
  const Point3 first = at(segment, segment.t0), last = at(segment, segment.t1);
  std::vector<Crossing> crossing;
  for (const auto t : triangles) {
    const auto& v = solid.triangle[t].vertex;
    const auto outside = [&](int axis, double lo, double hi) {
      const double p = solid.point[v[0]][axis], q = solid.point[v[1]][axis],
                   r = solid.point[v[2]][axis];
      return std::min({p, q, r}) > hi || std::max({p, q, r}) < lo;
    };
    if (outside(ua, segment.u, segment.u) || outside(va, segment.v, segment.v) ||
        outside(segment.axis, segment.t0, segment.t1))
      continue;
    const auto pierced = predicates.pierces(t, segment.axis, segment.u, segment.v);
    if (!pierced) {
      // The line touches the triangle's border or lies in its plane; harmless if elsewhere on it.
      const int s0 = predicates.plane_side(first, t), s1 = predicates.plane_side(last, t);
      if (s0 * s1 > 0) continue;
      return {FaceStatus::kBadPosition, "segment meets a boundary edge"};
    }
    if (*pierced == 0) continue;
    const int s0 = predicates.plane_side(first, t), s1 = predicates.plane_side(last, t);
    if (s0 == 0 || s1 == 0) return {FaceStatus::kBadPosition, "end of a segment on the boundary"};
    if (s0 == s1) continue;
    const auto [lo, hi] = crossing_parameter(context_.geometry, segment, t);
    crossing.push_back({t, lo, hi});
  }
  bool equal = false;
  std::sort(crossing.begin(), crossing.end(), [&](const Crossing& p, const Crossing& q) {
    if (p.triangle == q.triangle) return false;
    if (p.hi < q.lo) return true;
    if (q.hi < p.lo) return false;
    const int s =
        predicates.compare_crossing(p.triangle, q.triangle, segment.axis, segment.u, segment.v);
    if (s == 0) equal = true;
    return s != 0 ? s < 0 : p.triangle < q.triangle;
  });
  if (equal) return {FaceStatus::kBadPosition, "two boundary triangles at one point of a segment"};

  const auto where =
      context_.voronoi() ? InsideOracle::Where::kInside : context_.inside.locate(first);
  if (where == InsideOracle::Where::kBoundary)
    return {FaceStatus::kBadPosition, "end of a segment on the boundary"};
  bool inside = where == InsideOracle::Where::kInside;
  const SiteIndex& index = context_.geometry.index();

  StretchEnd begin{segment.t0, Breakpoint::kNone, {}};
  if (inside) {
    const auto label = governor(first, candidates);
    if (!label) return {FaceStatus::kBadPosition, "end of a segment on an essential tie"};
    begin.label = *label;
  }
  const auto stretch = [&](const StretchEnd& end) -> Trouble {
    const std::size_t old = out.breakpoint.size();
    if (const Trouble t = isolate(segment, begin, end, candidates, out.breakpoint)) return t;
    out.interval.push_back({true, begin.label});
    for (std::size_t k = old; k < out.breakpoint.size(); ++k)
      out.interval.push_back({true, out.breakpoint[k].above});
    return {};
  };
  for (const Crossing& c : crossing) {
    const SiteId face = index.face(c.triangle);
    const StretchEnd here{0.5 * (c.lo + c.hi), c.triangle, face};
    if (inside) {
      StretchEnd end = here;
      end.t = c.hi;
      if (const Trouble t = stretch(end)) return t;
    } else {
      out.interval.push_back({false, {}});
    }
    Breakpoint p;
    p.kind = Breakpoint::Kind::kBoundary;
    p.lo = c.lo;
    p.hi = c.hi;
    p.triangle = c.triangle;
    out.breakpoint.push_back(p);
    inside = !inside;
    begin = here;
    begin.t = c.lo;
  }
  if (!inside) {
    out.interval.push_back({false, {}});
    return {};
  }
  StretchEnd end{segment.t1, Breakpoint::kNone, {}};
  const auto label = governor(last, candidates);
  if (!label) return {FaceStatus::kBadPosition, "end of a segment on an essential tie"};
  end.label = *label;
  return stretch(end);
}

}  // namespace blum
