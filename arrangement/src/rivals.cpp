#include "rivals.hpp"

#include <algorithm>
#include <cmath>

#include "slope.hpp"

namespace blum {
namespace {

/// Conditions of a domain beyond so many are not looked at: vertices of many edges.
constexpr std::uint32_t kMaxConditions = 12;
/// Of more forms third ones are not looked for: bisecting is cheaper.
constexpr std::size_t kMaxForms = 16;

PairForm linear_form(const Ball& value, const BallVector& gradient) {
  PairForm f{value, gradient, {}};
  f.a.fill(Ball(0.0));
  return f;
}

/// Has the sign of the difference of their distances where these are the heights of faces over
/// known sides, or else of the carriers.
PairForm difference_form(EngineContext& context, const LocalForm& a, const LocalForm& c,
                         bool by_heights, const Range& range) {
  if (!by_heights) return pair_form(context, a, c, range);
  return linear_form(with_sign(a.height, a.side) - with_sign(c.height, c.side),
                     slope_of_heights(context, a, c));
}

/// What is 0 wherever both govern the same point: a plane where they touch, else the difference of
/// their distances or of the squares.
PairForm tie_form(EngineContext& context, const LocalForm& a, const LocalForm& c,
                  const Range& range) {
  if (context.voronoi()) {
    const Touch& t = context.touch(a.site, c.site);
    if (t.kind == Touch::Kind::kPlane || t.kind == Touch::Kind::kBisector)
      return linear_form(dot(t.w, difference(range.center, context.geometry.solid().point[t.base])),
                         t.w);
  }
  return difference_form(context, a, c, a.side != 0 && c.side != 0, range);
}

/// f + t * g.
PairForm combined(const PairForm& f, double t, const PairForm& g) {
  const Ball factor(t);
  PairForm sum;
  sum.value = f.value + factor * g.value;
  for (std::size_t k = 0; k < 3; ++k) sum.gradient[k] = f.gradient[k] + factor * g.gradient[k];
  for (std::size_t k = 0; k < 6; ++k) sum.a[k] = f.a[k] + factor * g.a[k];
  return sum;
}

/// May f + t * g be negative all over the range? A guess, by midpoints alone.
bool seems_negative(const PairForm& f, double t, const PairForm& g, const Range& range) {
  double bound = f.value.mid + t * g.value.mid;
  for (int i = 0; i < 3 && bound < 0; ++i) {
    if (range.half[i] == 0) continue;
    bound += std::abs(f.gradient[i].mid + t * g.gradient[i].mid) * range.half[i];
    for (int j = 0; j < 3; ++j)
      bound +=
          std::abs(f.matrix(i, j).mid + t * g.matrix(i, j).mid) * range.half[i] * range.half[j];
  }
  return bound < 0;
}

enum class Factor : std::uint8_t { kAny, kPositive };

/// Is there a factor with f + t * g < 0 all over the range? Tries those that leave no slope along
/// one of the axes.
bool exclude_each_other(const PairForm& f, const PairForm& g, Factor factor, const Range& range) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (range.half[k] == 0 || g.gradient[k].mid == 0) continue;
    const double t = -f.gradient[k].mid / g.gradient[k].mid;
    if (!std::isfinite(t) || (factor == Factor::kPositive && !(t > 0)) ||
        !seems_negative(f, t, g, range))
      continue;
    const PairForm sum = combined(f, t, g);
    if (sum.value.high() + sum.slack(range) < 0) return true;
  }
  return false;
}

/// A condition of a domain that may fail in the range, by midpoints: not negative where the site
/// governs.
struct Condition {
  double value;
  std::array<double, 3> gradient;
  const HalfSpace* exact;
};

struct Conditions {
  std::array<Condition, kMaxConditions> all;
  std::uint32_t count = 0;

