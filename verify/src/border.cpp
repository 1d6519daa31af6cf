#include "border.hpp"

#include <algorithm>

#include "failure.hpp"

namespace blum::verify {

Segment side_of(const Rect& r, int side) {
  const int u = u_axis(r.axis), v = v_axis(r.axis);
  if (side % 2 == 0) return {u, side == 0 ? r.v0 : r.v1, r.level, r.u0, r.u1};
  return {v, r.level, side == 1 ? r.u1 : r.u0, r.v0, r.v1};
}

std::vector<Interval> intervals(const Circle& circle) {
  const auto start = std::ranges::find_if(circle, &Step::separates) - circle.begin();
  std::vector<Interval> found;
  for (std::size_t k = 0; k < circle.size(); ++k) {
    const Step& s = circle[(start + k) % circle.size()];
    if (s.separates() || k == 0) found.push_back({s.separates() ? &s : nullptr, {}});
    if (!s.separates()) found.back().step.push_back(&s);
  }
  for (const Interval& i : found) require(!i.step.empty(), "face: two ties beside each other");
  return found;
}

Traces::Traces(const Shape& shape, const Rect& rect, std::span<const std::uint32_t> triangles)
    : shape_(shape) {
  for (const auto t : triangles) {
    std::vector<std::uint32_t> ends;
    for (const auto e : shape.triangle[t].edge) {
      const auto [v, w] = shape.edge[e].vertex;
      const Vec<Rational> a = exactly<Rational>(shape.point[v]), d = shape.along<Rational>(v, w);
      const Rational h = rect.level - a[rect.axis];
      require(h != 0 && h != d[rect.axis], "face: a boundary vertex lies in its plane");
      const Rational s = d[rect.axis] == 0 ? Rational(-1) : Rational(h / d[rect.axis]);
      if (s < 0 || s > 1) continue;
      const int u = u_axis(rect.axis), v_ = v_axis(rect.axis);
      point_[e] = {Rational(a[u] + s * d[u]), Rational(a[v_] + s * d[v_])};
      ends.push_back(e);
    }
    if (ends.size() == 2) trace_[t] = {ends[0], ends[1]};
  }
}

bool Traces::holds(const Rect& r, std::uint32_t edge) const {
  const auto& [u, v] = point_.at(edge);
  return u > r.u0 && u < r.u1 && v > r.v0 && v < r.v1;
}

std::vector<std::uint32_t> Traces::edges_in(const Rect& rect) const {
  std::vector<std::uint32_t> edges;
  for (const auto& [e, p] : point_)
    if (holds(rect, e)) edges.push_back(e);
  return edges;
}

std::set<std::uint32_t> Traces::loop_of(std::uint32_t t) const {
  std::set<std::uint32_t> loop;
  for (auto from = kNone; loop.insert(t).second; t = shape_.across(from, t))
    from = trace_.at(t)[trace_.at(t)[0] == from ? 1 : 0];
  return loop;
}

Border Traces::border(const Box& box) const {
  struct Item {
    const Line::Piece* piece;
    const Line::Change* change;  // one of the two is null
  };
  std::vector<Item> item;  // counter-clockwise
  for (std::size_t s = 0; s < 4; ++s) {
    const Line& side = box.side[s];
    const std::size_t n = side.piece.size();
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = s < 2 ? k : n - 1 - k;
      if (k > 0) item.push_back({nullptr, &side.change[s < 2 ? i - 1 : i]});
      item.push_back({&side.piece[i], nullptr});
    }
  }
  std::map<std::uint32_t, std::vector<std::size_t>> crossing;  // triangle -> items
  for (std::size_t i = 0; i < item.size(); ++i)
    if (item[i].change && item[i].change->boundary) crossing[item[i].change->triangle].push_back(i);
  std::set<std::uint32_t> visited;
  // Along ∂O from where it enters the part to where it leaves it.
  const auto follow = [&](std::size_t start, Circle& circle) {
    auto t = item[start].change->triangle;
    for (auto from = kNone;;) {
      require(visited.insert(t).second, "face: ∂O runs through a part in circles");
      circle.push_back({Step::Kind::kTrace, t, shape_.face_site(t)});
      const auto& ends = trace_.at(t);
      const auto e = std::ranges::find_if(
          ends, [&](std::uint32_t x) { return x != from && holds(box.rect, x); });
      if (e == ends.end()) break;
      if (shape_.edge[*e].bend == Bend::kConvex) circle.push_back({Step::Kind::kConvexEdge, *e});
      from = *e;
      t = shape_.across(from, t);
    }
    for (const auto i : crossing[t])
      if (i != start) return i;
    throw Failure("face: ∂O enters a part and does not leave it");
  };
  Border border;
  std::vector<bool> done(item.size(), false);
  for (std::size_t first = 0; first < item.size(); ++first) {
    if (done[first] || !item[first].piece || !item[first].piece->inside) continue;
    Circle circle;
    std::size_t i = first;
    do {
      if (const Line::Piece* p = item[i].piece) {
        require(p->inside && !done[i], "face: a border is no circle");
        done[i] = true;
        circle.push_back({Step::Kind::kPiece, p->id, p->label});
      } else if (!item[i].change->boundary) {
        circle.push_back({Step::Kind::kTie, item[i].change->id});
      } else {
        i = follow(i, circle);
      }
      i = (i + 1) % item.size();
    } while (i != first);
    border.circle.push_back(std::move(circle));
  }
  // What is left of ∂O in the part are closed curves.
  border.loop = std::ranges::any_of(trace_, [&](const auto& entry) {
    const auto& [t, ends] = entry;
    return !visited.contains(t) && (holds(box.rect, ends[0]) || holds(box.rect, ends[1]));
  });
  return border;
}

}  // namespace blum::verify
