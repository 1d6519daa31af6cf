// Thesis section 2.9: a site is drawn in a tile only if it was seen in a tile beside it.
//
// For each of the 8 directions (signs of the axes) the tiles are gone through along it. Drawn in a
// tile are the sites that meet it and those seen in one of the three tiles before it. No owner is
// lost: let x in a tile belong to a site with the foot f. The segment from x to f belongs to that
// site, too; backwards it goes through tiles along one of the directions, begins in a tile that the
// site meets, and the site is seen in each of these tiles.
//
// Departures from the thesis, both needed for that argument:
// * Theorem 2.2 starts a site from the tile of one pivot point and says that connectedness alone
//   leads to the tile through its neighbours of that direction; but a connected region can go round
//   another way. Here a site starts from every tile that its sphere's box meets.
// * Seen is what is nearest at some sample after two half diagonals of a voxel are taken off (see
//   gl_sweep.cpp). Sites beyond the grid's box are drawn everywhere.
#include <algorithm>

#include "gl_field.hpp"
#include "vector3.hpp"

namespace blum::detail {
namespace {

constexpr std::uint32_t kSide = 32, kSlices = 8;

class Ranges {
 public:
  Ranges(GlRaster& raster, GlJob& job)
      : raster_(raster),
        job_(job),
        pieces_(job.style.method, job.frame),
        half_(0.5 * length(job.grid.spacing)) {
    for (int axis = 0; axis < 3; ++axis) {
      side_[axis] = axis < 2 ? kSide : kSlices;
      tiles_[axis] = (job.grid.size[axis] + side_[axis] - 1) / side_[axis];
    }
    start_.resize(std::size_t{tiles_[0]} * tiles_[1] * tiles_[2]);
    for (std::uint32_t place = 0; place < job.sites.site.size(); ++place) enter(place);
  }

  bool run(int direction, std::vector<std::uint32_t>& ids) {
    seen_.assign(start_.size(), {});
    std::vector<std::uint8_t> is_in(job_.sites.site.size(), 0);
    for (std::size_t n = 0; n < start_.size(); ++n) {
      const std::array<std::uint32_t, 3> step = {
          static_cast<std::uint32_t>(n % tiles_[0]),
          static_cast<std::uint32_t>(n / tiles_[0] % tiles_[1]),
          static_cast<std::uint32_t>(n / tiles_[0] / tiles_[1])};
      std::array<std::uint32_t, 3> tile{};
      for (int axis = 0; axis < 3; ++axis) {
        tile[axis] = (direction >> axis & 1) != 0 ? tiles_[axis] - 1 - step[axis] : step[axis];
      }
      std::vector<std::uint32_t> places;
      const auto add = [&](const std::vector<std::uint32_t>& more) {
        for (const std::uint32_t place : more) {
          if (is_in[place] == 0) places.push_back(place);
          is_in[place] = 1;
        }
      };
      add(start_[index(tile)]);
      for (int axis = 0; axis < 3; ++axis) {
        if (step[axis] == 0) continue;
        auto before = tile;
        before[axis] += (direction >> axis & 1) != 0 ? 1 : -1;
        add(seen_[index(before)]);
      }
      for (const std::uint32_t place : places) is_in[place] = 0;
      draw(tile, places, ids);
      if (!job_.goes_on(
              (direction + static_cast<double>(n + 1) / static_cast<double>(start_.size())) / 8)) {
        return false;
      }
    }
    return true;
  }

 private:
  [[nodiscard]] std::size_t index(const std::array<std::uint32_t, 3>& tile) const {
    return tile[0] + tiles_[0] * (tile[1] + std::size_t{tiles_[1]} * tile[2]);
  }

