// `blum view`: a result as a page for the browser.
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "blum/show/page.hpp"
#include "blum/show/scene.hpp"
#include "camera_options.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "report.hpp"

namespace blum::app {
namespace {

struct ViewArguments {
  std::string result, output;
  Camera camera;
};

int run_view(const ViewArguments& arguments) {
  const Result<Scene> scene = read_scene(arguments.result);
  if (!scene) return report(scene.error());
  if (const auto error = write_page(scene.value(), arguments.camera, arguments.output)) {
    return report(*error);
  }
  std::cout << "wrote " << arguments.output << '\n';
  return kSuccess;
}

}  // namespace

void add_camera_options(CLI::App& command, Camera& camera) {
  command
      .add_option("--azimuth", camera.azimuth_deg,
                  "Degrees: where the camera is, from the x axis towards the y axis")
      ->check(CLI::Range(-360.0, 360.0))
      ->check(kNotNan)
      ->capture_default_str();
  command
      .add_option("--elevation", camera.elevation_deg, "Degrees of the camera above the xy plane")
      ->check(CLI::Range(-89.9, 89.9))
      ->check(kNotNan)
      ->capture_default_str();
}

Command add_view_command(CLI::App& app) {
  CLI::App* view = app.add_subcommand("view", "Write a result as a page to look at in a browser");
  const auto arguments = std::make_shared<ViewArguments>();
  view->add_option(
          "RESULT", arguments->result,
          "PREFIX of `blum medial -o PREFIX` (PREFIX.vtp, PREFIX.json), or a .vtp file of\n"
          "blum medial, voronoi, thickness or midsurface")
      ->required();
  view->add_option("-o,--output", arguments->output, "FILE.html")->required();
  add_camera_options(*view, arguments->camera);
  view->footer(
      R"(One file, without network: turn and zoom with the mouse, click for governors, radius
and angle. The slider for theta needs a result with all angles: blum medial --angles.

Examples:
  blum medial part.stl --angles -o out/part
  blum view out/part -o part.html)");
  return [arguments] { return run_view(*arguments); };
}

}  // namespace blum::app
