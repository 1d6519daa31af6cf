#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "blum/kernel/vtk_xml.hpp"
#include "blum/medial/subcomplex.hpp"
#include "io_formats.hpp"

namespace blum::detail {
namespace {

class VtpWriter {
 public:
  VtpWriter(OutputStream& out, const MedialResult& result, const Solid& solid)
      : out_(out), result_(result), k_(result.complex), solid_(solid), line_(drawn_edges(result)) {}

  void write() {
    out_ << vtp_head() << "<FieldData>\n";
    field_data();
    out_ << "</FieldData>\n<Piece NumberOfPoints=\"" << k_.vertex.size()
         << "\" NumberOfVerts=\"0\" NumberOfLines=\"" << line_.size()
         << "\" NumberOfStrips=\"0\" NumberOfPolys=\"" << k_.triangle.size()
         << "\">\n<PointData Scalars=\"radius\">\n";
    point_data();
    out_ << "</PointData>\n<CellData Scalars=\"sheet\">\n";
    cell_data();
    out_ << "</CellData>\n<Points>\n";
    points();
    out_ << "</Points>\n<Lines>\n";
    lines();
    out_ << "</Lines>\n<Polys>\n";
    polys();
    out_ << "</Polys>\n</Piece>\n" << kVtpTail;
  }

 private:
  using Int = std::int64_t;

  void field_data() {
    governors();
    solid();
    undecided();
    edges();
    DataArray<std::uint8_t>(out_, "certified", 1)
        .put(result_.certified && !result_.smoothed ? 1 : 0);
    DataArray<std::uint64_t>(out_, "seed", 1).put(result_.seed);
    shape();
  }

  /// Sheets keep their numbers when others are left out, and are left out whole; nothing is left
  /// out unless a sheet is (simplified()).
  [[nodiscard]] bool is_part() const {
    std::vector<bool> there(result_.parts.sheets, false);
    for (const std::uint32_t sheet : result_.parts.triangle_sheet) there[sheet] = true;
    return std::find(there.begin(), there.end(), false) != there.end();
  }

  /// Of what is in the file, which the summary of the run need not be about.
  void shape() {
    const bool part = is_part();
    const auto number = [this](const char* name, std::size_t n) {
      DataArray<Int>(out_, name, 1).put(n);
    };
    DataArray<std::uint8_t>(out_, "pruned", 1).put(part ? 1 : 0);
    if (result_.certified) {
      DataArray<Int> array(out_, "betti", 1, 3);
      for (const long b : result_.betti) array.put(b);
    }
    if (part) {
      const ShapeCounts counts = count_shapes(k_);
      number("sheets", counts.sheets);
      number("seams", counts.seams);
      number("junctions", counts.junctions);
      return;  // clusters are those of the whole, and so is the bound
    }
    const Parts& parts = result_.parts;
    number("sheets", parts.sheets);
    number("seams", parts.seams);
    number("junctions", parts.junctions);
    number("clusters", parts.clusters);
    if (result_.certified && !result_.smoothed && std::isfinite(result_.hausdorff_bound)) {
      DataArray<double>(out_, "hausdorff_bound", 1).put(result_.hausdorff_bound);
    }
  }

  void governors() {
    std::size_t all = 0;
    {
      DataArray<Int> array(out_, "governor_offset", k_.vertex.size() + 1);
      array.put(0);
      for (const ComplexVertex& v : k_.vertex) array.put(all += v.governors.size());
    }
    DataArray<Int> array(out_, "governor", all);
    for (const ComplexVertex& v : k_.vertex) {
      for (const SiteId s : v.governors) array.put(s.value);
    }
  }

  void solid() {
    {
      DataArray<Int> array(out_, "site_counts", 3);
      array.put(solid_.point.size());
      array.put(solid_.edge.size());
      array.put(solid_.triangle.size());
    }
    {
      DataArray<double> array(out_, "solid_points", solid_.point.size(), 3);
      for (const Point3& p : solid_.point) array.put(solid_.frame.to_model(p));
    }
    {
      DataArray<Int> array(out_, "solid_edges", solid_.edge.size(), 2);
      for (const SolidEdge& e : solid_.edge) {
        for (const std::uint32_t v : e.vertex) array.put(v);
      }
    }
    DataArray<Int> array(out_, "solid_triangles", solid_.triangle.size(), 3);
    for (const SolidTriangle& t : solid_.triangle) {
      for (const std::uint32_t v : t.vertex) array.put(v);
    }
  }

  void undecided() {
    {
      DataArray<double> array(out_, "undecided_box", result_.undecided.size(), 6);
      for (const UndecidedCell& cell : result_.undecided) {
        array.put(cell.box.lo);
        array.put(cell.box.hi);
      }
    }
    DataArray<std::uint8_t> array(out_, "undecided_reason", result_.undecided.size());
    for (const UndecidedCell& cell : result_.undecided) array.put(cell.reason);
  }

  /// Edges are not told by their ends: two may have the same.
  void edges() {
    {
      DataArray<std::uint32_t> array(out_, "line_edge", line_.size());
      for (const std::uint32_t e : line_) array.put(e);
    }
    DataArray<std::uint32_t> array(out_, "triangle_edge", k_.triangle.size(), 3);
    for (const ComplexTriangle& t : k_.triangle) {
      for (const std::uint32_t e : t.edge) array.put(e);
    }
  }

