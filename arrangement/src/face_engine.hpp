/// Diagrams on rectangles: recursive bisection until every part is a star (see
/// production_engine.hpp), then gluing by shared ids.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "blum/arrangement/face_diagram.hpp"
#include "blum/kernel/union_find.hpp"
#include "engine_context.hpp"
#include "groups.hpp"
#include "rivals.hpp"
#include "segment_engine.hpp"
#include "slope.hpp"

namespace blum {

class FaceEngine {
 public:
  FaceEngine(EngineContext& context, const FaceProblem& problem)
      : context_(context), problem_(problem), segments_(context) {}

  [[nodiscard]] FaceDiagram solve(const std::array<std::shared_ptr<const SegmentDiagram>, 4>& side);

 private:
  static constexpr std::size_t kMaxGroups = 24;  // more: bisecting is cheaper than all pairs

  /// A point of a side of a part: an essential tie (node) or a crossing of ∂O.
  struct Break {
    Breakpoint point;
    std::uint32_t id = 0;  ///< kTie: node; kBoundary: crossing
  };
  struct Piece1 {  // an interval of a segment; `element` is shared by all parts of it
    bool inside = false;
    SiteId witness{};
    std::uint32_t element = 0;
  };
  struct Line {
    Segment segment;
    std::vector<Break> brk;
    std::vector<Piece1> piece;
  };
  struct Box {
    double u0, u1, v0, v1;
    std::array<Line, 4> side;
    std::vector<SiteId> candidates;
    std::vector<std::uint32_t> triangles;  // whose traces meet the box
    int depth = 0;
    int stuck = 0;  // bisections since a candidate was lost
  };
  /// One step along the border of a component of box ∩ O.
  struct Step {
    enum class Kind : std::uint8_t { kInterval, kTie, kTrace, kConvexEdge } kind;
    std::uint32_t id = 0;   // element | node | triangle | boundary edge
    SiteId label{};         // kInterval, kTrace
    std::uint8_t side = 0;  // kInterval
  };
  using Circle = std::vector<Step>;
  struct Border {
    std::vector<Circle> circle;
    std::vector<std::uint32_t> loop;  // one triangle of each closed trace loop inside the box
  };
  struct Node {
    FaceNode node;
    std::vector<std::uint32_t> arc;
    std::uint32_t element = 0;  // of a region beside it, to find its piece
  };
  struct TracePoint {
    std::uint32_t edge;
    Ball u, v;
  };

