/// The plug-in that knows OpenVDB: a shared library of its own, which the tool loads for .vdb files
/// alone, because the 69,000 relocations of libopenvdb would cost each start of it 50 ms.
#pragma once

#include <string>

#include "blum/gpu/field_io.hpp"

/// `bytes` becomes the file: a DoubleGrid `distance` and an
/// Int32Grid `site`. Precondition: image.order == 1.
extern "C" void blum_vdb_bytes(const blum::FieldImage& image, std::string& bytes);
