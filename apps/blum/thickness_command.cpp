// `blum thickness` and `blum midsurface`: walls, measured on the medial axis.
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "axis_run.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "blum/medial/io.hpp"
#include "blum/show/chart.hpp"
#include "blum/thickness/midsurface.hpp"
#include "blum/thickness/thickness.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "output_names.hpp"
#include "report.hpp"

namespace blum::app {
namespace {

namespace fs = std::filesystem;

/// Samples where no density is given.
constexpr double kUsualSamples = 20'000;

struct ThicknessArguments {
  AxisArguments axis;
  ThicknessOptions options;
  std::size_t bins = 40;
  std::string prefix;
};

fs::path prefix_of(const std::string& given, const std::string& model, const char* what) {
  return given.empty() ? fs::path(fs::path(model).stem().string() + what) : fs::path(given);
}

fs::path with_suffix(const fs::path& prefix, const char* suffix) {
  fs::path file = prefix;
  file += suffix;
  return file;
}

/// Six digits are enough for people; the files have all.
std::string six(double value) {
  std::array<char, 32> digits;
  std::snprintf(digits.data(), digits.size(), "%.6g", value);
  return digits.data();
}
std::string six(const Point3& p) {
  return "(" + six(p.x) + ", " + six(p.y) + ", " + six(p.z) + ")";
}

/// Model units squared.
double surface_area(const Solid& solid) {
  double sum = 0;
  for (const SolidTriangle& t : solid.triangle) {
    const Point3 a = solid.frame.to_model(solid.point[t.vertex[0]]),
                 b = solid.frame.to_model(solid.point[t.vertex[1]]),
                 c = solid.frame.to_model(solid.point[t.vertex[2]]);
    sum += length(cross(b - a, c - a)) / 2;
  }
  return sum;
}

void print_thinnest(const Thickness& thickness) {
  const auto thin = thinnest(thickness);
  if (!thin) {
    std::cout << "thinnest   no sample counts: theta is too large\n";
    return;
  }
  const ThicknessSample& s = thickness.sample[*thin];
  std::cout << "thinnest   " << six(s.thickness) << " at " << six(s.position) << " of face "
            << s.triangle << ", opposite " << six(s.opposite) << "; within " << six(s.error)
            << '\n';
}

/// 0 if the files of the prefix can be written; else what is wrong has been reported.
int refuse_outputs(const fs::path& prefix, const std::vector<const char*>& suffixes,
                   const std::string& model) {
  std::vector<fs::path> files;
  for (const char* suffix : suffixes) files.push_back(with_suffix(prefix, suffix));
  if (const auto problem = conflict(model, files)) return report_usage(*problem);
  if (const auto problem = output_problem(files)) return report(*problem);
  return kSuccess;
}

int run_thickness(ThicknessArguments arguments) {
  const fs::path prefix = prefix_of(arguments.prefix, arguments.axis.model, ".thickness");
  const std::vector<const char*> suffixes{".vtp", ".ply", ".csv", ".png"};
  int code = refuse_outputs(prefix, suffixes, arguments.axis.model);
  if (code != kSuccess) return code;
  std::optional<AxisRun> run = run_axis(arguments.axis, code);
  if (!run) return code;
  ThicknessOptions& options = arguments.options;
  options.seed = arguments.axis.options.seed;
  options.threads = arguments.axis.options.threads;
  if (options.density == 0) options.density = kUsualSamples / surface_area(run->solid);
  const Result<Thickness> measured = measure_thickness(run->solid, run->axis, options);
  if (!measured) return report_usage("--density: " + measured.error().message);
  if (interrupted_by() != 0) return report_interrupted();
  const Thickness& thickness = measured.value();

  const ThicknessHistogram bars = histogram(thickness, arguments.bins);
  if (const auto error = write_thickness(thickness, prefix)) return report(*error);
  if (const auto error = write_text(histogram_csv(bars), with_suffix(prefix, ".csv"))) {
    return report(*error);
  }
  BarChart chart;
  chart.title = "Thickness of " + fs::path(arguments.axis.model).filename().string();
  chart.x_label = "thickness (model units)";
  chart.y_label = "area";
  chart.bin_width = bars.bin_width;
  chart.height = bars.area;
  if (const auto error = write_bar_chart(chart, with_suffix(prefix, ".png"))) return report(*error);

  double all = 0, counted = 0;
  std::size_t samples = 0;
  for (const ThicknessSample& s : thickness.sample) {
    all += s.area;
    if (!s.counts) continue;
    counted += s.area;
    ++samples;
  }
  std::cout << "model      " << arguments.axis.model << '\n'
            << "axis       " << (run->axis.certified ? "certified" : "NOT certified") << ", "
            << run->axis.parts.sheets << " sheets\n"
            << "samples    " << thickness.sample.size() << ", on sheets of angle "
            << six(options.theta_deg) << " or more: " << samples << " ("
            << six(std::round(1000 * counted / all) / 10) << " % of the area)\n"
            << "error      at most " << six(thickness.largest_error) << '\n';
  if (thickness.unknown_sheets > 0) {
    std::cout << "sheets     " << thickness.unknown_sheets
              << " samples with the centre on no sheet that the complex tells apart\n";
  }
  print_thinnest(thickness);
  for (const char* suffix : suffixes) {
    std::cout << "wrote " << with_suffix(prefix, suffix).string() << '\n';
  }
  return run->axis.certified ? kSuccess : kNotCertified;
}

struct MidsurfaceArguments {
  AxisArguments axis;
  MidsurfaceOptions options;
  std::string prefix;
};

int run_midsurface(const MidsurfaceArguments& arguments) {
  const fs::path prefix = prefix_of(arguments.prefix, arguments.axis.model, ".midsurface");
  const std::vector<const char*> suffixes{".vtp", ".ply"};
  int code = refuse_outputs(prefix, suffixes, arguments.axis.model);
  if (code != kSuccess) return code;
  const std::optional<AxisRun> run = run_axis(arguments.axis, code);
  if (!run) return code;
  const Midsurface middle = midsurface(run->axis, arguments.options);
  if (interrupted_by() != 0) return report_interrupted();
  if (const auto error = write_midsurface(middle, prefix)) return report(*error);
  std::cout << "model      " << arguments.axis.model << '\n'
            << "axis       "
            << (run->axis.certified ? "certified within " + six(run->axis.hausdorff_bound)
                                    : "NOT certified")
            << ", " << run->axis.parts.sheets << " sheets\n"
            << "midsurface " << middle.sheets << " sheets, " << middle.triangle.size()
            << " triangles, area " << six(middle.area) << "; " << middle.junction_lines
            << " edges where three or more meet\n"
            << "thickness  " << six(middle.least) << " to " << six(middle.most) << '\n';
  for (const char* suffix : suffixes) {
    std::cout << "wrote " << with_suffix(prefix, suffix).string() << '\n';
  }
  return run->axis.certified ? kSuccess : kNotCertified;
}

}  // namespace

Command add_thickness_command(CLI::App& app) {
  CLI::App* thickness = app.add_subcommand(
      "thickness", "Measure walls: the largest ball inside that touches at each sample of a face");
  const auto arguments = std::make_shared<ThicknessArguments>();
  arguments->axis.epsilon = 0.05;
  add_axis_options(*thickness, arguments->axis);
  thickness
      ->add_option("--density", arguments->options.density,
                   "Samples per squared model unit (default: 20,000 samples on the whole model)")
      ->check(CLI::PositiveNumber)
      ->check(kNotNan);
  thickness
      ->add_option(
          "--theta", arguments->options.theta_deg,
          "Degrees: samples count whose ball is centred on a sheet of this angle or more;\n"
          "smaller ones come from edges that bend a little, not from walls")
      ->check(CLI::Range(0.0, 180.0))
      ->check(kNotNan)
      ->capture_default_str();
  thickness->add_option("--bins", arguments->bins, "Bars of the histogram")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100000}))
      ->capture_default_str();
  thickness->add_option("-o,--output", arguments->prefix,
                        "PREFIX of the files (default: the model's name and .thickness, here)");
  thickness->footer(
      R"(Writes PREFIX.vtp (faces coloured by thickness: blum view, blum render, ParaView),
PREFIX.ply (samples), PREFIX.csv and PREFIX.png (histogram by area). Every value comes with a
certified bound of its error. Exit code 3 if the axis is not certified: then the values are right
all the same, but of more samples the sheet is not known, and their own angle decides what counts.

Examples:
  blum thickness part.stl
  blum thickness part.stl --density 4 --theta 90 -o out/part)");
  return [arguments] { return run_thickness(*arguments); };
}

