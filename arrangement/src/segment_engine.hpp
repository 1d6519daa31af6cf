/// Diagrams on axis-parallel segments.
#pragma once

#include <optional>
#include <vector>

#include "engine_context.hpp"
#include "groups.hpp"
#include "local_form.hpp"

namespace blum {

/// One end of a stretch of a segment inside the solid: a double, or the crossing of ∂O.
struct StretchEnd {
  double t = 0;  ///< for a crossing: a double within its enclosure
  std::uint32_t triangle = Breakpoint::kNone;
  SiteId label{};  ///< an exact governor there
};

/// Outcome of a computation that may find the input in bad position.
struct Trouble {
  FaceStatus status = FaceStatus::kDecided;
  const char* reason = "";
  explicit operator bool() const { return status != FaceStatus::kDecided; }
};

class SegmentEngine {
 public:
  explicit SegmentEngine(EngineContext& context) : context_(context) {}

  [[nodiscard]] Trouble solve(const Segment& segment, std::span<const SiteId> candidates,
                              std::span<const std::uint32_t> triangles, SegmentDiagram& out);

  /// Essential ties on the open stretch (a, b), in order, appended to out.
  [[nodiscard]] Trouble isolate(const Segment& line, const StretchEnd& a, const StretchEnd& b,
                                std::span<const SiteId> candidates, std::vector<Breakpoint>& out,
                                int depth = 0);

  /// An exact governor at a point of the solid; nullopt on an essential tie.
  [[nodiscard]] std::optional<SiteId> governor(const Point3& x, std::span<const SiteId> candidates);

 private:
  /// The governing group can change at most once (GroupChanges); appends the tie, if there is one.
  [[nodiscard]] bool change_at_most_once(const Segment& line, const StretchEnd& a,
                                         const StretchEnd& b, std::span<const LocalForm> forms,
                                         const Groups& groups, const Range& range,
                                         std::vector<Breakpoint>& out);
  [[nodiscard]] bool merge_at_most_once(const Segment& line, const StretchEnd& a,
                                        const StretchEnd& b, std::span<const LocalForm> forms,
                                        const Range& range, std::vector<Breakpoint>& out);
  /// Voronoi diagrams: nothing but two faces and the edge between their regions, at both of whose
  /// ends a face governs: two ties, however near to each other.
  [[nodiscard]] bool edge_between_ends(const StretchEnd& a, const StretchEnd& b,
                                       std::span<const LocalForm> forms,
                                       std::vector<Breakpoint>& out);
  [[nodiscard]] static Breakpoint tie_between(const StretchEnd& a, const StretchEnd& b);
  /// The same by exact algebra, for a stretch that bounds cannot decide; false if that cannot be.
  [[nodiscard]] bool isolate_exactly(const Segment& line, const StretchEnd& a, const StretchEnd& b,
                                     std::span<const LocalForm> forms,
                                     std::vector<Breakpoint>& out);

  EngineContext& context_;
  std::vector<SiteId> governors_;
  std::uint32_t steps_ = 0, exact_stretches_ = 0;
};

}  // namespace blum
