#include "voxel_image.hpp"

#ifdef BLUM_HAS_TEEM
#include <teem/nrrd.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#endif

namespace blum::app {

namespace fs = std::filesystem;

bool is_voxel_image(const fs::path& file) {
  return file.extension() == ".nrrd" || file.extension() == ".nhdr";
}

#ifdef BLUM_HAS_TEEM
namespace {

struct Nuke {
  void operator()(Nrrd* image) const { nrrdNuke(image); }
};
using Image = std::unique_ptr<Nrrd, Nuke>;

Error malformed(const fs::path& file, std::string what) {
  return {ErrorCode::kMalformedFile, std::move(what), file.string(), {}};
}

/// Teem's reasons, innermost last, a line each.
std::string teem_reason() {
  const std::unique_ptr<char, decltype(&std::free)> lines(biffGetDone(NRRD), &std::free);
  std::string text = lines ? lines.get() : "not readable";
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t last = text.rfind('\n');
  return last == std::string::npos ? text : text.substr(last + 1);
}

Result<Image> load(const fs::path& file, bool with_values) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) {
    return Error{ErrorCode::kFileNotFound, "no such file", file.string(), {}};
  }
  const std::unique_ptr<NrrdIoState, decltype(&nrrdIoStateNix)> how(nrrdIoStateNew(),
                                                                    &nrrdIoStateNix);
  how->skipData = with_values ? 0 : 1;
  Image image(nrrdNew());
  if (nrrdLoad(image.get(), file.c_str(), how.get()) != 0) {
    return malformed(file, teem_reason());
  }
  if (image->dim != 3) {
    return malformed(file, "the image has " + std::to_string(image->dim) + " axes, not 3");
  }
  if (image->spaceDim != 0 && image->spaceDim != 3)
    return malformed(file, "the space is not of 3 dimensions");
  if (image->type == nrrdTypeBlock) return malformed(file, "the values are blocks, not numbers");
  return image;
}

}  // namespace

bool has_voxel_images() { return true; }

Result<VoxelGrid> read_voxel_grid(const fs::path& file) {
  Result<Image> image = load(file, false);
  if (!image) return image.error();
  const Nrrd& n = *image.value();
  VoxelGrid grid;
  grid.spacing = {1, 1, 1};
  for (unsigned axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    if (n.axis[axis].size >= std::size_t{1} << 32) return malformed(file, "the image is too large");
    grid.size[axis] = static_cast<std::uint32_t>(n.axis[axis].size);
    const NrrdAxisInfo& info = n.axis[axis];
    double unused = 0, direction[NRRD_SPACE_DIM_MAX] = {};
    switch (nrrdSpacingCalculate(&n, axis, &unused, direction)) {
      case nrrdSpacingStatusDirection:
        for (unsigned k = 0; k < n.spaceDim; ++k) {
          if (k == axis ? !(direction[k] > 0) : direction[k] != 0) {
            return malformed(file,
                             "the axes are turned, exchanged or reversed: resample the image");
          }
        }
        grid.spacing[a] = info.spaceDirection[axis];
        break;
      case nrrdSpacingStatusNone:
        if (!std::isnan(info.min) || !std::isnan(info.max)) {
          return malformed(file, "axis mins and maxs without spacings");
        }
        break;
      default:
        grid.spacing[a] = info.spacing;
    }
    if (n.spaceDim > 0) {
      grid.origin[a] = std::isnan(n.spaceOrigin[axis]) ? 0 : n.spaceOrigin[axis];
    } else if (!std::isnan(info.min)) {
      grid.origin[a] = info.center == nrrdCenterNode ? info.min : info.min + 0.5 * grid.spacing[a];
    }
  }
  if (std::string problem = grid_problem(grid); !problem.empty()) {
    return malformed(file, std::move(problem));
  }
  return grid;
}

Result<std::vector<std::uint8_t>> read_features(const fs::path& file,
                                                std::optional<double> threshold) {
  Result<Image> image = load(file, true);
  if (!image) return image.error();
  const Nrrd& n = *image.value();
  const auto value = nrrdDLookup[n.type];
  std::vector<std::uint8_t> is_feature(nrrdElementNumber(&n));
  for (std::size_t v = 0; v < is_feature.size(); ++v) {
    const double x = value(n.data, v);
    if (std::isnan(x)) {
      return Error{ErrorCode::kMalformedFile, "voxel " + std::to_string(v) + " is no number",
                   file.string(), v};
    }
    is_feature[v] = threshold ? x >= *threshold : x != 0;
  }
  return is_feature;
}

#else

bool has_voxel_images() { return false; }

// arguments_problem() has refused these files.
Result<VoxelGrid> read_voxel_grid(const fs::path& file) {
  return Error{ErrorCode::kUnknownFormat, "built without Teem", file.string(), {}};
}
Result<std::vector<std::uint8_t>> read_features(const fs::path& file, std::optional<double>) {
  return Error{ErrorCode::kUnknownFormat, "built without Teem", file.string(), {}};
}

#endif

}  // namespace blum::app
