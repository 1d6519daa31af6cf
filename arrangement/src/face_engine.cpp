#include "face_engine.hpp"

#include <algorithm>
#include <cmath>

#include "blum/arrangement/common_point.hpp"
#include "blum/kernel/check.hpp"

namespace blum {
namespace {

constexpr int kMaxDepth = 90;
/// A part that lost no candidate in so many bisections is asked of exact algebra, once: an event in
/// general position has passed long before.
constexpr int kStuck = 44;
/// A part of very many groups is compared pair by pair only every so many bisections that lost none
/// of its candidates.
constexpr int kPatience = 4;
constexpr std::size_t kMaxStuck = 512;
/// Most parts that bounds decide at all are decided before they lost no candidate so often.
constexpr int kHardened = 16;
constexpr std::uint32_t kMaxExactParts = 64;
constexpr int kSplitAttempts = 8;
/// How far a point within a strip may be from its tip (working units), or its direction from that
/// of its edge: any positive number would do.
constexpr double kAside = 0x1p-44;
/// A face in general position needs some ten boxes an event: this many say that a seam runs along
/// the plane so near that moving the plane is better.
constexpr std::uint32_t kMaxBoxes = 50'000;

/// A direction w (in the plane) with g . w < 0 for all given vectors, if they span less than pi.
std::optional<std::array<double, 2>> opposite(std::span<const std::array<double, 2>> g) {
  const auto& first = g.front();
  double lo = 0, hi = 0;
  for (const auto& x : g) {
    const double angle =
        std::atan2(first[0] * x[1] - first[1] * x[0], first[0] * x[0] + first[1] * x[1]);
    lo = std::min(lo, angle);
    hi = std::max(hi, angle);
  }
  if (!(hi - lo < 3.1415)) return std::nullopt;
  const double turn = 0.5 * (lo + hi), c = std::cos(turn), s = std::sin(turn);
  const double length = std::hypot(first[0], first[1]);
  if (!(length > 0)) return std::nullopt;
  return std::array{-(c * first[0] - s * first[1]) / length,
                    -(s * first[0] + c * first[1]) / length};
}

}  // namespace

Range FaceEngine::range_of(const Box& box) const {
  const Rect& r = problem_.rect;
  return Range::of(point_on(r.axis, r.level, box.u0, box.v0),
                   point_on(r.axis, r.level, box.u1, box.v1));
}

FaceEngine::Line FaceEngine::make_line(const SegmentDiagram& diagram) {
  Line line;
  line.segment = diagram.segment;
  for (const Breakpoint& b : diagram.breakpoint) line.brk.push_back({b, 0});
  for (const auto& i : diagram.interval) {
    line.piece.push_back({i.inside, i.witness, new_element()});
  }
  return line;
}

std::uint32_t FaceEngine::new_element() {
  component_.add();
  element_label_.emplace_back();
  return region_.add();
}

std::uint32_t FaceEngine::trace_element(std::uint32_t triangle) {
  const auto [it, fresh] = trace_element_.try_emplace(triangle, 0u);
  if (fresh) it->second = new_element();
  return it->second;
}

std::uint32_t FaceEngine::new_node(FaceNode::Kind kind, const Box& box) {
  Node n;
  n.node.kind = kind;
  n.node.u0 = box.u0;
  n.node.u1 = box.u1;
  n.node.v0 = box.v0;
  n.node.v1 = box.v1;
  nodes_.push_back(std::move(n));
  return static_cast<std::uint32_t>(nodes_.size() - 1);
}

std::uint32_t FaceEngine::convex_node(std::uint32_t edge) {
  const auto [it, fresh] = convex_node_.try_emplace(edge, 0u);
  if (fresh) {
    for (const TracePoint& p : trace_point_)
      if (p.edge == edge)
        it->second = new_node(FaceNode::Kind::kConvexEdge,
                              Box{p.u.low(), p.u.high(), p.v.low(), p.v.high(), {}, {}, {}, 0});
    FaceNode& n = nodes_[it->second].node;
    n.boundary_edge = edge;
    for (const auto t : context_.geometry.solid().edge[edge].triangle)
      n.governors.push_back(context_.geometry.index().face(t));
    std::sort(n.governors.begin(), n.governors.end());
  }
  return it->second;
}

void FaceEngine::add_arc(std::uint32_t from, std::uint32_t to, SiteId left, SiteId right,
                         std::array<std::uint32_t, 2> beside) {
  const auto id = static_cast<std::uint32_t>(arcs_.size());
  arcs_.push_back({from, to, left, right, beside});
  nodes_[from].arc.push_back(id);
  nodes_[to].arc.push_back(id);
}

void FaceEngine::label_element(std::uint32_t element, std::span<const SiteId> labels) {
  auto& l = element_label_[element];
  l.insert(l.end(), labels.begin(), labels.end());
}

Trouble FaceEngine::find_traces(Box& root) {
  const Solid& solid = context_.geometry.solid();
  const Rect& r = problem_.rect;
  if (context_.voronoi()) return find_corners_in_plane();
  std::map<std::uint32_t, std::uint32_t> point_of_edge;
  for (const auto t : problem_.triangles) {
    const auto& tri = solid.triangle[t];
    for (const auto v : tri.vertex)
      if (solid.point[v][r.axis] == r.level)
        return {FaceStatus::kBadPosition, "boundary vertex in the plane of a face"};
    std::array<std::uint32_t, 2> ends{};
    int n = 0;
    for (const auto e : tri.edge) {
      const Point3 &a = solid.point[solid.edge[e].vertex[0]],
                   &b = solid.point[solid.edge[e].vertex[1]];
      if ((a[r.axis] < r.level) == (b[r.axis] < r.level)) continue;
      const auto [it, fresh] =
          point_of_edge.try_emplace(e, static_cast<std::uint32_t>(trace_point_.size()));
      if (fresh) {
        const Ball s = divide(Ball(r.level) - Ball(a[r.axis]), Ball(b[r.axis]) - Ball(a[r.axis]));
        const auto coordinate = [&](int k) { return Ball(a[k]) + s * (Ball(b[k]) - Ball(a[k])); };
        trace_point_.push_back({e, coordinate(u_), coordinate(v_)});
      }
      ends[n++] = it->second;
    }
    if (n == 0) continue;
    BLUM_CHECK(n == 2);
    trace_[t] = ends;
    root.triangles.push_back(t);
  }
  return {};
}

bool FaceEngine::in_box(const TracePoint& p, const Box& box) {
  const Rect& r = problem_.rect;
  const auto side = [&](int axis, const Ball& approx, double value) {
    const int quick = (approx - Ball(value)).sign();
    return quick != 2
               ? quick
               : context_.predicates.compare_edge_crossing(p.edge, r.axis, r.level, axis, value);
  };
  return side(u_, p.u, box.u0) > 0 && side(u_, p.u, box.u1) < 0 && side(v_, p.v, box.v0) > 0 &&
         side(v_, p.v, box.v1) < 0;
}

FaceEngine::Border FaceEngine::border_of(const Box& box) {
  // The border as a cyclic sequence, counter-clockwise in (u, v).
  struct Item {
    bool interval = false;
    const Piece1* piece = nullptr;
    const Break* brk = nullptr;
    std::uint8_t side = 0;
  };
  std::vector<Item> item;
  for (const std::uint8_t s : {kLowV, kHighU, kHighV, kLowU}) {
    const Line& line = box.side[s];
    const bool forward = s == kLowV || s == kHighU;
    const auto n = line.piece.size();
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = forward ? k : n - 1 - k;
      if (k > 0) item.push_back({false, nullptr, &line.brk[forward ? i - 1 : i]});
      item.push_back({true, &line.piece[i], nullptr, s});
    }
  }
  const std::size_t n = item.size();

