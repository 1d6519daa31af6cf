/// The OpenGL drivers of the machine, and what a field of theirs must satisfy.
#pragma once

#include <array>
#include <string>

#include "field_tools.hpp"

namespace blum::test {

inline constexpr std::array<FieldBackend, 2> kGlBackends = {FieldBackend::kEgl,
                                                            FieldBackend::kOsmesa};

/// The greatest regret, recomputed from the twin; what is wrong goes to `problem`.
inline double greatest_regret(const SiteSet& sites, const DistanceField& field,
                              const DistanceField& brute, std::string& problem) {
  problem = difference(sites, field, brute);
  double greatest = 0;
  for (std::size_t v = 0; v < field.site.size(); ++v) {
    const DistanceInterval truth = brute.interval(v);
    const double of_site =
        std::sqrt(sites.squared_distance(field.grid.point(v), field.site_at(v)).lo);
    greatest = std::max(greatest, of_site - truth.hi);
    if (of_site > truth.hi + field.bound.regret) problem = "regret at " + std::to_string(v);
    // The distance is the proposed site's, in double.
    if (field.distance[v] < of_site || field.distance[v] > of_site * (1 + 1e-12) + 1e-9) {
      problem = "distance at " + std::to_string(v);
    }
  }
  return greatest;
}

}  // namespace blum::test
