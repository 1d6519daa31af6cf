/// The diagram of half a rectangle from that of the whole, where counting tells how the cut parts
/// it (docs/proofs.md, "Halves").
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "face_engine.hpp"

namespace blum {

/// Where a rectangle lies in one that it is a half of.
struct Half {
  std::uint8_t cut = 0;              ///< its side that is not on the whole's border
  bool high = false;                 ///< the half of greater coordinates
  std::array<std::uint8_t, 2> ends;  ///< the sides that meet the cut, in the order along it
  double at = 0;                     ///< the cut's coordinate
  bool along_u = false;              ///< that coordinate is u

  /// Nullopt: it is no half.
  static std::optional<Half> of(const Rect& half, const Rect& whole);
};

/// All that is known of the half before anything is recorded. Nodes are numbered as in the whole,
/// and then by the ties of the cut; regions as in the whole.
class FaceEngine::HalfMap {
 public:
  HalfMap(FaceEngine& engine, const Box& root, const Half& half)
      : engine_(engine), whole_(*engine.problem_.whole), root_(root), half_(half) {}

  [[nodiscard]] bool find() {
    border_ = engine_.border_of(root_);
    if (!border_.loop.empty()) return false;
    for (const FacePiece& p : whole_.piece)
      if (p.boundary_circles != 1) return false;
    if (!find_regions_of_sides() || !find_nodes() || !walk_cut() || !place_nodes() ||
        !find_graph() || !find_circles() || !find_sides_of_arcs())
      return false;
    find_labels();
    find_governors();
    return std::ranges::all_of(arcs_, [this](Arc& a) { return name_sides(a); });
  }
  void record();

 private:
  static constexpr auto kNone = Breakpoint::kNone;

  struct Arc {
    std::uint32_t from, to;  ///< local nodes
    const FaceArc* of;       ///< that it is part of
    /// A run on each side, or kNone for the region that it shares with no run.
    std::array<std::uint32_t, 2> run{kNone, kNone};
    std::array<SiteId, 2> sites{};  ///< a governor on each side
  };
  /// A node that may stand for a tree through which the cut passes, and the regions around it.
  struct Tree {
    std::uint32_t node;
    std::vector<std::uint32_t> around;
  };
  struct Run {
    std::uint32_t region;
    std::vector<std::uint32_t> elements, traces;
  };

  /// Of side s of the whole, those on the half begin at this number.
  [[nodiscard]] std::size_t first_on(std::uint8_t s) const {
    const auto n = whole_.side[s]->breakpoint.size(), own = root_.side[s].brk.size();
    return half_.high && s != opposite() ? n - own : 0;
  }
  [[nodiscard]] std::uint8_t opposite() const {
    return static_cast<std::uint8_t>((half_.cut + 2) % 4);
  }
  [[nodiscard]] std::uint32_t region_of_trace(std::uint32_t triangle) const {
    for (const FaceTrace& t : whole_.trace)
      if (t.triangle == triangle) return t.region;
    return kNone;
  }
  [[nodiscard]] bool may_govern(SiteId s, std::uint32_t region) const {
    return std::ranges::binary_search(whole_.region[region].labels, s);
  }
  [[nodiscard]] bool in(std::uint32_t node) const { return where_[node] == Where::kIn; }
  /// Does the arc have one end in each half? False too if that is not known of its ends.
  [[nodiscard]] bool joins_halves(const FaceArc& a) const {
    return where_[a.from] != Where::kUnknown && where_[a.to] != Where::kUnknown &&
           where_[a.from] != where_[a.to];
  }
  /// Perhaps by an arc within the tree, of which the whole's diagram does not tell?
  [[nodiscard]] bool may_cross(const Tree& tree, std::uint32_t region, SiteId above) const;
  [[nodiscard]] std::optional<std::uint32_t> region_at_end(std::size_t k) const;
  /// The arc by which a way along the cut leaves the region for one that `above` may govern.
  [[nodiscard]] std::optional<std::uint32_t> arc_crossed(std::uint32_t region, SiteId above,
                                                         bool once_each) const;
  [[nodiscard]] bool find_regions_of_sides();
  [[nodiscard]] bool find_nodes();
  [[nodiscard]] bool walk_cut();
  [[nodiscard]] bool place_nodes();
  [[nodiscard]] bool find_graph();
  [[nodiscard]] bool find_circles();
  [[nodiscard]] bool find_sides_of_arcs();

  void find_labels();
  void find_governors();
  [[nodiscard]] bool name_sides(Arc& a);

  FaceEngine& engine_;
  const FaceDiagram& whole_;
  const Box& root_;
  const Half half_;
  Border border_;
  std::map<std::uint32_t, std::uint32_t> region_of_element_;
  std::map<std::uint32_t, SiteId> witness_;       // of elements on sides
  std::map<std::uint32_t, std::uint32_t> local_;  // engine's node -> local
  std::vector<std::uint32_t> id_;                 // local node -> engine's, kNone for inner ones
  enum class Where : std::uint8_t { kIn, kOut, kUnknown };
  std::vector<Where> where_;  // of the whole's nodes
  std::vector<Tree> tree_;
  std::vector<std::uint32_t> crossed_;  // arc of the whole -> local node on the cut
  std::vector<Arc> arcs_;
  UnionFind graph_;                                            // over local nodes
  std::vector<Run> runs_;                                      // of all circles
  std::vector<std::uint32_t> circle_;                          // first run of each circle
  std::map<std::uint32_t, std::array<std::uint32_t, 2>> end_;  // local node -> runs beside it
  std::vector<std::vector<SiteId>> labels_;                    // of the whole's regions
  UnionFind same_;                                             // over runs: parts of one region
  std::vector<std::vector<SiteId>> governors_;  // in each such part, by its first run
};

}  // namespace blum
