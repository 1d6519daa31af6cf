/// Fields as OpenVDB files, where the program was built with OpenVDB.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "blum/gpu/field_io.hpp"

namespace blum::app {

[[nodiscard]] bool has_vdb();
/// Why this run can write no .vdb file (built without OpenVDB, or blum-vdb.so is not beside the
/// program); empty: it can. Loads OpenVDB.
[[nodiscard]] std::string why_no_vdb();
[[nodiscard]] bool is_vdb(const std::filesystem::path& file);

/// The files that write_field_file would write; empty if it does not know the extension.
[[nodiscard]] std::vector<std::filesystem::path> output_files(const std::filesystem::path& file);

/// As write_field, and .vdb: a DoubleGrid `distance` and an Int32Grid `site` (order 1 alone),
/// active where there is a site, else infinity, -infinity inside; world coordinates are the
/// model's, samples are voxel centres.
[[nodiscard]] std::optional<Error> write_field_file(const FieldImage& image,
                                                    const std::filesystem::path& file);

}  // namespace blum::app
