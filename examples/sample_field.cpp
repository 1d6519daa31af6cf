// Samples the signed distance field of a solid and prints where its largest inscribed ball is, up
// to half a voxel's diagonal: sample_field MODEL [RESOLUTION].
#include <blum/gpu/field.hpp>
#include <blum/gpu/sides.hpp>
#include <blum/kernel/mesh.hpp>
#include <blum/kernel/solid.hpp>
#include <cmath>
#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: sample_field MODEL [RESOLUTION]\n";
    return 1;
  }
  const auto mesh = blum::read_mesh(argv[1]);
  if (!mesh) {
    std::cerr << mesh.error().message << '\n';
    return 1;
  }
  const auto solid = blum::build_solid(mesh.value());
  const auto sites = blum::SiteSet::build(blum::soup_of(mesh.value()));
  if (!solid || !sites) {
    std::cerr << (solid ? sites.error() : solid.error()).message << '\n';
    return 1;
  }
  const auto n = static_cast<std::uint32_t>(argc > 2 ? std::atoi(argv[2]) : 64);
  const auto grid = blum::make_grid(sites.value().box(), {n, n, n});
  if (!grid) {
    std::cerr << grid.error().message << '\n';
    return 1;
  }
  const auto field = blum::compute_field(sites.value(), grid.value(), {});
  const auto sides = blum::sides_of(solid.value(), field.value(), 1);
  std::size_t deepest = 0;
  for (std::size_t v = 0; v < grid.value().voxels(); ++v) {
    if (blum::signed_distance(field.value(), sides, v) <
        blum::signed_distance(field.value(), sides, deepest)) {
      deepest = v;
    }
  }
  const blum::Point3 p = grid.value().point(deepest), &w = grid.value().spacing;
  const blum::DistanceInterval radius = field.value().interval(deepest);
  std::cout << "a ball of radius " << radius.lo << " around (" << p.x << ", " << p.y << ", " << p.z
            << ") fits; none is larger than " << radius.hi + 0.5 * std::hypot(w.x, w.y, w.z)
            << '\n';
}
