/// The work on one cell. What becomes of a cell is a function of the cell alone, so that it does
/// not matter which thread works on it, nor when.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <variant>
#include <vector>

#include "blum/kernel/site_geometry.hpp"
#include "blum/subdivision/cell_test.hpp"
#include "blum/subdivision/engine_set.hpp"
#include "blum/subdivision/local_diagrams.hpp"
#include "blum/subdivision/subdivision.hpp"

namespace blum {

struct Cell {
  std::uint32_t node = 0;
  Box3 box;
  int depth = 0;
  int stuck = 0;  ///< bisections since a candidate was lost
  /// Of the leaves in it that meet the axis, working units.
  double largest_diameter = std::numeric_limits<double>::infinity();
  /// Accepted and with axis, but to be divided: it need not be tested again.
  bool to_divide = false;
  std::vector<SiteId> candidates;
  std::vector<std::uint32_t> triangles;
  /// Decided diagrams of faces that the cell has from its parent: of the plane that cut the parent,
  /// and of the parent's own face opposite. Others are null.
  std::array<std::shared_ptr<const FaceDiagram>, 6> face;
  /// Decided diagrams of the parent's faces that its plane cut, by the face of the cell that is a
  /// half. Others are null.
  std::array<std::shared_ptr<const FaceDiagram>, 6> whole;
};

struct Split {
  int axis = 0;
  double cut = 0;
  Cell low, high;  ///< their `node` is not set
};

using CellOutcome = std::variant<Leaf, Split>;

/// What the workers of one run have in common.
struct CellWork {
  const SiteGeometry& geometry;
  const SubdivisionOptions& options;
  EngineSet& engines;
  double root_diameter = 1;

  std::atomic<std::size_t> nodes{1};  ///< of the tree, those of splits in work included
};

/// One a thread.
class CellWorker {
 public:
  CellWorker(CellWork& work, int thread)
      : work_(work),
        geometry_(work.geometry),
        solid_(work.geometry.solid()),
        options_(work.options),
        medial_(work.geometry.kind() == DiagramKind::kMedial),
        one_sided_(!medial_ && work.options.side != VoronoiSide::kBoth),
        production_(work.engines.production(thread)),
        diagrams_(work.engines.diagrams(thread)) {}

  /// Takes the lists and the diagrams out of the cell. Worthless if the run was stopped meanwhile.
  [[nodiscard]] CellOutcome work(Cell& cell);

  [[nodiscard]] const SubdivisionStats& stats() const { return stats_; }

 private:
  using Faces = std::array<std::shared_ptr<const FaceDiagram>, 6>;

  /// What the engines are told of the boundary: in a Voronoi diagram it is no border.
  [[nodiscard]] std::span<const std::uint32_t> border(const Cell& cell) const {
    return medial_ ? std::span<const std::uint32_t>(cell.triangles)
                   : std::span<const std::uint32_t>();
  }
  [[nodiscard]] bool is_beyond(const Cell& cell) const;
  [[nodiscard]] CellVerdict test(Cell& cell, LocalDiagrams& diagrams, Leaf& leaf);
  [[nodiscard]] LocalDiagrams diagrams_of(const Cell& cell);
  void take_halves(Cell& cell);
  [[nodiscard]] bool fine_enough(const Cell& cell) const;
  [[nodiscard]] CellOutcome divide(Cell& cell, bool tested);
  [[nodiscard]] std::optional<Split> split(Cell& cell, bool validate);
  [[nodiscard]] const Predicates::AxisAtVertex* axis_at(std::uint32_t vertex);
  [[nodiscard]] bool one_junction(const Cell& cell, const Faces& face);

  CellWork& work_;
  const SiteGeometry& geometry_;
  const Solid& solid_;
  const SubdivisionOptions& options_;
  const bool medial_, one_sided_;
  ProductionEngine& production_;
  DiagramEngine& diagrams_;
  SubdivisionStats stats_;
  std::unordered_map<std::uint32_t, std::optional<Predicates::AxisAtVertex>> axis_at_;
};

}  // namespace blum
