#include "engine_context.hpp"

#include <algorithm>
#include <bit>

namespace blum {
namespace {

std::uint64_t mix(std::uint64_t x) {  // splitmix64's finaliser
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

std::uint64_t pair_key(SiteId a, SiteId b) {
  if (b < a) std::swap(a, b);
  return (std::uint64_t{a.value} << 32) | b.value;
}

}  // namespace

bool EngineContext::never_essential(SiteId a, SiteId b) {
  const auto [it, fresh] = never_.try_emplace(pair_key(a, b), false);
  if (fresh) it->second = predicates.never_essential(a, b);
  return it->second;
}

const BallVector& EngineContext::unit_difference(SiteId a, SiteId b) {
  const std::uint64_t key = (std::uint64_t{a.value} << 32) | b.value;
  const auto [it, fresh] = difference_.try_emplace(key);
  if (fresh) it->second = predicates.unit_difference(a, b);
  return it->second;
}

double EngineContext::jitter(double a, double b, std::uint64_t c) const {
  std::uint64_t h = mix(seed);
  h = mix(h ^ std::bit_cast<std::uint64_t>(a));
  h = mix(h ^ std::bit_cast<std::uint64_t>(b));
  h = mix(h ^ c);
  return static_cast<double>(h >> 11) * 0x1p-53;
}

double EngineContext::split(double lo, double hi, std::uint64_t attempt) const {
  return lo + (hi - lo) * (0.4 + 0.2 * jitter(lo, hi, attempt));
}

Groups Groups::make(EngineContext& context, std::span<const LocalForm> forms) {
  Groups g;
  const auto n = static_cast<std::uint32_t>(forms.size());
  constexpr auto kUnset = 0xffffffffu;
  g.of.assign(n, kUnset);
  std::vector<std::uint32_t> stack;
  std::vector<std::uint32_t> members;
  for (std::uint32_t root = 0; root < n; ++root) {
    if (g.of[root] != kUnset) continue;
    members.clear();
    stack.assign(1, root);
    g.of[root] = g.count;
    while (!stack.empty()) {
      const auto i = stack.back();
      stack.pop_back();
      members.push_back(i);
      for (std::uint32_t j = 0; j < n; ++j) {
        if (g.of[j] != kUnset || !context.never_essential(forms[i].site, forms[j].site)) continue;
        g.of[j] = g.count;
        stack.push_back(j);
      }
    }
    for (std::size_t i = 0; i < members.size() && g.cliques; ++i)
      for (std::size_t j = i + 1; j < members.size() && g.cliques; ++j)
        g.cliques = context.never_essential(forms[members[i]].site, forms[members[j]].site);
    ++g.count;
  }
  return g;
}

std::uint32_t Groups::find(std::span<const LocalForm> forms, SiteId s) const {
  for (std::uint32_t i = 0; i < forms.size(); ++i)
    if (forms[i].site == s) return of[i];
  return count;
}

PairSlope pair_slope(EngineContext& context, const LocalForm& a, const LocalForm& b) {
  PairSlope r;
  if (a.kind == SiteKind::kFace && b.kind == SiteKind::kFace) {
    // Inside both planes d = -height, so grad(d_a - d_b) = n_b - n_a: constant, and accurate
    // however close the planes are.
    r.gradient = context.unit_difference(b.site, a.site);
    r.constant = true;
    return r;
  }
  // At a tie grad(d_a - d_b) and grad(d_a^2 - d_b^2) differ by the positive factor 2d.
  for (int k = 0; k < 3; ++k) r.gradient[k] = a.gradient[k] - b.gradient[k];
  return r;
}

double slope_upper(const PairSlope& slope, const LocalForm& a, const LocalForm& b,
                   const Range& range, const std::array<double, 3>& w) {
  Ball s = slope.gradient[0] * Ball(w[0]) + slope.gradient[1] * Ball(w[1]) +
           slope.gradient[2] * Ball(w[2]);
  double bound = s.high();
  if (!slope.constant) {
    for (int i = 0; i < 3; ++i) {
      if (range.half[i] == 0) continue;
      Ball row(0.0);
      for (int j = 0; j < 3; ++j) {
        if (w[j] == 0) continue;
        row = row + (a.matrix(i, j) - b.matrix(i, j)) * Ball(w[j]);
      }
      bound += 2 * row.magnitude() * range.half[i] * Ball::kInflate;
    }
    bound += std::abs(bound) * 0x1p-48 + 0x1p-1000;
    // The sum of up to four terms may cancel: charge the rounding of each partial sum.
    bound += 0x1p-50 * std::abs(s.high());
  }
  return bound;
}

bool may_tie(EngineContext& context, const LocalForm& a, const LocalForm& b, const Range& range) {
  return !certainly_farther(context.geometry, a, b, range) &&
         !certainly_farther(context.geometry, b, a, range);
}

}  // namespace blum