  Conditions(const SiteGeometry& geometry, const LocalForm& f, const Range& range) {
    if (f.crossed == 0) return;
    const auto domain = geometry.domain(f.site);
    for (std::uint32_t k = 0; k < domain.size() && count < kMaxConditions; ++k) {
      if (k < 32 && (f.crossed >> k & 1) == 0) continue;
      const Point3& p = geometry.solid().point[domain[k].base];
      Condition& c = all[count++];
      c.exact = &domain[k];
      c.value = 0;
      for (int i = 0; i < 3; ++i) {
        c.gradient[i] = -domain[k].w[i].mid;
        c.value += c.gradient[i] * (range.center[i] - p[i]);
      }
    }
  }
  [[nodiscard]] const Condition* begin() const { return all.data(); }
  [[nodiscard]] const Condition* end() const { return all.data() + count; }
};

PairForm form_of(const SiteGeometry& geometry, const Condition& c, const Range& range) {
  const BallVector& w = c.exact->w;
  return linear_form(-dot(w, difference(range.center, geometry.solid().point[c.exact->base])),
                     {-w[0], -w[1], -w[2]});
}

/// By midpoints alone, with `bend` the most that the second-order terms of g add: a guess whether
/// exclude_each_other will find a factor.
bool seem_to_exclude(const Condition& f, double value, const std::array<double, 3>& gradient,
                     double bend, Factor factor, const Range& range) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (range.half[k] == 0 || gradient[k] == 0) continue;
    const double t = -f.gradient[k] / gradient[k];
    if (!std::isfinite(t) || (factor == Factor::kPositive && !(t > 0))) continue;
    double bound = f.value + t * value + std::abs(t) * bend;
    for (std::size_t i = 0; i < 3; ++i)
      bound += std::abs(f.gradient[i] + t * gradient[i]) * range.half[i];
    if (bound < 0) return true;
  }
  return false;
}

}  // namespace

bool tie_outside_domains(EngineContext& context, const LocalForm& a, const LocalForm& c,
                         const Range& range) {
  if (a.crossed == 0 && c.crossed == 0) return false;
  const SiteGeometry& geometry = context.geometry;
  const Conditions of_a(geometry, a, range), of_c(geometry, c, range);
  for (const Condition& f : of_a)
    for (const Condition& g : of_c)
      if (seem_to_exclude(f, g.value, g.gradient, 0, Factor::kPositive, range) &&
          exclude_each_other(form_of(geometry, f, range), form_of(geometry, g, range),
                             Factor::kPositive, range))
        return true;
  const PairForm tie = tie_form(context, a, c, range);
  const std::array<double, 3> gradient = {tie.gradient[0].mid, tie.gradient[1].mid,
                                          tie.gradient[2].mid};
  double bend = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      bend += std::abs(tie.matrix(i, j).mid) * range.half[i] * range.half[j];
  for (const auto* of : {&of_a, &of_c})
    for (const Condition& f : *of)
      if (seem_to_exclude(f, tie.value.mid, gradient, bend, Factor::kAny, range) &&
          exclude_each_other(form_of(geometry, f, range), tie, Factor::kAny, range))
        return true;
  return false;
}

bool nearer_at_ties(EngineContext& context, const LocalForm& b, const LocalForm& a,
                    const LocalForm& c, const Range& range) {
  if (!b.covers) return false;
  const bool by_heights = a.side != 0 && b.side != 0 && b.covers_side;
  return exclude_each_other(difference_form(context, b, a, by_heights, range),
                            tie_form(context, a, c, range), Factor::kAny, range);
}

bool Rivals::decide(std::size_t i, std::size_t j) {
  const LocalForm &a = forms_[i], &c = forms_[j];
  if (!may_both_govern(context_, a, c, range_)) return false;
  if (context_.plain || context_.parts != nullptr) return true;
  const auto behind = [&](const LocalForm& b) {
    return b.site != a.site && b.site != c.site && nearer_at_ties(context_, b, a, c, range_);
  };
  const bool apart = tie_outside_domains(context_, a, c, range_) ||
                     (forms_.size() <= kMaxForms && std::ranges::any_of(forms_, behind));
  context_.counts.rivals += apart;
  return !apart;
}

}  // namespace blum
