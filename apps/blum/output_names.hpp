/// Whether the files that a run is going to write can be written: asked before the work.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "blum/kernel/result.hpp"

namespace blum::app {

/// What is wrong with the names of the files, if anything: one is the model, or two are one.
[[nodiscard]] std::optional<std::string> conflict(const std::filesystem::path& model,
                                                  const std::vector<std::filesystem::path>& files);

/// Finds out before the work whether its result can be kept. (The writers check again.)
[[nodiscard]] std::optional<Error> output_problem(const std::vector<std::filesystem::path>& files);

}  // namespace blum::app
