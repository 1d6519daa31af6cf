#include "face.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "blum/kernel/union_find.hpp"
#include "exact.hpp"
#include "face_claims.hpp"
#include "failure.hpp"

namespace blum::verify {

Segment side_of(const Rect& r, int side) {
  const int u = u_axis(r.axis), v = v_axis(r.axis);
  if (side % 2 == 0) return {u, side == 0 ? r.v0 : r.v1, r.level, r.u0, r.u1};
  return {v, r.level, side == 1 ? r.u1 : r.u0, r.v0, r.v1};
}

namespace {

constexpr int kMostHalvings = 6;  // of a part that exact algebra does not decide

/// Sides have nodes for the ids of their ties, and elements of regions for those of their pieces.
struct Box {
  Rect rect;
  std::array<Line, 4> side;
  std::vector<Site> candidates;
};

struct Step {
  enum class Kind { kPiece, kTrace, kTie, kConvexEdge } kind;
  std::uint32_t id;  ///< element, triangle, node, boundary edge
  Site label = 0;
  [[nodiscard]] bool separates() const { return kind == Kind::kTie || kind == Kind::kConvexEdge; }
};
using Circle = std::vector<Step>;

/// What lies between two separators of a circle, and the one before it (null: there is none).
struct Interval {
  const Step* separator = nullptr;
  std::vector<const Step*> step;
};

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

class FaceChecker {
 public:
  FaceChecker(const Exclusion& exclusion, const Algebra& algebra, const Rect& rect,
              std::span<const Site> candidates, std::span<const std::uint32_t> triangles,
              std::span<const PartNode> parts)
      : exclusion_(exclusion),
        algebra_(algebra),
        shape_(exclusion.sites().shape()),
        lines_(exclusion, algebra),
        rect_(rect),
        triangles_(triangles.begin(), triangles.end()),
        candidates_(candidates.begin(), candidates.end()),
        parts_(parts) {}

  FaceMap run(const std::array<Line, 4>& sides);

 private:
  void find_traces();
  [[nodiscard]] bool holds(const Rect& r, std::uint32_t edge) const;
  [[nodiscard]] Line name(Line line, int side);
  void check(Box box);
  [[nodiscard]] std::array<Box, 2> cut(const Box& box, bool along_u, double m);
  void check_part(const Box& box, const Claim& claim);
  [[nodiscard]] std::vector<Circle> circles(const Box& box, bool& loop) const;
  /// The groups, and whether the part is one of chords.
  std::pair<Groups, bool> check_star(const Part& part, const SharedFeet& feet,
                                     const std::vector<Circle>& circles, const Claim& claim) const;
  bool check_about_vertex(const Part& part, const SharedFeet& feet, const Groups& groups,
                          const std::vector<Circle>& circles, const Claim& claim) const;
  void record(const Circle& circle, const Part& part, const Groups& feet, bool rim,
              const Groups* chords);
  void check_exact(const Box& box, std::span<const Site> listed, const std::string& reason,
                   int halvings = kMostHalvings);
  void record_exact(const Box& box, std::span<const Site> listed);
  [[nodiscard]] std::vector<Site> may_govern(const Box& box, std::span<const Site> listed) const;
  [[nodiscard]] std::uint32_t new_element() {
    labels_.emplace_back();
    piece_.add();
    return region_.add();
  }
  [[nodiscard]] std::uint32_t element_of(const Step& s) {
    if (s.kind == Step::Kind::kPiece) return s.id;
    const auto [it, fresh] = trace_element_.try_emplace(s.id, 0u);
    if (fresh) it->second = new_element();
    return it->second;
  }
  [[nodiscard]] std::uint32_t new_node(const FaceMap::Node& node, bool through = false) {
    node_.push_back(node);
    through_.push_back(through);
    return static_cast<std::uint32_t>(node_.size() - 1);
  }
  [[nodiscard]] std::uint32_t convex_node(std::uint32_t edge) {
    const auto [it, fresh] = convex_node_.try_emplace(edge, 0u);
    if (fresh) it->second = new_node({FaceMap::Node::Kind::kConvexEdge, 0, 0, edge});
    return it->second;
  }
  void splice();
  [[nodiscard]] FaceMap assemble(const Box& root);