  // Where each triangle's trace leaves the box, and which of its ends lie inside.
  std::map<std::uint32_t, std::vector<std::size_t>> crossing_of;
  for (std::size_t i = 0; i < n; ++i)
    if (!item[i].interval && item[i].brk->point.kind == Breakpoint::Kind::kBoundary)
      crossing_of[item[i].brk->point.triangle].push_back(i);
  std::map<std::uint32_t, std::array<std::uint32_t, 2>> triangle_of_point;  // both sides of a point
  std::map<std::uint32_t, bool> used;
  const Solid& solid = context_.geometry.solid();
  std::map<std::uint32_t, bool> inside_point;
  const auto is_inside = [&](std::uint32_t p) {
    const auto [it, fresh] = inside_point.try_emplace(p, false);
    if (fresh) it->second = in_box(trace_point_[p], box);
    return it->second;
  };
  constexpr auto kNone = Breakpoint::kNone;
  std::map<std::uint32_t, bool> visited;
  // Follows ∂O from a crossing through the box; appends its triangles and convex edges.
  const auto follow = [&](std::size_t start, Circle& circle) -> std::size_t {
    std::uint32_t t = item[start].brk->point.triangle, came_from = kNone;
    for (;;) {
      visited[t] = true;
      circle.push_back({Step::Kind::kTrace, t, context_.geometry.index().face(t)});
      std::uint32_t next = kNone;
      for (const auto p : trace_.at(t))
        if (p != came_from && is_inside(p)) next = p;
      if (next == kNone) {
        const auto& c = crossing_of.at(t);
        for (const auto i : c)
          if (i != start) return i;
        broken_invariant("trace enters a box and does not leave it", __FILE__, __LINE__);
      }
      const auto e = trace_point_[next].edge;
      if (solid.edge[e].kind == EdgeKind::kConvex)
        circle.push_back({Step::Kind::kConvexEdge, e, {}});
      t = solid.edge[e].triangle[0] == t ? solid.edge[e].triangle[1] : solid.edge[e].triangle[0];
      came_from = next;
    }
  };

