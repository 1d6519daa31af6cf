/// The collapses of a certificate, replayed (docs/proofs.md, "Pruning"): boundaries of cells and
/// counting.
#pragma once

#include <optional>

#include <nlohmann/json.hpp>

#include "glue.hpp"

namespace blum::verify {

class Pruning {
 public:
  /// Both must outlive it.
  Pruning(const Shape& shape, const Complex& complex);

  /// Removes the pairs of a record one after the other, each of a free face and its only coface;
  /// its cost must be one, and its value the largest cost so far. Throws Failure or Unreadable.
  void collapse(const nlohmann::json& j);
  /// The angle stated at the end, in degrees: above all values. Throws Failure or Unreadable.
  [[nodiscard]] double end(const nlohmann::json& j) const;

  [[nodiscard]] const std::vector<bool>& gone() const { return gone_; }
  [[nodiscard]] std::size_t collapses() const { return collapses_; }
  /// Triangles over arcs that are gone; and those of them of which it was shown that the angle of
  /// the sheet on the arc is not above the cost: it is that of two faces.
  [[nodiscard]] std::size_t pieces() const { return pieces_; }
  [[nodiscard]] std::size_t angles() const { return angles_; }

 private:
  [[nodiscard]] std::uint32_t cell(const nlohmann::json& name) const;
  [[nodiscard]] std::uint32_t base(const nlohmann::json& name, std::size_t at) const;
  [[nodiscard]] std::uint32_t named(Complex::Name kind, std::uint32_t a, std::uint32_t b) const;
  void remove(std::uint32_t face, std::uint32_t cell);
  void check_angle(const FaceMap& map, const FaceMap::Arc& arc, double cost);

  const Shape& shape_;
  const Complex& complex_;
  std::vector<std::uint32_t> cofaces_;  // a face counted twice in a cell twice
  std::vector<bool> gone_;
  struct Arc {
    const FaceMap* map = nullptr;  // null: the cell is no arc
    std::uint32_t number = 0;
  };
  std::vector<Arc> arc_;  // of each cell
  std::optional<double> value_;
  std::size_t collapses_ = 0, pieces_ = 0, angles_ = 0;
};

}  // namespace blum::verify
