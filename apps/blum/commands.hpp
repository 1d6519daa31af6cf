/// The subcommands: each adds itself to the command line and returns what runs it.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <functional>
#include <string>

namespace blum::app {

/// Runs after the command line is parsed; returns an exit code (exit_code.hpp).
using Command = std::function<int()>;

/// Digits only: CLI11 2.1 reads "-1" as the largest unsigned number.
inline const CLI::Validator kDigits(
    [](std::string& text) {
      const bool is_good = text.find_first_not_of("0123456789") == std::string::npos;
      return is_good ? std::string() : "not a whole number from 0: " + text;
    },
    "", "digits");

/// CLI11's ranges let it pass. (Shown nowhere: the range says enough.)
inline const CLI::Validator kNotNan(
    [](std::string& text) {
      double value = 0;
      const bool is_nan = CLI::detail::lexical_cast(text, value) && std::isnan(value);
      return is_nan ? "not a number: " + text : std::string();
    },
    "", "number");

[[nodiscard]] Command add_info_command(CLI::App& app);
[[nodiscard]] Command add_make_command(CLI::App& app);
[[nodiscard]] Command add_medial_command(CLI::App& app);
[[nodiscard]] Command add_field_command(CLI::App& app);
[[nodiscard]] Command add_voronoi_command(CLI::App& app);
[[nodiscard]] Command add_verify_command(CLI::App& app);
[[nodiscard]] Command add_certificate_command(CLI::App& app);
[[nodiscard]] Command add_thickness_command(CLI::App& app);
[[nodiscard]] Command add_midsurface_command(CLI::App& app);
[[nodiscard]] Command add_view_command(CLI::App& app);
[[nodiscard]] Command add_render_command(CLI::App& app);

}  // namespace blum::app
