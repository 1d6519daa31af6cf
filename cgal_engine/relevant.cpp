#include "relevant.hpp"

#include <algorithm>
#include <numeric>
#include <set>

namespace blum::cgal {
namespace {

constexpr int kDepth = 5;  // bisections in u and in v

std::size_t at(int k) { return static_cast<std::size_t>(k); }

class Search {
 public:
  Search(const Forms& forms, Relevant& out) : forms_(forms), out_(out) {
    out_.site.assign(forms.site.size(), 0);
  }

  void visit(const Window& w, std::vector<int> sites, std::vector<int> triangles, int depth) {
    const auto range = [&](const Affine& a) { return bounds(quadratic(a), w); };
    std::erase_if(triangles, [&](int t) {
      const TriangleForm& f = forms_.triangle[at(t)];
      return !has_zero(range(f.plane)) ||
             std::any_of(f.prism.begin(), f.prism.end(),
                         [&](const Affine& a) { return range(a).lo > 0; });
    });
    std::vector<char> covers(forms_.site.size(), 0);
    std::erase_if(sites, [&](int i) {
      const auto& domain = forms_.site[at(i)].domain;
      bool all = true;
      for (const Affine& a : domain) {
        const Range r = range(a);
        if (r.lo > 0) return true;
        all = all && r.hi <= 0;
      }
      covers[at(i)] = all;
      return false;
    });
    const std::vector<int> before = sites;
    std::erase_if(sites, [&](int i) {
      return std::any_of(before.begin(), before.end(), [&](int j) {
        return j != i && covers[at(j)] && bounds(difference(i, j), w).lo > 0;
      });
    });
    if (sites.size() < 2 && triangles.empty()) {
      for (const int i : sites) out_.site[at(i)] = 1;
      return;
    }
    if (depth < kDepth) {
      const Rational mu = (w.u.lo + w.u.hi) / Rational(2), mv = (w.v.lo + w.v.hi) / Rational(2);
      for (const Range& u : {Range{w.u.lo, mu}, Range{mu, w.u.hi}})
        for (const Range& v : {Range{w.v.lo, mv}, Range{mv, w.v.hi}})
          visit({u, v}, sites, triangles, depth + 1);
      return;
    }
    collect(w, sites, triangles);
  }

 private:
  Quadratic difference(int i, int j) const {
    return forms_.site[at(i)].squared_distance - forms_.site[at(j)].squared_distance;
  }

  void keep(const Quadratic& q, const Window& w, bool boundary) {
    if (!has_zero(bounds(q, w))) return;
    for (const Curve& c : zeros(q).on) {
      if (!has_zero(bounds(quadratic(c), w))) continue;
      const int k = out_.curves.add(c);
      if (boundary) out_.boundary.push_back(k);
    }
  }

  void collect(const Window& w, const std::vector<int>& sites, const std::vector<int>& triangles) {
    for (const int i : sites) {
      out_.site[at(i)] = 1;
      if (sites.size() > 1)
        for (const Affine& a : forms_.site[at(i)].domain) keep(quadratic(a), w, false);
      for (const int j : sites) {
        if (j >= i) continue;
        pairs_.insert({j, i});
        keep(difference(i, j), w, false);
      }
    }
    for (const int t : triangles) {
      const TriangleForm& f = forms_.triangle[at(t)];
      keep(quadratic(f.plane), w, true);
      for (const Affine& a : f.prism) keep(quadratic(a), w, true);
    }
    out_.pair.assign(pairs_.begin(), pairs_.end());
  }

  const Forms& forms_;
  Relevant& out_;
  std::set<std::array<int, 2>> pairs_;
};

}  // namespace

Relevant relevant_curves(const Forms& forms, const Window& window) {
  Relevant out;
  const Rational zero = 0, one = 1;
  const std::array<Affine, 4> sides{
      Affine{zero, one, zero - window.v.lo}, Affine{one, zero, zero - window.u.hi},
      Affine{zero, one, zero - window.v.hi}, Affine{one, zero, zero - window.u.lo}};
  for (std::size_t k = 0; k < 4; ++k)
    out.side[k] = out.curves.add(zeros(quadratic(sides[k])).on.at(0));
  std::vector<int> sites(forms.site.size()), triangles(forms.triangle.size());
  std::iota(sites.begin(), sites.end(), 0);
  std::iota(triangles.begin(), triangles.end(), 0);
  Search(forms, out).visit(window, sites, triangles, 0);
  std::sort(out.boundary.begin(), out.boundary.end());
  out.boundary.erase(std::unique(out.boundary.begin(), out.boundary.end()), out.boundary.end());
  return out;
}

}  // namespace blum::cgal