  Border border;
  std::vector<bool> done(n, false);
  for (std::size_t first = 0; first < n; ++first) {
    if (done[first] || !item[first].interval || !item[first].piece->inside) continue;
    Circle circle;
    std::size_t i = first;
    do {
      if (item[i].interval) {
        BLUM_CHECK(item[i].piece->inside && !done[i]);
        done[i] = true;
        circle.push_back(
            {Step::Kind::kInterval, item[i].piece->element, item[i].piece->witness, item[i].side});
      } else if (item[i].brk->point.kind == Breakpoint::Kind::kTie) {
        circle.push_back({Step::Kind::kTie, item[i].brk->id, {}});
      } else {
        i = follow(i, circle);
      }
      i = (i + 1) % n;
    } while (i != first);
    border.circle.push_back(std::move(circle));
  }
  for (const auto t : box.triangles) {
    if (visited[t]) continue;
    // A trace whose crossings were not walked: a closed loop, or a triangle outside this box.
    std::uint32_t x = t, came_from = kNone;
    bool loop = false;
    for (;;) {
      visited[x] = true;
      std::uint32_t next = kNone;
      for (const auto p : trace_.at(x))
        if (p != came_from && is_inside(p)) next = p;
      if (next == kNone) break;
      const auto e = trace_point_[next].edge;
      x = solid.edge[e].triangle[0] == x ? solid.edge[e].triangle[1] : solid.edge[e].triangle[0];
      came_from = next;
      if (x == t) {
        loop = true;
        break;
      }
    }
    if (loop) border.loop.push_back(t);
  }
  return border;
}

bool FaceEngine::gain_along(std::span<const GainPair> pairs, std::span<const LocalForm> forms,
                            const Range& range, const Direction& direction) {
  return std::all_of(pairs.begin(), pairs.end(), [&](const GainPair& p) {
    const LocalForm &a = forms[p.i], &b = forms[p.j];
    if (gains(p.slope, range, direction.w)) return true;
    return !may_share_foot(context_, a.site, b.site, forms, range) &&
           gains_by_feet(context_, p.slope, a.site, b.site, direction, forms, range);
  });
}