Command add_midsurface_command(CLI::App& app) {
  CLI::App* middle =
      app.add_subcommand("midsurface", "The middle surface of thin walls, with their thickness");
  const auto arguments = std::make_shared<MidsurfaceArguments>();
  arguments->axis.epsilon = 0.03;
  add_axis_options(*middle, arguments->axis);
  middle
      ->add_option("--opposite", arguments->options.opposite_deg,
                   "Degrees: sheets whose feet are somewhere seen under so large an angle, 180\n"
                   "being opposite faces")
      ->check(CLI::Range(0.0, 180.0))
      ->check(kNotNan)
      ->capture_default_str();
  middle
      ->add_option("--max-thickness", arguments->options.most_thickness,
                   "Model units: leave out sheets that are thicker somewhere (default: none)")
      ->check(CLI::PositiveNumber)
      ->check(kNotNan);
  middle->add_option("-o,--output", arguments->prefix,
                     "PREFIX of the files (default: the model's name and .midsurface, here)");
  middle->footer(R"(Writes PREFIX.vtp and PREFIX.ply, with the thickness at each vertex. Where walls
meet in a T, three sheets share an edge.

Examples:
  blum midsurface part.stl
  blum midsurface part.stl --epsilon 0.01 --max-thickness 3 -o out/part)");
  return [arguments] { return run_midsurface(*arguments); };
}

}  // namespace blum::app