  [[nodiscard]] Trouble refine(Box box);
  [[nodiscard]] bool accept(const Box& box, std::span<const LocalForm> forms, const Border& border);
  /// Theorem D' with the given groups.
  [[nodiscard]] bool accept_star(const Box& box, std::span<const LocalForm> forms,
                                 const Groups& groups, const Groups& feet, const Border& border,
                                 Rivals& rivals);
  /// Decides the part by exact algebra; false if that cannot be or takes too many candidates.
  [[nodiscard]] bool accept_exact(const Box& box, std::span<const LocalForm> forms,
                                  const Border& border);
  [[nodiscard]] std::uint32_t new_element();
  [[nodiscard]] std::uint32_t trace_element(std::uint32_t triangle);
  /// A cone about the point where a rim inside the solid crosses the plane.
  [[nodiscard]] bool accept_rim(const Box& box, std::span<const LocalForm> forms,
                                const Groups& feet, const Border& border);
  /// Theorem G: all sites meet in one vertex.
  [[nodiscard]] bool accept_cone(const Box& box, std::span<const LocalForm> forms,
                                 const Groups& feet, const Border& border);
  /// The vertex of Theorem G, where it holds.
  struct Apex {
    std::uint32_t vertex;
    bool is_foot;  ///< perhaps of a point of the part; false: certainly of none
  };
  [[nodiscard]] std::optional<Apex> apex_of(const Box& box, std::span<const LocalForm> forms,
                                            const Border& border);
  /// Theorem G, with the chains of triangles at the vertex and the axis' ends on its foot cone.
  [[nodiscard]] bool accept_link(const Apex& apex, const Box& box, std::span<const LocalForm> forms,
                                 const Groups& feet, const Circle& circle);
  /// The extreme rays of the foot cone of the vertex that pass through the part and on which a
  /// sheet of the axis ends. Nullopt: an extreme ray passes through the border.
  [[nodiscard]] std::optional<std::vector<Predicates::VertexLink::Ray>> ends_on_cone(
      const Apex& apex, const Box& box);
  /// What an interval of a circle shows.
  struct Shown {
    bool vertex = false;
    std::vector<std::uint32_t> chain;  ///< at the vertex
  };
  [[nodiscard]] std::vector<Shown> shown_on(const Circle& circle, const Apex& apex);
  /// Where in record() a tree ends inside: that of the end after interval `run`, which is of the
  /// region about its tip.
  struct Tip {
    std::uint32_t run;
    std::array<SiteId, 2> sites;  ///< that tie there
  };
  /// Of trees with several ends on the circle, each of which has one inside.
  [[nodiscard]] std::optional<std::vector<Tip>> tips_of(
      const Apex& apex, std::span<const Predicates::VertexLink::Ray> rays,
      std::span<const std::uint32_t> region, std::span<const Shown> shown);
  [[nodiscard]] Tip tip_of(const Predicates::VertexLink::Ray& ray, std::uint32_t run) const;
  /// Theorem S: all sites seen from a vertex.
  [[nodiscard]] bool accept_slice(const Box& box, std::span<const LocalForm> forms,
                                  const Groups& feet, const Border& border);
  /// Does Theorem S hold, seen from v? Then the regions of the intervals of each circle with more
  /// than three ends.
  [[nodiscard]] std::optional<std::vector<std::vector<std::uint32_t>>> slice_from(
      std::uint32_t v, const Box& box, std::span<const LocalForm> forms, const Groups& feet,
      const Border& border);
  [[nodiscard]] bool flow_parts_all(std::uint32_t v, const Box& box,
                                    std::span<const LocalForm> forms);
  /// The region of each interval of a circle, where Theorem S holds; nullopt: undecided.
  [[nodiscard]] std::optional<std::vector<std::uint32_t>> regions_in_slice(
      const Circle& circle, std::span<const LocalForm> forms, const Groups& feet, std::uint32_t v,
      const Box& box);
  /// Does the flow of the site, seen from its corner v, enter the part all along that side?
  [[nodiscard]] bool flows_in(SiteId site, std::uint32_t v, std::uint8_t side,
                              const Box& box) const;
  [[nodiscard]] static std::uint32_t ends_of(const Circle& circle);
  /// Voronoi: all regions are convex in the part, and all show on its border.
  [[nodiscard]] bool accept_convex(const Box& box, std::span<const LocalForm> forms,
                                   const Groups& sites, const Border& border);
  [[nodiscard]] bool ties_are_straight(std::span<const LocalForm> forms, const Range& range);
  /// Do all points of the range project into the face, or beyond the edge it shares with `other`?
  [[nodiscard]] bool reaches(SiteId face, SiteId other, const Range& range) const;
  [[nodiscard]] bool edge_and_its_faces(std::span<const LocalForm> forms, const Range& range) const;
  /// Records a part whose regions are connected and all show on the border, perhaps several times:
  /// then the graph is a forest. False, and nothing recorded, if the border contradicts that.
  [[nodiscard]] bool record_forest(const Circle& circle, std::span<const LocalForm> forms,
                                   const Groups& sites, const Box& box);
  /// Voronoi, Theorem G': all sites meet in one vertex.
  [[nodiscard]] bool accept_vertex_link(const Box& box, std::span<const LocalForm> forms,
                                        const Groups& sites, const Border& border);
  /// Does the region of every site show at most once on the border of the part?
  [[nodiscard]] static bool each_shows_once(const Border& border);
  [[nodiscard]] Trouble find_corners_in_plane() const;
  [[nodiscard]] static bool wholly_inside(const Border& border);
  /// May four or more ends meet in one node? Always, unless clusters are to be parted.
  [[nodiscard]] bool may_be_cluster(const Box& box, std::span<const LocalForm> forms,
                                    const Groups& groups, const Circle& circle);
  /// Groups of the intervals between separators, from just behind the last separator of the
  /// circle; nullopt if they do not lie between groups.
  [[nodiscard]] static std::optional<std::vector<std::uint32_t>> runs_of(
      const Circle& circle, std::span<const LocalForm> forms, const Groups& groups);
  /// Do all groups that show on the circle tie at one point of the box, to kCommonTolerance?
  [[nodiscard]] bool meet_in_one_point(const Box& box, std::span<const LocalForm> forms,
                                       const Groups& groups, const Circle& circle);
  /// One for each group; none for a group that ties with no other.
  using Directions = std::vector<std::optional<Direction>>;
  [[nodiscard]] bool directions_exist(std::span<const LocalForm> forms, const Groups& groups,
                                      Rivals& rivals, Directions& found);
  /// Site i is to gain on site j.
  struct GainPair {
    std::uint32_t i, j;
    PairSlope slope;
  };
  /// Do all pairs gain along the direction?
  [[nodiscard]] bool gain_along(std::span<const GainPair> pairs, std::span<const LocalForm> forms,
                                const Range& range, const Direction& direction);
  /// The intervals between the separators of a circle: run[k] follows end[k].
  struct Sequence {
    struct End {
      std::uint32_t node;
      SiteId below, above;
    };
    struct Run {
      std::uint32_t element;
      SiteId label;
    };
    std::vector<End> end;
    std::vector<Run> run;
  };
  [[nodiscard]] static bool separates(const Step& s) {
    return s.kind == Step::Kind::kTie || s.kind == Step::Kind::kConvexEdge;
  }
  /// Along a circle, from just behind a separator if it has one: at_separator(step), and
  /// at_label(step, fresh) for the others, fresh at the first of an interval.
  template <class AtSeparator, class AtLabel>
  static void walk(const Circle& circle, AtSeparator at_separator, AtLabel at_label) {
    const std::size_t n = circle.size();
    std::size_t start = 0;
    for (std::size_t i = 0; i < n; ++i)
      if (separates(circle[i])) start = i;
    bool fresh = true;
    for (std::size_t k = 0; k < n; ++k) {
      const Step& s = circle[(start + k) % n];
      if (separates(s))
        at_separator(s);
      else
        at_label(s, fresh);
      fresh = separates(s);
    }
  }
  /// Labels the regions along a circle, and makes them one component.
  [[nodiscard]] Sequence label_circle(const Circle& circle, std::span<const LocalForm> forms,
                                      const Groups& feet);
  /// Theorem D', chords: no three groups tie pairwise. `runs`: of each circle, by runs_of.
  [[nodiscard]] bool accept_chords(const Box& box, const Border& border,
                                   std::span<const std::vector<std::uint32_t>> runs,
                                   std::span<const LocalForm> forms, const Groups& groups,
                                   const Groups& feet, Rivals& rivals);
  /// Voronoi diagrams, Theorem D‴: within the strip of an edge, however thin it is, towards a point
  /// of it next to its tip or, if the edge is parallel to the plane, far away.
  [[nodiscard]] std::optional<Direction> along_strip(std::span<const GainPair> pairs,
                                                     std::span<const LocalForm> forms,
                                                     const Range& range) const;
  [[nodiscard]] std::optional<Direction> direction(std::span<const GainPair> pairs,
                                                   std::span<const LocalForm> forms,
                                                   const Range& range);
  [[nodiscard]] PlaneDirection in_plane(const Direction& d) const;
  /// Writes the part down, where that is asked for.
  void note(PartRecord::Kind kind, std::span<const LocalForm> forms, std::uint32_t vertex = 0,
            std::array<std::uint32_t, 2> edge = {});
  void note(PartRecord::Kind kind, std::span<const LocalForm> forms, const Groups& groups,
            const Directions& directions);
  /// A forest with a separator at each end parts the inside of a circle into regions: the ends of
  /// each tree, from the regions of the intervals; interval k follows end k.
  using Trees = std::map<std::uint32_t, std::vector<std::uint32_t>>;
  [[nodiscard]] static Trees trees_of(std::span<const std::uint32_t> region);
  /// Records the graph of a component: a forest whose ends are the separators of its circle.
  /// `region` numbers the region of each interval, in the order of runs_of; empty: all different,
  /// so the forest is one tree.
  enum class Rims : std::uint8_t {
    kNone,
    kCone,  ///< one tree, a cone about one more end inside
    kTips,  ///< each tree has one more end inside: with several, that of `tips`
  };
  void record(const Circle& circle, std::span<const LocalForm> forms, const Groups& feet,
              const Box& box, std::span<const std::uint32_t> region = {}, Rims rims = Rims::kNone,
              std::span<const Tip> tips = {});
  [[nodiscard]] Trouble split(Box& box, Box& low, Box& high);
  [[nodiscard]] Trouble cut(const Line& line, double m, const Box& box, Line& low, Line& high,
                            bool& inside, SiteId& label);
  [[nodiscard]] Border border_of(const Box& box);
  [[nodiscard]] bool in_box(const TracePoint& p, const Box& box);
  [[nodiscard]] Line make_line(const SegmentDiagram& diagram);
  [[nodiscard]] Range range_of(const Box& box) const;
  std::uint32_t new_node(FaceNode::Kind kind, const Box& box);
  std::uint32_t convex_node(std::uint32_t edge);
  /// beside: an element of the region on each side.
  void add_arc(std::uint32_t from, std::uint32_t to, SiteId left, SiteId right,
               std::array<std::uint32_t, 2> beside);
  void label_element(std::uint32_t element, std::span<const SiteId> labels);
  [[nodiscard]] Trouble find_traces(Box& root);
  [[nodiscard]] FaceDiagram assemble(const Box& root);
  class HalfMap;
  /// Records the diagram as half of problem_.whole; false, and nothing recorded: that tells too
  /// little.
  [[nodiscard]] bool take_half(const Box& root);

  EngineContext& context_;
  const FaceProblem& problem_;
  SegmentEngine segments_;
  int u_ = 0, v_ = 0;

  UnionFind region_, component_;                    // over elements
  std::vector<std::vector<SiteId>> element_label_;  // per element
  std::vector<Node> nodes_;
  std::vector<FaceArc> arcs_;
  std::vector<TracePoint> trace_point_;
  std::map<std::uint32_t, std::array<std::uint32_t, 2>> trace_;  // triangle -> its trace points
  std::map<std::uint32_t, std::uint32_t> trace_element_;         // triangle -> element
  std::map<std::uint32_t, std::uint32_t> convex_node_;           // boundary edge -> node
  std::uint32_t crossings_ = 0;
  std::uint32_t boxes_ = 0, exact_parts_ = 0;
};

}  // namespace blum
