#include "line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "failure.hpp"
#include "gains.hpp"
#include "inside.hpp"

namespace blum::verify {
namespace {

constexpr int kMaxDepth = 100, kPatience = 12;  // bisections; halves are the cheaper reason first

Box3 hull(const Segment& s, double a, double b) {
  return {at(s, std::min(a, b)), at(s, std::max(a, b))};
}

struct Crossing {
  Rational t;
  std::uint32_t triangle;
};

}  // namespace

std::optional<Site> LineSolver::label(const Point3& x, std::span<const Site> candidates) const {
  const Sites& sites = exclusion_.sites();
  const auto found = sites.governors(x, candidates);
  require(!found.empty(), "a point of the solid has no governor among the candidates");
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!sites.never_essential(found[i], found[j])) return std::nullopt;
  return found.front();
}

bool LineSolver::at_most_one(const Segment& line, const StretchEnd& a, const StretchEnd& b,
                             std::span<const Site> sites, const Groups& groups,
                             const SharedFeet& feet, bool thorough,
                             std::vector<Change>& out) const {
  if (!groups.cliques) return false;
  const auto first = groups.find(sites, a.label), last = groups.find(sites, b.label);
  require(first < groups.count && last < groups.count, "line: the governor of an end was excluded");
  const Box3 box = hull(line, a.t, b.t);
  Vec<Rational> w{};
  w[line.axis] = 1;
  // Where the governor may change from one group to another: a pair where the first does not gain.
  const std::uint32_t n = groups.count;
  std::vector<bool> walk(std::size_t{n} * n, false);
  for (std::size_t i = 0; i < sites.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Site p = sites[i], q = sites[j];
      const std::size_t forth = groups.of[i] * n + groups.of[j],
                        back = groups.of[j] * n + groups.of[i];
      if (forth == back || (walk[forth] && walk[back]) || exclusion_.never_tie(p, q, box) ||
          (thorough && !may_both_govern(exclusion_, box, p, q)))
        continue;
      const int low = exclusion_.sites().slope(box.lo, p, q, w),
                high = exclusion_.sites().slope(box.hi, p, q, w);
      const auto gain = [&](int sign, Site x, Site y) {
        return (low == sign && high == sign) || (thorough && gains(exclusion_, box, feet, x, y, w));
      };
      if (!gain(-1, p, q)) walk[forth] = true;
      if (!gain(1, q, p)) walk[back] = true;
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
                      std::span<const Site> candidates, std::vector<Change>& out, int depth) const {
  const Box3 box = hull(line, a.t, b.t);
  std::vector<Site> sites = exclusion_.remaining(candidates, box);
  const bool thorough = depth >= kPatience;
  if (thorough) std::erase_if(sites, [&](Site s) { return exclusion_.outside_polar_cone(s, box); });
  const SharedFeet feet(exclusion_, sites, box);
  if (at_most_one(line, a, b, sites, groups_by_ties(exclusion_.sites(), sites, box), feet, thorough,
                  out) ||
      (thorough && at_most_one(line, a, b, sites, groups_by_feet(exclusion_.sites(), sites, feet),
                               feet, thorough, out)))
    return;
  require(depth < kMaxDepth, "line: bisection does not decide (Theorem D' on a line)");
  for (const double share : {0.5, 0.4375, 0.53125, 0.4609375}) {
    const double m = a.t + share * (b.t - a.t);
    require(m > a.t && m < b.t, "line: no number left between two points (Theorem D' on a line)");
    const Point3 x = at(line, m);
    const auto outside = [&](const StretchEnd& e) {
      return e.triangle != StretchEnd::kNone &&
             exclusion_.sites().shape().side_of_plane(e.triangle, x) >= 0;
    };
    if (outside(a) || outside(b)) continue;
    const auto middle_label = label(x, sites);
    if (!middle_label) continue;
    const StretchEnd middle{m, StretchEnd::kNone, *middle_label};
    ties(line, a, middle, sites, out, depth + 1);
    ties(line, middle, b, sites, out, depth + 1);
    return;
  }
  throw Failure("line: not in general position");
}

Line LineSolver::solve(const Segment& segment, bool starts_inside, std::span<const Site> candidates,
                       std::span<const std::uint32_t> triangles) const {
  const Shape& shape = exclusion_.sites().shape();
  std::vector<Crossing> crossing;
  const Point3 first = at(segment, segment.t0), last = at(segment, segment.t1);
  for (const auto t : triangles) {
    const auto corner = [&](int k) { return shape.point[shape.triangle[t].vertex[k % 3]]; };
    int left = 0, right = 0, on = 0;
    for (int k = 0; k < 3; ++k) {
      const int s = turn(segment.axis, corner(k), corner(k + 1), segment.u, segment.v);
      ++(s > 0 ? left : s < 0 ? right : on);
    }
    if (left > 0 && right > 0) continue;
    const int s0 = shape.side_of_plane(t, first), s1 = shape.side_of_plane(t, last);
    if (s0 * s1 > 0) continue;
    require(on == 0 && s0 != 0 && s1 != 0, "line: meets a boundary edge, or ends on the boundary");
    const Vec<Rational> n = shape.normal<Rational>(t);
    const Rational height = inner(n, minus(exactly<Rational>(first), exactly<Rational>(corner(0))));
    crossing.push_back({Rational(segment.t0) - height / n[segment.axis], t});
  }
  std::ranges::sort(crossing, [](const Crossing& p, const Crossing& q) { return p.t < q.t; });
  for (std::size_t k = 1; k < crossing.size(); ++k)
    require(crossing[k - 1].t < crossing[k].t, "line: two triangles at one point");

  Line line{segment, {}, {}};
  bool inside = starts_inside;
  StretchEnd begin{segment.t0, StretchEnd::kNone, 0};
  const auto end_at = [&](const Point3& x) {
    const auto found = label(x, candidates);
    require(found.has_value(), "line: ends on an essential tie");
    return *found;
  };
  if (inside) begin.label = end_at(first);
  const auto stretch = [&](const StretchEnd& end) {
    const std::size_t old = line.change.size();
    ties(segment, begin, end, candidates, line.change, 0);
    line.piece.push_back({true, begin.label});
    for (std::size_t k = old; k < line.change.size(); ++k)
      line.piece.push_back({true, line.change[k].above.label});
  };
  for (const Crossing& c : crossing) {
    // get_d truncates: the next doubles enclose.
    const double t = c.t.get_d(), infinity = std::numeric_limits<double>::infinity();
    StretchEnd here{t, c.triangle, shape.face_site(c.triangle)};
    here.t = std::min(segment.t1, std::nextafter(t, infinity));
    if (inside)
      stretch(here);
    else
      line.piece.push_back({});
    StretchEnd after = here;
    after.t = std::max(segment.t0, std::nextafter(t, -infinity));
    line.change.push_back({true, c.triangle, after, here});
    begin = after;
    inside = !inside;
  }
  if (!inside) {
    line.piece.push_back({});
  } else {
    stretch({segment.t1, StretchEnd::kNone, end_at(last)});
  }
  return line;
}

std::array<Line, 2> LineSolver::cut(const Line& line, double m,
                                    std::span<const Site> candidates) const {
  const Point3 x = at(line.segment, m);
  const Shape& shape = exclusion_.sites().shape();
  std::size_t first = 0;  // changes below m, counting whole stretches
  for (std::size_t k = 0; k < line.change.size(); ++k) {
    if (!line.change[k].boundary) continue;
    const int side = shape.side_of_plane(line.change[k].triangle, x);
    require(side != 0, "line: cut on the boundary");
    const bool enters = !line.piece[k].inside;
    if ((side < 0) != enters) break;
    first = k + 1;
  }
  std::array<Line, 2> half{Line{line.segment, {}, {}}, Line{line.segment, {}, {}}};
  half[0].segment.t1 = half[1].segment.t0 = m;
  std::size_t below = first;
  std::optional<Site> here;
  if (line.piece[first].inside) {
    here = label(x, candidates);
    require(here.has_value(), "line: cut on an essential tie");
    for (; below < line.change.size() && !line.change[below].boundary; ++below) {
      const Change& c = line.change[below];
      const bool after_begin = c.below.triangle != StretchEnd::kNone || m > c.below.t;
      const bool before_end = c.above.triangle != StretchEnd::kNone || m < c.above.t;
      if (!after_begin) break;
      if (!before_end) continue;
      const StretchEnd middle{m, StretchEnd::kNone, *here};
      std::vector<Change> low, high;
      ties(line.segment, c.below, middle, candidates, low, 0);
      ties(line.segment, middle, c.above, candidates, high, 0);
      require(low.size() + high.size() == 1, "line: a cut finds another number of ties");
      half[0].change.assign(line.change.begin(), line.change.begin() + static_cast<long>(below));
      half[1].change = high;
      half[0].change.insert(half[0].change.end(), low.begin(), low.end());
      half[1].change.insert(half[1].change.end(),
                            line.change.begin() + static_cast<long>(below) + 1, line.change.end());
      const std::size_t at = half[0].change.size();
      half[0].piece.assign(line.piece.begin(), line.piece.begin() + static_cast<long>(at) + 1);
      half[1].piece.assign(line.piece.begin() + static_cast<long>(at), line.piece.end());
      half[0].piece.back().label = half[1].piece.front().label = *here;
      return half;
    }
  }
  half[0].change.assign(line.change.begin(), line.change.begin() + static_cast<long>(below));
  half[1].change.assign(line.change.begin() + static_cast<long>(below), line.change.end());
  half[0].piece.assign(line.piece.begin(), line.piece.begin() + static_cast<long>(below) + 1);
  half[1].piece.assign(line.piece.begin() + static_cast<long>(below), line.piece.end());
  if (here) half[0].piece.back().label = half[1].piece.front().label = *here;
  return half;
}

}  // namespace blum::verify
