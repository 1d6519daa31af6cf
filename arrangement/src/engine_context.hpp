/// What the segment and face subdivisions share: predicates, cached pair facts, jitter.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "blum/arrangement/part_record.hpp"
#include "blum/arrangement/production_engine.hpp"
#include "blum/arrangement/touching.hpp"
#include "blum/kernel/inside.hpp"
#include "blum/kernel/predicates.hpp"

namespace blum {

struct EngineContext {
  EngineContext(const SiteGeometry& g, const InsideOracle& i, std::uint64_t s)
      : geometry(g), inside(i), predicates(g), seed(s) {}

  const SiteGeometry& geometry;
  const InsideOracle& inside;
  Predicates predicates;
  std::uint64_t seed;
  EngineCounts counts;
  bool part_clusters = false;
  /// Decide without fans (fan.hpp), by conditions that hold at corners: for certificates.
  bool plain = false;
  bool slices_first = false;                 ///< ProductionEngine::prefer_slices
  bool links_first = false;                  ///< ProductionEngine::prefer_links
  std::vector<PartRecord>* parts = nullptr;  ///< where the face in work is written down, or null
  /// Set from outside to give up: running work then answers kUndecided soon.
  const std::atomic<bool>* stop = nullptr;
  [[nodiscard]] bool stopped() const {
    return stop != nullptr && stop->load(std::memory_order_relaxed);
  }
  /// May parts that bounds cannot decide go to brute_engine.hpp? Its test of what is inside walks
  /// the whole boundary for each part, which large solids cannot afford.
  [[nodiscard]] bool exact_affordable() const {
    constexpr std::size_t kMaxTriangles = 512;
    return geometry.solid().triangle.size() <= kMaxTriangles;
  }

  [[nodiscard]] bool voronoi() const { return geometry.kind() == DiagramKind::kVoronoi; }

  /// Do ties of two sites never count? Predicates::never_essential, remembered; in a Voronoi
  /// diagram all ties count. unit_difference, foot_cone, vertex_link, carrier_difference and
  /// (Voronoi) touch are remembered too.
  [[nodiscard]] bool never_essential(SiteId a, SiteId b);
  [[nodiscard]] const BallVector& unit_difference(SiteId a, SiteId b);
  /// Predicates::height of a point of the solid over a face, remembered.
  [[nodiscard]] const Ball& height(std::uint32_t point, SiteId face);
  [[nodiscard]] Predicates::FootCone foot_cone(std::uint32_t vertex);
  [[nodiscard]] const std::optional<Predicates::VertexLink>& vertex_link(std::uint32_t vertex);
  [[nodiscard]] const Touch& touch(SiteId a, SiteId b);
  [[nodiscard]] const Predicates::CarrierDifference& carrier_difference(SiteId a, SiteId b);

  /// Reproducible number in [0, 1) from the seed and the given keys.
  [[nodiscard]] double jitter(double a, double b, std::uint64_t c) const;
  /// A split coordinate near the middle of (lo, hi), in general position with probability 1.
  [[nodiscard]] double split(double lo, double hi, std::uint64_t attempt) const;

 private:
  std::unordered_map<std::uint64_t, bool> never_;
  std::unordered_map<std::uint64_t, BallVector> difference_;
  std::unordered_map<std::uint64_t, Ball> height_;
  std::unordered_map<std::uint32_t, Predicates::FootCone> foot_cone_;
  std::unordered_map<std::uint32_t, std::optional<Predicates::VertexLink>> vertex_link_;
  std::unordered_map<std::uint64_t, Touch> touch_;
  std::unordered_map<std::uint64_t, Predicates::CarrierDifference> carrier_difference_;
};

}  // namespace blum
