/// The cells of a rectangle with what holds on them: inside or not, boundary triangles, governors.
#pragma once

#include <memory>
#include <stdexcept>
#include <vector>

#include "blum/arrangement/face_diagram.hpp"
#include "forms.hpp"
#include "planar_cells.hpp"
#include "relevant.hpp"

namespace blum::cgal {

/// The rectangle or segment is in bad position; what() says why.
struct BadPosition : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Cell {
  bool inside = false;        ///< in the open solid
  unsigned sides = 0;         ///< bit k: on Side k of the rectangle
  std::vector<int> triangle;  ///< boundary triangles through it
  std::vector<int> governor;  ///< of its points, where inside; of a vertex on ∂O also
  bool feet_differ = false;   ///< two of them have different feet
};

/// In the order of PlanarCells.
struct LabelledCells {
  std::vector<Cell> vertex, edge, face;
};

/// Is the point, which is not on the boundary, inside the solid? Exact, by CGAL's ray shooting.
class InsideTest {
 public:
  explicit InsideTest(const Solid& solid);
  ~InsideTest();
  [[nodiscard]] bool inside(const Vector& p) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Exact signs on the samples of edges and faces and at the vertices. No test: all is inside.
[[nodiscard]] LabelledCells label(const Forms& forms, const Relevant& relevant,
                                  const PlanarCells& cells, const InsideTest* test);

}  // namespace blum::cgal
