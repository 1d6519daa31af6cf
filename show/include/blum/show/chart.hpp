/// Plain charts as pictures.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "blum/kernel/result.hpp"

namespace blum {

struct BarChart {
  std::string title, x_label, y_label;
  double bin_width = 1;  ///< bar i is over [i bin_width, (i + 1) bin_width)
  std::span<const double> height;
  int width_px = 900, height_px = 560;
};

/// Bars over an axis that begins at 0, coloured as pictures colour the values. Error:
/// kOutputNotWritten.
[[nodiscard]] std::optional<Error> write_bar_chart(const BarChart& chart,
                                                   const std::filesystem::path& file);

}  // namespace blum
