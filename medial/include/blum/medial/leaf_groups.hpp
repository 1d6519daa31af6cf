/// Which sites of a leaf govern which piece of it, and which parts of K stand for which of its
/// ties.
///
/// Groups: the components of the leaf's surface minus the axis, as its six diagrams and the
/// boundary triangles in it show them. By Theorem A' (docs/proofs.md) the governors of a connected
/// piece of the leaf minus the axis are labels of one component. Most sites label one; a site that
/// labels several, or a vertex in the leaf, which may govern whatever it touches, belongs to
/// several groups, and then counts wherever one of them does.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "blum/kernel/site_geometry.hpp"
#include "blum/medial/complex.hpp"
#include "blum/medial/parts.hpp"
#include "blum/subdivision/subdivision.hpp"

namespace blum {

using GroupSet = std::uint64_t;  ///< bit per group; all groups from the 63rd on share the last bit

class LeafGroups {
 public:
  LeafGroups() = default;
  LeafGroups(const SiteGeometry& geometry, const Leaf& leaf);
  /// The site's groups; for sites that label nothing all of them.
  [[nodiscard]] GroupSet of(SiteId s) const;
  [[nodiscard]] GroupSet all() const { return all_; }
  [[nodiscard]] bool labels(SiteId s) const;
  /// Sites that label groups, with these; sorted.
  [[nodiscard]] const std::vector<std::pair<SiteId, GroupSet>>& entries() const { return set_; }

 private:
  std::vector<std::pair<SiteId, GroupSet>> set_;  // sorted
  GroupSet all_ = 0;
};

/// A part of K: sheets, then seams, then vertices, numbered through.
struct PartNumbers {
  std::uint32_t sheets = 0, seams = 0, vertices = 0;
  [[nodiscard]] std::uint32_t seam(std::uint32_t s) const { return sheets + s; }
  [[nodiscard]] std::uint32_t vertex(std::uint32_t v) const { return sheets + seams + v; }
  [[nodiscard]] std::uint32_t count() const { return sheets + seams + vertices; }
  [[nodiscard]] bool is_sheet(std::uint32_t p) const { return p < sheets; }
  [[nodiscard]] bool is_seam(std::uint32_t p) const { return p >= sheets && p < sheets + seams; }
};

/// What stands for what in one leaf.
struct LeafParts {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t leaf = 0;
  Box3 box;  ///< of the leaf
  LeafGroups groups;
  struct Arc {
    GroupSet a = 0, b = 0;  ///< a <= b; the sides of an arc
    std::uint32_t sheet = 0;
  };
  struct Seam {
    GroupSet groups = 0;   ///< that may be around a node of three or more arcs
    GroupSet certain = 0;  ///< of these, those that are
    std::uint32_t seam = 0;
    std::uint32_t arcs = 0;  ///< at the node
    /// All its sides are different groups: a point of the seam has feet in three at least.
    [[nodiscard]] bool distinct() const {
      return groups == certain && static_cast<std::uint32_t>(std::popcount(groups)) == arcs;
    }
  };
  /// Where arcs meet that part as many different groups: on a face of the leaf, or about a vertex
  /// of the solid inside it where as many convex edges meet.
  struct Node {
    std::uint32_t vertex = kNone;  ///< of the solid
    Box3 box;                      ///< else: flat, holds the tree of ties that the arcs are ends of
    GroupSet groups = 0;           ///< three at least
    std::vector<GroupSet> arc;     ///< the groups on its two sides
  };
  std::vector<Arc> arc;
  std::vector<Seam> seam;
  std::vector<Node> node;
  /// The part that counts what no sheet and no seam does: one that an apex belongs to, a node if
  /// there is one, else a seam, else a sheet.
  std::uint32_t rest = kNone;
  bool junction = false;  ///< one cone, of the shape of a junction
  bool conical = false;   ///< everything is told by the leaf's faces
};

/// Part that each vertex of K belongs to, and whether it is a part of its own.
struct VertexParts {
  std::vector<std::uint32_t> part;  ///< kNone: on the boundary of the solid
  std::vector<bool> is_node;
  static constexpr std::uint32_t kNone = 0xffffffffu;
};

[[nodiscard]] PartNumbers part_numbers(const CellComplex& complex, const Parts& parts);
[[nodiscard]] VertexParts vertex_parts(const CellComplex& complex, const Parts& parts);

/// One for each leaf with cones.
[[nodiscard]] std::vector<LeafParts> leaf_parts(const SiteGeometry& geometry,
                                                const Subdivision& subdivision,
                                                const CellComplex& complex, const Parts& parts);

}  // namespace blum
