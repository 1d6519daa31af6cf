#include "blum/medial/summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "blum/kernel/check.hpp"
#include "blum/kernel/site.hpp"

namespace blum {
namespace {

using Json = nlohmann::ordered_json;  // keys in the order of the schema

constexpr std::size_t kMostUndecidedListed = 1000;
constexpr std::size_t kMostUndecidedInText = 5;

Json coordinates(const Point3& p) { return {p.x, p.y, p.z}; }

Json undecided_cells(const std::vector<UndecidedCell>& cells) {
  Json list = Json::array();
  for (std::size_t i = 0; i < std::min(cells.size(), kMostUndecidedListed); ++i) {
    list.push_back({{"reason", undecided_reason_name(cells[i].reason)},
                    {"depth", cells[i].depth},
                    {"lo", coordinates(cells[i].box.lo)},
                    {"hi", coordinates(cells[i].box.hi)}});
  }
  return list;
}

Json to_json(const FlattenReport& report) {
  return {{"tolerance", report.tolerance},
          {"vertices_moved", report.vertices_moved},
          {"largest_displacement", report.largest_displacement},
          {"slivers_dropped", report.slivers_dropped},
          {"flat_edges_before", report.before.flat},
          {"flat_edges_after", report.after.flat},
          {"nearly_flat_edges_before", report.before.nearly_flat},
          {"nearly_flat_edges_left", report.after.nearly_flat}};
}

const char* criterion_name(Criterion criterion) {
  switch (criterion) {
    case Criterion::kStrict:
      return "strict";
    case Criterion::kDisks:
      return "disks";
    case Criterion::kRelaxed:
      break;
  }
  return "relaxed";
}

const char* side_name(VoronoiSide side) {
  switch (side) {
    case VoronoiSide::kInside:
      return "inside";
    case VoronoiSide::kOutside:
      return "outside";
    case VoronoiSide::kBoth:
      break;
  }
  return "both";
}

/// Numbers of what was not computed are null.
Json to_json(const VoronoiCheck& check, const MedialResult& result) {
  return {{"regions", check.regions},
          {"pieces_euler", check.decided ? Json(check.pieces_euler) : Json(nullptr)},
          {"euler", result.undecided.empty() ? Json(check.euler) : Json(nullptr)},
          {"criterion", criterion_name(result.criterion)},
          {"margin", result.margin},
          {"side", side_name(check.side)},
          {"regions_inside", check.regions_inside},
          {"regions_outside", check.regions_outside},
          {"solid_euler", check.solid_euler},
          {"tubes", result.tubes}};
}

/// Reasons that occur, in their order, with the number of cells.
std::map<UndecidedReason, std::size_t> by_reason(const std::vector<UndecidedCell>& cells) {
  std::map<UndecidedReason, std::size_t> count;
  for (const UndecidedCell& cell : cells) ++count[cell.reason];
  return count;
}

/// printf with its own memory: 40 formats read better here than as streams.
template <class... Values>
void append(std::string& text, const char* format, Values... values) {
  std::array<char, 512> line;
  const int length = std::snprintf(line.data(), line.size(), format, values...);
  if (length > 0) text.append(line.data(), std::min<std::size_t>(length, line.size() - 1));
}

/// "n word" or "n words".
std::string counted(std::size_t n, std::string_view word) {
  return std::to_string(n) + ' ' + std::string(word) + (n == 1 ? "" : "s");
}

void append_changes(std::string& text, const FlattenReport& report) {
  if (report.vertices_moved == 0) {
    append(text, "changed    nothing (--coplanar-tolerance %g)\n", report.tolerance);
  } else {
    append(text, "changed    %zu %s moved by at most %.3g, ", report.vertices_moved,
           report.vertices_moved == 1 ? "vertex" : "vertices", report.largest_displacement);
    text += counted(report.slivers_dropped, "sliver") + " dropped";
    append(text, " (--coplanar-tolerance %g)\n", report.tolerance);
  }
  append(text, "flat       %zu edges, before %zu; nearly flat %zu, before %zu\n", report.after.flat,
         report.before.flat, report.after.nearly_flat, report.before.nearly_flat);
}

}  // namespace

std::string summary_json(const SummaryInput& input) {
  BLUM_CHECK(input.solid != nullptr && input.result != nullptr);
  const MedialResult& r = *input.result;
  const SiteCounts sites = count_sites(*input.solid);
  Json json = {
      {"model", input.model},
      {"sites", {{"vertices", sites.vertices}, {"edges", sites.edges}, {"faces", sites.faces}}},
      {"solid", {{"betti", r.solid_betti}}},
      {"result",
       {{"mode", r.kind == DiagramKind::kMedial ? "medial" : "voronoi"},
        {"certified", r.certified},
        {"betti", r.certified ? Json(r.betti) : Json(nullptr)},
        {"sheets", r.parts.sheets},
        {"seams", r.parts.seams},
        {"junctions", r.parts.junctions},
        {"clusters", r.parts.clusters},
        {"leaves", r.leaves},
        {"max_depth", r.max_depth},
        {"undecided_cells", r.undecided.size()},
        {"hausdorff_bound", r.hausdorff_bound}}},
      {"cuts", {{"leaves", r.leaves_cut}, {"planes_tried", r.planes_tried}}},
      {"stages",
       {{"filter", r.stages.filter}, {"extended", r.stages.extended}, {"exact", r.stages.exact}}},
      {"time_s",
       {{"read", input.read_s},
        {"sites", input.sites_s},
        {"subdivide", r.time.subdivide_s},
        {"assemble", r.time.assemble_s},
        {"total", input.total_s}}},
      {"peak_memory_bytes", input.peak_memory_bytes},
      {"seed", r.seed},
      {"threads", r.threads},
      {"version", input.version},
  };
  if (r.voronoi) json["voronoi"] = to_json(*r.voronoi, r);
  if (input.flattened != nullptr) json["coplanar"] = to_json(*input.flattened);
  if (r.angles) {
    json["angles"] = {{"boxes", r.angles->boxes},
                      {"parts_wider", r.angles->wide},
                      {"widest_deg", r.angles->widest_deg},
                      {"time_s", r.time.angles_s}};
  }
  if (input.pruned != nullptr) {
    const ShapeCounts shape = count_shapes(input.pruned->complex);
    json["pruned"] = {{"theta_deg", input.theta_deg},
                      {"method", input.simplify == Simplify::kHomotopy ? "hma" : "sma"},
                      {"betti", input.pruned->betti},
                      {"sheets", shape.sheets},
                      {"seams", shape.seams},
                      {"curves", shape.curves},
                      {"junctions", shape.junctions},
                      {"area", shape.area}};
  }
  if (!r.undecided.empty()) {
    for (const auto& [reason, count] : by_reason(r.undecided)) {
      json["undecided_by_reason"][undecided_reason_name(reason)] = count;
    }
    json["undecided"] = undecided_cells(r.undecided);
  }
  for (const SummarySection& section : input.sections)
    json[section.name] = Json::parse(section.json);
  // File names need not be UTF-8: bytes that are not are replaced, never a reason to fail.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string summary_text(const SummaryInput& input) {
  BLUM_CHECK(input.solid != nullptr && input.result != nullptr);
  const MedialResult& r = *input.result;
  const SiteCounts sites = count_sites(*input.solid);
  std::string text = "model      " + input.model + '\n';
  if (input.flattened != nullptr) append_changes(text, *input.flattened);
  text += "sites      " + std::to_string(sites.vertices) + " vertices, " +
          std::to_string(sites.edges) + " edges, " + std::to_string(sites.faces) + " faces\n";
  append(text, "solid      Betti numbers %ld %ld %ld\n", r.solid_betti[0], r.solid_betti[1],
         r.solid_betti[2]);
  if (r.certified) {
    append(text, "result     certified, Betti numbers %ld %ld %ld\n", r.betti[0], r.betti[1],
           r.betti[2]);
  } else {
    text += "result     NOT certified, " + counted(r.undecided.size(), "cell") + " undecided";
    const char* separator = " (";
    for (const auto& [reason, count] : by_reason(r.undecided)) {
      text += separator + std::to_string(count) + ' ' + undecided_reason_name(reason);
      separator = ", ";
    }
    text += r.undecided.empty() ? "\n" : ")\n";
  }
  if (r.voronoi) {
    const VoronoiCheck& v = *r.voronoi;
    if (v.side != VoronoiSide::kBoth)
      append(text, "side       %s: regions of %zu edges and vertices\n", side_name(v.side),
             v.side == VoronoiSide::kInside ? v.regions_inside : v.regions_outside);
    append(text, "voronoi    Euler characteristic %ld, %zu regions, ", v.euler, v.regions);
    if (v.decided)
      append(text, "%ld on the box: %s\n", v.pieces_euler,
             v.holds() ? "the formula holds" : "the formula does not hold");
    else
      text += "sides of the box undecided\n";
  }
  text += "parts      " + counted(r.parts.sheets, "sheet") + ", " + counted(r.parts.seams, "seam") +
          ", " + counted(r.parts.junctions, "junction") + ", " +
          counted(r.parts.clusters, "cluster") + '\n';
  text += "cells      " + counted(r.leaves, "leaf cell") + ", deepest " +
          counted(static_cast<std::size_t>(r.max_depth), "bisection");
  if (r.leaves_cut > 0)
    append(text, "; %zu cut by planes, %zu tried", r.leaves_cut, r.planes_tried);
  if (r.tubes > 0) append(text, "; a region passes through %zu", r.tubes);
  text += '\n';
  if (std::isfinite(r.hausdorff_bound))
    append(text, "accuracy   Hausdorff distance at most %.6g\n", r.hausdorff_bound);

  if (r.angles) {
    append(text,
           "angles     widest interval %.3g degrees, %zu parts wider than asked for; %.3f s\n",
           r.angles->widest_deg, r.angles->wide, r.time.angles_s);
  }
  if (input.pruned != nullptr) {
    const ShapeCounts shape = count_shapes(input.pruned->complex);
    append(text, "pruned     theta %g (%s): ", input.theta_deg,
           input.simplify == Simplify::kHomotopy ? "hma" : "sma");
    text += counted(shape.sheets, "sheet") + ", " + counted(shape.seams, "seam") + ", " +
            counted(shape.curves, "curve") + ", " + counted(shape.junctions, "junction");
    append(text, ", Betti numbers %ld %ld %ld\n", input.pruned->betti[0], input.pruned->betti[1],
           input.pruned->betti[2]);
  }

  for (const SummarySection& section : input.sections) text += section.text;

  const double decisions =
      static_cast<double>(r.stages.filter + r.stages.extended + r.stages.exact);
  if (decisions > 0) {
    append(text, "decisions  %.0f: filter %.3f %%, extended %.3f %%, exact %.3f %%\n", decisions,
           100 * static_cast<double>(r.stages.filter) / decisions,
           100 * static_cast<double>(r.stages.extended) / decisions,
           100 * static_cast<double>(r.stages.exact) / decisions);
  }
  append(text, "time       %.3f s: read %.3f, sites %.3f, subdivide %.3f, assemble %.3f; %s\n",
         input.total_s, input.read_s, input.sites_s, r.time.subdivide_s, r.time.assemble_s,
         counted(static_cast<std::size_t>(r.threads), "thread").c_str());
  append(text, "memory     %.1f MB at most\n", static_cast<double>(input.peak_memory_bytes) / 1e6);

  for (std::size_t i = 0; i < std::min(r.undecided.size(), kMostUndecidedInText); ++i) {
    const auto& [box, reason, depth] = r.undecided[i];
    append(text, "undecided  (%.9g, %.9g, %.9g) to (%.9g, %.9g, %.9g): %s, depth %d\n", box.lo.x,
           box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z, undecided_reason_name(reason), depth);
  }
  if (r.undecided.size() > kMostUndecidedInText) {
    text +=
        "undecided  and " + std::to_string(r.undecided.size() - kMostUndecidedInText) + " more\n";
  }
  return text;
}

}  // namespace blum
