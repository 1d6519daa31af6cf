/// A rectangle cut into cells by curves, whatever package cut it.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "curves.hpp"
#include "numbers.hpp"

namespace blum::cgal {

/// A point with algebraic coordinates, as the package that made it knows it.
class ExactPoint {
 public:
  virtual ~ExactPoint() = default;
  /// A box around it, whose sides are at most 2^-bits long.
  [[nodiscard]] virtual Window box(int bits) const = 0;
  /// Does the curve pass through it? Exact.
  [[nodiscard]] virtual bool is_on(const Curve& curve) const = 0;
};

struct PlanarCells {
  struct Vertex {
    std::shared_ptr<const ExactPoint> point;
    std::vector<int> edge;  ///< those that end here
    int face = -1;          ///< isolated: the face around it
  };
  /// An open x-monotone arc that belongs to one curve of the table.
  struct Edge {
    std::array<int, 2> vertex{-1, -1}, face{-1, -1};  ///< face -1: outside the rectangle
    int curve = -1;
    Sample sample;  ///< a point of it
  };
  struct Face {
    Sample sample;  ///< a point of it, with rational coordinates
    bool found = false;
    int holes = 0;  ///< components of its boundary but the outer one, isolated points included
  };
  std::vector<Vertex> vertex;
  std::vector<Edge> edge;
  std::vector<Face> face;
};

/// Gives every face a sample, beside the sample of one of its edges that is not vertical. `above`:
/// per edge, the index in Edge::face of the face above it; -1 for vertical edges.
void sample_faces(PlanarCells& cells, const CurveTable& curves, const Window& window,
                  const std::vector<int>& above);

/// Exact sign of q at the point; `incident`: numbers of the curves known to pass through it.
[[nodiscard]] int sign_at(const Quadratic& q, const ExactPoint& p, const CurveTable& curves,
                          const std::vector<int>& incident);

}  // namespace blum::cgal
