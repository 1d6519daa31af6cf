#include "blum/placement/feet.hpp"

#include <cmath>
#include <map>
#include <tuple>

#include "blum/kernel/closest_point.hpp"
#include "blum/kernel/output_files.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "blum/kernel/vtk_xml.hpp"

namespace blum {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
constexpr double kFootTolerance = 1e-9;  // working units

struct Corner {
  Point3 foot;  // working frame
  SiteId site;
};

Corner corner_on(const SiteGeometry& geometry, const SiteGroup& side, const Point3& x) {
  Corner best;
  double least = std::numeric_limits<double>::infinity();
  for (const SiteId s : side) {
    const Point3 y = closest_point(geometry, s, x);
    const double d = distance_between(x, y);
    if (d < least) {
      least = d;
      best = {y, s};
    }
  }
  return best;
}

/// Images of one triangle: by side as its leaf names them, corners in order, then the centre.
using Images = std::array<std::array<Corner, 4>, 2>;

class FeetFinder {
 public:
  FeetFinder(const AxisPlacement& placement, const Parts& parts)
      : geometry_(placement.geometry()),
        mesh_(placement.mesh()),
        sides_(placement.sides()),
        parts_(parts) {}

  SheetFeet run() {
    const auto& complex = mesh_.complex;
    for (const ComplexTriangle& t : complex.triangle) images_.push_back(images_of(t));
    swapped_.assign(images_.size(), false);
    orient();
    SheetFeet feet;
    feet.one_sided = one_sided_;
    // Feet of one vertex are shared by the triangles of one sheet where they are the same.
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint8_t, std::uint32_t>, std::uint32_t>
        known;
    for (std::uint32_t t = 0; t < images_.size(); ++t) {
      const auto corner = corners(complex, complex.triangle[t]);
      const auto sheet = parts_.triangle_sheet[mesh_.triangle[t]];
      for (const std::uint8_t side : {0, 1}) {
        const auto& image = images_[t][swapped_[t] ? 1u - side : side];
        SheetFeet::Patch patch;
        patch.triangle = t;
        patch.side = side;
        patch.site = image[3].site;
        for (std::size_t k = 0; k < 3; ++k) {
          const auto [it, fresh] = known.try_emplace({corner[k], sheet, side, image[k].site.value},
                                                     static_cast<std::uint32_t>(feet.foot.size()));
          if (fresh) feet.foot.push_back(foot_of(image[k], corner[k]));
          patch.foot[k] = it->second;
        }
        feet.patch.push_back(patch);
      }
    }
    return feet;
  }

 private:
  [[nodiscard]] SheetFeet::Foot foot_of(const Corner& corner, std::uint32_t vertex) const {
    const Frame& frame = geometry_.solid().frame;
    const ComplexVertex& v = mesh_.complex.vertex[vertex];
    const double way = distance_between(corner.foot, frame.to_working(v.position));
    return {frame.to_model(corner.foot), vertex, corner.site,
            std::abs(way - frame.length_to_working(v.radius)) <= kFootTolerance};
  }
  Images images_of(const ComplexTriangle& t) {
    const auto side = sides_[t.cone]->sides_of(t.governors);
    one_side_.push_back(side.size() < 2);
    std::array<Point3, 4> x;
    const auto corner = corners(mesh_.complex, t);
    for (std::size_t k = 0; k < 3; ++k)
      x[k] = geometry_.solid().frame.to_working(mesh_.complex.vertex[corner[k]].position);
    x[3] = (1.0 / 3) * (x[0] + x[1] + x[2]);
    Images images;
    for (std::size_t k = 0; k < 4; ++k) {
      images[0][k] = corner_on(geometry_, side.front(), x[k]);
      images[1][k] = corner_on(geometry_, side.back(), x[k]);
    }
    return images;
  }

  /// Does side 0 of `t` go on as side 1 of `u` across their common edge?
  [[nodiscard]] bool turned(std::uint32_t t, std::uint32_t u) const {
    const auto& triangle = mesh_.complex.triangle;
    const auto a = corners(mesh_.complex, triangle[t]), b = corners(mesh_.complex, triangle[u]);
    double same = 0, other = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        if (a[i] != b[j]) continue;
        for (const std::size_t side : {0u, 1u}) {
          same += distance_between(images_[t][side][i].foot, images_[u][side][j].foot);
          other += distance_between(images_[t][side][i].foot, images_[u][1 - side][j].foot);
        }
      }
    if (same != other) return other < same;
    // The common edge is a rim's, where the sides meet.
    const auto gap = [&](std::size_t side) {
      return distance_between(images_[t][0][3].foot, images_[u][side][3].foot) +
             distance_between(images_[t][1][3].foot, images_[u][1 - side][3].foot);
    };
    return gap(1) < gap(0);
  }

