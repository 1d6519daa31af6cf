#include "line.hpp"

#include <cmath>
#include <limits>

#include "exact.hpp"

namespace blum::verify {

constexpr int kMaxDepth = 100, kPatience = 12;  // bisections; halves are the cheaper reason first

/// A governor of x, if all governors of x are ties that are never essential (Lemma 1).
std::optional<Site> LineSolver::label(const Point3& x, std::span<const Site> candidates) const {
  const auto found = exclusion_.sites().governors(x, candidates);
  require(!found.empty(), "a point of the solid has no governor among the candidates");
  for (const Site a : found)
    for (const Site b : found)
      if (!exclusion_.sites().never_essential(a, b)) return std::nullopt;
  return found.front();
}

/// "Lines" of docs/proofs.md; by slopes at the ends alone, unless thorough.
bool LineSolver::at_most_one(const Segment& line, const StretchEnd& a, const StretchEnd& b,
                             std::span<const Site> sites, const Groups& groups,
                             const SharedFeet& feet, bool thorough,
                             std::vector<Line::Change>& out) const {
  if (!groups.cliques) return false;
  const std::uint32_t n = groups.count, first = groups.find(sites, a.label),
                      last = groups.find(sites, b.label);
  require(first < n && last < n, "line: the governor of an end was excluded");
  const Box3& box = feet.box();
  Vec<Rational> axis{};
  axis[static_cast<std::size_t>(line.axis)] = 1;
  const Exact w(axis);
  // Where the governor may change from one group to another: a pair where the first does not gain.
  std::vector<bool> walk(std::size_t{n} * n, false);
  for (std::size_t i = 0; i < sites.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Site p = sites[i], q = sites[j];
      const std::size_t g = groups.of[i], h = groups.of[j];
      if (g == h || (walk[g * n + h] && walk[h * n + g]) || exclusion_.never_tie(p, q, box) ||
          (thorough && !may_both_govern(exclusion_, box, p, q)))
        continue;
      const int low = exclusion_.sites().slope(box.lo, p, q, w),
                high = exclusion_.sites().slope(box.hi, p, q, w);
      const auto gain = [&](int sign, Site x, Site y) {
        return (low == sign && high == sign) || (thorough && gains(exclusion_, box, feet, x, y, w));
      };
      if (!gain(-1, p, q)) walk[g * n + h] = true;
      if (!gain(1, q, p)) walk[h * n + g] = true;
    }
  // Every walk from the first to the last has one step (none, if they are the same)?
  for (std::uint32_t k = 0; k < n; ++k)
    for (std::uint32_t g = 0; g < n; ++g)
      for (std::uint32_t h = 0; walk[g * n + k] && h < n; ++h)
        if (walk[k * n + h]) walk[g * n + h] = true;
  if (walk[first * n + first] || walk[last * n + last]) return false;
  for (std::uint32_t k = 0; first != last && k < n; ++k)
    if (walk[first * n + k] && walk[k * n + last]) return false;
  if (first != last) out.push_back({false, 0, a, b});
  return true;
}

void LineSolver::ties(const Segment& line, const StretchEnd& a, const StretchEnd& b,
                      std::span<const Site> candidates, std::vector<Line::Change>& out,
                      int depth) const {
  const Box3 box{at(line, std::min(a.t, b.t)), at(line, std::max(a.t, b.t))};
  std::vector<Site> sites = exclusion_.remaining(candidates, box);
  const bool thorough = depth >= kPatience;
  if (thorough) std::erase_if(sites, [&](Site s) { return exclusion_.outside_polar_cone(s, box); });
  const SharedFeet feet(exclusion_, sites, box);
  const auto decided = [&](const Groups& groups) {
    return at_most_one(line, a, b, sites, groups, feet, thorough, out);
  };
  if (decided(groups_by_ties(exclusion_.sites(), sites, box)) ||
      (thorough && decided(groups_by_feet(exclusion_.sites(), sites, feet))))
    return;
  if (depth == kMaxDepth) throw Undecided("line: bisection does not decide (Theorem D' on a line)");
  for (const double share : {0.5, 0.4375, 0.53125, 0.4609375}) {
    const double m = a.t + share * (b.t - a.t);
    if (!(m > a.t && m < b.t)) {
      if (a.triangle != kNone || b.triangle != kNone)
        throw Undecided("line: no number left beside a crossing");
      const std::size_t n = algebra_.ties({line.axis, line.u, line.v, a.t, b.t}, sites);
      if (n > 1) throw Undecided("line: several ties between two numbers");
      if (n == 1) out.push_back({false, 0, a, b});
      return;
    }
    const Point3 x = at(line, m);
    const auto outside = [&](const StretchEnd& e) {
      return e.triangle != kNone && exclusion_.sites().shape().side_of_plane(e.triangle, x) >= 0;
    };
    if (outside(a) || outside(b)) continue;
    const auto middle = label(x, sites);
    if (!middle) continue;
    ties(line, a, {m, kNone, *middle}, sites, out, depth + 1);
    return ties(line, {m, kNone, *middle}, b, sites, out, depth + 1);
  }
  throw Undecided("line: not in general position");
}

Line LineSolver::solve(const Segment& segment, bool starts_inside, std::span<const Site> candidates,
                       std::span<const std::uint32_t> triangles) const {
  const Shape& shape = exclusion_.sites().shape();
  const auto crossed = triangles_crossed(shape, segment, triangles);
  require(crossed.has_value(), "line: meets a boundary edge, or ends on the boundary");
  std::vector<std::pair<Rational, std::uint32_t>> crossing;
  for (const auto t : *crossed) {
    const Vec<Rational>& n = shape.normal<Rational>(t);
    const Rational height =
        inner(n, shape.from<Rational>(shape.triangle[t].vertex[0], at(segment, segment.t0)));
    crossing.emplace_back(Rational(segment.t0) - height / n[segment.axis], t);
  }
  std::ranges::sort(crossing);
  for (std::size_t k = 1; k < crossing.size(); ++k)
    require(crossing[k - 1].first < crossing[k].first, "line: two triangles at one point");

  Line line{segment, {}, {}};
  const auto end_at = [&](double t) {
    const auto found = label(at(segment, t), candidates);
    require(found.has_value(), "line: ends on an essential tie");
    return StretchEnd{t, kNone, *found};
  };
  bool inside = starts_inside;
  StretchEnd begin;
  if (inside) begin = end_at(segment.t0);
  const auto stretch = [&](const StretchEnd& end) {
    line.piece.push_back({inside, begin.label});
    if (!inside) return;
    std::size_t k = line.change.size();
    ties(segment, begin, end, candidates, line.change, 0);
    for (; k < line.change.size(); ++k) line.piece.push_back({true, line.change[k].above.label});
  };
  for (const auto& [exact, triangle] : crossing) {
    // get_d truncates: the next doubles enclose.
    const double t = exact.get_d(), infinity = std::numeric_limits<double>::infinity();
    const StretchEnd end{std::min(segment.t1, std::nextafter(t, infinity)), triangle,
                         shape.face_site(triangle)};
    stretch(end);
    begin = end;
    begin.t = std::max(segment.t0, std::nextafter(t, -infinity));
    line.change.push_back({true, triangle, begin, end});
    inside = !inside;
  }
  stretch(inside ? end_at(segment.t1) : StretchEnd{});
  return line;
}

std::array<Line, 2> LineSolver::cut(const Line& line, double m,
                                    std::span<const Site> candidates) const {
  const Point3 x = at(line.segment, m);
  const auto side = [&](std::uint32_t triangle) {
    const int s = exclusion_.sites().shape().side_of_plane(triangle, x);
    require(s != 0, "line: cut on the boundary");
    return s;
  };
  const auto after_begin = [&](const StretchEnd& e) {
    return e.triangle == kNone ? m > e.t : side(e.triangle) < 0;
  };
  std::ptrdiff_t k = 0;  // the first change that is not below m, or has m beside it
  for (; k < std::ssize(line.change); ++k) {
    const Line::Change& c = line.change[k];
    const StretchEnd& e = c.above;
    if (c.boundary            ? (side(c.triangle) < 0) == line.piece[k].inside
        : e.triangle == kNone ? m < e.t
                              : side(e.triangle) < 0)
      break;
  }
  Line low = line, high = line;
  low.segment.t1 = high.segment.t0 = m;
  low.change.resize(k);
  low.piece.resize(k + 1);
  high.change.erase(high.change.begin(), high.change.begin() + k);
  high.piece.erase(high.piece.begin(), high.piece.begin() + k);
  if (!line.piece[k].inside) return {low, high};
  const auto here = label(x, candidates);
  require(here.has_value(), "line: cut on an essential tie");
  if (k < std::ssize(line.change) && !line.change[k].boundary &&
      after_begin(line.change[k].below)) {
    const Line::Change& c = line.change[k];
    std::vector<Line::Change> before, after;
    ties(line.segment, c.below, {m, kNone, *here}, candidates, before, 0);
    ties(line.segment, {m, kNone, *here}, c.above, candidates, after, 0);
    require(before.size() + after.size() == 1, "line: a cut finds another number of ties");
    if (before.empty()) {
      high.change[0] = after[0];
    } else {
      low.change.push_back(before[0]);
      low.piece.push_back(line.piece[k + 1]);
      high.change.erase(high.change.begin());
      high.piece.erase(high.piece.begin());
    }
    (before.empty() ? high.change[0] : low.change.back()).id = c.id;
  }
  low.piece.back().label = high.piece.front().label = *here;
  return {low, high};
}

}  // namespace blum::verify
