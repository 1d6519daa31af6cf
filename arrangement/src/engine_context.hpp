/// What the segment and face subdivisions share: predicates, cached pair facts, jitter.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "blum/arrangement/production_engine.hpp"
#include "blum/kernel/inside.hpp"
#include "blum/kernel/predicates.hpp"
#include "local_form.hpp"

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

  /// Predicates::never_essential and unit_difference, remembered.
  [[nodiscard]] bool never_essential(SiteId a, SiteId b);
  [[nodiscard]] const BallVector& unit_difference(SiteId a, SiteId b);

  /// Reproducible number in [0, 1) from the seed and the given keys.
  [[nodiscard]] double jitter(double a, double b, std::uint64_t c) const;
  /// A split coordinate near the middle of (lo, hi), in general position with probability 1.
  [[nodiscard]] double split(double lo, double hi, std::uint64_t attempt) const;

 private:
  std::unordered_map<std::uint64_t, bool> never_;
  std::unordered_map<std::uint64_t, BallVector> difference_;
};

/// A partition of candidates into groups: connected components of "never tie essentially".
struct Groups {
  std::vector<std::uint32_t> of;  ///< group of each form
  std::uint32_t count = 0;
  bool cliques = true;  ///< within each group no pair can tie essentially
  [[nodiscard]] static Groups make(EngineContext& context, std::span<const LocalForm> forms);
  /// Group of a site; count if it is not among the forms.
  [[nodiscard]] std::uint32_t find(std::span<const LocalForm> forms, SiteId s) const;
};

/// Enclosure of the derivative of d_a - d_b, up to a positive factor, valid wherever in the range a
/// and b tie; `spread` bounds how much direction . (x - center) part varies.
struct PairSlope {
  BallVector gradient;    ///< at the centre
  bool constant = false;  ///< two faces: the same everywhere
};
[[nodiscard]] PairSlope pair_slope(EngineContext& context, const LocalForm& a, const LocalForm& b);

/// Upper bound of slope . w over the range, w a vector of doubles.
[[nodiscard]] double slope_upper(const PairSlope& slope, const LocalForm& a, const LocalForm& b,
                                 const Range& range, const std::array<double, 3>& w);

/// May a and b tie somewhere in the range? False only if certain.
[[nodiscard]] bool may_tie(EngineContext& context, const LocalForm& a, const LocalForm& b,
                           const Range& range);

}  // namespace blum
