/// The production engine: diagrams on segments and rectangles by certified subdivision.
///
/// Method. A segment or rectangle is bisected until every part passes an interval version of
/// Theorem D (theory section 3): its candidates split into groups whose members never tie
/// essentially, and each group has a direction along which it only gains on all others. Then the
/// topology of the part is that of a star, read from its border; borders of rectangles are
/// segments, ends of segments are points, and at points the governor is decided exactly
/// (Predicates). No algebraic number is ever represented. A rim inside the solid, where no such
/// direction exists, is recognised by exact tests: the part is then a cone about a rational point.
///
/// General position is required and checked; see FaceStatus.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>

#include "blum/arrangement/diagram_engine.hpp"
#include "blum/arrangement/part_record.hpp"
#include "blum/kernel/distance_hint.hpp"
#include "blum/kernel/inside.hpp"
#include "blum/kernel/predicates.hpp"

namespace blum {

/// Counts of the work done, for benchmarks and tests.
struct EngineCounts {
  std::uint64_t segments = 0, faces = 0, boxes = 0, clusters = 0, rims = 0;
  std::uint64_t halves = 0;                            ///< faces by FaceProblem::whole
  std::uint64_t slices = 0;                            ///< parts by Theorem S (docs/proofs.md)
  std::uint64_t links = 0;                             ///< parts by the chains at a vertex
  std::uint64_t rivals = 0;                            ///< pairs told apart by "Rivals" there
  std::uint64_t exact_parts = 0, exact_stretches = 0;  ///< decided by exact algebra
};

/// Not thread-safe: one object a thread. Answers do not depend on what was asked before.
class ProductionEngine final : public DiagramEngine {
 public:
  /// part_clusters: go on subdividing where four or more groups meet, until a common point of all
  /// is found or the part is smaller than kSmallestCluster.
  ProductionEngine(const SiteGeometry& geometry, const InsideOracle& inside, std::uint64_t seed,
                   bool part_clusters = false);
  static constexpr double kSmallestCluster = 0x1p-24;  ///< working units
  ~ProductionEngine() override;
  ProductionEngine(ProductionEngine&&) noexcept;

  using DiagramEngine::face;
  [[nodiscard]] SegmentAnswer segment(const Segment& segment, std::span<const SiteId> candidates,
                                      std::span<const std::uint32_t> triangles) override;
  [[nodiscard]] FaceDiagram face(
      const FaceProblem& problem,
      const std::array<std::shared_ptr<const SegmentDiagram>, 4>& side) override;

  /// The same diagram, with the reasons for it in `parts`, which is empty before: all of them where
  /// it is decided.
  [[nodiscard]] FaceDiagram face(const FaceProblem& problem,
                                 const std::array<std::shared_ptr<const SegmentDiagram>, 4>& side,
                                 std::vector<PartRecord>& parts);

  /// Sites of `candidates` that may govern a point inside the solid in [lo, hi] (closed box).
  /// `hint`: gives an upper bound on the distance from a point to ∂O, or is empty; bounds only
  /// save work, however good or bad they are.
  [[nodiscard]] std::vector<SiteId> prune(std::span<const SiteId> candidates, const Point3& lo,
                                          const Point3& hi, const DistanceHint& hint = {}) const;

  /// Decides by exact algebra (brute_engine.hpp, on the node's own rectangle) which of the
  /// diagram's clusters are one event: these become exact, with all their governors. The others
  /// stay clusters: several events too close for interval arithmetic to part.
  void decide_clusters(const FaceProblem& problem, FaceDiagram& diagram) const;

  /// Candidates that may govern a point inside the solid in [lo, hi], in groups whose members never
  /// tie essentially; empty where some group is not such a clique.
  [[nodiscard]] std::vector<std::vector<SiteId>> tie_groups(std::span<const SiteId> candidates,
                                                            const Point3& lo, const Point3& hi);

  /// From now on, faces are decided without fans (docs/proofs.md) where that is possible: with more
  /// parts, for reasons that are easier to check.
  void prefer_plain_reasons();

  /// From now on, Theorem S is tried first wherever it may hold, and not only where all else failed
  /// for long: slower, for tests of it.
  void prefer_slices();

  /// From now on, the same for parts that see one vertex only, by its chains: for tests.
  void prefer_links();

  /// From now on, work in progress and to come answers kUndecided ("stopped") soon after *stop
  /// becomes true. The flag must outlive the engine; null: none.
  void stop_on(const std::atomic<bool>* stop);

  [[nodiscard]] Predicates& predicates();
  [[nodiscard]] const EngineCounts& counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace blum
