// `blum make`: writes a solid from the table of shapes below.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <numeric>
#include <optional>
#include <span>

#include "blum/kernel/shapes.hpp"
#include "blum/kernel/solid.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "report.hpp"

namespace blum::app {
namespace {

struct Parameter {
  const char* name;
  double fallback;
  bool is_count = false;  ///< a whole number, at least `least`; else a positive length
  int least = 0;
};

struct Shape {
  const char* name;
  const char* description;
  std::vector<Parameter> parameters;
  PolygonMesh (*generate)(std::span<const double>, shapes::Move);
};

constexpr int kLargestCount = 100'000;
constexpr double kLargestLength = 1e50;  // sums stay below the readers' limit of 2^200

int whole(double value) { return static_cast<int>(value); }

const std::vector<Shape>& all_shapes() {
  using P = std::span<const double>;
  using shapes::Move;
  static const std::vector<Shape> table{
      {"cuboid",
       "box with sides a, b, c",
       {{"a", 1}, {"b", 2}, {"c", 3}},
       [](P p, Move) { return shapes::cuboid(p[0], p[1], p[2]); }},
      {"lbracket",
       "L profile: arms a and b, thickness t, depth d",
       {{"a", 4}, {"b", 3}, {"t", 1}, {"d", 2}},
       [](P p, Move) { return shapes::lbracket(p[0], p[1], p[2], p[3]); }},
      {"lpocket",
       "box of 4w x 4w with a blind L-shaped pocket, its depth d and floor f",
       {{"w", 1}, {"d", 2}, {"f", 1}},
       [](P p, Move) { return shapes::lpocket(p[0], p[1], p[2]); }},
      {"prism",
       "regular n-gon of circumradius r, height h; --move, --move-ulps move a corner",
       {{"n", 6, true, 3}, {"r", 1}, {"h", 1}},
       [](P p, Move move) { return shapes::prism(whole(p[0]), p[1], p[2], move); }},
      {"plate",
       "plate with a row of through holes, each a regular polygon",
       {{"count", 2, true, 0}, {"sides", 6, true, 3}, {"pitch", 2}, {"thickness", 0.5}},
       [](P p, Move) { return shapes::plate(whole(p[0]), whole(p[1]), p[2], p[3]); }},
      {"voids",
       "k hollow boxes, each in the void of the next larger one",
       {{"k", 1, true, 1}},
       [](P p, Move) { return shapes::nested_voids(whole(p[0])); }},
      {"torus",
       "n facets about the axis, m about the tube; radii R > r",
       {{"n", 8, true, 3}, {"m", 4, true, 3}, {"R", 2}, {"r", 0.75}},
       [](P p, Move) { return shapes::torus(whole(p[0]), whole(p[1]), p[2], p[3]); }},
      {"planar_torus",
       "the same with exactly planar trapezoids",
       {{"n", 8, true, 3}, {"m", 4, true, 3}, {"R", 2}, {"r", 0.75}},
       [](P p, Move) { return shapes::planar_torus(whole(p[0]), whole(p[1]), p[2], p[3]); }},
      {"spoon",
       "spoon of 84 triangles, 126 edges, 44 vertices, none of them degenerate",
       {},
       [](P, Move) { return shapes::spoon(); }},
      {"chisel",
       "chisel of 632 triangles, 318 vertices: its handle flattened, perturbed at random",
       {},
       [](P, Move) { return shapes::chisel(); }},
      {"knot",
       "tube about the (p,q) torus knot: n pieces, s sides, radii R > r, tube radius t",
       {{"p", 2, true, 1},
        {"q", 3, true, 1},
        {"n", 48, true, 3},
        {"s", 6, true, 3},
        {"R", 2},
        {"r", 1},
        {"t", 0.375}},
       [](P p, Move) {
         return shapes::knot(
             {whole(p[0]), whole(p[1]), whole(p[2]), whole(p[3]), p[4], p[5], p[6]});
       }},
  };
  return table;
}

std::string footer() {
  std::string result = "Shapes, with their parameters and defaults (later ones may be left out):\n";
  for (const Shape& shape : all_shapes()) {
    std::string call = shape.name;
    for (const Parameter& parameter : shape.parameters) {
      call += std::string(" ") + parameter.name + "=" + number(parameter.fallback);
    }
    result += "  " + call + "\n      " + shape.description + "\n";
  }
  return result + R"(
Examples:
  blum make cuboid 2 2 3 -o box.off
  blum make prism 5 --move-ulps 1 -o prism.off
  blum make lbracket --rotate 7 -o bracket.off
  blum make cuboid --split-edges 1 --triangulate 2 --shuffle 3 -o box.off
  blum make torus 16 8 2 0.5 -o torus.off)";
}

/// The parameters with defaults filled in, or what is wrong with them.
Result<std::vector<double>> complete(const Shape& shape, const std::vector<double>& given) {
  const auto bad = [&](const std::string& message) {
    return Error{ErrorCode::kBadArgument, std::string(shape.name) + ": " + message, {}, {}};
  };
  if (given.size() > shape.parameters.size()) {
    return bad("takes at most " + std::to_string(shape.parameters.size()) + " parameters");
  }
  std::vector<double> values = given;
  for (std::size_t i = given.size(); i < shape.parameters.size(); ++i) {
    values.push_back(shape.parameters[i].fallback);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& [name, fallback, is_count, least] = shape.parameters[i];
    if (is_count && (values[i] != std::floor(values[i]) || !(values[i] >= least) ||
                     values[i] > kLargestCount)) {
      return bad(std::string(name) + " must be a whole number from " + std::to_string(least) +
                 " to " + std::to_string(kLargestCount));
    }
    if (!is_count && !(values[i] > 1 / kLargestLength && values[i] < kLargestLength)) {
      return bad(std::string(name) + " must be positive (between 1e-50 and 1e50)");
    }
  }
  return values;
}

/// Conditions between parameters that the generators require.
std::optional<std::string> conflict(const std::string& shape, const std::vector<double>& p) {
  if (shape == "lbracket" && !(p[2] < std::min(p[0], p[1]))) return "t must be less than a and b";
  if ((shape == "torus" || shape == "planar_torus") && !(p[2] > p[3]))
    return "R must be greater than r";
  if (shape == "knot" && !(p[4] > p[5])) return "R must be greater than r";
  if (shape == "knot" && std::gcd(whole(p[0]), whole(p[1])) != 1) return "p and q must be coprime";
  return std::nullopt;
}

struct MakeArguments {
  std::string shape, output;
  std::vector<double> parameters;
  shapes::Move move;
  std::optional<std::uint64_t> split, triangulate, rotate, shuffle;
};

int run_make(const MakeArguments& arguments) {
  const auto shape = std::find_if(all_shapes().begin(), all_shapes().end(),
                                  [&](const Shape& s) { return s.name == arguments.shape; });
  const Result<std::vector<double>> parameters = complete(*shape, arguments.parameters);
  if (!parameters) return report_usage(parameters.error().message);
  if (const auto message = conflict(arguments.shape, parameters.value())) {
    return report_usage(arguments.shape + ": " + *message);
  }
  const bool has_move = arguments.move.amount != 0 || arguments.move.ulps != 0;
  if (has_move && arguments.shape != "prism") return report_usage("only a prism can be moved");

  PolygonMesh mesh = shape->generate(parameters.value(), arguments.move);
  if (arguments.split) mesh = shapes::split_edges(mesh, *arguments.split);
  if (arguments.triangulate) mesh = shapes::triangulate_facets(mesh, *arguments.triangulate);
  if (arguments.rotate) mesh = shapes::rotate_rounded(mesh, *arguments.rotate);
  if (arguments.shuffle) mesh = shapes::shuffle(mesh, *arguments.shuffle);

  const Result<Solid> solid = build_solid(mesh);
  if (!solid) {
    return report_usage("these parameters give no valid solid: " + solid.error().message);
  }
  defer_interrupts();  // the file is written whole
  if (const auto error = write_off(mesh, arguments.output)) return report(*error);
  const auto betti = solid.value().betti();
  std::cout << arguments.output << ": " << mesh.points.size() << " vertices, " << mesh.faces.size()
            << " faces, Betti numbers " << betti[0] << ' ' << betti[1] << ' ' << betti[2] << '\n';
  return kSuccess;
}

}  // namespace

