/// The two simplified medial axes of an angle theta.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "blum/medial/medial_axis.hpp"
#include "blum/medial/subcomplex.hpp"

namespace blum {

enum class Simplify : std::uint8_t {
  kHomotopy,  ///< θ-HMA: what the filtration leaves; homotopy equivalent to the axis
  kSubset,    ///< θ-SMA: every part with an angle of theta or more; may be torn
};

/// A medial axis with what was left out: complex, parts (numbered as before), angles, values of the
/// filtration. Its Betti numbers are those of the part. Requires angles in the result. `certified`
/// stays, and for kSubset says that the complex it was taken from was certified.
[[nodiscard]] MedialResult simplified(const MedialResult& result, double theta_deg, Simplify how);

struct ThetaRow {
  double theta_deg = 0;
  Simplify how = Simplify::kHomotopy;
  ShapeCounts shape;
  std::array<long, 3> betti{};
};

/// One row for each angle and way, in the order of the angles. Requires angles in the result.
[[nodiscard]] std::vector<ThetaRow> theta_table(const MedialResult& result,
                                                std::span<const double> theta_deg);
[[nodiscard]] std::string theta_table_text(std::span<const ThetaRow> rows);
/// "theta_deg,method,sheets,seams,curves,junctions,area,b0,b1,b2" and a line for each row.
[[nodiscard]] std::string theta_table_csv(std::span<const ThetaRow> rows);

}  // namespace blum