  void point_data() {
    {
      DataArray<double> array(out_, "radius", k_.vertex.size());
      for (const ComplexVertex& v : k_.vertex) array.put(v.radius);
    }
    {
      DataArray<std::uint8_t> array(out_, "on_axis", k_.vertex.size());
      for (const ComplexVertex& v : k_.vertex) array.put(v.on_axis ? 1 : 0);
    }
    {
      DataArray<std::uint8_t> array(out_, "kind", k_.vertex.size());
      for (const ComplexVertex& v : k_.vertex) array.put(v.kind);
    }
    if (!result_.angles) return;
    {
      DataArray<double> array(out_, "angle_lo", k_.vertex.size());
      for (const AngleInterval& i : result_.angles->vertex) array.put(i.lo);
    }
    {
      DataArray<double> array(out_, "angle_hi", k_.vertex.size());
      for (const AngleInterval& i : result_.angles->vertex) array.put(i.hi);
    }
    DataArray<double> array(out_, "theta", k_.vertex.size());
    for (const double v : result_.filtration->value.vertex) array.put(v);
  }

  /// Cells are the lines, then the triangles. `of_line` and `of_triangle` give the values.
  template <class T, class OfLine, class OfTriangle>
  void cell_array(std::string_view name, OfLine of_line, OfTriangle of_triangle) {
    DataArray<T> array(out_, name, line_.size() + k_.triangle.size());
    for (const std::uint32_t e : line_) array.put(of_line(e));
    for (std::size_t t = 0; t < k_.triangle.size(); ++t) array.put(of_triangle(t));
  }

  void cell_data() {
    const Parts& parts = result_.parts;
    const auto seam = [&](std::size_t e) -> std::int32_t {
      const bool is_seam = e < parts.edge_seam.size() && parts.edge_seam[e] != Parts::kNoSeam;
      return is_seam ? static_cast<std::int32_t>(parts.edge_seam[e]) : -1;
    };
    const auto sheet = [&](std::size_t t) -> std::int32_t {
      return t < parts.triangle_sheet.size() ? static_cast<std::int32_t>(parts.triangle_sheet[t])
                                             : -1;
    };
    const auto none = [](std::size_t) { return -1; };
    cell_array<std::int32_t>("sheet", none, sheet);
    cell_array<std::int32_t>("seam", seam, none);

    // A rim or convex edge belongs to one triangle and takes its governors.
    std::vector<const ComplexTriangle*> beside(k_.edge.size(), nullptr);
    for (const ComplexTriangle& t : k_.triangle) {
      for (const std::uint32_t e : t.edge) beside[e] = &t;
    }
    for (const std::size_t side : {0u, 1u}) {
      cell_array<Int>(
          side == 0 ? "governor_a" : "governor_b",
          [&](std::size_t e) -> Int {
            const bool alone = seam(e) < 0 && beside[e] != nullptr;
            return alone ? static_cast<Int>(beside[e]->governors[side].value) : -1;
          },
          [&](std::size_t t) -> Int { return k_.triangle[t].governors[side].value; });
    }
    angles(beside);
  }

  void angles(const std::vector<const ComplexTriangle*>& beside) {
    if (!result_.angles) return;
    const PartAngles& angles = *result_.angles;
    const auto of_line = [&](std::size_t e) -> AngleInterval {
      const auto seam = result_.parts.edge_seam[e];
      if (seam != Parts::kNoSeam) return angles.seam[seam];
      if (k_.edge[e].kind == ComplexEdge::Kind::kConvexEdge || beside[e] == nullptr) return {0, 0};
      return angles.sheet[result_.parts.triangle_sheet[static_cast<std::size_t>(
          beside[e] - k_.triangle.data())]];
    };
    const auto of_triangle = [&](std::size_t t) {
      return angles.sheet[result_.parts.triangle_sheet[t]];
    };
    cell_array<double>(
        "angle_lo", [&](std::size_t e) { return of_line(e).lo; },
        [&](std::size_t t) { return of_triangle(t).lo; });
    cell_array<double>(
        "angle_hi", [&](std::size_t e) { return of_line(e).hi; },
        [&](std::size_t t) { return of_triangle(t).hi; });
    const CellValues& value = result_.filtration->value;
    cell_array<double>(
        "theta", [&](std::size_t e) { return value.edge[e]; },
        [&](std::size_t t) { return value.triangle[t]; });
  }

  void points() {
    DataArray<double> array(out_, "Points", k_.vertex.size(), 3);
    for (const ComplexVertex& v : k_.vertex) array.put(v.position);
  }

  void lines() {
    {
      DataArray<Int> array(out_, "connectivity", 2 * line_.size());
      for (const std::uint32_t e : line_) {
        for (const std::uint32_t v : k_.edge[e].vertex) array.put(v);
      }
    }
    put_offsets(out_, line_.size(), 2);
  }

  void polys() {
    {
      DataArray<Int> array(out_, "connectivity", 3 * k_.triangle.size());
      for (const ComplexTriangle& t : k_.triangle) {
        for (const std::uint32_t v : corners(k_, t)) array.put(v);
      }
    }
    put_offsets(out_, k_.triangle.size(), 3);
  }

  OutputStream& out_;
  const MedialResult& result_;
  const CellComplex& k_;
  const Solid& solid_;
  std::vector<std::uint32_t> line_;
};

}  // namespace

void put_vtp(OutputStream& out, const MedialResult& result, const Solid& solid) {
  VtpWriter(out, result, solid).write();
}

}  // namespace blum::detail