  void enter(std::uint32_t place) {
    const Sphere& s = job_.sites.sphere[place];
    std::array<std::uint32_t, 3> lo{}, hi{};
    for (int axis = 0; axis < 3; ++axis) {
      // In samples; a voxel more on either side covers all rounding.
      const double from =
          (s.centre[axis] - s.radius - job_.grid.origin[axis]) / job_.grid.spacing[axis];
      const double to =
          (s.centre[axis] + s.radius - job_.grid.origin[axis]) / job_.grid.spacing[axis];
      const bool is_inside = from > -0.5 && to < job_.grid.size[axis] - 0.5;
      const double last = tiles_[axis] - 1;
      lo[axis] = is_inside
                     ? static_cast<std::uint32_t>(std::clamp((from - 1) / side_[axis], 0.0, last))
                     : 0;
      hi[axis] = is_inside
                     ? static_cast<std::uint32_t>(std::clamp((to + 1) / side_[axis], 0.0, last))
                     : tiles_[axis] - 1;
      if (is_inside) continue;
      lo = {0, 0, 0};
      hi = {tiles_[0] - 1, tiles_[1] - 1, tiles_[2] - 1};
      break;
    }
    for (std::uint32_t k = lo[2]; k <= hi[2]; ++k) {
      for (std::uint32_t j = lo[1]; j <= hi[1]; ++j) {
        for (std::uint32_t i = lo[0]; i <= hi[0]; ++i) start_[index({i, j, k})].push_back(place);
      }
    }
  }

  void draw(const std::array<std::uint32_t, 3>& tile, std::vector<std::uint32_t>& places,
            std::vector<std::uint32_t>& ids) {
    std::array<std::uint32_t, 3> begin{}, end{};
    Point3 middle;
    for (int axis = 0; axis < 3; ++axis) {
      begin[axis] = tile[axis] * side_[axis];
      end[axis] = std::min(begin[axis] + side_[axis], job_.grid.size[axis]);
      middle[axis] = 0.5 * (job_.grid.coordinate(axis, begin[axis]) +
                            job_.grid.coordinate(axis, end[axis] - 1));
    }
    const auto far = [&](std::uint32_t place) {
      const Sphere& s = job_.sites.sphere[place];
      return length(minus(s.centre, middle)) - s.radius;
    };
    std::ranges::sort(places, {}, far);
    std::vector<std::uint8_t> is_seen(places.size(), 0);
    const double more = 2 * half_ + job_.slack, reach = job_.options.band + job_.slack;
    for (std::uint32_t k = begin[2]; k < end[2]; ++k) {
      const Slice slice(job_.grid, k);
      raster_.begin_part(slice.z(), {begin[0], begin[1]}, {end[0], end[1]});
      const PixelRect rect = {static_cast<double>(begin[0]), static_cast<double>(begin[1]),
                              static_cast<double>(end[0]), static_cast<double>(end[1])};
      look({slice, rect, job_.style, reach}, places, is_seen);
      SlicePass again{slice, rect, job_.style, reach + more, more, false};
      again.style.dilation += 1;
      again.style.depth = job_.grid.spacing.z;
      look(again, places, is_seen);
      const std::size_t samples = std::size_t{job_.grid.size[0]} * job_.grid.size[1];
      raster_.read_ids(std::span(ids).subspan(job_.grid.index(0, 0, k), samples));
      ++job_.statistics.blocks;
      job_.statistics.owner_sites +=
          count_owners(ids, job_.grid, {begin[0], begin[1], k}, {end[0], end[1], k + 1});
    }
    std::vector<std::uint32_t>& seen = seen_[index(tile)];
    for (std::size_t n = 0; n < places.size(); ++n) {
      if (is_seen[n] != 0) seen.push_back(places[n]);
    }
  }

  /// Without writing only the sites that were not seen yet are tested.
  void look(const SlicePass& pass, const std::vector<std::uint32_t>& places,
            std::vector<std::uint8_t>& is_seen) {
    std::vector<std::uint32_t> tested;
    std::vector<std::size_t> which;
    for (std::size_t n = 0; n < places.size(); ++n) {
      if (!pass.writes && is_seen[n] != 0) continue;
      tested.push_back(places[n]);
      which.push_back(n);
    }
    const auto seen = visible_sites(raster_, job_, pieces_, pass, tested);
    for (std::size_t n = 0; n < which.size(); ++n) is_seen[which[n]] |= seen[n];
  }

  GlRaster& raster_;
  GlJob& job_;
  PieceBuffer pieces_;
  double half_;
  std::array<std::uint32_t, 3> side_{}, tiles_{};
  std::vector<std::vector<std::uint32_t>> start_, seen_;  // by tile
};

}  // namespace

bool draw_ranges(GlRaster& raster, GlJob& job, const UseProposals& use) {
  Ranges ranges(raster, job);
  for (int direction = 0; direction < 8; ++direction) {
    std::vector<std::uint32_t> ids(job.grid.voxels(), kNoSite.value);
    if (!ranges.run(direction, ids)) return false;
    use(ids);
  }
  return job.goes_on(1);
}

}  // namespace blum::detail
