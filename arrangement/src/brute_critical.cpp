#include "brute_critical.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "blum/arrangement/face_diagram.hpp"
#include "blum/kernel/check.hpp"

namespace blum::brute {
namespace {

constexpr slong kPrecision = 192;

/// A point, or a box of points, in coordinates (s, v), and what may hold there.
struct Spot {
  Real s, v;
  std::vector<int> sign;  ///< per curve: certain sign, 0: not certain, kAsk: not asked yet
  std::vector<char> governs, on_triangle;  ///< possibly; filled by judge()
};

/// A crossing of two curves, or a point of one with a vertical tangent.
struct Crossing {
  Algebraic s;
  bool within = true;        ///< possibly in the rectangle
  std::optional<Spot> spot;  ///< nullopt: several points, or not known where
};

class Collector {
 public:
  explicit Collector(const Setting& s) : s_(s) { make_grid(); }

  std::vector<Algebraic> collect() {
    const std::size_t k = s_.site.size();
    for (std::size_t i = 0; i < k; ++i) {
      pairs_within(s_.domain[i], {i});
      for (std::size_t j = 0; j < k; ++j) {
        if (j == i) continue;
        const std::vector<Function> tie = {s_.difference[i][j]};
        pairs(tie, s_.domain[i], {i, j});
        if (tie[0].sign == 0) pairs(s_.domain[i], s_.domain[j], {i, j});
        if (j > i) {
          vertical(tie[0], {i, j});
          pairs_within(tie, {i, j});
        }
        for (std::size_t l = j + 1; j > i && l < k; ++l)
          pairs(tie, {s_.difference[i][l]}, {i, j, l});
      }
    }
    for (std::size_t t = 0; t < s_.triangle.size(); ++t) {
      const std::vector<Function> trace = {s_.plane[t]};
      pairs(trace, s_.prism[t], {}, static_cast<int>(t));
      for_all_sites([&](const std::vector<Function>& f, const std::vector<std::size_t>& sites) {
        pairs(trace, f, sites, static_cast<int>(t));
      });
      pairs(trace, s_.limit, {}, static_cast<int>(t));
    }
    pairs_within(s_.limit, {});
    for_all_sites([&](const std::vector<Function>& f, const std::vector<std::size_t>& sites) {
      pairs(s_.limit, f, sites);
    });
    return finish();
  }

 private:
  using Sites = std::vector<std::size_t>;

  template <class F>
  void for_all_sites(F&& f) {
    for (std::size_t i = 0; i < s_.site.size(); ++i) {
      f(s_.domain[i], Sites{i});
      for (std::size_t j = 0; j < i; ++j)
        f(std::vector<Function>{s_.difference[i][j]}, Sites{i, j});
    }
  }

  void vertical(const Function& f, const Sites& sites) {
    for (const auto& [c, exponent] : f.curve)
      if (s_.curve[at(c)].degree() == 2) keep(c, c, sites, -1);
  }

  void pairs(const std::vector<Function>& a, const std::vector<Function>& b, const Sites& sites,
             int triangle = -1) {
    for (const Function& f : a)
      for (const Function& g : b)
        for (const auto& [p, p_exponent] : f.curve)
          for (const auto& [q, q_exponent] : g.curve)
            if (p != q) keep(std::min(p, q), std::max(p, q), sites, triangle);
  }
  void pairs_within(const std::vector<Function>& a, const Sites& sites) { pairs(a, a, sites); }

  /// Keeps the crossings of two curves where the sites may govern, on the triangle if there is one.
  void keep(int p, int q, const Sites& sites, int triangle) {
    const auto possible = [&](const Spot& spot) {
      return (triangle < 0 || spot.on_triangle[at(triangle)]) &&
             std::all_of(sites.begin(), sites.end(),
                         [&](std::size_t i) { return spot.governs[i]; });
    };
    if (std::none_of(grid_.begin(), grid_.end(), [&](const Spot& box) {
          return box.sign[at(p)] == 0 && box.sign[at(q)] == 0 && possible(box);
        }))
      return;
    for (Crossing& c : crossings(p, q)) {
      if (!c.within) continue;
      if (c.spot && c.spot->governs.empty()) judge(*c.spot);
      if (!c.spot || possible(*c.spot)) kept_[c.s.minimal->poly()].emplace(c.s.index, c.s);
    }
  }

  std::vector<Crossing>& crossings(int p, int q) {
    const auto [it, fresh] = crossings_.try_emplace({p, q});
    if (!fresh) return it->second;
    const Curve &f = s_.curve[at(p)], &g = s_.curve[at(q)];
    const Elimination e = p == q ? Elimination{f.discriminant(), {}, {}} : eliminate(f, g);
    for (Algebraic& s : store_.roots(e.resultant)) {
      const Real& x = s.enclosure(kPrecision);
      Crossing c{std::move(s), true, std::nullopt};
      std::optional<Real> v;
      if (p == q ||
          (c.s.is_root_of(e.first) && f.degree() == 2 && c.s.is_root_of(f.discriminant()))) {
        v = curve_root(f, 0, true, x, kPrecision);
      } else if (!c.s.is_root_of(e.first)) {
        v = evaluate(e.rest, x, kPrecision);
        arb_neg(v->get(), v->get());
        arb_div(v->get(), v->get(), evaluate(e.first, x, kPrecision).get(), kPrecision);
      }
      if (v && arb_is_finite(v->get())) {
        c.spot = spot(x, *v);
        c.within = possibly_all(*c.spot, s_.limit, +1);
      }
      it->second.push_back(std::move(c));
    }
    return it->second;
  }

