/// CGAL's arrangements behind the engine interface, for tests and small problems.
///
/// CGAL 5.5 aborts, crashes or runs for ever on some inputs, so it lives in a process of its own,
/// blum-cgal-engine, with limits on processor time and memory; this class talks to it and starts a
/// new one when it is gone. What goes wrong there is kUndecided with a reason, never an answer. No
/// header of CGAL is needed here.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "blum/arrangement/diagram_engine.hpp"

namespace blum {

/// What cuts the rectangle into cells; see docs/oracles.md for what each can do.
enum class CgalMethod : std::uint8_t {
  kAlgebraic,  ///< Arr_algebraic_segment_traits_2: for everything
  kEnvelope,   ///< Envelope_3 over partially defined quadratics: small coordinates
  kConic,      ///< Arr_conic_traits_2: has known faults
};
[[nodiscard]] const char* cgal_method_name(CgalMethod method);

/// Sanitizers reserve terabytes of addresses, in a helper built with one, too.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr std::uint64_t kCgalMemoryBytes = 0;
#else
inline constexpr std::uint64_t kCgalMemoryBytes = std::uint64_t{3} << 30;
#endif

struct CgalLimits {
  double wall_s = 20;                             ///< a request; then the helper is killed
  double cpu_s = 20;                              ///< a request
  std::uint64_t memory_bytes = kCgalMemoryBytes;  ///< address space of the helper; 0: no limit
  int requests = 400;                             ///< a helper's life: CGAL's caches grow
};

/// How often things went wrong, for tests.
struct CgalCounts {
  std::uint64_t requests = 0, started = 0, timeouts = 0, crashes = 0, malformed = 0;
};

/// The helper: $BLUM_CGAL_ENGINE, or blum-cgal-engine beside the running program. Empty if there is
/// none, as in builds without BLUM_CGAL_ORACLES.
[[nodiscard]] std::optional<std::filesystem::path> find_cgal_helper();

/// Not thread-safe: one object a thread; each has a process of its own. `solid` must outlive it.
class CgalEngine final : public DiagramEngine {
 public:
  CgalEngine(const Solid& solid, std::filesystem::path helper,
             CgalMethod method = CgalMethod::kAlgebraic, const CgalLimits& limits = {});
  ~CgalEngine() override;

  /// Answers kUndecided soon after *stop becomes true. Must outlive the engine; null: none.
  void stop_on(const std::atomic<bool>* stop);

  using DiagramEngine::face;
  [[nodiscard]] SegmentAnswer segment(const Segment& segment, std::span<const SiteId> candidates,
                                      std::span<const std::uint32_t> triangles) override;
  /// `side` is not looked at: the helper computes the sides again.
  [[nodiscard]] FaceDiagram face(
      const FaceProblem& problem,
      const std::array<std::shared_ptr<const SegmentDiagram>, 4>& side) override;

  [[nodiscard]] const CgalCounts& counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace blum
