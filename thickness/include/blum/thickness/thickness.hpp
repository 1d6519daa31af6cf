/// Wall thickness at samples of a solid's faces, from its medial axis.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "blum/kernel/point.hpp"
#include "blum/kernel/result.hpp"
#include "blum/kernel/solid.hpp"
#include "blum/medial/medial_axis.hpp"

namespace blum {

struct ThicknessOptions {
  double density = 0;  ///< samples per squared model unit
  double theta_deg = 60;
  std::uint64_t seed = 1;
  int threads = 1;
};

/// Model units. The diameter of the largest ball inside the solid that touches at the sample is
/// within `error` of `thickness`, certified.
struct ThicknessSample {
  Point3 position;
  std::uint32_t triangle = 0;  ///< of the solid
  double area = 0;             ///< that it stands for
  double thickness = 0, error = 0;
  Point3 opposite;          ///< where the ball also touches
  double angle_deg = 0;     ///< between the two feet, seen from the ball's centre
  std::int32_t sheet = -1;  ///< of the medial axis, with the centre; -1: inside a leaf, not told
  /// The sheet's angle is theta or more. Where its interval has theta inside, and where there is no
  /// sheet, angle_deg decides.
  bool counts = false;
};

/// One sample in each of k^2 equal parts of each triangle, k as the density asks, 1 at least.
struct Thickness {
  std::vector<ThicknessSample> sample;
  /// The parts, as a surface: three corners for each sample.
  std::vector<Point3> point;
  std::vector<std::array<std::uint32_t, 3>> part;
  std::size_t unknown_sheets = 0;  ///< samples with sheet == -1
  double largest_error = 0;
};

/// Requires angles in the result. Equal inputs give equal samples, on any number of threads.
/// Errors: kBadArgument if the density is not positive or asks for more than 10 million samples.
[[nodiscard]] Result<Thickness> measure_thickness(const Solid& solid, const MedialResult& axis,
                                                  const ThicknessOptions& options);

/// Index of the sample with the least thickness among those that count; none if none does.
[[nodiscard]] std::optional<std::size_t> thinnest(const Thickness& thickness);

/// Equal bins from 0 to the largest thickness among samples that count.
struct ThicknessHistogram {
  double bin_width = 0;
  std::vector<double> area;  ///< of the samples in each bin
};
[[nodiscard]] ThicknessHistogram histogram(const Thickness& thickness, std::size_t bins);
/// "from,to,area,fraction", a line for each bin.
[[nodiscard]] std::string histogram_csv(const ThicknessHistogram& histogram);

/// PREFIX.vtp: the parts as VTK XML PolyData with CellData thickness, error, contact_angle, sheet,
/// counts, face (thickness is NaN where the sample does not count; thickness_any is the value all the
/// same). PREFIX.ply: the samples, binary, as vertices with x, y, z, thickness, error, angle,
/// sheet, counts. Error: kOutputNotWritten.
[[nodiscard]] std::optional<Error> write_thickness(const Thickness& thickness,
                                                   const std::filesystem::path& prefix);

}  // namespace blum
