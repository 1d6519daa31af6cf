/// The camera's options, the same in view and render.
#pragma once

#include <CLI/CLI.hpp>

#include "blum/show/camera.hpp"

namespace blum::app {

void add_camera_options(CLI::App& command, Camera& camera);

}  // namespace blum::app
