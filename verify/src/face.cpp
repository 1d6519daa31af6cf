#include "face.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "face_claims.hpp"

namespace blum::verify {
namespace {

class FaceChecker {
 public:
  FaceChecker(const Exclusion& exclusion, const Algebra& algebra, const Rect& rect,
              std::span<const Site> candidates, std::span<const std::uint32_t> triangles,
              std::span<const PartNode> parts)
      : exclusion_(exclusion),
        algebra_(algebra),
        lines_(exclusion, algebra),
        triangles_(triangles),
        parts_(parts),
        traces_(exclusion.sites().shape(), rect, triangles),
        root_{rect, {}, {candidates.begin(), candidates.end()}} {}

  FaceMap run(const std::array<Line, 4>& sides);

 private:
  void check(const Box& box);
  [[nodiscard]] std::array<Box, 2> cut(const Box& box, bool along_u, double m);
  void check_part(const Box& box, const Claim& claim);
  /// The groups, and whether the part is one of chords.
  std::pair<Groups, bool> check_star(const Part& part, const SharedFeet& feet,
                                     const std::vector<Circle>& circles, const Claim& claim) const;
  bool check_about_vertex(const Part& part, const SharedFeet& feet, const Groups& groups,
                          const std::vector<Circle>& circles, const Claim& claim) const;
  void record(const Circle& circle, const Part& part, const Groups& feet, bool rim,
              const Groups* chords);
  void record_exact(const Box& box, const Border& border, std::span<const Site> listed,
                    std::span<const Site> sites);
  [[nodiscard]] std::vector<Site> may_govern(const Box& box, std::span<const Site> listed) const;

  const Exclusion& exclusion_;
  const Algebra& algebra_;
  LineSolver lines_;
  std::span<const std::uint32_t> triangles_;
  std::span<const PartNode> parts_;
  std::size_t next_part_ = 0;
  Traces traces_;
  MapBuilder map_{traces_};
  Box root_;
};

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
  const bool foot = ties > 0 && feet.vertex(claim.vertex) &&
                    exclusion_.sites().domain_meets(claim.vertex, part.box);
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
    if (const Step* s = i.separator) ends.push_back(map_.node_of(*s));
    runs.push_back(map_.element_of(*i.step.front()));
    label.push_back(i.step.front()->label);
    for (const Step* s : i.step) {
      map_.same_region(runs.back(), map_.element_of(*s));
      map_.same_piece(runs.front(), runs.back());
    }
    // Feet are continuous in a region: all its governors are in one group of shared feet.
    const auto g = feet.find(part.sites, label.back());
    for (std::size_t k = 0; k < part.sites.size(); ++k)
      if (feet.of[k] == g) map_.label(runs.back(), part.sites[k]);
  }
  for (const auto e : ends) map_.place(e, runs.front());
  const std::size_t n = ends.size();
  const auto before = [n](std::size_t k) { return (k + n - 1) % n; };
  if (chords) {
    std::map<std::set<std::uint32_t>, std::size_t> first;
    for (std::size_t k = 0; k < n; ++k) {
      const auto [it, fresh] = first.try_emplace(
          {chords->find(part.sites, label[before(k)]), chords->find(part.sites, label[k])}, k);
      if (fresh) continue;
      const std::size_t i = it->second;
      map_.add_arc({{ends[i], ends[k]}, {runs[i], runs[before(i)]}});
      map_.same_region(runs[i], runs[before(k)]);
      map_.same_region(runs[before(i)], runs[k]);
    }
  } else if (n == 2 && !rim) {
    map_.add_arc({{ends[0], ends[1]}, {runs[0], runs[1]}});
  } else if (n > 0) {
    const Point3 &lo = part.box.lo, &hi = part.box.hi;
    const int u = u_axis(part.axis), v = v_axis(part.axis);
    const auto center =
        map_.new_node({.kind = rim ? FaceMap::Node::Kind::kRim : FaceMap::Node::Kind::kEvent,
                       .box = {lo[u], hi[u], lo[v], hi[v]},
                       .piece = runs.front()});
    for (std::size_t k = 0; k < n; ++k)
      map_.add_arc({{center, ends[k]}, {runs[before(k)], runs[k]}});
  }
}

/// Those listed, and all that are not shown to govern nothing.
std::vector<Site> FaceChecker::may_govern(const Box& box, std::span<const Site> listed) const {
  std::vector<Site> others, sites;
  std::ranges::set_difference(box.candidates, listed, std::back_inserter(others));
  others = exclusion_.may_govern(others, box_of(box.rect), listed, triangles_);
  std::ranges::copy_if(box.candidates, std::back_inserter(sites), [&](Site s) {
    return std::ranges::binary_search(listed, s) || std::ranges::binary_search(others, s);
  });
  return sites;
}

