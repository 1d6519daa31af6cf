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

std::uint64_t ordered_key(SiteId a, SiteId b) { return (std::uint64_t{a.value} << 32) | b.value; }

std::uint64_t pair_key(SiteId a, SiteId b) { return a < b ? ordered_key(a, b) : ordered_key(b, a); }

}  // namespace

bool EngineContext::never_essential(SiteId a, SiteId b) {
  if (voronoi()) return a == b;
  const auto [it, fresh] = never_.try_emplace(pair_key(a, b), false);
  if (fresh) it->second = predicates.never_essential(a, b);
  return it->second;
}

const BallVector& EngineContext::unit_difference(SiteId a, SiteId b) {
  const auto [it, fresh] = difference_.try_emplace(ordered_key(a, b));
  if (fresh) it->second = predicates.unit_difference(a, b);
  return it->second;
}

const Ball& EngineContext::height(std::uint32_t point, SiteId face) {
  const auto [it, fresh] = height_.try_emplace((std::uint64_t{point} << 32) | face.value);
  if (fresh) it->second = predicates.height(point, geometry.index().element(face));
  return it->second;
}

Predicates::FootCone EngineContext::foot_cone(std::uint32_t vertex) {
  const auto [it, fresh] = foot_cone_.try_emplace(vertex, Predicates::FootCone::kNone);
  if (fresh) it->second = predicates.foot_cone(vertex);
  return it->second;
}

const std::optional<Predicates::VertexLink>& EngineContext::vertex_link(std::uint32_t vertex) {
  const auto [it, fresh] = vertex_link_.try_emplace(vertex);
  if (fresh) it->second = predicates.vertex_link(vertex);
  return it->second;
}

const Touch& EngineContext::touch(SiteId a, SiteId b) {
  const std::uint64_t key = (std::uint64_t{a.value} << 32) | b.value;
  const auto [it, fresh] = touch_.try_emplace(key);
  if (fresh) it->second = blum::touch(predicates, a, b);
  return it->second;
}

const Predicates::CarrierDifference& EngineContext::carrier_difference(SiteId a, SiteId b) {
  const auto [it, fresh] = carrier_difference_.try_emplace(ordered_key(a, b));
  if (fresh) it->second = predicates.carrier_difference(a, b);
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

}  // namespace blum
