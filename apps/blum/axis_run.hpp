/// The medial axis of a file, for commands that measure on it.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "blum/kernel/solid.hpp"
#include "blum/medial/medial_axis.hpp"

namespace blum::app {

struct AxisArguments {
  std::string model;
  double epsilon = 0;  ///< of the diagonal
  MedialOptions options;
};

/// MODEL, --epsilon, --time-limit, --threads, and the seed of the planes and all else.
void add_axis_options(CLI::App& command, AxisArguments& arguments);

struct AxisRun {
  Solid solid;
  double diagonal = 0;  ///< model units
  MedialResult axis;    ///< with angles
};

/// Nothing if it failed: that has been reported, and `code` is set.
[[nodiscard]] std::optional<AxisRun> run_axis(AxisArguments arguments, int& code);

}  // namespace blum::app
