/// The command line of `blum field`.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "blum/gpu/field.hpp"

namespace blum::app {

struct FieldArguments {
  std::string model, output, slice;
  std::vector<std::uint32_t> resolution;  // one number (along the longest side), or three
  std::vector<double> box;                // six numbers, or none
  std::uint32_t order = 1;
  bool is_signed = false, is_dry_run = false;
  int slice_axis = 2;
  std::optional<std::uint32_t> slice_index;
  std::optional<FieldBackend> backend;  // none: auto
  std::vector<std::string> culling;     // names; empty: the default
  std::optional<FieldMethod> method;    // of OpenGL, as are the meshes' errors
  std::optional<double> mesh_error;
  std::optional<double> threshold;  // of voxel images
  FieldOptions options;             // backend, method, mesh_error and culling by resolve_backend
};

void add_field_options(CLI::App& command, FieldArguments& arguments);

/// Fills in the options that it decides; says why the backend is the one it is.
/// Errors: the backend asked for has no driver (the options are filled in all the same).
[[nodiscard]] Result<std::string> resolve_backend(FieldArguments& arguments);

/// What is wrong with the command line, beyond what CLI11 finds; empty if nothing.
[[nodiscard]] std::string arguments_problem(const FieldArguments& arguments);
/// The same of the options that resolve_backend has filled in.
[[nodiscard]] std::string resolved_problem(const FieldArguments& arguments);

/// The same of --slice-index, once the size of the grid is known.
[[nodiscard]] std::string slice_problem(const FieldArguments& arguments,
                                        const std::array<std::uint32_t, 3>& size);

/// The grid asked for: the given box, or the model's with a tenth more on every side.
[[nodiscard]] Result<VoxelGrid> grid_of(const FieldArguments& arguments, const Box3& model);

}  // namespace blum::app
