// The filtration by trial: after every step each unit is tried at each cost, on sets of cells.

#include <algorithm>
#include <optional>
#include <set>

#include "blum/kernel/check.hpp"
#include "blum/medial/filtration.hpp"

namespace blum {
namespace {

class Trial {
 public:
  Trial(const CellComplex& complex, const Parts& parts, const CellValues& cost)
      : complex_(complex), parts_(parts), cost_(cost), cells_(all_cells(complex)) {}

  Filtration run();

 private:
  struct Offer {
    double cost = 0;
    bool is_sheet = false;
    std::uint32_t unit = 0;
    std::vector<ElementaryCollapse> collapse;
  };
  [[nodiscard]] std::size_t triangles_at(std::uint32_t edge) const;
  [[nodiscard]] std::size_t edges_at(std::uint32_t vertex) const;
  [[nodiscard]] std::optional<Offer> offer_edge(std::uint32_t edge) const;
  [[nodiscard]] std::optional<Offer> offer_sheet(std::uint32_t sheet);
  [[nodiscard]] bool try_at(std::uint32_t sheet, double cost, Offer& offer);
  [[nodiscard]] bool only_of(std::uint32_t sheet, std::uint32_t edge) const;

  const CellComplex& complex_;
  const Parts& parts_;
  const CellValues& cost_;
  CellMask cells_;
};

std::size_t Trial::triangles_at(std::uint32_t edge) const {
  std::size_t n = 0;
  for (std::size_t t = 0; t < complex_.triangle.size(); ++t)
    if (cells_.triangle[t])
      n += std::count(complex_.triangle[t].edge.begin(), complex_.triangle[t].edge.end(), edge);
  return n;
}

std::size_t Trial::edges_at(std::uint32_t vertex) const {
  std::size_t n = 0;
  for (std::size_t e = 0; e < complex_.edge.size(); ++e)
    if (cells_.edge[e])
      n += std::count(complex_.edge[e].vertex.begin(), complex_.edge[e].vertex.end(), vertex);
  return n;
}

std::optional<Trial::Offer> Trial::offer_edge(std::uint32_t edge) const {
  if (!cells_.edge[edge] || triangles_at(edge) > 0) return std::nullopt;
  std::optional<Offer> best;
  std::uint32_t end = 0;
  for (const auto v : complex_.edge[edge].vertex) {
    if (edges_at(v) != 1) continue;
    const double cost = std::max(cost_.edge[edge], cost_.vertex[v]);
    if (best && (best->cost < cost || (best->cost == cost && end < v))) continue;
    best = Offer{cost, false, edge, {{1, v, edge}}};
    end = v;
  }
  return best;
}

bool Trial::only_of(std::uint32_t sheet, std::uint32_t edge) const {
  std::size_t own = 0;
  for (std::size_t t = 0; t < complex_.triangle.size(); ++t) {
    if (!cells_.triangle[t]) continue;
    const auto& edges = complex_.triangle[t].edge;
    if (std::find(edges.begin(), edges.end(), edge) == edges.end()) continue;
    if (parts_.triangle_sheet[t] != sheet) return false;
    ++own;
  }
  return own > 0;
}

bool Trial::try_at(std::uint32_t sheet, double cost, Offer& offer) {
  std::set<std::uint32_t> edges, vertices, triangles;  // that have to go
  for (std::uint32_t t = 0; t < complex_.triangle.size(); ++t) {
    if (!cells_.triangle[t] || parts_.triangle_sheet[t] != sheet) continue;
    triangles.insert(t);
    for (const auto e : complex_.triangle[t].edge)
      if (only_of(sheet, e) && !(cost_.edge[e] > cost)) edges.insert(e);
  }
  for (const auto t : triangles)
    for (const auto e : complex_.triangle[t].edge)
      for (const auto v : complex_.edge[e].vertex) {
        bool inside = !(cost_.vertex[v] > cost);
        for (std::uint32_t f = 0; f < complex_.edge.size(); ++f)
          if (cells_.edge[f] &&
              (complex_.edge[f].vertex[0] == v || complex_.edge[f].vertex[1] == v))
            inside &= edges.contains(f);
        if (inside) vertices.insert(v);
      }
  const CellMask before = cells_;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto t : triangles) {
      if (!cells_.triangle[t]) continue;
      for (const auto e : complex_.triangle[t].edge)
        if (cells_.triangle[t] && edges.contains(e) && cells_.edge[e] && triangles_at(e) == 1) {
          cells_.triangle[t] = cells_.edge[e] = false;
          offer.collapse.push_back({2, e, t});
          changed = true;
        }
    }
    for (const auto e : edges)
      for (const auto v : complex_.edge[e].vertex)
        if (cells_.edge[e] && triangles_at(e) == 0 && vertices.contains(v) && edges_at(v) == 1) {
          cells_.edge[e] = cells_.vertex[v] = false;
          offer.collapse.push_back({1, v, e});
          changed = true;
        }
  }
  const bool all = offer.collapse.size() * 2 == triangles.size() + edges.size() + vertices.size();
  cells_ = before;
  return all;
}

