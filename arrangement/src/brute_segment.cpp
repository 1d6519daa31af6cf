// The oracle on a segment: all roots on one line, in exact order.
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "blum/arrangement/brute_engine.hpp"
#include "blum/kernel/check.hpp"
#include "brute_fiber.hpp"

namespace blum {

using namespace brute;

namespace {

/// Three sites at a point, each two of them essential.
bool essential_triple(const Setting& s, const std::vector<int>& sites) {
  const auto e = [&](int i, int j) {
    return s.essential[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] != 0;
  };
  for (const int i : sites)
    for (const int j : sites)
      for (const int k : sites)
        if (e(i, j) && e(j, k) && e(i, k)) return true;
  return false;
}

/// Double bounds of a point, equal if its parameter is a double.
std::pair<double, double> tight_bounds(const Setting& s, const Fiber& fiber, int point) {
  auto [lo, hi] = bounds(fiber.value(point));
  const auto is_at = [&](double t) {
    return fiber.vanishes(*s.factor({0, 0, 0, 0, 1, -Rational(t)}), point);
  };
  // As a rule the bounds are a few ulps apart; about 0 there are too many doubles to try.
  constexpr int kMostTried = 16;
  if (lo <= 0 && hi >= 0 && is_at(0)) return {0.0, 0.0};
  double t = lo;
  for (int k = 0; t <= hi && k < kMostTried; ++k) {
    if (is_at(t)) return {t, t};
    t = std::nextafter(t, std::numeric_limits<double>::infinity());
  }
  return {lo, hi};
}

}  // namespace

std::optional<SegmentDiagram> brute_segment(const Solid& solid, const Segment& segment,
                                            std::span<const SiteId> candidates,
                                            std::span<const std::uint32_t> triangles, bool interior,
                                            DiagramKind kind) {
  BLUM_CHECK(segment.t0 < segment.t1);
  const Setting setting = segment_setting(solid, segment, candidates, triangles, kind);
  const Fiber fiber(setting, rational(0));
  const auto end = [&](std::size_t k) {
    return 2 * fiber.point_of(setting.limit[k].curve[0].first, 0) + 1;
  };
  const auto is_inside = [&](double t) {
    return interior || inside(solid, exact(point_on(segment.axis, t, segment.u, segment.v)));
  };
  const int first = end(0), last = end(1);
  for (const int p : {first, last})
    if (!fiber.place(p).triangle.empty()) return std::nullopt;

  SegmentDiagram out;
  out.segment = segment;
  bool in = is_inside(segment.t0);
  std::vector<int> below;  // governors of the interval below the current position
  const auto open_interval = [&] {
    out.interval.push_back({in, {}});
    if (!in) return;
    BLUM_CHECK(!below.empty());  // the candidates miss a governor
    out.interval.back().witness = setting.site[static_cast<std::size_t>(below[0])];
  };
  for (int p = first; p <= last; ++p) {
    const Place place = fiber.place(p);
    const bool tie = in && setting.essential_pair(place.governor, place.governor).has_value();
    if (p % 2 == 0) {  // an interval
      if (!place.triangle.empty() || tie) return std::nullopt;
      below = place.governor;
      if (out.interval.size() == out.breakpoint.size()) open_interval();
      BLUM_CHECK(!in || !below.empty());
      continue;
    }
    if (p == first || p == last) {
      if (tie) return std::nullopt;
      continue;
    }
    Breakpoint b;
    if (!place.triangle.empty()) {
      const auto t = static_cast<std::size_t>(place.triangle[0]);
      const auto& prism = setting.prism[t];
      if (place.triangle.size() != 1 ||
          std::any_of(prism.begin(), prism.end(),
                      [&](const Function& f) { return fiber.sign(f, p) == 0; }))
        return std::nullopt;  // a boundary edge or vertex
      b.kind = Breakpoint::Kind::kBoundary;
      b.triangle = setting.triangle[t];
      in = !in;
    } else if (tie) {
      const std::vector<int> above = fiber.place(p + 1).governor;
      const auto pair = setting.essential_pair(below, above);
      if (!pair || essential_triple(setting, place.governor) ||
          !feet_differ(setting, fiber, p / 2, place.governor))
        return std::nullopt;
      b.kind = Breakpoint::Kind::kTie;
      b.below = setting.site[static_cast<std::size_t>(pair->first)];
      b.above = setting.site[static_cast<std::size_t>(pair->second)];
    } else {
      continue;
    }
    std::tie(b.lo, b.hi) = tight_bounds(setting, fiber, p / 2);
    b.lo = std::max(b.lo, segment.t0);
    b.hi = std::min(b.hi, segment.t1);
    if (!out.breakpoint.empty() && b.lo < out.breakpoint.back().hi &&
        (kind != DiagramKind::kVoronoi || !share_a_gap(out.breakpoint.back(), b)))
      return std::nullopt;
    out.breakpoint.push_back(b);
  }
  BLUM_CHECK(in == is_inside(segment.t1));
  return out;
}

}  // namespace blum
