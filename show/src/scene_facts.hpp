/// What people are told of a result besides its picture.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "blum/show/scene.hpp"
#include "blum/show/vtp_file.hpp"

namespace blum::detail {

using Facts = std::vector<std::array<std::string, 2>>;

/// What the file itself says. `scene` is what has been read of it.
[[nodiscard]] Facts facts_of(const VtpFile& file, const Scene& scene);

/// The model's name, which the file does not hold, from the summary of the run that wrote it: the
/// file of that name, if it is there and has the same seed and number of faces.
[[nodiscard]] std::optional<std::string> title_of(const VtpFile& file, const Scene& scene,
                                                  const std::filesystem::path& summary_file);

}  // namespace blum::detail
