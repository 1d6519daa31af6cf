/// What runs of `blum field` have in common, whatever they start from: plans, progress, files.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <optional>
#include <string>

#include "blum/gpu/field_io.hpp"
#include "blum/gpu/grid.hpp"
#include "field_arguments.hpp"

namespace blum::app {

[[nodiscard]] std::string mib(std::uint64_t bytes);

void print_grid(const VoxelGrid& grid);

/// What to say if there is less memory; none if there is enough.
[[nodiscard]] std::optional<std::string> memory_shortage(std::uint64_t needed);
/// A grid of the same shape, as --resolution takes it.
[[nodiscard]] std::string size_that_fits(std::uint64_t needed, const VoxelGrid& grid);
/// Returns the exit code.
int report_too_large(const std::string& message);

/// A percentage on a terminal.
class FieldProgress {
 public:
  /// From any thread; false once the run is interrupted.
  bool show(double part);

 private:
  bool is_on_ = isatty(STDERR_FILENO) == 1;
};

/// Writes what the arguments ask for, says so, and returns the exit code.
int write_outputs(const FieldImage& image, const FieldArguments& arguments);

}  // namespace blum::app