std::optional<Trial::Offer> Trial::offer_sheet(std::uint32_t sheet) {
  double own = -1;
  std::set<double> dearer;
  for (std::uint32_t t = 0; t < complex_.triangle.size(); ++t) {
    if (!cells_.triangle[t] || parts_.triangle_sheet[t] != sheet) continue;
    own = std::max(own, cost_.triangle[t]);
    for (const auto e : complex_.triangle[t].edge) {
      dearer.insert(cost_.edge[e]);
      for (const auto v : complex_.edge[e].vertex) dearer.insert(cost_.vertex[v]);
    }
  }
  if (own < 0) return std::nullopt;
  dearer.insert(own);
  for (auto level = dearer.find(own); level != dearer.end(); ++level) {
    Offer offer{0, true, sheet, {}};
    if (!try_at(sheet, *level, offer)) continue;
    offer.cost = own;
    for (const ElementaryCollapse& c : offer.collapse) {
      const CellValues& k = cost_;
      offer.cost = std::max({offer.cost, (c.dimension == 2 ? k.edge : k.vertex)[c.face],
                             (c.dimension == 2 ? k.triangle : k.edge)[c.cell]});
    }
    return offer;
  }
  return std::nullopt;
}

Filtration Trial::run() {
  Filtration f;
  f.value.vertex.assign(complex_.vertex.size(), Filtration::kStays);
  f.value.edge.assign(complex_.edge.size(), Filtration::kStays);
  f.value.triangle.assign(complex_.triangle.size(), Filtration::kStays);
  double reached = 0;
  while (true) {
    std::optional<Offer> best;
    const auto consider = [&](std::optional<Offer> o) {
      if (o && (!best || o->cost < best->cost)) best = std::move(o);
    };
    for (std::uint32_t e = 0; e < complex_.edge.size(); ++e) consider(offer_edge(e));
    for (std::uint32_t s = 0; s < parts_.sheets; ++s) consider(offer_sheet(s));
    if (!best) return f;
    reached = std::max(reached, best->cost);
    const auto begin = f.collapse.size();
    f.step.push_back(
        {best->cost, reached, best->is_sheet, best->unit, static_cast<std::uint32_t>(begin)});
    for (const ElementaryCollapse& c : best->collapse) {
      f.collapse.push_back(c);
      (c.dimension == 2 ? f.value.edge : f.value.vertex)[c.face] = reached;
      (c.dimension == 2 ? f.value.triangle : f.value.edge)[c.cell] = reached;
    }
    const auto wrong = replay(complex_, f.collapse, begin, f.collapse.size(), cells_);
    BLUM_CHECK(!wrong);
  }
}

}  // namespace

Filtration filter_by_trial(const CellComplex& complex, const Parts& parts, const CellValues& cost) {
  return Trial(complex, parts, cost).run();
}

}  // namespace blum