Command add_make_command(CLI::App& app) {
  CLI::App* make = app.add_subcommand("make", "Write a solid to try things on (OFF)");
  const auto arguments = std::make_shared<MakeArguments>();
  std::vector<std::string> names;
  for (const Shape& shape : all_shapes()) names.emplace_back(shape.name);
  make->add_option("NAME", arguments->shape, "The shape, see below")
      ->required()
      ->check(CLI::IsMember(names));
  make->add_option("PARAMETER", arguments->parameters, "Its parameters, in the order below");
  make->add_option("-o,--output", arguments->output, "The file to write (OFF)")->required();
  make->add_option("--move", arguments->move.amount,
                   "prism: move corner 0 of the top by this much along x and z");
  make->add_option("--move-ulps", arguments->move.ulps,
                   "prism: the same in units in the last place")
      ->check(CLI::Range(-1'000'000, 1'000'000));
  const auto add_seed = [make](const char* name, std::optional<std::uint64_t>& seed,
                               const char* description) {
    make->add_option(name, seed, description)->type_name("SEED")->check(kDigits);
  };
  add_seed("--split-edges", arguments->split,
           "Midpoints of random edges become collinear vertices");
  add_seed("--triangulate", arguments->triangulate, "A random triangulation of the facets");
  add_seed("--rotate", arguments->rotate, "A random rotation, coordinates rounded to doubles");
  add_seed("--shuffle", arguments->shuffle, "Random order of vertices and faces");
  make->footer(footer());
  return [arguments] { return run_make(*arguments); };
}

}  // namespace blum::app
