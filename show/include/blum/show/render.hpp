/// A picture of a scene, drawn in software: no display, no GPU, no OpenGL.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "blum/kernel/result.hpp"
#include "blum/show/camera.hpp"
#include "blum/show/scene.hpp"

namespace blum {

struct Section {
  int axis = 0;       ///< orthogonal to x, y or z (0, 1, 2)
  double at = 0.5;    ///< from 0 to 1 through the scene's box
  bool flip = false;  ///< false: what is below the plane is shown
};

struct RenderOptions {
  Camera camera;
  int width = 1200, height = 900;  ///< pixels
  double zoom = 1;                 ///< 2: everything twice as large
  std::string colour;              ///< name of a field; empty: the first
  double theta_deg = 0;            ///< the axis simplified by this angle
  bool model = true, sheets = true, seams = true, rims = true, undecided = true, legend = true;
  std::optional<Section> section;
  int threads = 1;  ///< the picture does not depend on it
};

/// What a picture shows, for tests and people.
struct RenderReport {
  std::size_t triangles = 0;    ///< visible cells
  double covered_fraction = 0;  ///< of the pixels that are not background, legend apart
};

/// Draws and writes a PNG file. Nine samples a pixel; faces of the model are translucent and drawn
/// in the exact order of depth. Equal scenes and options give equal pixels, text of the legend
/// apart, for which the system's fonts are used. Errors: kBadArgument (size, zoom, unknown field,
/// empty section), kOutputNotWritten.
[[nodiscard]] Result<RenderReport> render_png(const Scene& scene, const RenderOptions& options,
                                              const std::filesystem::path& file);

}  // namespace blum
