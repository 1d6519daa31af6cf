/// The cones of leaves over what of the axis is on their surfaces (theory section 4).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "blum/kernel/union_find.hpp"
#include "blum/medial/complex.hpp"
#include "blum/subdivision/tube.hpp"
#include "interfaces.hpp"

namespace blum {

std::uint32_t add_vertex(const Solid& solid, const Placed& placed, ComplexVertex::Kind kind,
                         CellComplex& complex);

/// What cones stand on.
struct LeafBase {
  std::vector<std::uint32_t> arc;                                 ///< complex edges
  std::vector<std::pair<std::uint32_t, std::uint32_t>> crossing;  ///< (boundary edge, vertex)
};

class LeafCones {
 public:
  /// `partial`: some leaf is undecided, so ends of boundary edges may be missing.
  LeafCones(const AssemblyInput& input, bool partial, CellComplex& complex)
      : in_(input), partial_(partial), complex_(complex) {}

  /// One cone for each component of the base, to which the boundary edges inside the leaf are added
  /// that the diagram ends on. `tube`: where its tube crosses the base, by places in base.arc.
  void add(std::uint32_t leaf, LeafBase& base, std::span<const Crossing> tube);

 private:
  struct Pieces;  // of a base

  void add_boundary_edges(const Leaf& leaf, LeafBase& base);
  [[nodiscard]] std::uint32_t boundary_vertex(std::uint32_t v, std::uint32_t tree);
  void add_apexes(std::uint32_t leaf, Pieces& pieces);
  [[nodiscard]] Placed apex(const Leaf& leaf, Pieces& pieces, std::uint32_t component,
                            const Point3& center) const;
  [[nodiscard]] Point3 nearest_base(Pieces& pieces, std::uint32_t component, const Point3& x) const;
  [[nodiscard]] bool is_wanted(const Point3& x) const;
  /// From all vertices of the base to the apexes.
  void add_spokes(const LeafBase& base, Pieces& pieces);
  /// The sheets in a leaf with a tube run around it: into a ring of three vertices, the first of
  /// which is the apex of `cone`.
  void add_tube(const LeafBase& base, std::span<const Crossing> tube, std::uint32_t cone,
                const std::map<std::uint32_t, std::uint32_t>& spoke);
  [[nodiscard]] std::uint32_t add_vertex(const Placed& placed, ComplexVertex::Kind kind) {
    return blum::add_vertex(in_.solid(), placed, kind, complex_);
  }

  const AssemblyInput& in_;
  const bool partial_;
  CellComplex& complex_;
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> boundary_vertex_;  // by vertex and tree
};

}  // namespace blum
