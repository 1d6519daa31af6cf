// Finds out which parts of a surface can be Voronoi neighbours, the certified superset beside what
// a grid of samples shows: find_neighbours MODEL [RESOLUTION].
#include <blum/gpu/field.hpp>
#include <blum/gpu/neighbours.hpp>
#include <blum/kernel/mesh.hpp>
#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: find_neighbours MODEL [RESOLUTION]\n";
    return 1;
  }
  const auto mesh = blum::read_mesh(argv[1]);
  if (!mesh) {
    std::cerr << mesh.error().message << '\n';
    return 1;
  }
  const auto sites = blum::SiteSet::build(blum::soup_of(mesh.value()));
  if (!sites) {
    std::cerr << sites.error().message << '\n';
    return 1;
  }
  const auto n = static_cast<std::uint32_t>(argc > 2 ? std::atoi(argv[2]) : 24);
  const auto grid = blum::make_grid(sites.value().box(), {n, n, n});
  if (!grid) {
    std::cerr << grid.error().message << '\n';
    return 1;
  }
  const auto field = blum::compute_field(sites.value(), grid.value(), {});
  const auto superset = blum::neighbour_superset(sites.value(), grid.value(), 1);
  const std::size_t all = std::size_t{sites.value().size()} * (sites.value().size() - 1) / 2;
  std::cout << all << " pairs of sites; " << superset.value().size() << " can be neighbours, "
            << blum::neighbour_pairs(field.value()).size() << " are seen by the samples\n";
}