std::optional<Direction> FaceEngine::along_strip(std::span<const GainPair> pairs,
                                                 std::span<const LocalForm> forms,
                                                 const Range& range) const {
  const SiteGeometry& geometry = context_.geometry;
  const SiteIndex& index = geometry.index();
  const LocalForm& own = forms[pairs.front().i];
  if (own.kind != SiteKind::kEdge) return std::nullopt;
  const SolidEdge& edge = geometry.solid().edge[index.element(own.site)];
  const Point3 &p = geometry.solid().point[edge.vertex[0]],
               &q = geometry.solid().point[edge.vertex[1]];
  const Rect& r = problem_.rect;
  std::vector<Direction> tried;
  if (p[r.axis] == q[r.axis]) {
    for (const auto& [from, to] : {std::pair{p, q}, std::pair{q, p}}) {
      Direction d;
      double size = 0;
      for (const int k : {u_, v_}) size = std::max(size, std::abs(to[k] - from[k]));
      for (const int k : {u_, v_}) d.w[k] = Ball(to[k]) - Ball(from[k]) + Ball(0.0, kAside * size);
      tried.push_back(d);
    }
  } else {
    const Ball s = divide(Ball(r.level) - Ball(p[r.axis]), Ball(q[r.axis]) - Ball(p[r.axis]));
    Direction d;
    bool apart = false;
    for (const int k : {u_, v_}) {
      // A little beside the crossing.
      const Ball at = Ball(p[k]) + s * (Ball(q[k]) - Ball(p[k])) + Ball(0.0, kAside);
      d.w[k] = at - Ball(range.center[k]) + Ball(0.0, range.half[k]);
      const Ball gap = at - Ball(range.center[k]);
      apart |= gap.low() > range.half[k] || gap.high() < -range.half[k];
    }
    if (!apart) return std::nullopt;
    tried.push_back(d);
  }
  for (const Direction& d : tried)
    if (std::ranges::all_of(pairs, [&](const GainPair& g) {
          const LocalForm& other = forms[g.j];
          return forms[g.i].site == own.site &&
                 (other.site == index.face(edge.triangle[0]) ||
                  other.site == index.face(edge.triangle[1]) || gains(g.slope, range, d.w));
        }))
      return d;
  return std::nullopt;
}

std::optional<Direction> FaceEngine::direction(std::span<const GainPair> pairs,
                                               std::span<const LocalForm> forms,
                                               const Range& range) {
  const Solid& solid = context_.geometry.solid();
  const auto along =
      [&](std::span<const std::array<double, 2>> against) -> std::optional<Direction> {
    const auto w2 = opposite(against);
    if (!w2) return std::nullopt;
    Direction d;
    d.w[u_] = Ball((*w2)[0]);
    d.w[v_] = Ball((*w2)[1]);
    if (!gain_along(pairs, forms, range, d)) return std::nullopt;
    return d;
  };
  std::vector<std::array<double, 2>> against;
  for (const GainPair& p : pairs)
    against.push_back({p.slope.gradient[u_].mid, p.slope.gradient[v_].mid});
  if (const auto d = along(against)) return d;

  // By all directions of their feet, where edges are so near that gradients vary too much.
  against.clear();
  bool known = true;
  for (const GainPair& p : pairs) {
    const auto& [f, g, tie] = p.slope.fans;
    if (p.slope.constant) against.push_back({p.slope.gradient[u_].mid, p.slope.gradient[v_].mid});
    known &= p.slope.constant || (f.count > 0 && g.count > 0);
    for (int i = 0; i < f.count; ++i)
      for (int j = 0; j < g.count; ++j)
        against.push_back(
            {f.end[i][u_].mid - g.end[j][u_].mid, f.end[i][v_].mid - g.end[j][v_].mid});
  }
  if (known)
    if (const auto d = along(against)) return d;

  if (context_.voronoi())
    if (const auto d = along_strip(pairs, forms, range)) return d;

  // Sites that meet in a vertex: by their corners as seen from there.
  against.clear();
  bool meet = false;
  for (const GainPair& p : pairs) {
    const SiteId a = forms[p.i].site, b = forms[p.j].site;
    const CommonCorners common = common_corners(context_.geometry, a, b);
    if (common.count != 1) {
      against.push_back({p.slope.gradient[u_].mid, p.slope.gradient[v_].mid});
      continue;
    }
    meet = true;
    const Point3& o = solid.point[common.vertex[0]];
    for (const auto& [site, sign] : {std::pair{a, -1.0}, std::pair{b, 1.0}}) {
      int n = 0;
      const auto corner = context_.geometry.corners(site, n);
      for (int k = 0; k < n; ++k)
        if (corner[k] != common.vertex[0])
          against.push_back({sign * (solid.point[corner[k]][u_] - o[u_]),
                             sign * (solid.point[corner[k]][v_] - o[v_])});
    }
  }
  if (!meet || context_.voronoi()) return std::nullopt;
  if (const auto d = along(against)) return d;

  // By the planes through their common convex edges, or through one and an edge of one of them.
  for (const GainPair& p : pairs) {
    const CommonCorners common =
        common_corners(context_.geometry, forms[p.i].site, forms[p.j].site);
    std::vector<std::uint32_t> tip;
    if (common.count == 2) tip.push_back(common.vertex[1]);
    if (common.count == 1)
      for (const SiteId s : {forms[p.i].site, forms[p.j].site}) {
        int n = 0;
        const auto corner = context_.geometry.corners(s, n);
        for (int k = 0; k < n; ++k)
          if (corner[k] != common.vertex[0]) tip.push_back(corner[k]);
      }
    for (const auto t : tip) {
      const Direction d = left_normal(solid, problem_.rect.axis, common.vertex[0], t);
      if (gain_along(pairs, forms, range, d)) return d;
      if (gain_along(pairs, forms, range, d.reversed())) return d.reversed();
    }
  }
  return std::nullopt;
}