  const Exclusion& exclusion_;
  const Algebra& algebra_;
  const Shape& shape_;
  LineSolver lines_;
  Rect rect_;
  std::vector<std::uint32_t> triangles_;
  std::vector<Site> candidates_;  // sorted
  std::span<const PartNode> parts_;
  std::size_t next_part_ = 0;
  std::map<std::uint32_t, std::array<Rational, 2>> point_;              // boundary edge -> (u, v)
  std::map<std::uint32_t, std::array<std::uint32_t, 2>> trace_;         // triangle -> two edges
  std::map<std::uint32_t, std::uint32_t> trace_element_, convex_node_;  // by triangle, edge
  std::vector<FaceMap::Node> node_;  // their pieces: elements; kNone where there is no node left
  std::vector<bool> through_;        // nodes inside the rectangle where two parts meet
  std::vector<FaceMap::Arc> arc_;
  UnionFind region_, piece_;  // of elements
  std::vector<std::vector<Site>> labels_;
};

void FaceChecker::find_traces() {
  for (const auto t : triangles_) {
    std::vector<std::uint32_t> ends;
    for (const auto e : shape_.triangle[t].edge) {
      const auto [v, w] = shape_.edge[e].vertex;
      const Vec<Rational> a = exactly<Rational>(shape_.point[v]), d = shape_.along<Rational>(v, w);
      const Rational h = rect_.level - a[rect_.axis];
      require(h != 0 && h != d[rect_.axis], "face: a boundary vertex lies in its plane");
      const Rational s = d[rect_.axis] == 0 ? Rational(-1) : Rational(h / d[rect_.axis]);
      if (s < 0 || s > 1) continue;
      const int u = u_axis(rect_.axis), v_ = v_axis(rect_.axis);
      point_[e] = {Rational(a[u] + s * d[u]), Rational(a[v_] + s * d[v_])};
      ends.push_back(e);
    }
    if (ends.size() == 2) trace_[t] = {ends[0], ends[1]};
  }
}

bool FaceChecker::holds(const Rect& r, std::uint32_t edge) const {
  const auto& [u, v] = point_.at(edge);
  return u > r.u0 && u < r.u1 && v > r.v0 && v < r.v1;
}

/// side: 0 to 3, or -1 for a line inside the rectangle.
Line FaceChecker::name(Line line, int side) {
  for (std::uint32_t k = 0; k < line.change.size(); ++k)
    if (!line.change[k].boundary)
      line.change[k].id = new_node({FaceMap::Node::Kind::kSide, side, k}, side < 0);
  for (Line::Piece& p : line.piece)
    if (p.inside) p.id = new_element();
  return line;
}

std::vector<Circle> FaceChecker::circles(const Box& box, bool& loop) const {
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
  std::vector<Circle> found;
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
    found.push_back(std::move(circle));
  }
  // What is left of ∂O in the part are closed curves.
  loop = std::ranges::any_of(trace_, [&](const auto& entry) {
    const auto& [t, ends] = entry;
    return !visited.contains(t) && (holds(box.rect, ends[0]) || holds(box.rect, ends[1]));
  });
  return found;
}

std::pair<Groups, bool> FaceChecker::check_star(const Part& part, const SharedFeet& feet,
                                                const std::vector<Circle>& circles,
                                                const Claim& claim) const {
  Groups groups = claim.by_feet ? groups_by_feet(exclusion_.sites(), part.sites, feet)
                                : groups_by_ties(exclusion_.sites(), part.sites, part.box);
  require(groups.cliques, "Theorem D': a group with an essential tie");
  std::vector<std::vector<std::uint32_t>> all;
  bool twice = false;
  for (const Circle& circle : circles) {
    // Ties and convex edges are where the group changes, and each group has one run.
    std::vector<std::uint32_t> runs;
    for (const Interval& i : intervals(circle))
      for (const Step* s : i.step) {
        const auto g = groups.find(part.sites, s->label);
        require(g < groups.count, "Theorem D': the governor of a border was excluded");
        if (s == i.step.front()) runs.push_back(g);
        require(runs.back() == g, "Theorem D': a group changes without a tie");
      }
    require(std::ranges::count_if(circle, &Step::separates) != 1,
            "Theorem D': a single tie on a border");
    twice |= std::set(runs.begin(), runs.end()).size() < runs.size();
    all.push_back(std::move(runs));
  }
  if (claim.type == Claim::Type::kChords) {
    check_chords(part, groups, feet, all, claim);
    return {groups, true};
  }
  require(!twice, "Theorem D': a group governs two intervals of a border");
  check_directions(part, groups, feet, claim);
  return {groups, false};
}

/// Theorem G, or a rim. Is there an end of arcs inside, however few ties are on the border?
bool FaceChecker::check_about_vertex(const Part& part, const SharedFeet& feet, const Groups& groups,
                                     const std::vector<Circle>& circles, const Claim& claim) const {
  require(circles.size() == 1 &&
              std::ranges::find(circles[0], Step::Kind::kTrace, &Step::kind) == circles[0].end(),
          "a part about a vertex is not inside the solid");
  if (claim.type == Claim::Type::kRim) {
    check_rim(part, claim.vertex, claim.edge);
    return true;
  }
  check_cone(part, claim.vertex);
  const auto ties = std::ranges::count_if(circles[0], &Step::separates);
  const bool foot =
      ties > 0 && feet.vertex(claim.vertex) && polar_cone_meets(shape_, claim.vertex, part.box);
  // Intervals of different groups are of different regions: then the forest is one tree.
  std::set<std::uint32_t> shown;
  for (const Interval& i : intervals(circles[0]))
    shown.insert(groups.find(part.sites, i.step.front()->label));
  require(
      ties == 0 || (ties == 1 ? foot : !foot && (ties <= 3 || std::cmp_equal(shown.size(), ties))),
      "Theorem G: this number of ties decides nothing");
  return ties == 1;
}

/// The regions along a circle, and the arcs that join its separators. Chords: an arc joins the two
/// ends between the same groups, and runs on one side of it are one region.
void FaceChecker::record(const Circle& circle, const Part& part, const Groups& feet, bool rim,
                         const Groups* chords) {
  std::vector<std::uint32_t> ends, runs;  // run[k] after end[k]
  std::vector<Site> label;
  for (const Interval& i : intervals(circle)) {
    if (const Step* s = i.separator)
      ends.push_back(s->kind == Step::Kind::kTie ? s->id : convex_node(s->id));
    runs.push_back(element_of(*i.step.front()));
    label.push_back(i.step.front()->label);
    for (const Step* s : i.step) {
      const auto element = element_of(*s);
      region_.unite(runs.back(), element);
      piece_.unite(runs.front(), element);
    }
    // Feet are continuous in a region: all its governors are in one group of shared feet.
    const auto g = feet.find(part.sites, label.back());
    for (std::size_t k = 0; k < part.sites.size(); ++k)
      if (feet.of[k] == g) labels_[runs.back()].push_back(part.sites[k]);
  }
  for (const auto e : ends) node_[e].piece = runs.front();
  const std::size_t n = ends.size();
  const auto before = [n](std::size_t k) { return (k + n - 1) % n; };
  if (chords) {
    std::map<std::set<std::uint32_t>, std::size_t> first;
    for (std::size_t k = 0; k < n; ++k) {
      const auto [it, fresh] = first.try_emplace(
          {chords->find(part.sites, label[before(k)]), chords->find(part.sites, label[k])}, k);
      if (fresh) continue;
      const std::size_t i = it->second;
      arc_.push_back({{ends[i], ends[k]}, {runs[i], runs[before(i)]}});
      region_.unite(runs[i], runs[before(k)]);
      region_.unite(runs[before(i)], runs[k]);
    }
  } else if (n == 2 && !rim) {
    arc_.push_back({{ends[0], ends[1]}, {runs[0], runs[1]}});
  } else if (n > 0) {
    const Point3 &lo = part.box.lo, &hi = part.box.hi;
    const int u = u_axis(part.axis), v = v_axis(part.axis);
    const auto center = new_node({rim ? FaceMap::Node::Kind::kRim : FaceMap::Node::Kind::kEvent,
                                  0,
                                  0,
                                  0,
                                  {lo[u], hi[u], lo[v], hi[v]},
                                  runs.front()});
    for (std::size_t k = 0; k < n; ++k)
      arc_.push_back({{center, ends[k]}, {runs[before(k)], runs[k]}});
  }
}

/// Those listed, and all that are not shown to govern nothing.
std::vector<Site> FaceChecker::may_govern(const Box& box, std::span<const Site> listed) const {
  std::vector<Site> sites;
  const Box3 part = box_of(box.rect);
  std::ranges::copy_if(box.candidates, std::back_inserter(sites), [&](Site s) {
    return std::ranges::binary_search(listed, s) ||
           !(exclusion_.governs_nothing(s, part, listed, triangles_) ||
             exclusion_.governs_nothing(s, part, box.candidates, triangles_, 20000));
  });
  return sites;
}

/// By exact algebra, on halves of the part where it does not decide.
void FaceChecker::check_exact(const Box& box, std::span<const Site> listed,
                              const std::string& reason, int halvings) {
  std::string last;
  try {
    return record_exact(box, listed);
  } catch (const Algebra::Undecided& undecided) {
    last = undecided.what();
  }
  const Rect& r = box.rect;
  const bool along_u = r.u1 - r.u0 > r.v1 - r.v0;
  const double low = along_u ? r.u0 : r.v0, m = low + 0.4375 * ((along_u ? r.u1 : r.v1) - low);
  if (halvings == 0 || !(m > low && m < (along_u ? r.u1 : r.v1)))
    throw Failure("face: a part that only exact algebra or Theorem S decides: " + reason + "; " +
                  last);
  for (const Box& half : cut(box, along_u, m)) check_exact(half, listed, reason, halvings - 1);
}

/// The problem is of the checker's own: the sites and triangles are all that it could not exclude
/// itself, whatever the certificate lists.
void FaceChecker::record_exact(const Box& box, std::span<const Site> listed) {
  bool loop = false;
  const std::vector<Circle> border = circles(box, loop);
  if (border.empty() && !loop) return;
  const std::vector<Site> sites = may_govern(box, listed);
  std::vector<std::uint32_t> edges, triangles, node;
  for (const auto& [e, p] : point_)
    if (holds(box.rect, e)) edges.push_back(e);
  const bool crossed = std::ranges::any_of(box.side, [](const Line& side) {
    return std::ranges::find(side.piece, false, &Line::Piece::inside) != side.piece.end();
  });
  if (crossed || !edges.empty())
    triangles = exclusion_.sites().meeting(triangles_, box_of(box.rect));
  const FaceMap map = algebra_.diagram(box.rect, box.side, sites, triangles);
  for (const FaceMap::Region& r : map.region)
    require(std::ranges::includes(listed, r.labels),
            "face: a site that governs a part by exact algebra is missing");
  require(map.trace_point == edges, "face: exact algebra finds other boundary edges");
  require(loop || std::accumulate(map.circles.begin(), map.circles.end(), std::size_t{0}) ==
                      border.size(),
          "face: exact algebra finds other borders of ∂O and the part");
  // Regions get the elements of the intervals of sides and of the traces that they show on.
  std::vector<std::uint32_t> of_region(map.region.size(), kNone),
      of_piece(map.circles.size(), kNone);
  const auto join = [&](std::uint32_t r, std::uint32_t own) {
    if (of_region[r] == kNone) of_region[r] = own;
    region_.unite(of_region[r], own);
    auto& first = of_piece[map.region[r].piece];
    if (first == kNone) first = own;
    piece_.unite(first, own);
  };
  for (std::size_t s = 0; s < 4; ++s)
    for (std::size_t k = 0; k < box.side[s].piece.size(); ++k)
      if (const Line::Piece& own = box.side[s].piece[k]; own.inside)
        join(map.side[s].piece[k].id, own.id);
  for (const auto& [t, r] : map.trace) join(r, element_of({Step::Kind::kTrace, t}));
  for (std::uint32_t r = 0; r < map.region.size(); ++r) {
    if (of_region[r] == kNone) join(r, new_element());
    auto& labels = labels_[of_region[r]];
    labels.insert(labels.end(), map.region[r].labels.begin(), map.region[r].labels.end());
  }
  for (const Circle& c : border)
    for (const Interval& i : intervals(c))
      for (const Step* s : i.step)
        require(region_.find(element_of(*s)) == region_.find(element_of(*i.step.front())),
                "face: exact algebra parts the border elsewhere");
  for (const FaceMap::Node& n : map.node) {
    node.push_back(n.kind == FaceMap::Node::Kind::kSide
                       ? box.side[static_cast<std::size_t>(n.side)].change[n.change].id
                   : n.kind == FaceMap::Node::Kind::kConvexEdge ? convex_node(n.edge)
                                                                : new_node(n));
    node_[node.back()].piece = of_piece[n.piece];
  }
  for (const auto& [ends, r] : map.arc)
    arc_.push_back({{node[ends[0]], node[ends[1]]}, {of_region[r[0]], of_region[r[1]]}});
}

void FaceChecker::check_part(const Box& box, const Claim& claim) {
  bool loop = false;
  const std::vector<Circle> border = circles(box, loop);
  if (border.empty() && !loop) return;
  const Part part{exclusion_, box_of(box.rect), box.rect.axis, claim.sites};
  require(std::ranges::includes(candidates_, part.sites),
          "face: a part names a site that is no candidate");
  const SharedFeet shared(exclusion_, part.sites, part.box);
  const Groups feet = groups_by_feet(exclusion_.sites(), part.sites, shared);
  bool rim = false;
  std::pair<Groups, bool> star;
  try {
    require(!loop, "face: a closed curve of ∂O inside a part");
    require(std::ranges::includes(part.sites, may_govern(box, part.sites)),
            "face: a site that may govern a part is missing");
    if (claim.type == Claim::Type::kStar || claim.type == Claim::Type::kChords)
      star = check_star(part, shared, border, claim);
    else
      rim = check_about_vertex(part, shared, feet, border, claim);
  } catch (const Failure& failure) {
    if (!claim.proposed) throw;
    return check_exact(box, part.sites, failure.what());
  }
  for (const Circle& c : border) record(c, part, feet, rim, star.second ? &star.first : nullptr);
}

void FaceChecker::check(Box box) {
  require(next_part_ < parts_.size(), "face: parts are missing");
  const PartNode& node = parts_[next_part_++];
  if (node.axis < 0) return check_part(box, node.claim);
  for (Box& half : cut(box, node.axis == 0, node.cut)) check(std::move(half));
}

/// The low and the high half.
std::array<Box, 2> FaceChecker::cut(const Box& box, bool along_u, double m) {
  const Rect& r = box.rect;
  require(along_u ? m > r.u0 && m < r.u1 : m > r.v0 && m < r.v1, "face: a cut outside its part");
  Box low = box, high = box;
  (along_u ? low.rect.u1 : low.rect.v1) = (along_u ? high.rect.u0 : high.rect.v0) = m;
  // The sides that the cut meets; low and high are their parts.
  for (const std::size_t s : {along_u ? 0u : 3u, along_u ? 2u : 1u}) {
    auto half = lines_.cut(box.side[s], m, box.candidates);
    low.side[s] = std::move(half[0]);
    high.side[s] = std::move(half[1]);
  }
  const std::size_t last = along_u ? 1 : 2, first = along_u ? 3 : 0;
  const bool starts_inside = low.side[along_u ? 0 : 3].piece.back().inside;
  low.side[last] = high.side[first] = name(lines_.solve(side_of(low.rect, static_cast<int>(last)),
                                                        starts_inside, box.candidates, triangles_),
                                           -1);
  for (Box* half : {&low, &high})
    half->candidates = exclusion_.remaining(box.candidates, box_of(half->rect));
  return {std::move(low), std::move(high)};
}

/// Where two parts meet arcs go on: one node less, but on a closed arc, which keeps one.
void FaceChecker::splice() {
  std::vector<std::vector<std::uint32_t>> at(node_.size());
  for (std::uint32_t a = 0; a < arc_.size(); ++a)
    for (const auto n : arc_[a].node) at[n].push_back(a);
  std::vector<bool> gone(arc_.size(), false);
  for (std::uint32_t n = 0; n < node_.size(); ++n) {
    if (!through_[n] || node_[n].piece == kNone) continue;
    node_[n].kind = FaceMap::Node::Kind::kEvent;
    require(at[n].size() == 2, "face: an arc ends where two parts meet");
    const auto a = at[n][0], b = at[n][1];
    if (a == b) continue;
    const auto far = arc_[b].node[arc_[b].node[0] == n ? 1 : 0];
    arc_[a].node[arc_[a].node[0] == n ? 0 : 1] = far;
    std::ranges::replace(at[far], b, a);
    gone[b] = true;
    node_[n].piece = kNone;
  }
  std::erase_if(arc_, [&](const FaceMap::Arc& a) { return gone[&a - arc_.data()]; });
}

/// The parts' regions, pieces and nodes with numbers of their own.
FaceMap FaceChecker::assemble(const Box& root) {
  FaceMap map;
  map.rect = root.rect;
  map.side = root.side;
  std::vector<std::uint32_t> region_of(region_.size(), kNone), piece_of(region_.size(), kNone),
      node_of(node_.size(), kNone);
  const auto piece = [&](std::uint32_t element) {
    auto& index = piece_of[piece_.find(element)];
    if (index == kNone) {
      index = static_cast<std::uint32_t>(map.circles.size());
      map.circles.push_back(0);
    }
    return index;
  };
  const auto region = [&](std::uint32_t element) {
    auto& index = region_of[region_.find(element)];
    if (index == kNone) {
      index = static_cast<std::uint32_t>(map.region.size());
      map.region.push_back({{}, piece(element)});
    }
    return index;
  };
  for (std::uint32_t e = 0; e < region_.size(); ++e)
    for (const Site s : labels_[e]) map.region[region(e)].labels.push_back(s);
  for (FaceMap::Region& r : map.region) {
    std::ranges::sort(r.labels);
    r.labels.erase(std::ranges::unique(r.labels).begin(), r.labels.end());
  }
  for (std::uint32_t n = 0; n < node_.size(); ++n) {
    if (node_[n].piece == kNone) continue;
    node_of[n] = static_cast<std::uint32_t>(map.node.size());
    map.node.push_back(node_[n]);
    map.node.back().piece = piece(node_[n].piece);
  }
  for (const FaceMap::Arc& a : arc_)
    map.arc.push_back(
        {{node_of[a.node[0]], node_of[a.node[1]]}, {region(a.region[0]), region(a.region[1])}});
  for (Line& side : map.side)
    for (Line::Piece& p : side.piece)
      if (p.inside) p.id = region(p.id);
  for (const auto& [t, e] : trace_element_) map.trace.push_back({t, region(e)});
  for (const auto& [e, p] : point_)
    if (holds(root.rect, e)) map.trace_point.push_back(e);
  // Circles around the pieces: those that meet the border, and closed curves of ∂O.
  bool loop = false;
  std::set<std::uint32_t> seen;
  for (const Circle& c : circles(root, loop)) {
    for (const Step& s : c)
      if (s.kind == Step::Kind::kTrace) seen.insert(s.id);
    ++map.circles[piece(element_of(c.front()))];
  }
  for (const auto& [t, element] : trace_element_) {
    if (seen.contains(t)) continue;
    ++map.circles[piece(element)];
    for (auto x = t, from = kNone; seen.insert(x).second; x = shape_.across(from, x))
      from = trace_.at(x)[trace_.at(x)[0] == from ? 1 : 0];
  }
  return map;
}

FaceMap FaceChecker::run(const std::array<Line, 4>& sides) {
  find_traces();
  Box root{rect_, {}, candidates_};
  for (std::size_t s = 0; s < 4; ++s) root.side[s] = name(sides[s], static_cast<int>(s));
  check(root);
  require(next_part_ == parts_.size(), "face: too many parts");
  splice();
  return assemble(root);
}

}  // namespace

FaceMap check_face(const Exclusion& exclusion, const Algebra& algebra, const Rect& rect,
                   const std::array<Line, 4>& sides, std::span<const Site> candidates,
                   std::span<const std::uint32_t> triangles, std::span<const PartNode> parts) {
  return FaceChecker(exclusion, algebra, rect, candidates, triangles, parts).run(sides);
}

}  // namespace blum::verify
