#include "segment_diagram.hpp"

#include <algorithm>

namespace blum::cgal {
namespace {

Sample on_line(const Root& t) { return {Root(Rational(0)), t}; }

/// Distinct roots between lo and hi, and both, in order.
std::vector<Root> break_points(const Forms& f, const Rational& lo, const Rational& hi) {
  std::vector<Root> out{Root(lo), Root(hi)};
  const auto add = [&](const Quadratic& q) {
    const Roots r = roots(q.vv, q.v, q.c);
    for (int k = 0; k < r.count; ++k) {
      const Root& t = r.root[static_cast<std::size_t>(k)];
      if (CGAL::compare(t, Root(lo)) == CGAL::LARGER && CGAL::compare(t, Root(hi)) == CGAL::SMALLER)
        out.push_back(t);
    }
  };
  for (std::size_t i = 0; i < f.site.size(); ++i) {
    for (const Affine& a : f.site[i].domain) add(quadratic(a));
    for (std::size_t j = 0; j < i; ++j)
      add(f.site[i].squared_distance - f.site[j].squared_distance);
  }
  for (const TriangleForm& t : f.triangle) {
    add(quadratic(t.plane));
    for (const Affine& a : t.prism) add(quadratic(a));
  }
  std::sort(out.begin(), out.end(),
            [](const Root& a, const Root& b) { return CGAL::compare(a, b) == CGAL::SMALLER; });
  out.erase(
      std::unique(out.begin(), out.end(),
                  [](const Root& a, const Root& b) { return CGAL::compare(a, b) == CGAL::EQUAL; }),
      out.end());
  return out;
}

/// Three sites each two of which tie essentially.
bool essential_triple(const Forms& f, const std::vector<int>& sites) {
  const auto e = [&](int i, int j) {
    return f.essential[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] != 0;
  };
  for (const int i : sites)
    for (const int j : sites)
      for (const int k : sites)
        if (e(i, j) && e(j, k) && e(i, k)) return true;
  return false;
}

class Walk {
 public:
  Walk(const Forms& forms, SegmentDiagram& out) : f_(forms), out_(out) {}

  void interval(const Sample& p, bool inside) {
    below_ = inside ? f_.governors(p) : std::vector<int>{};
    if (inside && below_.empty()) throw std::logic_error("the candidates miss a governor");
    if (inside && f_.essential_pair(below_, below_)) throw BadPosition("a sheet along the segment");
    if (!f_.triangles(p).empty()) throw BadPosition("the segment lies in the boundary");
    if (out_.interval.size() == out_.breakpoint.size())
      out_.interval.push_back({inside, inside ? f_.site[at(below_[0])].id : SiteId{}});
  }

  /// Between an interval with governors below_ and one whose sample is `next`. Returns whether the
  /// segment crosses the boundary here.
  bool point(const Root& t, const Sample& next, bool inside) {
    const Sample p = on_line(t);
    const std::vector<int> hit = f_.triangles(p);
    Breakpoint b;
    if (!hit.empty()) {
      const auto& prism = f_.triangle[at(hit[0])].prism;
      if (hit.size() > 1 || std::any_of(prism.begin(), prism.end(), [&](const Affine& a) {
            return CGAL::sign(value(a, p)) == CGAL::ZERO;
          }))
        throw BadPosition("a boundary edge or vertex on the segment");
      b.kind = Breakpoint::Kind::kBoundary;
      b.triangle = f_.triangle[at(hit[0])].id;
    } else {
      if (!inside) return false;
      const std::vector<int> here = f_.governors(p);
      if (!f_.essential_pair(here, here)) return false;
      const std::vector<int> above = f_.governors(next);
      b.kind = Breakpoint::Kind::kTie;
      if (essential_triple(f_, here)) throw BadPosition("three governors at a point");
      if (!f_.feet_differ(here, p)) throw BadPosition("a rim on the segment");
      const auto pair = [&] {
        for (const int i : below_)
          for (const int j : above)
            if (f_.essential[at(i)][at(j)]) return std::pair(i, j);
        throw BadPosition("a sheet touches the segment");
      }();
      b.below = f_.site[at(pair.first)].id;
      b.above = f_.site[at(pair.second)].id;
    }
    b.lo = double_below(t);
    b.hi = double_above(t);
    if (!out_.breakpoint.empty() && b.lo < out_.breakpoint.back().hi)
      throw BadPosition("two breakpoints between two doubles");
    out_.breakpoint.push_back(b);
    return b.kind == Breakpoint::Kind::kBoundary;
  }

  void end(const Root& t, bool inside) const {
    const Sample p = on_line(t);
    if (!f_.triangles(p).empty()) throw BadPosition("an end on the boundary");
    if (!inside) return;
    const std::vector<int> here = f_.governors(p);
    if (f_.essential_pair(here, here)) throw BadPosition("an end on a tie");
  }

 private:
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }
  const Forms& f_;
  SegmentDiagram& out_;
  std::vector<int> below_;
};

}  // namespace

SegmentDiagram segment_diagram(const Solid& solid, const Segment& segment,
                               std::span<const SiteId> candidates,
                               std::span<const std::uint32_t> triangles, const InsideTest* test) {
  const Forms f = segment_forms(solid, segment, candidates, triangles);
  const std::vector<Root> t = break_points(f, Rational(segment.t0), Rational(segment.t1));
  SegmentDiagram out;
  out.segment = segment;
  const auto sample = [&](std::size_t k) { return on_line(Root(between(t[k], t[k + 1]))); };
  const auto is_inside = [&](const Sample& p) {
    if (test == nullptr) return true;
    Vector x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = value(f.x[k], p).a0();
    return test->inside(x);
  };
  Walk walk(f, out);
  const Sample first = sample(0);
  if (!f.triangles(first).empty()) throw BadPosition("the segment lies in the boundary");
  bool inside = is_inside(first);
  walk.end(t.front(), inside);
  walk.interval(first, inside);
  for (std::size_t k = 1; k + 1 < t.size(); ++k) {
    const Sample next = sample(k);
    if (walk.point(t[k], next, inside)) inside = !inside;
    walk.interval(next, inside);
  }
  walk.end(t.back(), inside);
  if (inside != is_inside(sample(t.size() - 2))) throw std::logic_error("inside by parity");
  return out;
}

}  // namespace blum::cgal
