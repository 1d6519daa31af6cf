/// What `blum` says about errors, and numbers as text.
#pragma once

#include <string>

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/result.hpp"
#include "blum/kernel/validate.hpp"

namespace blum::app {

/// The shortest decimal that reads back as the same double.
[[nodiscard]] std::string number(double value);
[[nodiscard]] std::string text(const Point3& point);

/// "2 boundary_edge" with its first elements and their coordinates.
[[nodiscard]] std::string text(const Defect& defect);

/// Prints `blum: error: <code>: <message>` to stderr and returns the exit code for it.
int report(const Error& error);
int report_usage(const std::string& message);

/// The same for a mesh that bounds no solid: one line for each class of defects.
int report_invalid(const std::string& file, const ValidationReport& validation);
/// Why build_solid refused the mesh of the file.
int report_no_solid(const Error& error, const std::string& file, const PolygonMesh& mesh);

}  // namespace blum::app
