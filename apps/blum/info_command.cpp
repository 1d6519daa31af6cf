// `blum info`: what a mesh is, and what is wrong with it.
#include <iostream>
#include <nlohmann/json.hpp>

#include "blum/kernel/info.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "report.hpp"

namespace blum::app {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Point3& point) { return {point.x, point.y, point.z}; }

Json to_json(const Defect& defect) {
  Json examples = Json::array();
  for (const DefectExample& example : defect.examples) {
    Json points = Json::array();
    for (const Point3& point : example.points) points.push_back(to_json(point));
    examples.push_back({{"elements", example.elements}, {"points", points}});
  }
  return {{"code", defect_kind_name(defect.kind)},
          {"severity", severity_name(defect_severity(defect.kind))},
          {"count", defect.count},
          {"element", defect_element_name(defect.kind)},
          {"examples", examples}};
}

Json to_json(const MeshInfo::SolidInfo& solid) {
  return {{"components", solid.components},
          {"shells", solid.shells},
          {"voids", solid.voids},
          {"genus_per_shell", solid.genus_per_shell},
          {"betti", solid.betti},
          {"facets", solid.facets},
          {"edges", solid.triangle_edges},
          {"convex_edges", solid.convex_edges},
          {"reflex_edges", solid.reflex_edges},
          {"coplanar_pairs", solid.coplanar_pairs},
          {"nearly_coplanar_pairs", solid.nearly_coplanar_pairs},
          {"degenerate_vertices", solid.degenerate_vertices},
          {"min_dihedral_deg", solid.min_dihedral_deg},
          {"max_dihedral_deg", solid.max_dihedral_deg},
          {"volume", solid.volume}};
}

Json to_json(const std::string& model, const MeshInfo& info) {
  Json box;
  if (info.bounding_box) {
    box = {{"min", to_json(info.bounding_box->lo)}, {"max", to_json(info.bounding_box->hi)}};
  }
  Json defects = Json::array();
  for (const Defect& defect : info.validation.defects) defects.push_back(to_json(defect));
  return {{"model", model},
          {"valid", info.validation.valid()},
          {"mesh",
           {{"vertices", info.vertices},
            {"edges", info.edges},
            {"faces", info.faces},
            {"polygon_faces", info.polygon_faces},
            {"triangles", info.triangles},
            {"short_edges", info.short_edges},
            {"shortest_edge_over_diagonal", info.shortest_edge_over_diagonal}}},
          {"bounding_box", box},
          {"defects", defects},
          {"warnings", info.warnings},
          {"solid", info.solid ? to_json(*info.solid) : Json()}};
}

Json to_json(const Error& error) {
  Json element = error.element ? Json(*error.element) : Json();
  return {{"error",
           {{"code", error_code_name(error.code)},
            {"message", error.message},
            {"file", error.file},
            {"element", element}}}};
}

void print(const Json& json) {
  // File names need not be UTF-8.
  std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

std::ostream& row(const char* name) {
  std::string label = std::string(name) + ":";
  label.resize(17, ' ');
  return std::cout << label;
}

void print(const MeshInfo::SolidInfo& solid) {
  row("Betti numbers") << solid.betti[0] << ' ' << solid.betti[1] << ' ' << solid.betti[2]
                       << " (components, tunnels, voids)\n";
  row("shells") << solid.shells << " (" << solid.voids << " bound voids), genus";
  for (const int genus : solid.genus_per_shell) std::cout << ' ' << genus;
  std::cout << '\n';
  row("facets") << solid.facets << " (maximal sets of exactly coplanar neighbours)\n";
  row("edges") << solid.triangle_edges << " of the triangulation: " << solid.convex_edges
               << " convex, " << solid.reflex_edges << " reflex, "
               << solid.triangle_edges - solid.convex_edges - solid.reflex_edges << " flat\n";
  row("flat pairs") << solid.coplanar_pairs << " adjacent faces are exactly coplanar, "
                    << solid.nearly_coplanar_pairs - solid.coplanar_pairs
                    << " more within 1e-4 degrees\n";
  row("dihedral angles") << number(solid.min_dihedral_deg) << " .. "
                         << number(solid.max_dihedral_deg) << " degrees\n";
  row("volume") << number(solid.volume) << '\n';
}

void print(const std::string& model, const MeshInfo& info) {
  row("model") << model << '\n';
  row("mesh") << info.vertices << " vertices, " << info.edges << " edges, " << info.faces
              << " faces (" << info.polygon_faces << " not triangles)\n";
  if (info.bounding_box) {
    row("bounding box") << text(info.bounding_box->lo) << " .. " << text(info.bounding_box->hi)
                        << '\n';
  }
  row("valid solid") << (info.validation.valid() ? "yes" : "no") << '\n';
  for (const Defect& defect : info.validation.defects) {
    row(severity_name(defect_severity(defect.kind))) << text(defect) << '\n';
  }
  for (const std::string& warning : info.warnings) row("warning") << warning << '\n';
  if (info.solid) print(*info.solid);
}

int run_info(const std::string& model, bool as_json) {
  const Result<PolygonMesh> mesh = read_mesh(model);
  if (!mesh) {
    if (as_json) print(to_json(mesh.error()));
    return report(mesh.error());
  }
  const MeshInfo info = mesh_info(mesh.value());
  if (as_json) {
    print(to_json(model, info));
  } else {
    print(model, info);
  }
  return info.validation.valid() ? kSuccess : report_invalid(model, info.validation);
}

}  // namespace

Command add_info_command(CLI::App& app) {
  CLI::App* info = app.add_subcommand("info", "Is a mesh a solid? Counts, topology, defects");
  struct Arguments {
    std::string model;
    bool as_json = false;
  };
  const auto arguments = std::make_shared<Arguments>();
  info->add_option("MODEL", arguments->model, "OFF, OBJ, STL or PLY")->required();
  info->add_flag("--json", arguments->as_json, "Machine-readable output, also of defects");
  info->footer("Examples:\n  blum info part.stl\n  blum info part.stl --json | jq .solid.betti");
  return [arguments] { return run_info(arguments->model, arguments->as_json); };
}

}  // namespace blum::app
