/// Relevant curves as arcs of Arr_algebraic_segment_traits_2, and arrangements of such arcs as
/// cells.
#pragma once

#include <CGAL/Arr_algebraic_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>

#include <map>
#include <vector>

#include "planar_cells.hpp"
#include "relevant.hpp"

namespace blum::cgal {

using AlgebraicTraits = CGAL::Arr_algebraic_segment_traits_2<Integer>;

class AlgebraicArcs {
 public:
  using Arc = AlgebraicTraits::X_monotone_curve_2;
  using Point = AlgebraicTraits::Point_2;
  using Analysis = AlgebraicTraits::Curve_2;

  AlgebraicArcs(const Relevant& relevant, const Window& window);

  /// The part of a curve in the closed window: arcs, and isolated points of the curve.
  struct Part {
    std::vector<Arc> arc;
    std::vector<Point> point;
  };
  [[nodiscard]] Part part(int curve) const;
  [[nodiscard]] const AlgebraicTraits& traits() const { return traits_; }

  /// Arranges arcs and points and reads the cells.
  [[nodiscard]] PlanarCells cells(const std::vector<Arc>& arcs,
                                  const std::vector<Point>& points) const;
  [[nodiscard]] Analysis analysis(const Curve& curve) const;
  [[nodiscard]] static std::shared_ptr<const ExactPoint> exact_point(const Point& p);
  /// The segment between two different rational points of a line of the table.
  [[nodiscard]] Arc segment(int line, const std::array<Rational, 2>& p,
                            const std::array<Rational, 2>& q) const;
  /// A point of the arc with one rational coordinate.
  [[nodiscard]] Sample sample(const Arc& arc, int curve) const;
  /// The number of the curve that the arc is part of.
  [[nodiscard]] int number(const Arc& arc) const;

 private:
  [[nodiscard]] bool in_window(const Sample& p) const;
  [[nodiscard]] std::vector<Arc> split(std::vector<Arc> arcs, const Arc& border) const;

  const Relevant& relevant_;
  Window window_;
  AlgebraicTraits traits_;
  std::vector<Analysis> analysis_;  // by number of the curve
  std::array<Arc, 4> line_;         // the lines of the sides, unbounded
};

}  // namespace blum::cgal