/// By exact algebra. The problem is of the checker's own: `sites` and triangles are all that it
/// could not exclude itself, whatever is listed; and what is found has to fit the border found
/// without it.
void FaceChecker::record_exact(const Box& box, const Border& border, std::span<const Site> listed,
                               std::span<const Site> sites) {
  std::vector<std::uint32_t> triangles;
  const bool crossed = std::ranges::any_of(box.side, [](const Line& side) {
    return std::ranges::find(side.piece, false, &Line::Piece::inside) != side.piece.end();
  });
  if (crossed || !traces_.edges_in(box.rect).empty())
    triangles = exclusion_.sites().meeting(triangles_, box_of(box.rect));
  const FaceMap map = algebra_.diagram(box.rect, box.side, sites, triangles);
  for (const FaceMap::Region& r : map.region)
    require(std::ranges::includes(listed, r.labels),
            "face: a site that governs a part by exact algebra is missing");
  require(map.trace_point == traces_.edges_in(box.rect),
          "face: exact algebra finds other boundary edges");
  require(border.loop || std::accumulate(map.circles.begin(), map.circles.end(), std::size_t{0}) ==
                             border.circle.size(),
          "face: exact algebra finds other borders of ∂O and the part");
  // Regions get the elements of the intervals of sides and of the traces that they show on.
  std::vector<std::uint32_t> of_region(map.region.size(), kNone),
      of_piece(map.circles.size(), kNone);
  const auto join = [&](std::uint32_t r, std::uint32_t own) {
    if (of_region[r] == kNone) of_region[r] = own;
    map_.same_region(of_region[r], own);
    auto& first = of_piece[map.region[r].piece];
    if (first == kNone) first = own;
    map_.same_piece(first, own);
  };
  for (std::size_t s = 0; s < 4; ++s)
    for (std::size_t k = 0; k < box.side[s].piece.size(); ++k)
      if (const Line::Piece& own = box.side[s].piece[k]; own.inside)
        join(map.side[s].piece[k].id, own.id);
  for (const auto& [t, r] : map.trace) join(r, map_.element_of({Step::Kind::kTrace, t}));
  for (std::uint32_t r = 0; r < map.region.size(); ++r) {
    if (of_region[r] == kNone) join(r, map_.new_element());
    for (const Site s : map.region[r].labels) map_.label(of_region[r], s);
  }
  for (const Circle& c : border.circle)
    for (const Interval& i : intervals(c))
      for (const Step* s : i.step)
        require(map_.in_same_region(map_.element_of(*s), map_.element_of(*i.step.front())),
                "face: exact algebra parts the border elsewhere");
  std::vector<std::uint32_t> node;
  for (const FaceMap::Node& n : map.node) {
    using Kind = FaceMap::Node::Kind;
    node.push_back(n.kind == Kind::kSide
                       ? box.side[static_cast<std::size_t>(n.side)].change[n.change].id
                   : n.kind == Kind::kConvexEdge ? map_.node_of({Step::Kind::kConvexEdge, n.edge})
                                                 : map_.new_node(n));
    map_.place(node.back(), of_piece[n.piece]);
  }
  for (const auto& [ends, r] : map.arc)
    map_.add_arc({{node[ends[0]], node[ends[1]]}, {of_region[r[0]], of_region[r[1]]}});
}

void FaceChecker::check_part(const Box& box, const Claim& claim) {
  const Border border = traces_.border(box);
  if (border.circle.empty() && !border.loop) return;
  const Part part{exclusion_, box_of(box.rect), box.rect.axis, claim.sites};
  require(std::ranges::includes(root_.candidates, part.sites),
          "face: a part names a site that is no candidate");
  const std::vector<Site> sites = may_govern(box, part.sites);
  const SharedFeet shared(exclusion_, part.sites, part.box);
  const Groups feet = groups_by_feet(exclusion_.sites(), part.sites, shared);
  bool rim = false;
  std::pair<Groups, bool> star;
  std::string reason;  // why the claim is not shown
  try {
    require(!border.loop, "face: a closed curve of ∂O inside a part");
    require(std::ranges::includes(part.sites, sites),
            "face: a site that may govern a part is missing");
    if (claim.type == Claim::Type::kStar || claim.type == Claim::Type::kChords)
      star = check_star(part, shared, border.circle, claim);
    else
      rim = check_about_vertex(part, shared, feet, border.circle, claim);
  } catch (const Failure& failure) {
    if (!claim.proposed) throw;
    reason = failure.what();
  }
  try {
    if (!reason.empty()) return record_exact(box, border, part.sites, sites);
  } catch (const Undecided& undecided) {
    throw Undecided("a part that only exact algebra or Theorem S decides: " + reason + "; " +
                    undecided.what());
  }
  for (const Circle& c : border.circle)
    record(c, part, feet, rim, star.second ? &star.first : nullptr);
}

void FaceChecker::check(const Box& box) {
  require(next_part_ < parts_.size(), "face: parts are missing");
  const PartNode& node = parts_[next_part_++];
  if (node.axis < 0) return check_part(box, node.claim);
  for (const Box& half : cut(box, node.axis == 0, node.cut)) check(half);
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
  low.side[last] = high.side[first] =
      map_.name(lines_.solve(side_of(low.rect, static_cast<int>(last)), starts_inside,
                             box.candidates, triangles_),
                -1);
  for (Box* half : {&low, &high})
    half->candidates = exclusion_.remaining(box.candidates, box_of(half->rect));
  return {std::move(low), std::move(high)};
}

FaceMap FaceChecker::run(const std::array<Line, 4>& sides) {
  for (std::size_t s = 0; s < 4; ++s) root_.side[s] = map_.name(sides[s], static_cast<int>(s));
  check(root_);
  require(next_part_ == parts_.size(), "face: too many parts");
  return map_.finish(root_);
}

}  // namespace

FaceMap check_face(const Exclusion& exclusion, const Algebra& algebra, const Rect& rect,
                   const std::array<Line, 4>& sides, std::span<const Site> candidates,
                   std::span<const std::uint32_t> triangles, std::span<const PartNode> parts) {
  return FaceChecker(exclusion, algebra, rect, candidates, triangles, parts).run(sides);
}

}  // namespace blum::verify
