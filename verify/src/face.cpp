#include "face.hpp"

#include <algorithm>
#include <set>

#include "blum/kernel/union_find.hpp"
#include "face_claims.hpp"
#include "failure.hpp"

namespace blum::verify {

Segment side_of(const Rect& r, int side) {
  const int u = u_axis(r.axis), v = v_axis(r.axis);
  switch (side) {
    case 0:
      return {u, r.v0, r.level, r.u0, r.u1};  // (u_axis(u), v_axis(u)) == (v, axis)
    case 1:
      return {v, r.level, r.u1, r.v0, r.v1};
    case 2:
      return {u, r.v1, r.level, r.u0, r.u1};
    default:
      return {v, r.level, r.u0, r.v0, r.v1};
  }
}

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// A line with names: nodes for its ties, elements of regions for its pieces inside.
struct Side {
  Line line;
  std::vector<std::uint32_t> node, element;
};

struct Box {
  Rect rect;
  std::array<Side, 4> side;
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
  const auto first = std::ranges::find_if(circle, &Step::separates);
  const auto start = static_cast<std::size_t>(first - circle.begin());
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
  FaceChecker(const Exclusion& exclusion, std::span<const std::uint32_t> triangles,
              std::span<const PartNode> parts)
      : exclusion_(exclusion),
        shape_(exclusion.sites().shape()),
        lines_(exclusion),
        triangles_(triangles.begin(), triangles.end()),
        parts_(parts) {}

  FaceMap run(const Rect& rect, const std::array<Line, 4>& sides, std::span<const Site> candidates);

 private:
  void find_traces(const Rect& rect);
  [[nodiscard]] bool holds(const Rect& r, std::uint32_t edge) const;
  [[nodiscard]] Side name(Line line, int side);
  void check(Box box);
  void check_part(const Box& box, const Claim& claim);
  [[nodiscard]] std::vector<Circle> circles(const Box& box, bool& loop) const;
  /// The groups, and whether chords are claimed.
  struct Star {
    Groups groups;
    bool chords = false;
  };
  Star check_star(const Part& part, const SharedFeet& feet, const std::vector<Circle>& circles,
                  const Claim& claim) const;
  /// Ends and runs of a circle, run[k] after end[k]: an element and a governor of each.
  struct Border {
    std::vector<std::uint32_t> end, run;
    std::vector<Site> label;
  };
  Border label(const Circle& circle, const Part& part, const Groups& feet);
  void record(const Circle& circle, const Part& part, const Groups& feet, bool rim);
  void record_chords(const Circle& circle, const Part& part, const Groups& feet,
                     const Groups& groups);
  [[nodiscard]] std::uint32_t new_element();
  [[nodiscard]] std::uint32_t element_of(const Step& s);
  [[nodiscard]] std::uint32_t convex_node(std::uint32_t edge);
  void splice();
  [[nodiscard]] FaceMap assemble(const Box& root);

