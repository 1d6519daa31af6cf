/// `blum field` with a voxel image for a model.
#pragma once

#include "field_arguments.hpp"

namespace blum::app {

/// The nearest feature voxel of each voxel, and its distance (feature_transform.hpp): the file's
/// `site` is that voxel's number, x fastest. Requires: arguments_problem() found none. Returns the
/// exit code.
int run_image_field(const FieldArguments& arguments);

}  // namespace blum::app
