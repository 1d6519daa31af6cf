#include "hints.hpp"

#include <chrono>
#include <cmath>
#include <map>
#include <random>

#include "blum/gpu/field.hpp"
#include "blum/gpu/field_hint.hpp"
#include "choice.hpp"
#include "commands.hpp"
#include "field_arguments.hpp"
#include "interrupt.hpp"
#include "report.hpp"

namespace blum::app {
namespace {

Result<DistanceField> coarse_field(const HintArguments& arguments, const SiteSet& sites,
                                   const VoxelGrid& grid, int threads) {
  FieldOptions options;
  options.threads = threads;
  options.on_progress = [](double) { return interrupted_by() == 0; };
  if (arguments.source == HintSource::kGl) {
    options.backend = FieldBackend::kEgl;
    Result<DistanceField> field = compute_field(sites, grid, options);
    if (field || field.error().code == ErrorCode::kInterrupted) return field;
    options.backend = FieldBackend::kOsmesa;
  }
  return compute_field(sites, grid, options);
}

}  // namespace

void add_hint_options(CLI::App& command, HintArguments& arguments) {
  command
      .add_option("--hints", arguments.source,
                  "Bounds on distance from a coarse field, to save work; the result is the same.\n"
                  "none, cpu, gl, or corrupted: of random sites, to show that it is")
      ->transform(choice(std::map<std::string, HintSource>{{"none", HintSource::kNone},
                                                           {"cpu", HintSource::kCpu},
                                                           {"gl", HintSource::kGl},
                                                           {"corrupted", HintSource::kCorrupted}}))
      ->default_str("none");
  command
      .add_option("--hint-resolution", arguments.resolution,
                  "Samples of that field along the longest side")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

Result<Hints> make_hints(const HintArguments& arguments, const PolygonMesh& mesh,
                         const Solid& solid, int threads) {
  if (!arguments.source) return Hints{};
  if (arguments.source == HintSource::kNone) return Hints{{}, "none"};
  const auto start = std::chrono::steady_clock::now();
  const Result<SiteSet> sites = SiteSet::build(soup_of(mesh));
  if (!sites) return sites.error();
  FieldArguments shape;
  shape.resolution = {arguments.resolution};
  const Result<VoxelGrid> grid = grid_of(shape, sites.value().box());
  if (!grid) return grid.error();
  Result<DistanceField> field = coarse_field(arguments, sites.value(), grid.value(), threads);
  if (!field) return field.error();
  if (arguments.source == HintSource::kCorrupted) {
    // Many of them are no sites at all.
    std::mt19937_64 random(1);
    for (std::uint32_t& id : field.value().site) {
      id = static_cast<std::uint32_t>(random() % (2 * std::uint64_t{sites.value().size()}));
    }
  }
  Hints hints;
  hints.hint = field_hint(sites.value(), field.value(), solid.frame);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  const auto& size = grid.value().size;
  hints.text = std::string(field_backend_name(field.value().backend)) +
               (arguments.source == HintSource::kCorrupted ? ", corrupted" : "") + ", " +
               std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " +
               std::to_string(size[2]) + " samples in " +
               number(std::round(1000 * time.count()) / 1000) + " s";
  return hints;
}

}  // namespace blum::app