  void orient() {
    const auto& complex = mesh_.complex;
    std::vector<std::array<std::uint32_t, 2>> beside(complex.edge.size(), {kNone, kNone});
    std::vector<bool> done(complex.triangle.size(), false), bad(parts_.sheets, false);
    for (std::uint32_t t = 0; t < complex.triangle.size(); ++t) {
      for (const auto e : complex.triangle[t].edge) beside[e][beside[e][0] == kNone ? 0 : 1] = t;
      if (one_side_[t]) bad[parts_.triangle_sheet[mesh_.triangle[t]]] = true;
    }
    for (std::uint32_t root = 0; root < done.size(); ++root) {
      if (done[root]) continue;
      std::vector<std::uint32_t> stack{root};
      done[root] = true;
      while (!stack.empty()) {
        const auto t = stack.back();
        stack.pop_back();
        for (const auto e : complex.triangle[t].edge) {
          const CellOrigin& o = mesh_.edge[e];
          if (o.dimension == 1 && parts_.edge_seam[o.cell] != Parts::kNoSeam) continue;
          const auto u = beside[e][0] == t ? beside[e][1] : beside[e][0];
          if (u == kNone || u == t) continue;
          const bool wanted = swapped_[t] != turned(t, u);
          if (!done[u]) {
            done[u] = true;
            swapped_[u] = wanted;
            stack.push_back(u);
          } else if (swapped_[u] != wanted) {
            bad[parts_.triangle_sheet[mesh_.triangle[t]]] = true;
          }
        }
      }
    }
    for (const bool b : bad) one_sided_ += b ? 1 : 0;
  }

  const SiteGeometry& geometry_;
  const AxisMesh& mesh_;
  const ConeSides& sides_;
  const Parts& parts_;
  std::vector<Images> images_;
  std::vector<bool> swapped_;
  std::vector<bool> one_side_;  // by triangle: its leaf knows one side only
  std::size_t one_sided_ = 0;
};

}  // namespace

SheetFeet sheet_feet(const AxisPlacement& placement, const Parts& parts) {
  return FeetFinder(placement, parts).run();
}

std::optional<Error> write_feet(const SheetFeet& feet, const Parts& sheets, const Solid& solid,
                                const std::filesystem::path& file) {
  using detail::DataArray;
  using detail::OutputStream;
  const SiteIndex index(solid);
  const auto write = [&](OutputStream& out) {
    const std::size_t cells = feet.patch.size();
    const auto cell_array = [&]<class T>(T, const char* name, auto&& value) {
      DataArray<T> array(out, name, cells);
      for (const SheetFeet::Patch& p : feet.patch) array.put(value(p));
    };
    out << detail::vtp_head() << "<FieldData>\n";
    DataArray<std::int64_t>(out, "one_sided", 1).put(feet.one_sided);
    out << "</FieldData>\n<Piece NumberOfPoints=\"" << feet.foot.size()
        << "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\""
        << cells << "\">\n<PointData>\n";
    {
      DataArray<std::int64_t> array(out, "axis_point", feet.foot.size());
      for (const auto& f : feet.foot) array.put(f.axis_point);
    }
    {
      DataArray<std::int64_t> array(out, "site", feet.foot.size());
      for (const auto& f : feet.foot) array.put(f.site.value);
    }
    {
      DataArray<std::uint8_t> array(out, "is_foot", feet.foot.size());
      for (const auto& f : feet.foot) array.put(f.is_foot ? 1 : 0);
    }
    out << "</PointData>\n<CellData Scalars=\"sheet\">\n";
    cell_array(std::int32_t{}, "sheet", [&](const auto& p) {
      return static_cast<std::int32_t>(sheets.triangle_sheet[p.triangle]);
    });
    cell_array(std::uint8_t{}, "side", [](const auto& p) { return p.side; });
    cell_array(std::int64_t{}, "axis_triangle", [](const auto& p) { return p.triangle; });
    cell_array(std::int64_t{}, "site", [](const auto& p) { return p.site.value; });
    cell_array(std::int64_t{}, "element", [&](const auto& p) { return index.element(p.site); });
    cell_array(std::uint8_t{}, "element_kind", [&](const auto& p) {
      const SiteKind kind = index.kind(p.site);
      return kind == SiteKind::kVertex ? 0 : kind == SiteKind::kEdge ? 1 : 2;
    });
    out << "</CellData>\n<Points>\n";
    {
      DataArray<double> array(out, "Points", feet.foot.size(), 3);
      for (const auto& f : feet.foot) array.put(f.position);
    }
    out << "</Points>\n<Polys>\n";
    {
      DataArray<std::int64_t> array(out, "connectivity", 3 * cells);
      for (const auto& p : feet.patch)
        for (const auto f : p.foot) array.put(f);
    }
    detail::put_offsets(out, cells, 3);
    out << "</Polys>\n</Piece>\n" << detail::kVtpTail;
  };
  const detail::OutputFile output{file, write};
  return detail::write_files(std::span(&output, 1));
}

}  // namespace blum
