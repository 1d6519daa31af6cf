#include "field_output.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "exit_code.hpp"
#include "field_vdb.hpp"
#include "interrupt.hpp"
#include "report.hpp"
#include "slice_picture.hpp"

namespace blum::app {
namespace {

std::uint64_t available_bytes() {
  return static_cast<std::uint64_t>(sysconf(_SC_AVPHYS_PAGES)) *
         static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
}

}  // namespace

std::string mib(std::uint64_t bytes) { return std::to_string((bytes >> 20) + 1) + " MiB"; }

void print_grid(const VoxelGrid& grid) {
  std::cout << "grid:     " << grid.size[0] << " x " << grid.size[1] << " x " << grid.size[2]
            << ", first sample " << text(grid.origin) << ", spacing " << text(grid.spacing) << '\n';
}

std::optional<std::string> memory_shortage(std::uint64_t needed) {
  const std::uint64_t available = available_bytes();
  if (needed <= available) return std::nullopt;
  return "the grid needs about " + mib(needed) + ", " + mib(available) + " are free";
}

std::string size_that_fits(std::uint64_t needed, const VoxelGrid& grid) {
  const double part =
      std::cbrt(0.9 * static_cast<double>(available_bytes()) / static_cast<double>(needed));
  std::string fits;
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::uint32_t>(part * grid.size[static_cast<std::size_t>(axis)]);
    fits += (axis > 0 ? "," : "") + std::to_string(std::max(1u, n));
  }
  return fits;
}

int report_too_large(const std::string& message) {
  report({ErrorCode::kBadArgument, message, {}, {}});
  return kInput;
}

bool FieldProgress::show(double part) {
  if (is_on_) {
    const int percent = static_cast<int>(100 * part);
    std::string text = "\r" + std::to_string(percent) + " %\033[K";
    if (percent == 100) text = "\r\033[K";
    (void)!write(STDERR_FILENO, text.data(), text.size());
  }
  return interrupted_by() == 0;
}

int write_outputs(const FieldImage& image, const FieldArguments& arguments) {
  if (!arguments.output.empty()) {
    if (const auto error = write_field_file(image, arguments.output)) return report(*error);
    for (const std::filesystem::path& file : output_files(arguments.output)) {
      std::cout << "wrote " << file.string() << '\n';
    }
  }
  if (!arguments.slice.empty()) {
    const std::uint32_t middle =
        image.grid.size[static_cast<std::size_t>(arguments.slice_axis)] / 2;
    const std::uint32_t index = arguments.slice_index.value_or(middle);
    if (const auto error = write_slice(image, arguments.slice_axis, index, arguments.slice)) {
      return report(*error);
    }
    std::cout << "wrote " << arguments.slice << '\n';
  }
  return kSuccess;
}

}  // namespace blum::app
