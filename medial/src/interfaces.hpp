/// The rectangles that leaves share, what their diagrams are, and the ties on their sides.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "blum/kernel/site_geometry.hpp"
#include "blum/subdivision/engine_set.hpp"
#include "blum/subdivision/local_diagrams.hpp"
#include "blum/subdivision/sided_face.hpp"
#include "blum/subdivision/subdivision.hpp"
#include "locate.hpp"

namespace blum {

/// What is assembled, and with what: all leaves of a subdivision, or one alone, its whole surface.
struct AssemblyInput {
  const SiteGeometry& geometry;
  const Subdivision& subdivision;
  EngineSet& engines;
  bool alone = false;  ///< the tree is one leaf
  int first_thread = 0, threads = 1;

  [[nodiscard]] const Solid& solid() const { return geometry.solid(); }
  [[nodiscard]] const Leaf& leaf(std::uint32_t l) const { return subdivision.leaf[l]; }
  [[nodiscard]] bool medial() const { return geometry.kind() == DiagramKind::kMedial; }
  [[nodiscard]] bool one_sided() const { return subdivision.side != VoronoiSide::kBoth; }
  [[nodiscard]] bool inside_wanted() const { return subdivision.side == VoronoiSide::kInside; }
  [[nodiscard]] bool stopped() const { return engines.watch().flag(); }
  [[nodiscard]] Locator locator(int thread = 0) const {
    return {geometry, engines.production(first_thread + thread), engines.inside()};
  }
};

[[nodiscard]] bool is_accepted(const Leaf& leaf);

/// The common rectangle of two neighbouring leaves; or, Voronoi, a leaf's face on the box around
/// all, with kNone beyond.
struct Interface {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t low, high;  ///< leaves
  Rect rect;
  std::shared_ptr<const FaceDiagram> diagram{};  ///< null: the run was stopped before
  std::vector<Placed> placed{};                  ///< the diagram's nodes, but those on its sides
  SidedFace sides{};                             ///< of one-sided diagrams
  std::vector<Placed> crossing{};                ///< their crossings
  bool told = true;                              ///< what lies on which side

  [[nodiscard]] bool decided() const {
    return told && diagram && diagram->status == FaceStatus::kDecided;
  }
  template <class Visit>
  void for_each_leaf(Visit visit) const {
    for (const auto leaf : {low, high})
      if (leaf != kNone) visit(leaf);
  }
};

class Interfaces {
 public:
  using LineKey = std::tuple<int, double, double>;
  using PartKey = std::tuple<LineKey, double>;  ///< a part, by its lower end

  explicit Interfaces(const AssemblyInput& input) : in_(input) {}

  /// Ends early when the run is stopped; then there is nothing to be read.
  void solve();

  [[nodiscard]] const std::vector<Interface>& all() const { return interface_; }
  /// Leaves with an undecided interface.
  [[nodiscard]] const std::vector<bool>& dropped() const { return dropped_; }
  /// The leaf whose candidates serve on the interface.
  [[nodiscard]] const Leaf& donor(const Interface& i) const;

  [[nodiscard]] static PartKey key_of(const Segment& part) {
    return {{part.axis, part.u, part.v}, part.t0};
  }
  /// visit(side, part) for the parts of the four sides, in order along each: no end of an
  /// interface's side is inside a part.
  template <class Visit>
  void for_each_part(const Interface& interface, Visit visit) const;
  /// A number for each part, from 0.
  [[nodiscard]] std::uint32_t number_of(const Segment& part) const {
    return tie_of_.at(key_of(part));
  }
  [[nodiscard]] std::size_t parts() const { return tie_.size(); }
  /// The ties on the part of this number, in order.
  [[nodiscard]] std::span<const Placed> ties(std::size_t part) const { return tie_[part].placed; }

 private:
  struct EdgeTies {
    Segment part;
    const Interface* asker;  // the first interface beside it
    bool decided;
    std::vector<Placed> placed;
  };

  // The steps.
  void pair_cells();
  void solve_diagrams();
  void cut_lines();
  void solve_ties();

  void border_faces(std::uint32_t node, int face);
  void pair_faces(std::uint32_t low, std::uint32_t high, const Rect& rect);
  void solve_diagram(Interface& interface, int thread);
  void tell_sides(Interface& interface, int thread);
  void solve_ties_on(EdgeTies& ties, int thread);
  void drop(const Interface& interface);
  [[nodiscard]] LocalDiagrams diagrams_in(const Leaf& leaf, int thread) const;

  const AssemblyInput& in_;
  std::vector<Interface> interface_;
  std::map<LineKey, std::vector<double>> line_;  // breakpoints of minimal interface edges
  std::map<PartKey, std::uint32_t> tie_of_;
  std::vector<EdgeTies> tie_;
  std::vector<bool> dropped_;
};

template <class Visit>
void Interfaces::for_each_part(const Interface& interface, Visit visit) const {
  for (int s = 0; s < 4; ++s) {
    const Segment e = side_segment(interface.rect, s);
    const auto& points = line_.at({e.axis, e.u, e.v});
    for (auto it = std::lower_bound(points.begin(), points.end(), e.t0); *it != e.t1; ++it)
      visit(s, Segment{e.axis, e.u, e.v, *it, *std::next(it)});
  }
}

}  // namespace blum
