#include "labelled_cells.hpp"

#include <algorithm>
#include <numeric>
#include <set>

namespace blum::cgal {
namespace {

std::size_t at(int k) { return static_cast<std::size_t>(k); }

Vector point(const Moving& x, const Sample& p) {
  Vector out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = value(x[k], p).a0();
  return out;
}

class Labeller {
 public:
  Labeller(const Forms& forms, const Relevant& relevant, const PlanarCells& cells)
      : forms_(forms), relevant_(relevant), cells_(cells) {}

  LabelledCells run(const InsideTest* test) {
    for (const auto& e : cells_.edge) {
      Cell c;
      c.sides = sides(e.curve);
      c.triangle = forms_.triangles(e.sample);
      out_.edge.push_back(std::move(c));
    }
    inside_of_faces(test);
    for (std::size_t k = 0; k < cells_.edge.size(); ++k) edge(k);
    for (const auto& v : cells_.vertex) vertex(v);
    return std::move(out_);
  }

 private:
  unsigned sides(int curve) const {
    unsigned out = 0;
    for (std::size_t k = 0; k < 4; ++k) out |= relevant_.side[k] == curve ? 1u << k : 0u;
    return out;
  }

  /// One question for each set of faces joined by edges that are not on ∂O.
  void inside_of_faces(const InsideTest* test) {
    std::vector<int> parent(cells_.face.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto find = [&](int f) {
      while (parent[at(f)] != f) f = parent[at(f)];
      return f;
    };
    for (std::size_t k = 0; k < cells_.edge.size(); ++k) {
      const auto& [left, right] = cells_.edge[k].face;
      if (left >= 0 && right >= 0 && out_.edge[k].triangle.empty())
        parent[at(find(left))] = find(right);
    }
    std::vector<int> known(cells_.face.size(), -1);
    for (std::size_t f = 0; f < cells_.face.size(); ++f) {
      const Sample& p = cells_.face[f].sample;
      int& in = known[at(find(static_cast<int>(f)))];
      if (in < 0) in = test == nullptr || test->inside(point(forms_.x, p)) ? 1 : 0;
      Cell c;
      c.inside = in == 1;
      if (c.inside) govern(c, p);
      out_.face.push_back(std::move(c));
    }
  }

  void govern(Cell& c, const Sample& p) const {
    c.governor = forms_.governors(p);
    if (c.governor.empty()) throw std::logic_error("the candidates miss a governor");
    c.feet_differ = forms_.feet_differ(c.governor, p);
  }

  void edge(std::size_t k) {
    Cell& c = out_.edge[k];
    c.inside = c.triangle.empty() && beside_inside(cells_.edge[k]);
    if (c.inside) govern(c, cells_.edge[k].sample);
  }

  bool beside_inside(const PlanarCells::Edge& e) const {
    for (const int f : e.face)
      if (f >= 0 && out_.face[at(f)].inside) return true;
    return false;
  }

  void vertex(const PlanarCells::Vertex& v) {
    Cell c;
    std::set<int> incident, triangles;
    bool touches_inside = v.face >= 0 && out_.face[at(v.face)].inside;
    for (const int e : v.edge) {
      incident.insert(cells_.edge[at(e)].curve);
      c.sides |= out_.edge[at(e)].sides;
      triangles.insert(out_.edge[at(e)].triangle.begin(), out_.edge[at(e)].triangle.end());
      touches_inside = touches_inside || beside_inside(cells_.edge[at(e)]);
    }
    const std::vector<int> through(incident.begin(), incident.end());
    const auto sign = [&](const Quadratic& q) {
      return sign_at(q, *v.point, relevant_.curves, through);
    };
    const auto holds = [&](const Affine& a) { return sign(quadratic(a)) <= 0; };
    // Triangles are closed: one that shows at a vertex shows on an edge there, or touches here.
    for (std::size_t t = 0; t < forms_.triangle.size(); ++t) {
      const TriangleForm& f = forms_.triangle[t];
      if (triangles.count(static_cast<int>(t)) != 0 ||
          (sign(quadratic(f.plane)) == 0 && std::all_of(f.prism.begin(), f.prism.end(), holds)))
        c.triangle.push_back(static_cast<int>(t));
    }
    c.inside = touches_inside && c.triangle.empty();
    if (touches_inside) {
      std::vector<int> best;
      const Window near = v.point->box(64);
      for (std::size_t i = 0; i < forms_.site.size(); ++i) {
        if (!relevant_.site[i]) continue;
        const SiteForm& s = forms_.site[i];
        if (std::any_of(s.domain.begin(), s.domain.end(),
                        [&](const Affine& a) { return bounds(quadratic(a), near).lo > 0; }))
          continue;
        const int order =
            best.empty() ? -1
                         : sign(s.squared_distance - forms_.site[at(best[0])].squared_distance);
        if (order > 0 || !std::all_of(s.domain.begin(), s.domain.end(), holds)) continue;
        if (order < 0) best.clear();
        best.push_back(static_cast<int>(i));
      }
      c.governor = best;
      for (const int i : best)
        for (std::size_t k = 0; k < 3; ++k)
          c.feet_differ =
              c.feet_differ ||
              sign(quadratic(forms_.site[at(i)].foot[k] - forms_.site[at(best[0])].foot[k])) != 0;
    }
    out_.vertex.push_back(std::move(c));
  }

  const Forms& forms_;
  const Relevant& relevant_;
  const PlanarCells& cells_;
  LabelledCells out_;
};

}  // namespace

LabelledCells label(const Forms& forms, const Relevant& relevant, const PlanarCells& cells,
                    const InsideTest* test) {
  return Labeller(forms, relevant, cells).run(test);
}

}  // namespace blum::cgal
