/// A scene as one self-contained HTML page to turn around and look into.
#pragma once

#include <filesystem>
#include <optional>

#include "blum/kernel/result.hpp"
#include "blum/show/camera.hpp"
#include "blum/show/scene.hpp"

namespace blum {

/// Writes the page, with three.js and the data (arrays in base64) inside: nothing is loaded from
/// anywhere. Coordinates are rounded to floats about the centre of the scene, in a unit as large as
/// that; other values to floats where those hold them, those of the filtration not at all. Error:
/// kOutputNotWritten.
[[nodiscard]] std::optional<Error> write_page(const Scene& scene, const Camera& camera,
                                              const std::filesystem::path& file);

}  // namespace blum
