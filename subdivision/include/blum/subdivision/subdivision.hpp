/// Subdivision of a box around a solid into leaf cells whose part of the medial axis, or of the
/// Voronoi diagram, is certified to be contractible component by component (theory section 3).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "blum/arrangement/diagram_engine.hpp"
#include "blum/kernel/distance_hint.hpp"
#include "blum/kernel/point.hpp"
#include "blum/kernel/result.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "blum/kernel/stage.hpp"
#include "blum/subdivision/cut_plane.hpp"

namespace blum {

/// kCgal: needs the helper of cgal_engine.hpp.
enum class Engine : std::uint8_t { kProduction, kBrute, kCgal };

/// When a cell of a Voronoi diagram is accepted (docs/proofs.md, "Voronoi mode").
enum class Criterion : std::uint8_t {
  kStrict,   ///< the thesis' homotopy and boundary cell criteria (sections 5.4.1, 5.4.2)
  kDisks,    ///< each region that shows on the surface is one disk there, none is hidden
  kRelaxed,  ///< the same, and what the flow towards the boundary proves beyond
};

/// The part of the box in which a Voronoi diagram is wanted: the closed solid, the closure of the
/// rest, or all of it.
enum class VoronoiSide : std::uint8_t { kBoth, kInside, kOutside };

struct Progress {
  std::size_t leaves = 0;      ///< accepted so far
  double volume_fraction = 0;  ///< of the box, accepted so far
};

struct SubdivisionOptions {
  std::uint64_t seed = 1;
  Engine engine = Engine::kProduction;
  bool cuts = true;  ///< try planes that miss the axis before a cell is subdivided (Theorem E)
  /// Cells may hold boundary vertices near which the axis falls apart, among other sites.
  bool split_vertices = true;
  /// Every face is decided with the candidates of its own cell, so that a certificate can decide it
  /// again: with more of them, events that are nearly one may be parted otherwise.
  bool own_faces = false;
  /// Cells with more candidates are divided untested, but for some that lost none for long; 0: no
  /// bound. The more a cell may have, the fewer leaves, and the coarser the geometry of the
  /// complex.
  std::size_t max_candidates = 96;
  /// Voronoi: accept cells that one region passes through (Theorem T of docs/proofs.md).
  bool tubes = true;
  Criterion criterion = Criterion::kRelaxed;  ///< Voronoi only
  double margin = 0.1;  ///< Voronoi: how much larger than the solid's the box is, as a fraction
  VoronoiSide side = VoronoiSide::kBoth;  ///< Voronoi
  bool resolve = false;                   ///< refine until no avoidable cluster node is left
  /// Leaves that meet the axis are refined until their diameter is at most this (model units);
  /// it bounds the Hausdorff distance between the complex and the axis. 0: no bound asked for.
  double max_leaf_diameter = 0;
  DistanceHint distance_hint;  ///< saves work; never changes the answer
  int max_depth = 128;         ///< bisections from the box to a leaf: 2^-43 of it
  /// Nodes of the tree of cells. Where it is reached with several threads, which cells are left
  /// undecided depends on their timing; nothing else of a result does, but for the two limits
  /// below.
  std::size_t max_cells = 20'000'000;
  double time_limit_s = 0;             ///< see compute_medial_axis; 0: none
  std::uint64_t max_memory_bytes = 0;  ///< resident, of the process; 0: no limit
  int threads = 1;                     ///< at least 1
  /// Called now and then, from any thread but never by two at once; returning false interrupts the
  /// run soon.
  std::function<bool(const Progress&)> on_progress;
};

enum class UndecidedReason : std::uint8_t {
  kDepth,          ///< max_depth reached
  kCells,          ///< max_cells reached
  kTime,           ///< time_limit_s reached
  kFaceUndecided,  ///< no cutting plane in general position was found
  kMemory,         ///< max_memory_bytes reached
};
[[nodiscard]] const char* undecided_reason_name(UndecidedReason reason);

/// Why a leaf was accepted.
enum class LeafTheorem : std::uint8_t {
  kOutside,   ///< the cell does not meet the solid; Voronoi: the side that is wanted
  kConical,   ///< Theorem B about `boundary_vertex`
  kBoundary,  ///< Theorem C; Theorem A where the cell lies in the solid
  kVoronoi,   ///< Theorem V, by the criterion that was asked for
  kUndecided,
};

/// A node of the binary tree of cells. Leaves have axis == -1.
struct CellNode {
  Box3 box;
  std::int8_t axis = -1;  ///< the children are split by x[axis] = cut
  double cut = 0;
  std::uint32_t child = 0;  ///< low child; the high one is child + 1
  std::uint32_t leaf = 0;   ///< index into Subdivision::leaf, for leaves
  std::uint16_t depth = 0;
};

struct Leaf {
  Box3 box;
  LeafTheorem theorem = LeafTheorem::kUndecided;
  UndecidedReason reason = UndecidedReason::kDepth;  ///< kUndecided
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t boundary_vertex = kNone;  ///< kConical
  bool has_axis = false;                  ///< the graph on its surface is not empty
  /// kBoundary: planes whose sections of the leaf miss the axis, which its acceptance relies on
  /// (Theorem E in docs/proofs.md). None where the graph alone was enough.
  std::vector<CutPlane> cut;
  /// Accepted by Theorem T: the region that passes through is that of the two pieces of the surface
  /// which have a label among these.
  std::vector<SiteId> tube;
  std::vector<SiteId> candidates;        ///< superset of the governors in leaf ∩ O
  std::vector<std::uint32_t> triangles;  ///< superset of the boundary triangles that meet it
  /// Diagrams of its faces (box_face), for kConical, kBoundary and kVoronoi.
  std::array<std::shared_ptr<const FaceDiagram>, 6> face;
};

struct SubdivisionStats {
  StageCounts stages;  ///< depends on the number of threads: each remembers what it has decided
  std::size_t cells_tested = 0, faces_computed = 0, planes_moved = 0;
  std::size_t planes_tried = 0, leaves_cut = 0;  ///< see Leaf::cut
  std::size_t tubes = 0;                         ///< leaves with Leaf::tube
  std::size_t site_pairs = 0;  ///< of a cell and a site looked at when its candidates were pruned
  int max_depth = 0;
  std::array<std::size_t, 11> rejected{};  ///< tested cells by CellVerdict
};

/// Nodes and leaves are numbered depth first, the low child before the high one.
struct Subdivision {
  VoronoiSide side = VoronoiSide::kBoth;  ///< that was asked for
  std::vector<CellNode> node;             ///< node[0] is the root
  std::vector<Leaf> leaf;
  SubdivisionStats stats;
  /// Voronoi: the diagrams of the root's faces, where decided.
  std::array<std::shared_ptr<const FaceDiagram>, 6> surface;
};

/// The box around the solid with which the subdivision begins, in the working frame: in general
/// position by random margins. Medial: 2 to 6 % of the largest extent on each side. Voronoi: the
/// bounding box times 1 + margin about its centre, grown by at most a tenth of the margin more.
[[nodiscard]] Box3 root_box(const SiteGeometry& geometry, const SubdivisionOptions& options);

class EngineSet;

/// The same for any number of threads, unless a budget is reached. `engines` must be made with the
/// same geometry and options. Error kInterrupted if on_progress returned false.
[[nodiscard]] Result<Subdivision> subdivide(const SiteGeometry& geometry,
                                            const SubdivisionOptions& options, EngineSet& engines);

}  // namespace blum