bool FaceEngine::directions_exist(std::span<const LocalForm> forms, const Groups& groups,
                                  Rivals& rivals, Directions& found) {
  const Range& range = rivals.range();
  std::vector<std::vector<GainPair>> of_group(groups.count);
  for (auto& pairs : of_group) pairs.reserve(forms.size());
  for (std::uint32_t i = 0; i < forms.size(); ++i)
    for (std::uint32_t j = i + 1; j < forms.size(); ++j) {
      if (groups.of[i] == groups.of[j] || !rivals.meet(i, j)) continue;
      of_group[groups.of[i]].push_back({i, j, pair_slope(context_, forms[i], forms[j], range)});
      of_group[groups.of[j]].push_back({j, i, pair_slope(context_, forms[j], forms[i], range)});
    }
  found.assign(groups.count, std::nullopt);
  for (std::uint32_t g = 0; g < groups.count; ++g)
    if (!of_group[g].empty() && !(found[g] = direction(of_group[g], forms, range))) return false;
  return true;
}

void FaceEngine::note(PartRecord::Kind kind, std::span<const LocalForm> forms, std::uint32_t vertex,
                      std::array<std::uint32_t, 2> edge) {
  if (context_.parts == nullptr) return;
  PartRecord r;
  r.kind = kind;
  for (const LocalForm& f : forms) r.sites.push_back(f.site);
  r.vertex = vertex;
  r.edge = edge;
  r.plain = context_.plain;
  context_.parts->push_back(std::move(r));
}

void FaceEngine::note(PartRecord::Kind kind, std::span<const LocalForm> forms, const Groups& groups,
                      const Directions& directions) {
  if (context_.parts == nullptr) return;
  note(kind, forms);
  for (std::uint32_t g = 0; g < directions.size(); ++g)
    if (directions[g])
      for (const SiteId s : named_in(forms, groups, g))
        context_.parts->back().direction.emplace_back(s, in_plane(*directions[g]));
}

std::vector<SiteId> FaceEngine::named_in(std::span<const LocalForm> forms, const Groups& groups,
                                         std::uint32_t group) {
  std::vector<SiteId> members;
  int vertices = 0, edges = 0;  // degenerate vertices are no sites, but join edges
  for (std::size_t i = 0; i < forms.size(); ++i) {
    if (groups.of[i] != group) continue;
    members.push_back(forms[i].site);
    vertices += forms[i].kind == SiteKind::kVertex;
    edges += forms[i].kind == SiteKind::kEdge;
  }
  if (vertices == 0 && edges < 2) members.resize(1);
  return members;
}

PlaneDirection FaceEngine::in_plane(const Direction& d) const {
  PlaneDirection w{d.w[u_].mid, d.w[v_].mid, {}};
  if (d.line) w.line = {d.line->from, d.line->to};
  return w;
}

