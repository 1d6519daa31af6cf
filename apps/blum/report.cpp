#include "report.hpp"

#include <charconv>
#include <iostream>

#include "exit_code.hpp"

namespace blum::app {
namespace {

void print_error(const std::string& code, const std::string& message) {
  std::cerr << "blum: error: " << code << ": " << message << '\n';
}

}  // namespace

std::string number(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string text(const Point3& point) {
  return "(" + number(point.x) + ", " + number(point.y) + ", " + number(point.z) + ")";
}

std::string text(const Defect& defect) {
  std::string result = std::to_string(defect.count) + " " + defect_kind_name(defect.kind);
  const std::string element = defect_element_name(defect.kind);
  const char* separator = ": ";
  for (const DefectExample& example : defect.examples) {
    result += separator;
    separator = "; ";
    result += element;
    for (const std::size_t index : example.elements) result += " " + std::to_string(index);
    if (!example.points.empty()) result += " at";
    for (const Point3& point : example.points) result += " " + text(point);
  }
  if (defect.count > defect.examples.size() && !defect.examples.empty()) result += "; ...";
  return result;
}

int report(const Error& error) {
  const std::string where = error.file.empty() ? "" : error.file + ": ";
  print_error(error_code_name(error.code), where + error.message);
  switch (error.code) {
    case ErrorCode::kOutputNotWritten:
      return kOutput;
    case ErrorCode::kBadArgument:
      return kUsage;
    default:
      return kInput;
  }
}

int report_usage(const std::string& message) {
  print_error("usage", message);
  return kUsage;
}

int report_invalid(const std::string& file, const ValidationReport& validation) {
  std::size_t classes = 0;
  for (const Defect& defect : validation.defects) {
    classes += defect_severity(defect.kind) == Severity::kError;
  }
  print_error(error_code_name(ErrorCode::kInvalidSolid),
              file + ": the mesh bounds no solid (" + std::to_string(classes) +
                  (classes == 1 ? " class" : " classes") + " of defects)");
  for (const Defect& defect : validation.defects) {
    std::cerr << "  " << severity_name(defect_severity(defect.kind)) << ": " << text(defect)
              << '\n';
  }
  return kInput;
}

int report_no_solid(const Error& error, const std::string& file, const PolygonMesh& mesh) {
  return error.code == ErrorCode::kInvalidSolid ? report_invalid(file, validate_mesh(mesh))
                                                : report(error);
}

}  // namespace blum::app