  Spot spot(const Real& s, const Real& v) const {
    return {s, v, std::vector<int>(s_.curve.size(), kAsk), {}, {}};
  }

  /// Boxes in (s, v) that cover the rectangle, with the signs of all curves.
  void make_grid() {
    const auto bound = [&](int side) { return -s_.limit_value[at(side)]; };
    const Rational v0 = bound(kLowV), u0 = bound(kLowU);
    const Rational dv = -bound(kHighV) - v0, du = -bound(kHighU) - u0;
    const Rational s0 = u0 + s_.shear * v0, ds = du + s_.shear * dv;
    const auto box = [](const Rational& lo, const Rational& step, int k) {
      Real r = enclose(lo + step * k / kGrid, kPrecision);
      arb_union(r.get(), r.get(), enclose(lo + step * (k + 1) / kGrid, kPrecision).get(),
                kPrecision);
      return r;
    };
    for (int i = 0; i < kGrid; ++i) {
      for (int j = 0; j < kGrid; ++j) {
        Spot b = spot(box(s0, ds, i), box(v0, dv, j));
        if (!possibly_all(b, s_.limit, +1)) continue;
        judge(b);
        for (int c = 0; c < static_cast<int>(s_.curve.size()); ++c) curve_sign(b, c);
        grid_.push_back(std::move(b));
      }
    }
  }

  /// Fills `governs` and `on_triangle` by ball arithmetic.
  void judge(Spot& c) {
    const std::size_t k = s_.site.size();
    c.governs.assign(k, 1);
    c.on_triangle.assign(s_.triangle.size(), 1);
    for (std::size_t i = 0; i < k; ++i) c.governs[i] = possibly_all(c, s_.domain[i], -1);
    for (std::size_t j = 0; j < k; ++j) {
      if (!std::all_of(s_.domain[j].begin(), s_.domain[j].end(),
                       [&](const Function& f) { return f.sign == 0 || sign(c, f) < 0; }))
        continue;
      for (std::size_t i = 0; i < k; ++i)  // j certainly is at its distance: is i farther?
        if (i != j && c.governs[i] && sign(c, s_.difference[i][j]) > 0) c.governs[i] = 0;
    }
    for (std::size_t t = 0; t < s_.triangle.size(); ++t)
      c.on_triangle[t] = sign(c, s_.plane[t]) == 0 && possibly_all(c, s_.prism[t], -1);
  }

  int curve_sign(Spot& c, int curve) {
    int& s = c.sign[at(curve)];
    if (s == kAsk) s = evaluate(s_.curve[at(curve)], c.s, c.v, kPrecision).sign();
    return s;
  }
  /// Certain sign of f; 0: not known.
  int sign(Spot& c, const Function& f) {
    int r = f.sign;
    for (const auto& [curve, exponent] : f.curve) {
      const int s = curve_sign(c, curve);
      if (s == 0 || exponent % 2 != 0) r *= s;
    }
    return r;
  }
  bool possibly_all(Spot& c, const std::vector<Function>& fs, int wanted) {
    return std::all_of(fs.begin(), fs.end(),
                       [&](const Function& f) { return sign(c, f) * wanted >= 0; });
  }

  std::vector<Algebraic> finish() {
    std::vector<Algebraic> out;
    for (const auto& [poly, roots] : kept_)
      for (const auto& [index, s] : roots) out.push_back(s);
    std::sort(out.begin(), out.end(),
              [](const Algebraic& a, const Algebraic& b) { return compare(a, b) < 0; });
    // The corners: crossings of consecutive sides.
    Algebraic lo, hi;
    for (std::size_t side = 0; side < 4; ++side) {
      const int p = s_.limit[side].curve[0].first, q = s_.limit[(side + 1) % 4].curve[0].first;
      for (const Crossing& c : crossings(std::min(p, q), std::max(p, q))) {
        if (!lo.minimal || compare(c.s, lo) < 0) lo = c.s;
        if (!hi.minimal || compare(c.s, hi) > 0) hi = c.s;
      }
    }
    BLUM_CHECK(lo.minimal && hi.minimal);
    std::erase_if(out,
                  [&](const Algebraic& a) { return compare(a, lo) < 0 || compare(a, hi) > 0; });
    return out;
  }

  static constexpr int kAsk = 2, kGrid = 16;
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  const Setting& s_;
  std::vector<Spot> grid_;
  MinimalStore store_;
  std::map<std::pair<int, int>, std::vector<Crossing>> crossings_;
  std::map<Poly, std::map<int, Algebraic>> kept_;
};

}  // namespace

std::vector<Algebraic> critical_abscissae(const Setting& setting) {
  return Collector(setting).collect();
}

}  // namespace blum::brute
