/// The collapses of a certificate, replayed (docs/proofs.md, "Pruning"): boundaries of cells and
/// counting.
#pragma once

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

  std::vector<bool> gone;     ///< of the cells
  std::size_t collapses = 0;  ///< pairs
  /// Triangles over arcs that are gone; and those of them of which it was shown that the angle of
  /// the sheet on the arc is not above the cost: it is that of two faces.
  std::size_t pieces = 0, angles = 0;

 private:
  [[nodiscard]] std::uint32_t cell(const nlohmann::json& name) const;
  [[nodiscard]] std::uint32_t base(const nlohmann::json& name, std::size_t at) const;
  [[nodiscard]] std::uint32_t named(const Complex::Key& key) const;
  void check_angle(const FaceMap& map, const FaceMap::Arc& arc, double cost);

  const Shape& shape_;
  const Complex& complex_;
  std::vector<std::uint32_t> cofaces_;  // a face counted twice in a cell twice
  std::map<std::uint32_t, std::pair<const FaceMap*, std::uint32_t>> arc_;  // by cell
  double value_ = -1;
};

}  // namespace blum::verify
