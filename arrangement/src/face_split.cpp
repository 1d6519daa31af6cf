#include "face_engine.hpp"

#include <algorithm>
#include <optional>

#include "blum/kernel/check.hpp"

namespace blum {
namespace {

constexpr int kSplitAttempts = 8;

}  // namespace

// Bisection of a part.

Trouble FaceEngine::cut(const Line& line, double m, const Box& box, Line& low, Line& high,
                        bool& inside, SiteId& label) {
  const Segment& s = line.segment;
  const Point3 x = point_on(s.axis, m, s.u, s.v);
  low = Line{s, {}, {}};
  high = Line{s, {}, {}};
  low.segment.t1 = high.segment.t0 = m;
  // Exact position among the crossings of ∂O, then among the ties of the stretch that holds m.
  std::size_t first = 0;  // breakpoints below m
  for (std::size_t k = 0; k < line.brk.size(); ++k) {
    const Breakpoint& b = line.brk[k].point;
    if (b.kind != Breakpoint::Kind::kBoundary) continue;
    const int side = context_.predicates.plane_side(x, b.triangle);
    if (side == 0) return {FaceStatus::kBadPosition, "split on the boundary"};
    const bool enters = !line.piece[k].inside;  // going up, the solid begins here
    if ((side < 0) == enters)
      first = k + 1;
    else
      break;
  }
  std::size_t last = first;
  while (last < line.brk.size() && line.brk[last].point.kind == Breakpoint::Kind::kTie) ++last;
  inside = line.piece[first].inside;
  if (inside) {
    const auto governor = segments_.governor(x, box.candidates);
    if (!governor) return {FaceStatus::kBadPosition, "split on an essential tie"};
    label = *governor;
  }
  std::size_t at = first;
  std::optional<Break> shrunk_low, shrunk_high;
  for (; at < last; ++at) {
    const Breakpoint& b = line.brk[at].point;
    const bool above_lo = b.lo_triangle != Breakpoint::kNone || m > b.lo;
    const bool below_hi = b.hi_triangle != Breakpoint::kNone || m < b.hi;
    if (!above_lo) break;
    if (!below_hi) continue;
    std::vector<Breakpoint> found;
    const StretchEnd a{b.lo, b.lo_triangle, b.below};
    const StretchEnd middle{m, Breakpoint::kNone, label};
    if (const Trouble t = segments_.isolate(s, a, middle, box.candidates, found)) return t;
    BLUM_CHECK(found.size() <= 1);
    if (found.empty()) {
      shrunk_high = line.brk[at];
      shrunk_high->point.lo = m;
      shrunk_high->point.lo_triangle = Breakpoint::kNone;
      shrunk_high->point.below = label;
      break;
    }
    shrunk_low = Break{found[0], line.brk[at].id};
    ++at;
    break;
  }
  // Breakpoints [0, at) lie below m.
  low.brk.assign(line.brk.begin(), line.brk.begin() + static_cast<std::ptrdiff_t>(at));
  high.brk.assign(line.brk.begin() + static_cast<std::ptrdiff_t>(at), line.brk.end());
  low.piece.assign(line.piece.begin(), line.piece.begin() + static_cast<std::ptrdiff_t>(at) + 1);
  high.piece.assign(line.piece.begin() + static_cast<std::ptrdiff_t>(at), line.piece.end());
  if (shrunk_low) low.brk.back() = *shrunk_low;
  if (shrunk_high) high.brk.front() = *shrunk_high;
  if (inside) {
    low.piece.back().witness = label;
    high.piece.front().witness = label;
  }
  return {};
}

Trouble FaceEngine::split(Box& box, Box& low, Box& high) {
  const Rect& r = problem_.rect;
  const bool along_u = box.u1 - box.u0 >= box.v1 - box.v0;
  const double lo = along_u ? box.u0 : box.v0, hi = along_u ? box.u1 : box.v1;
  // The two sides that the new line meets, lower one first.
  const int s0 = along_u ? kLowV : kLowU, s1 = along_u ? kHighV : kHighU;
  Trouble trouble;
  for (int attempt = 0; attempt < kSplitAttempts; ++attempt) {
    const double m = context_.split(lo, hi, 1000 + attempt);
    if (!(m > lo && m < hi)) return {FaceStatus::kUndecided, "face: resolution spent"};
    Segment segment;
    if (along_u)
      segment = {v_, r.level, m, box.v0, box.v1};
    else
      segment = {u_, m, r.level, box.u0, box.u1};
    Line low0, high0, low1, high1;
    bool inside0 = false, inside1 = false;
    SiteId label0{}, label1{};
    if ((trouble = cut(box.side[s0], m, box, low0, high0, inside0, label0))) continue;
    if ((trouble = cut(box.side[s1], m, box, low1, high1, inside1, label1))) continue;
    SegmentDiagram diagram;
    if ((trouble = segments_.solve(segment, box.candidates, box.triangles, diagram))) continue;

    Line line = make_line(diagram);
    for (Break& b : line.brk) {
      if (b.point.kind == Breakpoint::Kind::kBoundary) {
        b.id = crossings_++;
        continue;
      }
      Box where{box.u0, box.u1, box.v0, box.v1, {}, {}, {}, 0};
      (along_u ? where.u0 : where.v0) = (along_u ? where.u1 : where.v1) = m;
      (along_u ? where.v0 : where.u0) = b.point.lo;
      (along_u ? where.v1 : where.u1) = b.point.hi;
      b.id = new_node(FaceNode::Kind::kSide, where);
      nodes_[b.id].node.side = 255;  // not on the rectangle's border
      nodes_[b.id].node.governors = {std::min(b.point.below, b.point.above),
                                     std::max(b.point.below, b.point.above)};
    }
    low = Box{box.u0, box.u1, box.v0, box.v1, {}, {}, {}, box.depth + 1};
    high = low;
    if (along_u) {
      low.u1 = high.u0 = m;
      low.side = {low0, line, low1, box.side[kLowU]};
      high.side = {high0, box.side[kHighU], high1, line};
    } else {
      low.v1 = high.v0 = m;
      low.side = {box.side[kLowV], low1, line, low0};
      high.side = {line, high1, box.side[kHighV], high0};
    }
    return {};
  }
  return {FaceStatus::kUndecided, trouble.reason};
}

}  // namespace blum
