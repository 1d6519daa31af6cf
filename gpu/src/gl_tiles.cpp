// Sites drawn tile by tile, culled by our hierarchy of blocks on the CPU.
#include <algorithm>

#include "blum/kernel/parallel.hpp"
#include "gl_field.hpp"

namespace blum::detail {
namespace {

constexpr std::uint32_t kTile = 32;

void add_tiles(const GlJob& job, const BlockCull& cull, const CullNode& node,
               const std::vector<Sphere>& list, std::uint32_t side, std::vector<CullTile>& out) {
  bool is_tile = true;
  for (int axis = 0; axis < 3; ++axis) is_tile &= node.end[axis] - node.begin[axis] <= side;
  if (is_tile) {
    CullTile& tile = out.emplace_back();
    tile.node = node;
    std::vector<Sphere> ordered = list;
    std::ranges::sort(ordered, {}, &Sphere::rank);
    for (const Sphere& s : ordered) tile.places.push_back(s.site);
    return;
  }
  std::vector<CullNode> parts;
  BlockCull::split(node, parts);
  std::vector<Sphere> kept;
  std::vector<double> scratch;
  for (CullNode& part : parts) {
    cull.filter(part, list, kept, scratch);
    job.statistics.tree_tests += list.size();
    add_tiles(job, cull, part, std::vector<Sphere>(kept), side, out);
  }
}

}  // namespace

std::vector<CullTile> make_cull_tiles(const GlJob& job, std::uint32_t side) {
  std::vector<CullTile> tiles;
  const BlockCull cull(job.sites, job.grid, job.options.band);
  CullNode root = cull.root();
  if (job.options.culling.blocks) {
    std::vector<Sphere> kept;
    std::vector<double> scratch;
    cull.filter(root, job.sites.sphere, kept, scratch);
    add_tiles(job, cull, root, kept, side, tiles);
    std::ranges::stable_sort(tiles, {}, [](const CullTile& t) { return t.node.begin[2]; });
    return tiles;
  }
  std::vector<Sphere> all = job.sites.sphere;
  std::ranges::sort(all, {}, &Sphere::rank);
  std::vector<std::uint32_t> places;
  for (const Sphere& s : all) places.push_back(s.site);
  for (std::uint32_t k = 0; k < job.grid.size[2]; k += side) {
    CullNode slab = root;
    slab.begin[2] = k;
    slab.end[2] = std::min(k + side, job.grid.size[2]);
    tiles.push_back({slab, places});
  }
  return tiles;
}

std::uint64_t count_owners(const std::vector<std::uint32_t>& ids, const VoxelGrid& grid,
                           const std::array<std::uint32_t, 3>& begin,
                           const std::array<std::uint32_t, 3>& end) {
  std::vector<std::uint32_t> owners;
  for (std::uint32_t k = begin[2]; k < end[2]; ++k) {
    for (std::uint32_t j = begin[1]; j < end[1]; ++j) {
      const auto row = ids.begin() + static_cast<std::ptrdiff_t>(grid.index(begin[0], j, k));
      for (auto id = row; id != row + (end[0] - begin[0]); ++id) {
        if (*id != kNoSite.value && (owners.empty() || owners.back() != *id)) {
          owners.push_back(*id);
        }
      }
    }
  }
  std::ranges::sort(owners);
  return static_cast<std::uint64_t>(std::ranges::unique(owners).begin() - owners.begin());
}

std::vector<std::uint8_t> visible_sites(GlRaster& raster, GlJob& job, PieceBuffer& pieces,
                                        const SlicePass& pass,
                                        std::span<const std::uint32_t> places) {
  pieces.clear();
  std::vector<std::size_t> ends;
  std::vector<SlicePiece> of_site;
  for (const std::uint32_t place : places) {
    of_site.clear();
    pass.slice.add_pieces(job.sites, place, pass.rect, pass.style, pass.reach, of_site);
    for (const SlicePiece& p : of_site) pieces.add(p, place, job.sites.site[place].id);
    if (pass.writes && !of_site.empty()) ++job.statistics.block_sites;
    ends.push_back(pieces.corners());
  }
  job.statistics.queries += places.size();
  job.statistics.fragments += static_cast<std::uint64_t>(pieces.area());
  return raster.visible(pieces, ends, pass.nearer, pass.writes);
}

bool draw_tiles(GlRaster& raster, GlJob& job, const UseProposals& use) {
  const std::vector<CullTile> tiles = make_cull_tiles(job, kTile);
  const VoxelGrid& grid = job.grid;
  std::vector<std::uint32_t> ids(grid.voxels(), kNoSite.value);
  double area = 0;
  const auto group = static_cast<std::uint32_t>(2 * job.options.threads);
  std::vector<PieceBuffer> buffers(group, PieceBuffer(job.style.method, job.frame));
  std::vector<std::uint64_t> drawn(group);
  for (std::uint32_t first = 0; first < grid.size[2]; first += group) {
    const std::uint32_t slices = std::min(group, grid.size[2] - first);
    for_each_in_parallel(job.options.threads, slices, [&](int, std::size_t n) {
      const std::uint32_t k = first + static_cast<std::uint32_t>(n);
      const Slice slice(grid, k);
      std::vector<SlicePiece> pieces;
      buffers[n].clear();
      drawn[n] = 0;
      for (const CullTile& tile : tiles) {
        if (k < tile.node.begin[2] || k >= tile.node.end[2]) continue;
        const PixelRect rect = {
            static_cast<double>(tile.node.begin[0]), static_cast<double>(tile.node.begin[1]),
            static_cast<double>(tile.node.end[0]), static_cast<double>(tile.node.end[1])};
        const double reach = tile.node.reach + job.slack;
        for (const std::uint32_t place : tile.places) {
          pieces.clear();
          slice.add_pieces(job.sites, place, rect, job.style, reach, pieces);
          for (const SlicePiece& p : pieces) buffers[n].add(p, place, job.sites.site[place].id);
          drawn[n] += !pieces.empty();
        }
      }
    });
    for (std::uint32_t n = 0; n < slices; ++n) {
      const std::uint32_t k = first + n;
      raster.begin_slice(Slice(grid, k).z());
      raster.draw(buffers[n]);
      raster.read_ids(
          std::span(ids).subspan(grid.index(0, 0, k), std::size_t{grid.size[0]} * grid.size[1]));
      area += buffers[n].area();
      job.statistics.block_sites += drawn[n];
    }
    if (!job.goes_on(0.9 * (first + slices) / grid.size[2])) return false;
  }
  for (const CullTile& tile : tiles) {
    for (std::uint32_t k = tile.node.begin[2]; k < tile.node.end[2]; ++k) {
      auto begin = tile.node.begin, end = tile.node.end;
      begin[2] = k;
      end[2] = k + 1;
      ++job.statistics.blocks;
      job.statistics.owner_sites += count_owners(ids, grid, begin, end);
    }
  }
  job.statistics.fragments += static_cast<std::uint64_t>(area);
  use(ids);
  return job.goes_on(1);
}

}  // namespace blum::detail