  const Exclusion& exclusion_;
  const Shape& shape_;
  LineSolver lines_;
  std::vector<std::uint32_t> triangles_;
  std::span<const PartNode> parts_;
  std::size_t next_part_ = 0;
  int u_ = 0, v_ = 0;
  std::map<std::uint32_t, std::array<Rational, 2>> point_;              // boundary edge -> (u, v)
  std::map<std::uint32_t, std::array<std::uint32_t, 2>> trace_;         // triangle -> two edges
  std::map<std::uint32_t, std::uint32_t> trace_element_, convex_node_;  // by triangle, edge
  std::vector<FaceMap::Node> node_;
  std::vector<std::uint32_t> node_element_;
  std::vector<bool> through_;     // nodes inside the rectangle where two parts meet
  std::vector<Site> candidates_;  // of the rectangle, sorted
  std::vector<FaceMap::Arc> arc_;
  UnionFind region_, piece_;  // of elements
  std::vector<std::vector<Site>> labels_;
};

std::uint32_t FaceChecker::new_element() {
  labels_.emplace_back();
  piece_.add();
  return region_.add();
}

std::uint32_t FaceChecker::element_of(const Step& s) {
  if (s.kind == Step::Kind::kPiece) return s.id;
  const auto [it, fresh] = trace_element_.try_emplace(s.id, 0u);
  if (fresh) it->second = new_element();
  return it->second;
}

std::uint32_t FaceChecker::convex_node(std::uint32_t edge) {
  const auto [it, fresh] = convex_node_.try_emplace(edge, static_cast<std::uint32_t>(node_.size()));
  if (fresh) {
    node_.push_back({FaceMap::Node::Kind::kConvexEdge, 0, 0, edge, 0, {}});
    node_element_.push_back(kNone);
    through_.push_back(false);
  }
  return it->second;
}

void FaceChecker::find_traces(const Rect& rect) {
  for (const auto t : triangles_) {
    const Triangle& tri = shape_.triangle[t];
    std::array<std::uint32_t, 2> ends{};
    int n = 0;
    for (const auto e : tri.edge) {
      const Point3 &a = shape_.point[shape_.edge[e].vertex[0]],
                   &b = shape_.point[shape_.edge[e].vertex[1]];
      require(a[rect.axis] != rect.level && b[rect.axis] != rect.level,
              "face: a boundary vertex lies in its plane");
      if ((a[rect.axis] < rect.level) == (b[rect.axis] < rect.level)) continue;
      const Rational s =
          (Rational(rect.level) - a[rect.axis]) / (Rational(b[rect.axis]) - a[rect.axis]);
      point_[e] = {Rational(a[u_]) + s * (Rational(b[u_]) - a[u_]),
                   Rational(a[v_]) + s * (Rational(b[v_]) - a[v_])};
      ends[n++] = e;
    }
    if (n == 2) trace_[t] = ends;
  }
}

bool FaceChecker::holds(const Rect& r, std::uint32_t edge) const {
  const auto& [u, v] = point_.at(edge);
  return u > r.u0 && u < r.u1 && v > r.v0 && v < r.v1;
}

/// side: 0 to 3, or -1 for a line inside the rectangle.
Side FaceChecker::name(Line line, int side) {
  Side s{std::move(line), {}, {}};
  for (std::uint32_t k = 0; k < s.line.change.size(); ++k) {
    s.node.push_back(kNone);
    if (s.line.change[k].boundary) continue;
    s.node.back() = static_cast<std::uint32_t>(node_.size());
    node_.push_back({FaceMap::Node::Kind::kSide, side, k, 0, 0, {}});
    node_element_.push_back(kNone);
    through_.push_back(side < 0);
  }
  for (const Line::Piece& p : s.line.piece) s.element.push_back(p.inside ? new_element() : kNone);
  return s;
}

std::vector<Circle> FaceChecker::circles(const Box& box, bool& loop) const {
  struct Item {
    bool piece;
    const Side* side;
    std::size_t index;
  };
  std::vector<Item> item;  // counter-clockwise
  for (int s = 0; s < 4; ++s) {
    const Side& side = box.side[static_cast<std::size_t>(s)];
    const std::size_t n = side.element.size();
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = s < 2 ? k : n - 1 - k;
      if (k > 0) item.push_back({false, &side, s < 2 ? i - 1 : i});
      item.push_back({true, &side, i});
    }
  }
  std::map<std::uint32_t, std::vector<std::size_t>> crossing;  // triangle -> items
  for (std::size_t i = 0; i < item.size(); ++i)
    if (!item[i].piece && item[i].side->line.change[item[i].index].boundary)
      crossing[item[i].side->line.change[item[i].index].triangle].push_back(i);
  std::set<std::uint32_t> visited;
  const auto across = [&](std::uint32_t e, std::uint32_t t) {
    return shape_.edge[e].triangle[shape_.edge[e].triangle[0] == t ? 1 : 0];
  };
  const auto next_point = [&](std::uint32_t t, std::uint32_t from) {
    for (const auto e : trace_.at(t))
      if (e != from && holds(box.rect, e)) return e;
    return kNone;
  };
  // Along ∂O from where it enters the part to where it leaves it.
  const auto follow = [&](std::size_t start, Circle& circle) {
    auto t = item[start].side->line.change[item[start].index].triangle;
    for (std::uint32_t from = kNone;;) {
      require(visited.insert(t).second, "face: ∂O runs through a part in circles");
      circle.push_back({Step::Kind::kTrace, t, shape_.face_site(t)});
      const auto e = next_point(t, from);
      if (e == kNone) break;
      if (shape_.edge[e].bend == Bend::kConvex) circle.push_back({Step::Kind::kConvexEdge, e, 0});
      t = across(e, t);
      from = e;
    }
    for (const auto i : crossing[t])
      if (i != start) return i;
    throw Failure("face: ∂O enters a part and does not leave it");
  };
  std::vector<Circle> found;
  std::vector<bool> done(item.size(), false);
  for (std::size_t first = 0; first < item.size(); ++first) {
    if (done[first] || !item[first].piece || item[first].side->element[item[first].index] == kNone)
      continue;
    Circle circle;
    std::size_t i = first;
    do {
      const Side& side = *item[i].side;
      if (item[i].piece) {
        require(side.element[item[i].index] != kNone && !done[i], "face: a border is no circle");
        done[i] = true;
        circle.push_back({Step::Kind::kPiece, side.element[item[i].index],
                          side.line.piece[item[i].index].label});
      } else if (!side.line.change[item[i].index].boundary) {
        circle.push_back({Step::Kind::kTie, side.node[item[i].index], 0});
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

bool intervals_differ(const Circle& circle, const Part& part, const Groups& feet) {
  std::vector<std::uint32_t> groups;
  for (const Interval& i : intervals(circle))
    groups.push_back(feet.find(part.sites, i.step.front()->label));
  std::ranges::sort(groups);
  return std::ranges::adjacent_find(groups) == groups.end();
}

FaceChecker::Star FaceChecker::check_star(const Part& part, const SharedFeet& feet,
                                          const std::vector<Circle>& circles,
                                          const Claim& claim) const {
  const Sites& sites = part.exclusion.sites();
  Groups groups = claim.by_feet ? groups_by_feet(sites, part.sites, feet)
                                : groups_by_ties(sites, part.sites, part.box);
  if (claim.proposed && !groups.cliques) groups = groups_by_feet(sites, part.sites, feet);
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
    all.push_back(runs);
    std::ranges::sort(runs);
    twice |= std::ranges::adjacent_find(runs) != runs.end();
  }
  if (claim.type == Claim::Type::kChords) {
    check_chords(part, groups, feet, all, claim);
    return {groups, true};
  }
  require(!twice || claim.proposed, "Theorem D': a group governs two intervals of a border");
  if (!twice) {
    check_directions(part, groups, feet, claim);
    return {groups, false};
  }
  // What is proposed for a star will do for chords: the direction of a group for all its pairs.
  Claim chords = claim;
  for (const auto& [a, along] : claim.direction)
    for (const auto& [b, other] : claim.direction)
      if (a != b) chords.between.push_back({a, b, along});
  check_chords(part, groups, feet, all, chords);
  return {groups, true};
}

/// Labels the regions along a circle, and makes them one piece.
FaceChecker::Border FaceChecker::label(const Circle& circle, const Part& part, const Groups& feet) {
  Border r;
  for (const Interval& i : intervals(circle)) {
    if (const Step* s = i.separator)
      r.end.push_back(s->kind == Step::Kind::kTie ? s->id : convex_node(s->id));
    r.run.push_back(element_of(*i.step.front()));
    r.label.push_back(i.step.front()->label);
    for (const Step* s : i.step) {
      const auto element = element_of(*s);
      region_.unite(r.run.back(), element);
      piece_.unite(r.run.front(), element);
    }
    // Feet are continuous in a region: all its governors are in one group of shared feet.
    const auto g = feet.find(part.sites, r.label.back());
    for (std::size_t k = 0; k < part.sites.size(); ++k)
      if (feet.of[k] == g) labels_[r.run.back()].push_back(part.sites[k]);
  }
  for (const auto e : r.end) node_element_[e] = r.run.front();
  return r;
}

void FaceChecker::record(const Circle& circle, const Part& part, const Groups& feet, bool rim) {
  const Border border = label(circle, part, feet);
  const auto &ends = border.end, &runs = border.run;
  const std::size_t n = ends.size();
  if (n == 0) return;
  if (n == 2 && !rim) {
    arc_.push_back({{ends[0], ends[1]}, {runs[0], runs[1]}});
    return;
  }
  const auto center = static_cast<std::uint32_t>(node_.size());
  const Box3& b = part.box;
  node_.push_back({rim ? FaceMap::Node::Kind::kRim : FaceMap::Node::Kind::kEvent,
                   0,
                   0,
                   0,
                   0,
                   {b.lo[u_], b.hi[u_], b.lo[v_], b.hi[v_]}});
  node_element_.push_back(runs.front());
  through_.push_back(false);
  for (std::size_t k = 0; k < n; ++k)
    arc_.push_back({{center, ends[k]}, {runs[(k + n - 1) % n], runs[k]}});
}

/// Chords: an arc joins the two ends between the same groups; runs on one side of it are one
/// region.
void FaceChecker::record_chords(const Circle& circle, const Part& part, const Groups& feet,
                                const Groups& groups) {
  const Border b = label(circle, part, feet);
  const std::size_t n = b.end.size();
  std::map<std::array<std::uint32_t, 2>, std::size_t> first;
  for (std::size_t k = 0; k < n; ++k) {
    const auto before = [n](std::size_t i) { return (i + n - 1) % n; };
    const auto g = groups.find(part.sites, b.label[before(k)]),
               h = groups.find(part.sites, b.label[k]);
    const auto [it, fresh] = first.try_emplace({std::min(g, h), std::max(g, h)}, k);
    if (fresh) continue;
    const std::size_t i = it->second;
    arc_.push_back({{b.end[i], b.end[k]}, {b.run[i], b.run[before(i)]}});
    region_.unite(b.run[i], b.run[before(k)]);
    region_.unite(b.run[before(i)], b.run[k]);
  }
}

void FaceChecker::check_part(const Box& box, const Claim& claim) {
  const Rect& r = box.rect;
  Part part{exclusion_,
            {point_on(r.axis, r.level, r.u0, r.v0), point_on(r.axis, r.level, r.u1, r.v1)},
            r.axis,
            {}};
  bool loop = false;
  const std::vector<Circle> border = circles(box, loop);
  require(!loop, "face: a closed curve of ∂O inside a part");
  if (border.empty()) return;
  require(std::ranges::includes(candidates_, claim.sites),
          "face: a part names a site that is no candidate");
  part.sites = claim.sites;
  for (const Site s : box.candidates)
    require(std::ranges::binary_search(claim.sites, s) ||
                exclusion_.governs_nothing(s, part.box, claim.sites, triangles_) ||
                exclusion_.governs_nothing(s, part.box, box.candidates, triangles_, 20000),
            "face: a site that may govern a part is missing");
  const SharedFeet shared(exclusion_, part.sites, part.box);
  const Groups feet = groups_by_feet(exclusion_.sites(), part.sites, shared);
  bool rim = false;
  Star star;
  if (claim.type == Claim::Type::kStar || claim.type == Claim::Type::kChords) {
    star = check_star(part, shared, border, claim);
  } else {
    require(border.size() == 1 &&
                std::ranges::none_of(border[0],
                                     [](const Step& s) { return s.kind == Step::Kind::kTrace; }),
            "a part about a vertex is not inside the solid");
    const auto ties = std::ranges::count_if(border[0], &Step::separates);
    rim = claim.type == Claim::Type::kRim || ties == 1;
    if (claim.type == Claim::Type::kRim) {
      check_rim(part, claim.vertex, claim.edge);
    } else {
      check_cone(part, claim.vertex);
      const bool foot = ties > 0 && shared.vertex(claim.vertex) &&
                        polar_cone_meets(shape_, claim.vertex, part.box);
      // Intervals of different groups are of different regions: then the forest is one tree.
      require(ties <= 1 ? (ties == 0 || foot)
                        : !foot && (ties <= 3 || intervals_differ(border[0], part, feet)),
              "Theorem G: this number of ties decides nothing");
    }
  }
  for (const Circle& c : border) {
    if (star.chords)
      record_chords(c, part, feet, star.groups);
    else
      record(c, part, feet, rim);
  }
}

void FaceChecker::check(Box box) {
  require(next_part_ < parts_.size(), "face: parts are missing");
  const PartNode& node = parts_[next_part_++];
  if (node.axis < 0) {
    try {
      return check_part(box, node.claim);
    } catch (const Failure& failure) {
      if (!node.claim.proposed) throw;
      throw Failure(std::string("face: a part that only exact algebra or Theorem S decides: ") +
                    failure.what());
    }
  }
  const bool along_u = node.axis == 0;
  const Rect& r = box.rect;
  const double m = node.cut;
  require(along_u ? m > r.u0 && m < r.u1 : m > r.v0 && m < r.v1, "face: a cut outside its part");
  Box low = box, high = box;
  (along_u ? low.rect.u1 : low.rect.v1) = (along_u ? high.rect.u0 : high.rect.v0) = m;
  // The sides that the cut meets; low and high are their parts.
  bool starts_inside = false;
  for (const std::size_t s : {along_u ? 0u : 3u, along_u ? 2u : 1u}) {
    const Side& side = box.side[s];
    const auto half = lines_.cut(side.line, m, box.candidates);
    const std::size_t n = half[0].change.size(), p = half[0].piece.size();
    low.side[s] = {half[0],
                   {side.node.begin(), side.node.begin() + static_cast<long>(n)},
                   {side.element.begin(), side.element.begin() + static_cast<long>(p)}};
    high.side[s] = {half[1],
                    {side.node.begin() + static_cast<long>(n), side.node.end()},
                    {side.element.begin() + static_cast<long>(p) - 1, side.element.end()}};
    if (s == (along_u ? 0u : 3u)) starts_inside = half[0].piece.back().inside;
  }
  Segment segment;
  if (along_u)
    segment = {v_, r.level, m, r.v0, r.v1};
  else
    segment = {u_, m, r.level, r.u0, r.u1};
  const Side middle = name(lines_.solve(segment, starts_inside, box.candidates, triangles_), -1);
  low.side[along_u ? 1 : 2] = middle;
  high.side[along_u ? 3 : 0] = middle;
  for (Box* half : {&low, &high}) {
    const Rect& h = half->rect;
    half->candidates = exclusion_.remaining(
        box.candidates,
        {point_on(h.axis, h.level, h.u0, h.v0), point_on(h.axis, h.level, h.u1, h.v1)});
  }
  box = Box{};
  check(std::move(low));
  check(std::move(high));
}

/// Where two parts meet arcs go on: one node less, but on a closed arc, which keeps one.
void FaceChecker::splice() {
  std::vector<std::vector<std::uint32_t>> at(node_.size());
  for (std::uint32_t a = 0; a < arc_.size(); ++a)
    for (const auto n : arc_[a].node) at[n].push_back(a);
  std::vector<bool> gone(arc_.size(), false);
  for (std::uint32_t n = 0; n < node_.size(); ++n) {
    if (!through_[n] || node_element_[n] == kNone) continue;
    require(at[n].size() == 2, "face: an arc ends where two parts meet");
    const auto a = at[n][0], b = at[n][1];
    if (a == b) continue;
    const auto far = arc_[b].node[arc_[b].node[0] == n ? 1 : 0];
    arc_[a].node[arc_[a].node[0] == n ? 0 : 1] = far;
    std::ranges::replace(at[far], b, a);
    gone[b] = true;
    node_element_[n] = kNone;
  }
  std::vector<FaceMap::Arc> kept;
  for (std::size_t a = 0; a < arc_.size(); ++a)
    if (!gone[a]) kept.push_back(arc_[a]);
  arc_ = std::move(kept);
}

FaceMap FaceChecker::assemble(const Box& root) {
  splice();
  FaceMap map;
  map.rect = root.rect;
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
    if (!labels_[e].empty()) {
      auto& all = map.region[region(e)].labels;
      all.insert(all.end(), labels_[e].begin(), labels_[e].end());
    }
  for (FaceMap::Region& r : map.region) {
    std::ranges::sort(r.labels);
    r.labels.erase(std::ranges::unique(r.labels).begin(), r.labels.end());
  }
  for (std::uint32_t n = 0; n < node_.size(); ++n) {
    if (node_element_[n] == kNone) continue;
    node_of[n] = static_cast<std::uint32_t>(map.node.size());
    map.node.push_back(node_[n]);
    if (through_[n]) map.node.back().kind = FaceMap::Node::Kind::kEvent;
    map.node.back().piece = piece(node_element_[n]);
  }
  for (const FaceMap::Arc& a : arc_)
    map.arc.push_back(
        {{node_of[a.node[0]], node_of[a.node[1]]}, {region(a.region[0]), region(a.region[1])}});
  for (std::size_t s = 0; s < 4; ++s) {
    map.side[s] = root.side[s].line;
    for (const auto e : root.side[s].element)
      map.side_region[s].push_back(e == kNone ? FaceMap::kOutside : region(e));
  }
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
  for (const auto& [t, ends] : trace_) {
    if (seen.contains(t) || !trace_element_.contains(t)) continue;
    ++map.circles[piece(trace_element_.at(t))];
    for (auto x = t, from = kNone; seen.insert(x).second;) {
      from = trace_.at(x)[trace_.at(x)[0] == from ? 1 : 0];
      x = shape_.edge[from].triangle[shape_.edge[from].triangle[0] == x ? 1 : 0];
    }
  }
  return map;
}

FaceMap FaceChecker::run(const Rect& rect, const std::array<Line, 4>& sides,
                         std::span<const Site> candidates) {
  u_ = u_axis(rect.axis);
  v_ = v_axis(rect.axis);
  find_traces(rect);
  candidates_.assign(candidates.begin(), candidates.end());
  Box root{rect, {}, {candidates.begin(), candidates.end()}};
  for (int s = 0; s < 4; ++s)
    root.side[static_cast<std::size_t>(s)] = name(sides[static_cast<std::size_t>(s)], s);
  check(root);
  require(next_part_ == parts_.size(), "face: too many parts");
  return assemble(root);
}

}  // namespace

FaceMap check_face(const Exclusion& exclusion, const Rect& rect, const std::array<Line, 4>& sides,
                   std::span<const Site> candidates, std::span<const std::uint32_t> triangles,
                   std::span<const PartNode> parts) {
  return FaceChecker(exclusion, triangles, parts).run(rect, sides, candidates);
}

}  // namespace blum::verify
