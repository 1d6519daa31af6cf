// `blum render`: a result as a picture.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>

#include "blum/show/render.hpp"
#include "camera_options.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "report.hpp"
#include "threads_option.hpp"

namespace blum::app {
namespace {

struct RenderArguments {
  std::string result, output, section;
  RenderOptions options;
};

/// "x", "y:0.3", "-z:0.5": the axis, where, and "-" for the other half.
std::optional<Section> section_of(std::string text) {
  Section section;
  section.flip = text.starts_with('-');
  if (section.flip) text.erase(0, 1);
  if (text.empty() || text[0] < 'x' || text[0] > 'z') return std::nullopt;
  section.axis = text[0] - 'x';
  if (text.size() == 1) return section;
  std::size_t used = 0;
  try {
    section.at = std::stod(text.substr(std::min<std::size_t>(2, text.size())), &used);
  } catch (const std::exception&) {
    return std::nullopt;
  }
  if (text[1] != ':' || used + 2 != text.size()) return std::nullopt;
  return section;
}

int run_render(RenderArguments arguments) {
  if (!arguments.section.empty()) {
    arguments.options.section = section_of(arguments.section);
    if (!arguments.options.section) return report_usage("--section: not like x, y:0.3 or -z:0.5");
  }
  const Result<Scene> scene = read_scene(arguments.result);
  if (!scene) return report(scene.error());
  const Result<RenderReport> done = render_png(scene.value(), arguments.options, arguments.output);
  if (!done) {
    return done.error().code == ErrorCode::kBadArgument ? report_usage(done.error().message)
                                                        : report(done.error());
  }
  std::cout << done.value().triangles << " triangles\n"
            << std::lround(100 * done.value().covered_fraction)
            << " % of the picture covered\nwrote " << arguments.output << '\n';
  return kSuccess;
}

}  // namespace

Command add_render_command(CLI::App& app) {
  CLI::App* render =
      app.add_subcommand("render", "Draw a result as a picture, without display or GPU");
  const auto arguments = std::make_shared<RenderArguments>();
  RenderOptions& options = arguments->options;
  render
      ->add_option(
          "RESULT", arguments->result,
          "PREFIX of `blum medial -o PREFIX` (PREFIX.vtp, PREFIX.json), or a .vtp file of\n"
          "blum medial, voronoi, thickness or midsurface")
      ->required();
  render->add_option("-o,--output", arguments->output, "FILE.png")->required();
  add_camera_options(*render, options.camera);
  render->add_option("--width", options.width, "Pixels")
      ->check(CLI::Range(16, 16384))
      ->capture_default_str();
  render->add_option("--height", options.height, "Pixels")
      ->check(CLI::Range(16, 16384))
      ->capture_default_str();
  render->add_option("--zoom", options.zoom, "2: everything twice as large")
      ->check(CLI::Range(0.01, 1000.0))
      ->check(kNotNan)
      ->capture_default_str();
  render->add_option("--colour", options.colour,
                     "radius, angle, sheet or thickness: what the file has (default: its first)");
  render
      ->add_option("--theta", options.theta_deg,
                   "Degrees: the axis simplified by this angle (needs blum medial --angles)")
      ->check(CLI::Range(0.0, 180.0))
      ->check(kNotNan)
      ->capture_default_str();
  render->add_option("--section", arguments->section,
                     "Cut away what is above a plane: x, y:0.3 (at 0.3 of the box), -z:0.5 (the\n"
                     "other half)");
  render->add_flag("!--no-model", options.model, "Without the solid");
  render->add_flag("!--no-sheets", options.sheets, "Without sheets");
  render->add_flag("!--no-seams", options.seams, "Without seams");
  render->add_flag("!--no-rims", options.rims, "Without rims");
  render->add_flag("!--no-undecided", options.undecided, "Without the boxes that are undecided");
  render->add_flag("!--no-legend", options.legend, "Without the legend of the colours");
  add_threads_option(*render, options.threads, "The picture");
  render->footer(R"(Examples:
  blum render out/part -o part.png
  blum render out/part -o part.png --theta 60 --colour sheet --azimuth 30 --elevation 20
  blum render out/part -o cut.png --section y:0.5 --no-model --width 1600)");
  return [arguments] { return run_render(*arguments); };
}

}  // namespace blum::app
