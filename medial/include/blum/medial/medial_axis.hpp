/// From a solid to its certified homotopy-preserving medial axis, in one call.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "blum/kernel/result.hpp"
#include "blum/kernel/solid.hpp"
#include "blum/kernel/stage.hpp"
#include "blum/medial/complex.hpp"
#include "blum/medial/parts.hpp"
#include "blum/subdivision/subdivision.hpp"

namespace blum {

using MedialOptions = SubdivisionOptions;

struct UndecidedCell {
  Box3 box;  ///< model units
  UndecidedReason reason = UndecidedReason::kDepth;
  int depth = 0;  ///< bisections from the box around the solid
};

struct PhaseTimes {
  double subdivide_s = 0, assemble_s = 0;
};

struct MedialResult {
  bool certified = false;
  CellComplex complex;  ///< without what lies in undecided cells; empty where all of it does
  Parts parts;
  std::array<long, 3> betti{};  ///< of the complex; meaningful only if certified
  std::array<long, 3> solid_betti{};
  std::size_t leaves = 0;
  int max_depth = 0;
  std::vector<UndecidedCell> undecided;
  /// Two-sided Hausdorff distance between the complex and M, model units: largest leaf diameter.
  double hausdorff_bound = 0;
  StageCounts stages;  ///< depends on the number of threads, the complex does not
  PhaseTimes time;
  std::uint64_t seed = 0;
  int threads = 1;  ///< used
};

/// Takes one line of a certificate (docs/certificate.md), without its end; false stops the writing.
using CertificateSink = std::function<bool(const std::string&)>;

/// Errors: kInterrupted; kBadArgument. Running out of a budget is not an error: the result says
/// certified == false and lists what is undecided. The time limit
/// is that of the subdivision; a twentieth of it (at least half a second) is added for assembling
/// what has been decided. If that does not suffice, or memory is what ran out, the complex is empty
/// and all cells that meet the axis are listed. The certificate, where asked for, is written after the
/// limits have been looked at.
[[nodiscard]] Result<MedialResult> compute_medial_axis(const Solid& solid,
                                                       const MedialOptions& options,
                                                       const CertificateSink& certificate = {});

}  // namespace blum
