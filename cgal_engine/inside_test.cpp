#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "labelled_cells.hpp"

namespace blum::cgal {

using Kernel = CGAL::Simple_cartesian<Rational>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

struct InsideTest::Impl {
  Mesh mesh;
  std::unique_ptr<CGAL::Side_of_triangle_mesh<Mesh, Kernel>> side;
};

InsideTest::InsideTest(const Solid& solid) : impl_(std::make_unique<Impl>()) {
  std::vector<Mesh::Vertex_index> v;
  for (const Point3& p : solid.point)
    v.push_back(impl_->mesh.add_vertex({Rational(p.x), Rational(p.y), Rational(p.z)}));
  for (const SolidTriangle& t : solid.triangle)
    if (impl_->mesh.add_face(v[t.vertex[0]], v[t.vertex[1]], v[t.vertex[2]]) == Mesh::null_face())
      throw std::invalid_argument("the solid's boundary is no mesh to CGAL");
  impl_->side = std::make_unique<CGAL::Side_of_triangle_mesh<Mesh, Kernel>>(impl_->mesh);
}

InsideTest::~InsideTest() = default;

bool InsideTest::inside(const Vector& p) const {
  return (*impl_->side)({p[0], p[1], p[2]}) == CGAL::ON_BOUNDED_SIDE;
}

}  // namespace blum::cgal
