#include "pruning.hpp"

#include <algorithm>
#include <numbers>

#include "failure.hpp"
#include "reader.hpp"

namespace blum::verify {

// Below which an angle and a cost are not told apart, as a difference of cosines: more than the
// rounding of a cosine, and 1e-6 degrees where it matters most.
constexpr double kCosine = 1e-13;

Pruning::Pruning(const Shape& shape, const Complex& complex)
    : gone(complex.cell.size(), false),
      shape_(shape),
      complex_(complex),
      cofaces_(complex.cell.size(), 0) {
  for (const auto& [key, id] : complex.named)
    if (const auto& [kind, diagram, k] = key; kind == Complex::Name::kArc)
      arc_[id] = {complex.diagram.at(diagram), k};
  for (const Complex::Cell& c : complex.cell)
    for (const auto f : c.faces()) ++cofaces_[f];
}

std::uint32_t Pruning::named(const Complex::Key& key) const {
  const auto it = complex_.named.find(key);
  require(it != complex_.named.end(), "pruning: the complex has no such cell");
  return it->second;
}

/// ["arc", diagram, arc], ["end", diagram, arc, 0 or 1], ["corner", vertex], ["edge", edge, leaf]
std::uint32_t Pruning::base(const nlohmann::json& name, std::size_t at) const {
  using Name = Complex::Name;
  const std::string kind = name.at(at);
  const auto index = [&](std::size_t k) { return read_index(name.at(at + k), kMost); };
  if (name.size() != at + (kind == "corner" ? 2 : kind == "end" ? 4 : 3))
    throw Unreadable("the name of a cell has another length");
  if (kind == "corner") return named({Name::kCorner, index(1), 0});
  if (kind == "edge") return named({Name::kConvexEdge, index(1), index(2)});
  if (kind != "arc" && kind != "end") throw Unreadable("unknown kind of cell: " + kind);
  const auto arc = named({Name::kArc, index(1), index(2)});
  return kind == "arc" ? arc : complex_.cell[arc].face[read_index(name.at(at + 3), 2)];
}

/// Of those, or ["cone", leaf, ...], ["apex", leaf, ...]: what is over them in a leaf.
std::uint32_t Pruning::cell(const nlohmann::json& name) const {
  const std::string kind = name.at(0);
  if (kind != "cone" && kind != "apex") return base(name, 0);
  const auto over = base(name, 2);
  const auto cone = named({Complex::Name::kCone, read_index(name.at(1), kMost), over});
  if (kind == "cone") return cone;
  if (complex_.cell[over].dimension != 0) throw Unreadable("an apex is named by a vertex");
  return complex_.cell[cone].face[1];
}

/// Where the governors on both sides of an arc are faces the angle of the sheet is that of two of
/// their normals; the labels hold the governors.
void Pruning::check_angle(const FaceMap& map, const FaceMap::Arc& arc, double cost) {
  const auto& left = map.region[arc.region[0]].labels;
  const auto& right = map.region[arc.region[1]].labels;
  for (const auto* labels : {&left, &right})
    for (const Site s : *labels)
      if (shape_.kind(s) != Kind::kFace) return;
  const double bound = std::cos(cost * std::numbers::pi / 180) - kCosine;
  std::size_t above = 0;
  for (const Site a : left)
    for (const Site b : right) {
      const int sign = decide([&](auto zero) {
        using N = decltype(zero);
        const Vec<N> m = shape_.normal<N>(shape_.element(a)),
                     n = shape_.normal<N>(shape_.element(b));
        return compare_over_roots<N>(inner<N>(m, n), N(inner<N>(m, m) * inner<N>(n, n)), N(bound),
                                     N(1));
      });
      if (sign < 0) ++above;
    }
  require(above < left.size() * right.size(),
          "pruning: the angle of a sheet between two faces is above the cost of its collapse");
  if (above == 0) ++angles;
}

void Pruning::collapse(const nlohmann::json& j) {
  const double cost = read_number(j.at("cost")), value = read_number(j.at("value"));
  require(cost >= 0 && cost <= 180, "pruning: a cost is not an angle");
  require(value == std::max(cost, value_), "pruning: a value is not the largest cost so far");
  value_ = value;
  for (const auto& pair : j.at("cells")) {
    if (pair.size() != 2) throw Unreadable("cells are removed in pairs");
    const auto face = cell(pair.at(0)), whole = cell(pair.at(1));
    require(!gone[face] && !gone[whole], "pruning: a cell is removed twice");
    const auto faces = complex_.cell[whole].faces();
    require(std::ranges::find(faces, face) != faces.end(),
            "pruning: a cell is removed with what is no face of it");
    require(cofaces_[whole] == 0, "pruning: a cell is removed that is a face of another");
    require(cofaces_[face] == 1, "pruning: a face that is not free");
    gone[face] = gone[whole] = true;
    for (const auto x : {whole, face})
      for (const auto f : complex_.cell[x].faces()) --cofaces_[f];
    ++collapses;
    const auto arc = arc_.find(complex_.cell[whole].face[0]);
    if (complex_.cell[whole].dimension < 2 || arc == arc_.end()) continue;
    ++pieces;
    check_angle(*arc->second.first, arc->second.first->arc[arc->second.second], cost);
  }
}

double Pruning::end(const nlohmann::json& j) const {
  const double theta = read_number(j.at("theta"));
  require(theta >= 0 && theta <= 180, "pruning: theta is not an angle");
  require(value_ < theta, "pruning: a collapse of a value that is not below theta");
  return theta;
}

}  // namespace blum::verify