bool FaceEngine::accept(const Box& box, std::span<const LocalForm> forms, const Border& border) {
  if (!border.loop.empty()) return false;
  if (border.circle.empty()) {  // outside the solid
    note(PartRecord::Kind::kOutside, forms);
    return true;
  }
  const Groups ties = Groups::by_ties(context_, forms);
  const std::size_t max_groups = box.stuck % kPatience == kPatience - 1 ? kMaxStuck : kMaxGroups;
  if (ties.cliques && ties.count > max_groups) return false;
  const Range range = range_of(box);
  const Groups feet = Groups::by_feet(context_, forms, range);
  if (context_.slices_first && !context_.voronoi() && accept_slice(box, forms, feet, border))
    return true;
  if (context_.links_first && !context_.voronoi() && accept_cone(box, forms, feet, border))
    return true;
  Rivals rivals(context_, forms, range);
  if (ties.cliques && accept_star(box, forms, ties, feet, border, rivals)) return true;
  if (feet.cliques && feet.count <= max_groups && feet != ties &&
      accept_star(box, forms, feet, feet, border, rivals))
    return true;
  if (context_.voronoi())
    return accept_convex(box, forms, ties, border) || accept_vertex_link(box, forms, ties, border);
  return accept_cone(box, forms, feet, border) || accept_rim(box, forms, feet, border) ||
         (!context_.plain && box.stuck >= kHardened && accept_slice(box, forms, feet, border));
}

bool FaceEngine::accept_star(const Box& box, std::span<const LocalForm> forms, const Groups& groups,
                             const Groups& feet, const Border& border, Rivals& rivals) {
  std::vector<std::vector<std::uint32_t>> runs;
  bool repeated = false;
  for (const Circle& circle : border.circle) {
    auto run = runs_of(circle, forms, groups);
    if (!run) return false;
    std::vector<bool> seen(groups.count, false);
    for (const auto g : *run) {
      repeated |= seen[g];
      seen[g] = true;
    }
    runs.push_back(std::move(*run));
  }
  // A certificate tells events by their boxes: one a part.
  if (context_.plain &&
      std::count_if(runs.begin(), runs.end(), [](const auto& run) { return run.size() > 2; }) > 1)
    return false;
  Directions directions;
  if (!repeated && (groups.count == 1 || directions_exist(forms, groups, rivals, directions))) {
    for (std::size_t c = 0; c < border.circle.size(); ++c)
      if (runs[c].size() >= 4 && !may_be_cluster(box, forms, groups, border.circle[c]))
        return false;
    for (std::size_t c = 0; c < border.circle.size(); ++c)
      record(border.circle[c], forms, feet, box);
    note(&groups == &feet ? PartRecord::Kind::kFeet : PartRecord::Kind::kStar, forms, groups,
         directions);
    return true;
  }
  return accept_chords(box, border, runs, forms, groups, feet, rivals);
}

bool FaceEngine::may_be_cluster(const Box& box, std::span<const LocalForm> forms,
                                const Groups& groups, const Circle& circle) {
  return !context_.part_clusters || range_of(box).radius() <= ProductionEngine::kSmallestCluster ||
         meet_in_one_point(box, forms, groups, circle);
}

bool FaceEngine::meet_in_one_point(const Box& box, std::span<const LocalForm> forms,
                                   const Groups& groups, const Circle& circle) {
  std::vector<std::vector<SiteId>> sites(groups.count);
  for (const Step& s : circle)
    if (s.kind == Step::Kind::kInterval || s.kind == Step::Kind::kTrace) {
      const auto g = groups.find(forms, s.label);
      if (!sites[g].empty()) continue;
      for (std::size_t i = 0; i < forms.size(); ++i)
        if (groups.of[i] == g) sites[g].push_back(forms[i].site);
    }
  std::erase_if(sites, [](const auto& g) { return g.empty(); });
  const Rect& r = problem_.rect;
  return common_point(context_.geometry, sites, point_on(r.axis, r.level, box.u0, box.v0),
                      point_on(r.axis, r.level, box.u1, box.v1))
             .gap <= kCommonTolerance;
}

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

