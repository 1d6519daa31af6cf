#include "image_field.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>

#include "blum/gpu/feature_transform.hpp"
#include "exit_code.hpp"
#include "field_output.hpp"
#include "interrupt.hpp"
#include "report.hpp"
#include "voxel_image.hpp"

namespace blum::app {
namespace {

/// Ids are written in 32 bits, to .vdb with a sign.
constexpr std::size_t kMostVoxels = 0x7fffffff;

struct ImageField {
  std::vector<double> distance;
  std::vector<std::uint32_t> site;
};

ImageField within_band(FeatureTransform transform, double band) {
  ImageField out{std::move(transform.distance), {}};
  out.site.reserve(out.distance.size());
  for (std::size_t v = 0; v < out.distance.size(); ++v) {
    const bool is_near = out.distance[v] <= band;
    if (!is_near) out.distance[v] = std::numeric_limits<double>::infinity();
    out.site.push_back(is_near ? static_cast<std::uint32_t>(transform.feature[v]) : kNoSite.value);
  }
  return out;
}

int report_of(Error error, const std::string& file) {
  error.file = file;
  report(error);
  return kInput;
}

}  // namespace

int run_image_field(const FieldArguments& arguments) {
  const Result<VoxelGrid> grid = read_voxel_grid(arguments.model);
  if (!grid) return report(grid.error());
  if (grid.value().voxels() > kMostVoxels) {
    return report_too_large("more than " + std::to_string(kMostVoxels) + " voxels");
  }
  if (const std::string problem = slice_problem(arguments, grid.value().size); !problem.empty()) {
    return report_usage(problem);
  }
  // The image, what the transform takes, and the ids as they are written.
  const std::uint64_t needed =
      feature_transform_bytes(grid.value()) + (1 + sizeof(std::uint32_t)) * grid.value().voxels();
  print_grid(grid.value());
  std::cout << "backend:  feature transform, " << arguments.options.threads << " threads\n"
            << "memory:   about " << mib(needed) << '\n';
  if (const auto shortage = memory_shortage(needed)) return report_too_large(*shortage);
  if (arguments.is_dry_run) return kSuccess;

  defer_interrupts();
  const auto start = std::chrono::steady_clock::now();
  const auto is_feature = read_features(arguments.model, arguments.threshold);
  if (!is_feature) return report(is_feature.error());
  const auto features = std::ranges::count_if(is_feature.value(), [](auto f) { return f != 0; });
  if (features == 0) {
    return report_of({ErrorCode::kMalformedFile,
                      arguments.threshold ? "no voxel reaches the threshold" : "all voxels are 0",
                      {},
                      {}},
                     arguments.model);
  }
  FieldProgress progress;
  Result<FeatureTransform> transform =
      feature_transform(grid.value(), is_feature.value(), arguments.options.threads,
                        [&](double part) { return progress.show(part); });
  if (interrupted_by() != 0) return report_interrupted();
  if (!transform) return report_of(transform.error(), arguments.model);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  std::cout << "features: " << features << " voxels\n"
            << "bound:    distances between centres, within " << number(0x1p-50) << " relative\n"
            << "time:     " << number(std::round(1000 * time.count()) / 1000) << " s\n";
  const ImageField field = within_band(std::move(transform).value(), arguments.options.band);
  return write_outputs({grid.value(), 1, field.distance, field.site, {}}, arguments);
}

}  // namespace blum::app
