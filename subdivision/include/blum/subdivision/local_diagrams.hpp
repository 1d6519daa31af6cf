/// Diagrams in one neighbourhood, such as the faces of a cell: rectangles with a common edge get
/// the same diagram of it, which test_cell relies on.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "blum/arrangement/diagram_engine.hpp"

namespace blum {

/// What it answers is a function of the candidates, the triangles and what was adopted, whatever
/// has been asked before. The engine and the lists must outlive it.
class LocalDiagrams {
 public:
  /// Candidates, triangles: supersets as in FaceProblem, for all that will be asked.
  LocalDiagrams(DiagramEngine& engine, const Solid& solid, std::span<const SiteId> candidates,
                std::span<const std::uint32_t> triangles)
      : engine_(engine), solid_(solid), candidates_(candidates), triangles_(triangles) {}

  /// Takes a diagram over, with those of its sides. Requires: decided; nothing asked yet that it
  /// has an edge in common with.
  void adopt(std::shared_ptr<const FaceDiagram> face);

  /// Takes a diagram as FaceProblem::whole of the rectangles in it, by halves of halves. Requires:
  /// decided.
  void inherit(std::shared_ptr<const FaceDiagram> whole) { whole_.push_back(std::move(whole)); }

  [[nodiscard]] std::shared_ptr<const FaceDiagram> face(const Rect& rect);
  [[nodiscard]] SegmentAnswer segment(const Segment& segment);

  /// Faces that had not been adopted.
  [[nodiscard]] std::size_t faces_computed() const { return computed_; }

 private:
  [[nodiscard]] std::shared_ptr<const FaceDiagram> whole_of(const Rect& rect);

  DiagramEngine& engine_;
  const Solid& solid_;
  std::span<const SiteId> candidates_;
  std::span<const std::uint32_t> triangles_;
  // A cell has six faces and twelve edges: a search along the list is the quickest.
  std::vector<std::shared_ptr<const FaceDiagram>> face_;
  std::vector<std::shared_ptr<const SegmentDiagram>> segment_;
  std::vector<std::shared_ptr<const FaceDiagram>> whole_;
  std::size_t computed_ = 0;
};

}  // namespace blum
