/// What has to hold for whatever a mesh reader returns.
#pragma once

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/result.hpp"

namespace blum::fuzz {

/// Aborts unless `read` is an error with a message, or a mesh within the readers' promises that all
/// formats with doubles give back bit for bit, and that validation survives.
void check_read(const Result<PolygonMesh>& read);

}  // namespace blum::fuzz