Trouble FaceEngine::refine(Box box) {
  ++context_.counts.boxes;
  if (context_.stopped()) return {FaceStatus::kUndecided, "stopped"};
  if (++boxes_ > kMaxBoxes) return {FaceStatus::kUndecided, "face: boxes spent"};
  std::vector<LocalForm> forms;
  prune(context_.geometry, box.candidates, range_of(box), forms, &context_);
  Border border = border_of(box);
  if (accept(box, forms, border)) return {};
  box.stuck = forms.size() < box.candidates.size() ? 0 : box.stuck + 1;
  if (box.stuck == kStuck) {
    if (++exact_parts_ > kMaxExactParts) return {FaceStatus::kUndecided, "face: exact parts spent"};
    if (accept_exact(box, forms, border)) return {};
  }
  if (box.depth >= kMaxDepth) return {FaceStatus::kUndecided, "face: depth spent"};
  box.candidates.clear();
  for (const LocalForm& f : forms) box.candidates.push_back(f.site);
  Box low, high;
  if (const Trouble t = split(box, low, high)) return t;
  if (context_.parts != nullptr) {
    const bool along_u = low.u1 < box.u1;
    note(along_u ? PartRecord::Kind::kCutU : PartRecord::Kind::kCutV, {});
    context_.parts->back().cut = along_u ? low.u1 : low.v1;
  }
  // A triangle stays with a part if its trace meets it: an end inside, or a crossing on its sides.
  for (Box* part : {&low, &high}) {
    part->candidates = box.candidates;
    part->stuck = box.stuck;
    for (const auto t : box.triangles) {
      const auto& ends = trace_.at(t);
      bool keep = in_box(trace_point_[ends[0]], *part) || in_box(trace_point_[ends[1]], *part);
      for (int s = 0; s < 4 && !keep; ++s)
        for (const Break& b : part->side[s].brk)
          keep |= b.point.kind == Breakpoint::Kind::kBoundary && b.point.triangle == t;
      if (keep) part->triangles.push_back(t);
    }
  }
  box = Box{};
  if (const Trouble t = refine(std::move(low))) return t;
  return refine(std::move(high));
}

FaceDiagram FaceEngine::assemble(const Box& root) {
  FaceDiagram d;
  d.rect = problem_.rect;
  // Internal ties are not nodes: splice the two arcs at each.
  std::vector<bool> arc_gone(arcs_.size(), false);
  std::vector<bool> node_gone(nodes_.size(), false);
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    Node& node = nodes_[n];
    if (node.node.kind != FaceNode::Kind::kSide || node.node.side != 255) continue;
    BLUM_CHECK(node.arc.size() == 2);
    const auto a = node.arc[0], b = node.arc[1];
    if (a == b) {  // a closed loop of G: keep this node on it
      node.node.kind = FaceNode::Kind::kEvent;
      continue;
    }
    const auto far = [&](std::uint32_t arc) {
      return arcs_[arc].from == n ? arcs_[arc].to : arcs_[arc].from;
    };
    const auto end_a = far(a), end_b = far(b);
    arcs_[a].from = end_a;
    arcs_[a].to = end_b;
    arc_gone[b] = true;
    std::replace(nodes_[end_b].arc.begin(), nodes_[end_b].arc.end(), b, a);
    node_gone[n] = true;
  }
  std::vector<std::uint32_t> node_index(nodes_.size(), Breakpoint::kNone);
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    if (node_gone[n]) continue;
    node_index[n] = static_cast<std::uint32_t>(d.node.size());
    d.node.push_back(nodes_[n].node);
  }
  for (std::uint32_t a = 0; a < arcs_.size(); ++a) {
    if (arc_gone[a]) continue;
    FaceArc arc = arcs_[a];
    arc.from = node_index[arc.from];
    arc.to = node_index[arc.to];
    d.arc.push_back(arc);
  }

  // Regions in order of their smallest element; labels of all their elements.
  const auto elements = region_.size();
  std::vector<std::uint32_t> region_index(elements, Breakpoint::kNone),
      piece_index(elements, Breakpoint::kNone);
  std::vector<bool> seen(elements, false);
  const auto see = [&](std::uint32_t e) { seen[region_.find(e)] = true; };
  for (std::uint32_t e = 0; e < elements; ++e)
    if (!element_label_[e].empty()) see(e);
  for (std::uint32_t e = 0; e < elements; ++e) {
    if (!seen[region_.find(e)]) continue;
    const auto root_e = region_.find(e), root_c = component_.find(e);
    if (piece_index[root_c] == Breakpoint::kNone) {
      piece_index[root_c] = static_cast<std::uint32_t>(d.piece.size());
      d.piece.push_back({0});
    }
    if (region_index[root_e] == Breakpoint::kNone) {
      region_index[root_e] = static_cast<std::uint32_t>(d.region.size());
      d.region.push_back({{}, piece_index[root_c]});
    }
    auto& labels = d.region[region_index[root_e]].labels;
    labels.insert(labels.end(), element_label_[e].begin(), element_label_[e].end());
  }
  for (FaceRegion& r : d.region) {
    std::sort(r.labels.begin(), r.labels.end());
    r.labels.erase(std::unique(r.labels.begin(), r.labels.end()), r.labels.end());
  }
  for (FaceArc& a : d.arc)
    for (auto& r : a.region) r = region_index[region_.find(r)];
  for (std::uint32_t n = 0; n < nodes_.size(); ++n)
    if (!node_gone[n])
      d.node[node_index[n]].piece = piece_index[component_.find(nodes_[n].element)];
  for (int s = 0; s < 4; ++s)
    for (const Piece1& p : root.side[s].piece)
      d.side_region[s].push_back(p.inside ? region_index[region_.find(p.element)]
                                          : FaceDiagram::kOutside);
  for (const auto& [t, e] : trace_element_) d.trace.push_back({t, region_index[region_.find(e)]});
  const Border border = border_of(root);
  for (const Circle& c : border.circle)
    for (const Step& s : c)
      if (s.kind == Step::Kind::kInterval) {
        ++d.piece[piece_index[component_.find(s.id)]].boundary_circles;
        break;
      }
  for (const auto t : border.loop)
    ++d.piece[piece_index[component_.find(trace_element_.at(t))]].boundary_circles;
  for (const TracePoint& p : trace_point_)
    if (in_box(p, root)) d.trace_point.push_back({p.edge});
  return d;
}

