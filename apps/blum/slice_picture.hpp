/// A slice of a field as a PNG picture.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "blum/gpu/field_io.hpp"
#include "blum/kernel/result.hpp"

namespace blum::app {

/// Voxels position[axis] == index as pixels, first remaining axis to the right, second upwards;
/// absolute distances from 0 to the slice's largest in the colours of "viridis" (perceptually
/// uniform, dark near the surface), samples without distance grey, the inside's edge white.
/// Of several distances a voxel the first. Errors: kOutputNotWritten.
[[nodiscard]] std::optional<Error> write_slice(const FieldImage& image, int axis,
                                               std::uint32_t index,
                                               const std::filesystem::path& file);

}  // namespace blum::app
