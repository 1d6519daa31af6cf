// `blum medial` and `blum voronoi`: from a file to the certified medial axis or Voronoi diagram, in
// files and as a summary.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>

#include "blum/kernel/flatten.hpp"
#include "blum/kernel/mesh.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "blum/kernel/solid.hpp"
#include "blum/medial/graph.hpp"
#include "blum/medial/io.hpp"
#include "blum/medial/medial_axis.hpp"
#include "blum/medial/simplify.hpp"
#include "blum/medial/summary.hpp"
#include "blum/placement/feet.hpp"
#include "blum/placement/placement.hpp"
#include "blum/placement/placement_summary.hpp"
#include "blum/placement/reconstruction.hpp"
#include "blum/placement/smooth.hpp"
#include "choice.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "hints.hpp"
#include "interrupt.hpp"
#include "output_names.hpp"
#include "progress_bar.hpp"
#include "report.hpp"
#include "threads_option.hpp"

namespace blum::app {
namespace {

namespace fs = std::filesystem;

struct MedialArguments {
  std::string model, prefix, summary, flattened, graph, certificate;
  double epsilon = 0, leaf_diameter = 0, edge_length = 0,
         coplanar_tolerance = 0;  // of the diagonal
  bool smooth = false, feet = false, reconstruction = false;
  std::uint64_t max_memory_mib = 0;  // 0: no limit
  std::optional<double> theta;       // degrees
  Simplify simplify = Simplify::kHomotopy;
  std::vector<double> theta_table;
  std::string theta_csv;
  bool with_angles = false;
  AngleOptions angles;
  DiagramKind kind = DiagramKind::kMedial;
  HintArguments hints;
  MedialOptions options;
};

constexpr std::uint64_t kMostMemoryMib = std::uint64_t{1} << 32;

class Stopwatch {
 public:
  /// Seconds since the construction or the last lap.
  double lap() {
    const auto now = Clock::now();
    const std::chrono::duration<double> time = now - start_;
    start_ = now;
    return time.count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

constexpr const char *kUndecidedSuffix = ".undecided.vtp", *kFeetSuffix = ".feet.vtp";

/// The files a run is going to write; the one of what is undecided, which it writes or removes, is
/// not among them.
std::vector<fs::path> outputs(const MedialArguments& arguments) {
  std::vector<fs::path> files;
  for (const char* suffix : {".ma", ".vtp", ".obj"}) files.emplace_back(arguments.prefix + suffix);
  if (arguments.feet) files.emplace_back(arguments.prefix + kFeetSuffix);
  for (const std::string& name : {arguments.summary, arguments.flattened, arguments.theta_csv,
                                  arguments.graph, arguments.certificate}) {
    if (!name.empty()) files.emplace_back(name);
  }
  return files;
}

Error in_file(Error error, const std::string& file) {
  error.file = file;
  return error;
}

int run_medial(MedialArguments arguments) {
  if (!(arguments.epsilon >= 0)) return report_usage("--epsilon: not a length");
  if (!(arguments.leaf_diameter >= 0)) return report_usage("--leaf-diameter: not a length");
  if (!(arguments.edge_length >= 0)) return report_usage("--edge-length: not a length");
  if (arguments.theta && arguments.simplify == Simplify::kSubset &&
      !arguments.certificate.empty()) {
    return report_usage(
        "--simplify sma: keeps no homotopy type that a certificate could be about; use hma, or "
        "write the certificate in a run without --theta");
  }
  if (arguments.smooth && !arguments.certificate.empty()) {
    return report_usage("--smooth: for display only, a certificate is about the exact result");
  }
  if (!(arguments.coplanar_tolerance >= 0 && arguments.coplanar_tolerance <= 1)) {
    return report_usage("--coplanar-tolerance: not in [0, 1]");
  }
  if (!arguments.certificate.empty() && arguments.options.engine != Engine::kProduction) {
    return report_usage("--certificate: the production engine alone gives its reasons");
  }
  if (!(arguments.angles.tolerance_deg >= 0))
    return report_usage("--angle-tolerance: not an angle");
  for (const double theta : arguments.theta_table) {
    if (!(theta >= 0 && theta <= 180)) return report_usage("--theta-table: not in [0, 180]");
  }
  if (arguments.theta && !(*arguments.theta >= 0 && *arguments.theta <= 180)) {
    return report_usage("--theta: not in [0, 180]");
  }
  arguments.angles.wanted =
      arguments.with_angles || arguments.theta || !arguments.theta_table.empty();
  if (!arguments.certificate.empty()) arguments.angles.certified_theta_deg = arguments.theta;
  if (const fs::path graph = arguments.graph;
      !graph.empty() && graph.extension() != ".json" && graph.extension() != ".graphml") {
    return report_usage("--graph: the name must end in .json or .graphml");
  }
  if (!(arguments.options.margin > 0 && arguments.options.margin <= 100)) {
    return report_usage("--margin: not in (0, 100]");
  }
  if (!(arguments.options.time_limit_s >= 0)) return report_usage("--time-limit: not a time");
  if (arguments.prefix.empty()) arguments.prefix = fs::path(arguments.model).stem().string();
  if (arguments.summary.empty() && arguments.graph != arguments.prefix + ".json") {
    arguments.summary = arguments.prefix + ".json";
  }
  std::vector<fs::path> files = outputs(arguments);
  files.emplace_back(arguments.prefix + kUndecidedSuffix);
  if (const auto problem = conflict(arguments.model, files)) return report_usage(*problem);

  Stopwatch total, phase;
  SummaryInput summary;
  summary.model = arguments.model;
  summary.version = BLUM_VERSION;
  Result<PolygonMesh> mesh = read_mesh(arguments.model);
  if (!mesh) return report(mesh.error());
  summary.read_s = phase.lap();
  Result<Solid> solid = build_solid(mesh.value());
  if (!solid) return report_no_solid(solid.error(), arguments.model, mesh.value());
  FlattenReport changed;
  if (arguments.coplanar_tolerance > 0) {
    Result<Flattened> flattened = flatten_facets(mesh.value(), arguments.coplanar_tolerance);
    if (!flattened) return report(in_file(flattened.error(), arguments.model));
    changed = flattened.value().report;
    summary.flattened = &changed;
    mesh = std::move(flattened.value().mesh);
    solid = std::move(flattened.value().solid);
  }
  summary.sites_s = phase.lap();
  for (const std::string& warning : solid.value().warnings) {
    std::cerr << "blum: warning: " << arguments.model << ": " << warning << '\n';
  }
  arguments.options.max_memory_bytes = arguments.max_memory_mib << 20;
  const double unit = diameter(bounds_of(mesh.value().points));
  const bool medial = arguments.kind == DiagramKind::kMedial;
  arguments.options.max_leaf_diameter =
      (medial ? arguments.leaf_diameter : arguments.epsilon) * unit;
  std::optional<AxisPlacement> placement;
  if (medial) {
    placement.emplace(solid.value(),
                      PlacementOptions{arguments.epsilon * unit, arguments.edge_length * unit});
  }
  if (const auto problem = output_problem(files)) return report(*problem);

  defer_interrupts();  // the engine looks at the flag, files are written whole
  Result<Hints> hints =
      make_hints(arguments.hints, mesh.value(), solid.value(), arguments.options.threads);
  if (interrupted_by() != 0) return report_interrupted();
  if (!hints) return report(hints.error());
  arguments.options.distance_hint = hints.value().hint;
  // The certificate is streamed, under another name until it is whole.
  const std::string unfinished = arguments.certificate + ".unfinished";
  std::ofstream certificate;
  CertificateSink sink;
  if (!arguments.certificate.empty()) {
    certificate.open(unfinished, std::ios::binary);
    sink = [&certificate](const std::string& line) {
      return interrupted_by() == 0 && (certificate << line << '\n').good();
    };
  }
  const auto drop_certificate = [&] {
    std::error_code ignored;
    if (sink) fs::remove(unfinished, ignored);
  };
  const auto compute = [&] {
    ProgressBar bar;
    arguments.options.on_progress = [&bar](const Progress& progress) {
      bar.show(progress);
      return interrupted_by() == 0;
    };
    return medial ? compute_medial_axis(solid.value(), arguments.options, arguments.angles, sink,
                                        placement->review())
                  : compute_voronoi_diagram(solid.value(), arguments.options);
  };
  const Result<MedialResult> result = compute();
  if (interrupted_by() != 0 || !result) drop_certificate();
  if (interrupted_by() != 0) return report_interrupted();
  if (!result) return report(result.error());
  if (sink) {
    certificate.close();
    std::error_code failed;
    if (certificate) fs::rename(unfinished, arguments.certificate, failed);
    if (!certificate || failed) {
      drop_certificate();
      return report(Error{ErrorCode::kOutputNotWritten, "the certificate could not be written",
                          arguments.certificate, std::nullopt});
    }
  }

  // What the files hold: the mesh of the complex, smoothed or pruned where that is asked for.
  MedialResult drawn = placement ? placement->realized(result.value()) : result.value();
  if (placement) {
    summary.sections.push_back(placement_section(placement->report(), placement->mesh(), unit));
  }
  if (arguments.reconstruction) {
    summary.sections.push_back(
        reconstruction_section(reconstruction_error(solid.value(), drawn.complex, {}), unit));
  }
  if (arguments.smooth) {
    summary.sections.push_back(smooth_section(smooth_sheets(drawn, solid.value(), {}), unit));
  }
  summary.solid = &solid.value();
  summary.result = &result.value();
  summary.total_s = total.lap();
  summary.peak_memory_bytes = peak_memory_bytes();
  std::optional<MedialResult> pruned;
  if (arguments.theta) {
    pruned = simplified(drawn, *arguments.theta, arguments.simplify);
    summary.pruned = &*pruned;
    summary.theta_deg = *arguments.theta;
    summary.simplify = arguments.simplify;
  }
  std::vector<ThetaRow> rows;
  if (!arguments.theta_table.empty()) rows = theta_table(result.value(), arguments.theta_table);
  std::vector<TextFile> texts;
  if (!arguments.theta_csv.empty()) {
    texts.push_back({arguments.theta_csv, theta_table_csv(rows)});
  }
  if (!arguments.summary.empty()) texts.push_back({arguments.summary, summary_json(summary)});
  if (!arguments.flattened.empty()) {
    texts.push_back({arguments.flattened, off_text(mesh.value())});
  }
  if (!arguments.graph.empty()) {
    const DiagramGraph graph = read_graph(result.value());
    texts.push_back({arguments.graph, fs::path(arguments.graph).extension() == ".json"
                                          ? graph_json(graph, solid.value())
                                          : graph_graphml(graph, solid.value())});
  }
  if (const auto error =
          write_medial(pruned ? *pruned : drawn, solid.value(), arguments.prefix, texts)) {
    return report(*error);
  }
  if (arguments.feet) {
    if (const auto error = write_feet(sheet_feet(*placement, result.value().parts), drawn.parts,
                                      solid.value(), arguments.prefix + kFeetSuffix)) {
      return report(*error);
    }
  }
  std::cout << summary_text(summary);
  if (!hints.value().text.empty()) {
    std::cout << "hints      " << hints.value().text << "; " << result.value().site_pairs
              << " pairs of a cell and a site\n";
  }
  if (!rows.empty()) std::cout << theta_table_text(rows);
  const bool certified = result.value().certified;
  if (certified) files.pop_back();
  for (const fs::path& file : files) std::cout << "wrote " << file.string() << '\n';
  if (certified && !result.value().certificate_whole) {
    std::cerr << "blum: " << arguments.certificate
              << ": the certificate lacks diagrams that were not decided again (--time-limit?)\n";
    return kNotCertified;
  }
  const bool reached = !placement || placement->report().reached;
  return certified && reached ? kSuccess : kNotCertified;
}

/// The options that both commands have.
std::shared_ptr<MedialArguments> add_options(CLI::App* medial) {
  const auto arguments = std::make_shared<MedialArguments>();
  MedialOptions& options = arguments->options;
  medial->add_option("MODEL", arguments->model, "OFF, OBJ, STL or PLY")->required();
  medial->add_option("-o,--output", arguments->prefix,
                     "PREFIX of the files written (default: the model's name, here)");
  medial->add_option("--summary", arguments->summary,
                     "File of the summary, as JSON (default: PREFIX.json)");
  medial->add_option("--seed", options.seed, "Seed of the cutting planes")
      ->check(kDigits)
      ->capture_default_str();
  medial->add_flag("--resolve", options.resolve,
                   "Refine until no avoidable cluster node is left (for counting sheets)");
  medial
      ->add_option("--epsilon", arguments->epsilon,
                   "Refine until the Hausdorff distance to the axis is at most this fraction of\n"
                   "the diagonal; 0: as coarse as the topology allows")
      ->capture_default_str();
  CLI::Option* const coplanar =
      medial
          ->add_option("--coplanar-tolerance", arguments->coplanar_tolerance,
                       "Make nearly axis-parallel facets and edges exactly so; no vertex moves by\n"
                       "more than this fraction of the diagonal. The changed solid is what is\n"
                       "certified; 0: the solid is taken as it is")
          ->capture_default_str();
  medial
      ->add_option("--write-flattened", arguments->flattened,
                   "Write the solid so changed to this file, as OFF")
      ->needs(coplanar);
  medial
      ->add_option("--cell-sites", options.max_candidates,
                   "Cells with more sites are divided untested; 0: all are tested, for the fewest\n"
                   "leaves in the shortest time, with the coarsest geometry")
      ->check(kDigits)
      ->capture_default_str();
  medial->add_option("--max-depth", options.max_depth, "Bisections from the box to a leaf")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  medial->add_option("--max-cells", options.max_cells, "Cells to look at")
      ->check(kDigits)
      ->capture_default_str();
  medial->add_option("--time-limit", options.time_limit_s, "Seconds of computing; 0: no limit")
      ->capture_default_str();
  medial
      ->add_option("--max-memory", arguments->max_memory_mib,
                   "MiB that the process may take; 0: no limit")
      ->check(CLI::Range(std::uint64_t{0}, kMostMemoryMib))
      ->capture_default_str();
  add_threads_option(*medial, options.threads)->capture_default_str();
  add_hint_options(*medial, arguments->hints);
  return arguments;
}

/// What Voronoi diagrams do not have.
void add_medial_options(CLI::App* medial, MedialArguments& arguments) {
  medial->add_flag("!--no-cuts", arguments.options.cuts,
                   "Subdivide a cell without trying planes that miss the axis: more cells, for\n"
                   "comparison");
  medial->add_option("--certificate", arguments.certificate,
                     "Write what `blum verify` needs to check the result to this file, with\n"
                     "--theta the collapses too. Such a run uses no cutting planes, so its leaves\n"
                     "may differ");
  medial
      ->add_option("--edge-length", arguments.edge_length,
                   "Longest edge of the meshes of sheets, seams and rims, as a fraction of the\n"
                   "diagonal; 0: that of the cells, or 0.4 times the root of --epsilon")
      ->capture_default_str();
  medial
      ->add_option("--leaf-diameter", arguments.leaf_diameter,
                   "Divide all leaves that meet the axis down to this fraction of the diagonal;\n"
                   "0: no more than topology and --epsilon need")
      ->capture_default_str();
  medial->add_flag("--feet", arguments.feet,
                   "Write PREFIX.feet.vtp: both feet of every point of every sheet, as patches of\n"
                   "the boundary");
  medial->add_flag(
      "--smooth", arguments.smooth,
      "Smooth the sheets for display; seams and rims stay. The files then do not hold\n"
      "the certified positions, and say so");
  medial->add_flag("--reconstruction", arguments.reconstruction,
                   "Report how far the union of the axis' balls is from the boundary");
  medial->add_flag("--angles", arguments.with_angles,
                   "Bound the separation angles of all parts, and write them to PREFIX.vtp");
  CLI::Option* const theta = medial->add_option(
      "--theta", arguments.theta, "Degrees: the files hold the axis simplified by this angle");
  medial
      ->add_option("--simplify", arguments.simplify,
                   "hma: keeps the homotopy type; sma: every part with a larger angle, which may\n"
                   "tear the axis apart")
      ->transform(choice(std::map<std::string, Simplify>{{"hma", Simplify::kHomotopy},
                                                         {"sma", Simplify::kSubset}}))
      ->default_str("hma")
      ->needs(theta);
  CLI::Option* const table =
      medial
          ->add_option("--theta-table", arguments.theta_table,
                       "Angles, with commas between: print both simplified axes for each")
          ->delimiter(',');
  medial->add_option("--theta-csv", arguments.theta_csv, "Write that table to this file, as CSV")
      ->needs(table);
  medial
      ->add_option(
          "--angle-tolerance", arguments.angles.tolerance_deg,
          "Degrees between the bounds of a part's angle; leaves that are too coarse to tell "
          "are divided")
      ->capture_default_str();
  medial
      ->add_option("--angle-budget", arguments.angles.boxes_per_leaf,
                   "Boxes to look at for each part, times the leaves that it is in")
      ->check(kDigits)
      ->capture_default_str();
}

/// The engines of a command, by their names.
void add_engine_option(CLI::App* command, Engine& engine, const char* description,
                       const std::map<std::string, Engine>& engines) {
  command->add_option("--engine", engine, description)
      ->transform(choice(engines))
      ->default_str("production");
}

}  // namespace

Command add_medial_command(CLI::App& app) {
  CLI::App* medial = app.add_subcommand("medial", "Compute the certified medial axis of a solid");
  const auto arguments = add_options(medial);
  add_medial_options(medial, *arguments);
  add_engine_option(
      medial, arguments->options.engine,
      "production; brute: slow and all exact; cgal: CGAL's arrangements, for\n"
      "small solids (needs blum-cgal-engine)",
      {{"production", Engine::kProduction}, {"brute", Engine::kBrute}, {"cgal", Engine::kCgal}});
  medial->footer(
      R"(Writes PREFIX.ma (text), PREFIX.vtp (ParaView) and PREFIX.obj. Cells that the budget
(--max-depth, --max-cells, --time-limit, --max-memory) leaves undecided are reported and written
to PREFIX.undecided.vtp as boxes, with exit code 3. That is the exit code, too, where the bound
that --epsilon asks for is not reached; the summary says which one is.

Examples:
  blum medial part.stl
  blum medial part.stl --resolve --epsilon 0.05
  blum medial part.stl --theta 60 --theta-table 0,30,60,90,120,150,180
  blum medial part.stl -o out/part --summary out/part.json --time-limit 60
  blum medial part.stl --coplanar-tolerance 1e-6 --write-flattened out/flat.off)");
  return [arguments] { return run_medial(*arguments); };
}

Command add_voronoi_command(CLI::App& app) {
  CLI::App* voronoi = app.add_subcommand(
      "voronoi", "Compute the certified Voronoi diagram of a solid's faces, edges and vertices");
  const auto arguments = add_options(voronoi);
  arguments->kind = DiagramKind::kVoronoi;
  MedialOptions& options = arguments->options;
  add_engine_option(voronoi, options.engine, "production, or brute: slow and all exact",
                    {{"production", Engine::kProduction}, {"brute", Engine::kBrute}});
  voronoi
      ->add_option("--margin", options.margin,
                   "How much larger than the solid's the box is in which the diagram is computed,\n"
                   "as a fraction; at least, up to a tenth more by chance")
      ->capture_default_str();
  voronoi
      ->add_option(
          "--side", options.side,
          "The part of the diagram that is wanted: inside (the closed solid), outside (the\n"
          "closure of the rest of the box) or both")
      ->transform(choice(std::map<std::string, VoronoiSide>{{"inside", VoronoiSide::kInside},
                                                            {"outside", VoronoiSide::kOutside},
                                                            {"both", VoronoiSide::kBoth}}))
      ->default_str("both");
  voronoi->add_option(
      "--graph", arguments->graph,
      "Write the Voronoi graph (faces, edges, vertices, what lies on what, with their\n"
      "governors) to this file, .json or .graphml");
  voronoi
      ->add_option(
          "--criterion", options.criterion,
          "When a cell is accepted: strict (Sud's thesis), disks (regions are disks on its\n"
          "surface, none is hidden) or relaxed (the same, and what the flow to the\n"
          "boundary proves)")
      ->transform(choice(std::map<std::string, Criterion>{{"strict", Criterion::kStrict},
                                                          {"disks", Criterion::kDisks},
                                                          {"relaxed", Criterion::kRelaxed}}))
      ->default_str("relaxed");
  voronoi->add_flag("!--no-tubes", options.tubes,
                    "Subdivide cells that one region passes through: more cells, for comparison");
  voronoi->footer(
      R"(The sites are the triangles, edges and vertices of the boundary that have a region with an
interior. The diagram is computed inside and outside the solid, in a box around it, or on one side.
Files and exit codes are those of `blum medial`; the summary gains "voronoi", with
  both     euler = 1 + regions - pieces_euler
  inside   euler = solid_euler + regions_inside
  outside  euler = 1 + solid_euler + regions_outside - pieces_euler

Examples:
  blum voronoi part.stl
  blum voronoi part.stl --margin 0.5 --summary part.json
  blum voronoi part.stl --side inside --graph part.graphml
  blum voronoi part.stl --criterion strict --time-limit 60)");
  return [arguments] { return run_medial(*arguments); };
}

}  // namespace blum::app