FaceDiagram FaceEngine::solve(const std::array<std::shared_ptr<const SegmentDiagram>, 4>& side) {
  ++context_.counts.faces;
  const Rect& r = problem_.rect;
  u_ = u_axis(r.axis);
  v_ = v_axis(r.axis);
  Box root{r.u0, r.u1, r.v0, r.v1, {}, {}, {}, 0};
  root.candidates.assign(problem_.candidates.begin(), problem_.candidates.end());
  if (const Trouble t = find_traces(root)) {
    FaceDiagram d;
    d.status = t.status;
    d.reason = t.reason;
    d.rect = r;
    d.side = side;
    return d;
  }
  for (std::uint8_t s = 0; s < 4; ++s) {
    root.side[s] = make_line(*side[s]);
    for (std::uint32_t k = 0; k < root.side[s].brk.size(); ++k) {
      Break& b = root.side[s].brk[k];
      if (b.point.kind == Breakpoint::Kind::kBoundary) {
        b.id = crossings_++;
        continue;
      }
      Box where = Box{r.u0, r.u1, r.v0, r.v1, {}, {}, {}, 0};
      const bool along_u = s == kLowV || s == kHighV;
      const double fixed = s == kLowV ? r.v0 : s == kHighV ? r.v1 : s == kLowU ? r.u0 : r.u1;
      (along_u ? where.v0 : where.u0) = (along_u ? where.v1 : where.u1) = fixed;
      (along_u ? where.u0 : where.v0) = b.point.lo;
      (along_u ? where.u1 : where.v1) = b.point.hi;
      b.id = new_node(FaceNode::Kind::kSide, where);
      FaceNode& n = nodes_[b.id].node;
      n.side = s;
      n.breakpoint = k;
      n.governors = {std::min(b.point.below, b.point.above),
                     std::max(b.point.below, b.point.above)};
    }
  }
  // Triangles whose trace misses the rectangle only cost time.
  std::erase_if(root.triangles, [&](std::uint32_t t) {
    const auto& ends = trace_.at(t);
    if (in_box(trace_point_[ends[0]], root) || in_box(trace_point_[ends[1]], root)) return false;
    for (int s = 0; s < 4; ++s)
      for (const Break& b : root.side[s].brk)
        if (b.point.kind == Breakpoint::Kind::kBoundary && b.point.triangle == t) return false;
    return true;
  });
  Trouble trouble;
  if (problem_.whole == nullptr || !take_half(root)) trouble = refine(root);
  FaceDiagram d;
  if (trouble) {
    d.status = trouble.status;
    d.reason = trouble.reason;
    d.rect = r;
  } else {
    d = assemble(root);
  }
  d.side = side;
  return d;
}

}  // namespace blum
