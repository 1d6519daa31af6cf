/// From a solid to its certified homotopy-preserving medial axis or Voronoi diagram, in one call.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "blum/kernel/result.hpp"
#include "blum/kernel/solid.hpp"
#include "blum/kernel/stage.hpp"
#include "blum/medial/angles.hpp"
#include "blum/medial/complex.hpp"
#include "blum/medial/parts.hpp"
#include "blum/medial/review.hpp"
#include "blum/subdivision/subdivision.hpp"

namespace blum {

using MedialOptions = SubdivisionOptions;

struct UndecidedCell {
  Box3 box;  ///< model units
  UndecidedReason reason = UndecidedReason::kDepth;
  int depth = 0;  ///< bisections from the box around the solid
};

struct PhaseTimes {
  double subdivide_s = 0, assemble_s = 0, angles_s = 0;
};

/// The check of a Voronoi diagram VD in its box B (docs/proofs.md, "Euler's formula in the box" and
/// "One side"), with χ the Euler characteristic of the solid:
///   both sides:  euler = 1 + regions - pieces_euler
///   inside:      euler = χ + regions_inside
///   outside:     euler = 1 + χ + regions_outside - pieces_euler
/// The numbers are computed independently. Inside, the Betti numbers are also those of the solid,
/// with regions_inside added to the last.
struct VoronoiCheck {
  VoronoiSide side = VoronoiSide::kBoth;
  long solid_euler = 0;
  /// Regions of edges and vertices, each wholly on one side; those of triangles are on both.
  std::size_t regions_inside = 0, regions_outside = 0;
  std::size_t regions = 0;  ///< sites: each has one region in the box
  long pieces_euler = 0;  ///< sum of the Euler characteristics of the regions' pieces on its sides
  long euler = 0;         ///< of the complex
  bool decided = false;   ///< the diagrams on the sides of the box are
  [[nodiscard]] bool holds() const { return decided && euler == expected(); }
  [[nodiscard]] long expected() const {
    switch (side) {
      case VoronoiSide::kInside:
        return solid_euler + static_cast<long>(regions_inside);
      case VoronoiSide::kOutside:
        return 1 + solid_euler + static_cast<long>(regions_outside) - pieces_euler;
      case VoronoiSide::kBoth:
        break;
    }
    return 1 + static_cast<long>(regions) - pieces_euler;
  }
};

struct MedialResult {
  DiagramKind kind = DiagramKind::kMedial;
  bool certified = false;
  /// With a certificate: every diagram is in it with its reasons. (It takes as long to write as the
  /// subdivision; past the time limit a part is missing, and a referee refuses it.)
  bool certificate_whole = true;
  bool smoothed = false;  ///< positions are for display: of the complex alone is it certified
  CellComplex complex;    ///< without what lies in undecided cells; empty where all of it does
  Parts parts;
  std::optional<PartAngles> angles;  ///< if wanted; the filtration by them too
  std::optional<Filtration> filtration;
  std::array<long, 3> betti{};  ///< of the complex; meaningful only if certified
  std::array<long, 3> solid_betti{};
  std::optional<VoronoiCheck> voronoi;        ///< if the Voronoi diagram was asked for
  Criterion criterion = Criterion::kRelaxed;  ///< Voronoi
  double margin = 0;                          ///< Voronoi
  std::size_t leaves = 0;
  /// Of them accepted thanks to planes (Theorem E); planes tried for them and for others.
  std::size_t leaves_cut = 0, planes_tried = 0;
  std::size_t tubes = 0;       ///< of them accepted by Theorem T; Voronoi
  std::size_t site_pairs = 0;  ///< of a cell and a site that were looked at: what hints save
  int max_depth = 0;
  std::vector<UndecidedCell> undecided;
  /// Two-sided Hausdorff distance between the complex and M, model units: largest leaf diameter,
  /// or what a review found.
  double hausdorff_bound = 0;  ///< infinite unless certified
  StageCounts stages;          ///< depends on the number of threads, the complex does not
  PhaseTimes time;
  std::uint64_t seed = 0;
  int threads = 1;  ///< used
};

/// Takes one line of a certificate (docs/certificate.md), without its end; false stops the writing.
using CertificateSink = std::function<bool(const std::string&)>;

/// The review, where asked for, moves the points of the complex, bounds its distance from the axis
/// and has leaves divided that are too coarse (review.hpp).
///
/// Errors: kInterrupted; kBadArgument. Running out of a budget is not an error: the result says
/// certified == false and lists what is undecided. The time limit
/// is that of the subdivision; a twentieth of it (at least half a second) is added for assembling
/// what has been decided. If that does not suffice, or memory is what ran out, the complex is empty
/// and all cells that meet the axis are listed. The certificate, where asked for, is written
/// after the limits have been looked at; a run with one uses no cutting planes (Theorem E) and
/// prefers reasons that are easy to check, so that it may take longer and give more leaves. Where
/// the time ends while angles are bounded, these stay wider.
[[nodiscard]] Result<MedialResult> compute_medial_axis(const Solid& solid,
                                                       const MedialOptions& options,
                                                       const AngleOptions& angles = {},
                                                       const CertificateSink& certificate = {},
                                                       const AxisReview& review = {});

/// The same for the Voronoi diagram of all sites that are not degenerate, in a box around the solid
/// (root_box), or the part of it in the closed solid or in the closure of the rest (options.side;
/// the two have the edges of the triangulation in common). Certified only if VoronoiCheck holds
/// too. `on_axis` and `hausdorff_bound` are about the Voronoi diagram in the box. Requires
/// options.margin > 0 and an engine that knows them, production or brute (kBadArgument).
[[nodiscard]] Result<MedialResult> compute_voronoi_diagram(const Solid& solid,
                                                           const MedialOptions& options);

}  // namespace blum
