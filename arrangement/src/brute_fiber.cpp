#include "brute_fiber.hpp"

#include <algorithm>

#include "blum/kernel/check.hpp"

namespace blum::brute {

Fiber::Fiber(const Setting& setting, Algebraic s) : setting_(setting), s_(std::move(s)) {
  for (precision_ = 128; !arrange(precision_); precision_ *= 2)
    BLUM_CHECK(precision_ < (slong{1} << 24));
}

std::vector<Real> Fiber::roots(const Curve& f, slong precision) const {
  const Real& s = s_.enclosure(precision);
  if (f.degree() == 1) return {curve_root(f, 0, false, s, precision)};
  const Poly d = f.discriminant();
  int sign = evaluate(d, s, precision).sign();
  if (sign == 0 && s_.is_root_of(d)) return {curve_root(f, 0, true, s, precision)};
  for (slong p = 2 * precision; sign == 0; p *= 2) sign = evaluate(d, s_.enclosure(p), p).sign();
  if (sign < 0) return {};
  return {curve_root(f, 0, false, s, precision), curve_root(f, 1, false, s, precision)};
}

Fiber::Equal Fiber::equal(const Curve& f, int branch_f, const std::vector<Real>& roots_f,
                          const Curve& g, int branch_g, const std::vector<Real>& roots_g,
                          slong precision) const {
  const Real &a = roots_f[at(branch_f)], &b = roots_g[at(branch_g)];
  if (!a.overlaps(b)) return Equal::kNo;
  if (f == g) {
    if (branch_f == branch_g) return Equal::kYes;
    return Equal::kUnknown;  // two roots of one curve differ: more precision
  }
  const Elimination e = eliminate(f, g);
  if (!s_.is_root_of(e.resultant)) return Equal::kUnknown;  // no common root: more precision
  if (s_.is_root_of(e.first)) {                             // proportional: the same roots
    BLUM_CHECK(roots_f.size() == roots_g.size());
    return branch_f == branch_g ? Equal::kYes : Equal::kUnknown;
  }
  // Exactly one common root.
  const Real& s = s_.enclosure(precision);
  Real common = evaluate(e.rest, s, precision);
  arb_neg(common.get(), common.get());
  arb_div(common.get(), common.get(), evaluate(e.first, s, precision).get(), precision);
  if (!common.overlaps(a) || !common.overlaps(b)) return Equal::kNo;
  for (const auto* roots : {&roots_f, &roots_g})
    if (std::count_if(roots->begin(), roots->end(),
                      [&](const Real& r) { return r.overlaps(common); }) != 1)
      return Equal::kUnknown;
  return Equal::kYes;
}

bool Fiber::arrange(slong precision) {
  const std::size_t n = setting_.curve.size();
  std::vector<std::vector<Real>> curve_roots(n);
  std::vector<Root> all;
  for (std::size_t c = 0; c < n; ++c) {
    curve_roots[c] = roots(setting_.curve[c], precision);
    for (std::size_t b = 0; b < curve_roots[c].size(); ++b) {
      if (!arb_is_finite(curve_roots[c][b].get())) return false;
      Root r{{static_cast<int>(c), static_cast<int>(b)}, curve_roots[c][b], {}, {}};
      arb_get_lbound_arf(r.lo.get(), r.value.get(), precision);
      arb_get_ubound_arf(r.hi.get(), r.value.get(), precision);
      all.push_back(std::move(r));
    }
  }
  std::sort(all.begin(), all.end(),
            [](const Root& a, const Root& b) { return arf_cmp(a.lo.get(), b.lo.get()) < 0; });
  const auto same = [&](const Branch& a, const Branch& b) {
    return equal(setting_.curve[at(a.curve)], a.branch, curve_roots[at(a.curve)],
                 setting_.curve[at(b.curve)], b.branch, curve_roots[at(b.curve)], precision);
  };
  point_.clear();
  std::vector<Bound> reach;  // the largest upper bound of the points so far
  for (const Root& r : all) {
    int home = -1;
    for (int k = static_cast<int>(point_.size()) - 1;
         k >= 0 && arf_cmp(reach[at(k)].get(), r.lo.get()) >= 0; --k) {
      if (!point_[at(k)].value.overlaps(r.value)) continue;
      // Distinct, but not by these enclosures, is no order either: more precision.
      if (home >= 0 || same(point_[at(k)].on[0], r.on) != Equal::kYes) return false;
      home = k;
    }
    if (home < 0) {
      home = static_cast<int>(point_.size());
      point_.push_back({{r.on}, r.value});
      reach.push_back(reach.empty() ? r.hi : reach.back());
    } else {
      Point& p = point_[at(home)];
      p.on.push_back(r.on);
      // Any member's enclosure holds; keep the smaller one.
      if (mag_cmp(arb_radref(r.value.get()), arb_radref(p.value.get())) < 0) p.value = r.value;
    }
    for (std::size_t k = at(home); k < reach.size(); ++k)
      if (arf_cmp(reach[k].get(), r.hi.get()) < 0) reach[k] = r.hi;
  }
  for (std::size_t k = 0; k + 1 < point_.size(); ++k)
    if (!point_[k].value.below(point_[k + 1].value)) return false;
  point_of_.assign(n, {-1, -1});
  for (std::size_t k = 0; k < point_.size(); ++k)
    for (const Branch& b : point_[k].on) point_of_[at(b.curve)][at(b.branch)] = static_cast<int>(k);
  for (std::size_t c = 0; c < n; ++c)
    if (setting_.curve[c].degree() == 2 && curve_roots[c].size() == 1)
      point_of_[c][1] = point_of_[c][0];
  return true;
}

int Fiber::point_of(int curve, int branch) const {
  const int k = point_of_[at(curve)][at(branch)];
  BLUM_CHECK(k >= 0);
  return k;
}

int Fiber::sign(const Function& f, int position) const {
  int sign = f.sign;
  for (const auto& [curve, exponent] : f.curve) {
    // The leading coefficient is positive: the sign is that of (-1)^(number of roots above).
    for (const int k : point_of_[at(curve)]) {
      if (k < 0) continue;
      const int p = 2 * k + 1;
      if (p == position) return 0;
      if (p > position && exponent % 2 != 0) sign = -sign;
    }
  }
  return sign;
}

Place Fiber::place(int position) const {
  Place out;
  const auto all_at_most_zero = [&](const std::vector<Function>& fs) {
    return std::all_of(fs.begin(), fs.end(),
                       [&](const Function& f) { return sign(f, position) <= 0; });
  };
  out.within = true;
  for (std::size_t k = 0; k < setting_.limit.size(); ++k) {
    const int s = sign(setting_.limit[k], position);
    if (s < 0) out.within = false;
    if (s == 0) out.sides |= 1u << k;
  }
  if (!out.within) return {};
  for (std::size_t t = 0; t < setting_.triangle.size(); ++t)
    if (sign(setting_.plane[t], position) == 0 && all_at_most_zero(setting_.prism[t]))
      out.triangle.push_back(static_cast<int>(t));
  std::vector<int> in_domain;
  for (std::size_t i = 0; i < setting_.site.size(); ++i)
    if (all_at_most_zero(setting_.domain[i])) in_domain.push_back(static_cast<int>(i));
  for (const int i : in_domain)
    if (std::all_of(in_domain.begin(), in_domain.end(),
                    [&](int j) { return sign(setting_.difference[at(i)][at(j)], position) <= 0; }))
      out.governor.push_back(i);
  return out;
}

bool Fiber::vanishes(const Factors& g, int k) const {
  if (g.sign == 0) return true;
  const Branch on = point(k)[0];
  const Curve& f = setting_.curve[at(on.curve)];
  for (const auto& [curve, exponent] : g.curve) {
    for (slong precision = precision_;; precision *= 2) {
      BLUM_CHECK(precision < (slong{1} << 24));
      const std::vector<Real> roots_f = roots(f, precision), roots_g = roots(curve, precision);
      bool unknown = false;
      for (int b = 0; b < static_cast<int>(roots_g.size()); ++b) {
        const Equal e = equal(f, on.branch, roots_f, curve, b, roots_g, precision);
        if (e == Equal::kYes) return true;
        unknown = unknown || e == Equal::kUnknown;
      }
      if (!unknown) break;
    }
  }
  return false;
}

namespace {

std::size_t at(int k) { return static_cast<std::size_t>(k); }

/// Is the affine function g zero at a point of a fiber?
bool vanishes(const Setting& setting, const Fiber& fiber, const Affine& g, int point) {
  if (g.cu != 0 && g.cv == setting.shear * g.cu) {  // a function of s alone
    const Rational s = -g.c / g.cu;
    return compare(fiber.abscissa(), rational(s)) == 0;
  }
  const auto factors = setting.factor({0, 0, 0, g.cu, g.cv, g.c});
  BLUM_CHECK(factors);
  return fiber.vanishes(*factors, point);
}

}  // namespace

bool feet_differ(const Setting& setting, const Fiber& fiber, int point,
                 const std::vector<int>& governors) {
  if (setting.kind == DiagramKind::kVoronoi) return governors.size() > 1;  // all ties count
  for (const int i : governors) {
    for (const int j : governors) {
      if (j >= i || !setting.essential[at(i)][at(j)]) continue;
      const Moving a = setting.foot(i), b = setting.foot(j);
      for (std::size_t k = 0; k < 3; ++k) {
        const Affine g{a[k].cu - b[k].cu, a[k].cv - b[k].cv, a[k].c - b[k].c};
        if (!vanishes(setting, fiber, g, point)) return true;
      }
    }
  }
  return false;
}

}  // namespace blum::brute
