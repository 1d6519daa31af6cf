// DiFi's sweep over the slices, once up and once down: sites that occlusion queries find hidden are
// left behind, and what is left is drawn no farther than it can matter.
//
// Departures from thesis sections 2.7 and 2.8, each needed for the claim that no owner is lost:
// * A site belongs to the upward sweep from the slice above its sphere's centre, a point of the
//   site, on, and to the downward sweep below; the thesis' zmax leaves sites in the downward sweep
//   that lie below the slice.
// * A site is hidden in a slice if it is hidden at every sample *after all of its distances are
//   lowered by two half diagonals of a pixel*. Lemma 2.2 lowers them by one. But let r in the slice
//   belong to the site p and q be the sample nearest to r, at most h away: then
//   d(q, p) <= d(r, p) + h and, for any other site, d(q, p') >= d(r, p') - h >= d(r, p) - h; so p
//   is seen at q if 2h is taken off, and with h alone it may not be.
// * That a region once left behind never comes back needs the way from its points to the site,
//   which lies in the region, to cross the slice within the grid's box: sites that leave the box
//   sideways are never left behind.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "gl_field.hpp"

namespace blum::detail {
namespace {

class Sweep {
 public:
  Sweep(GlRaster& raster, GlJob& job)
      : raster_(raster),
        job_(job),
        pieces_(job.style.method, job.frame),
        samples_(std::size_t{job.grid.size[0]} * job.grid.size[1]),
        half_(0.5 * std::hypot(job.grid.spacing.x, job.grid.spacing.y)) {}

  /// Adds the slice's proposals to `ids`.
  bool run(bool upwards, std::vector<std::uint32_t>& ids) {
    const std::uint32_t slices = job_.grid.size[2];
    std::vector<std::uint32_t> waiting = in_order(upwards);
    std::size_t next = 0;
    std::vector<std::uint32_t> active;
    double greatest = std::numeric_limits<double>::infinity();
    for (std::uint32_t n = 0; n < slices; ++n) {
      const std::uint32_t k = upwards ? n : slices - 1 - n;
      const Slice slice(job_.grid, k);
      for (; next < waiting.size(); ++next) {
        const double z = job_.sites.sphere[waiting[next]].centre.z;
        if (upwards ? z > slice.z() : z <= slice.z()) break;
        active.push_back(waiting[next]);
      }
      const double reach =
          job_.options.culling.clamping ? greatest + job_.grid.spacing.z : kNoLimit;
      draw(slice, std::min(reach, job_.options.band) + job_.slack, active);
      const auto proposed = std::span(ids).subspan(job_.grid.index(0, 0, k), samples_);
      raster_.read_ids(proposed);
      if (job_.options.culling.clamping) greatest = greatest_distance();
      job_.statistics.owner_sites +=
          count_owners(ids, job_.grid, {0, 0, k}, {job_.grid.size[0], job_.grid.size[1], k + 1});
      if (!job_.goes_on((upwards ? 0.0 : 0.5) + 0.5 * n / slices)) return false;
    }
    return true;
  }

 private:
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

  [[nodiscard]] std::vector<std::uint32_t> in_order(bool upwards) const {
    std::vector<std::uint32_t> order(job_.sites.site.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) {
      const double za = job_.sites.sphere[a].centre.z, zb = job_.sites.sphere[b].centre.z;
      return upwards ? za < zb : za > zb;
    });
    return order;
  }

  /// Draws the sites, the last ones first, and takes the hidden ones off the list.
  void draw(const Slice& slice, double reach, std::vector<std::uint32_t>& active) {
    raster_.begin_slice(slice.z());
    ++job_.statistics.blocks;
    std::ranges::reverse(active);
    const double more = 2 * half_ + job_.slack;
    const SlicePass first{slice, job_.slice_rect(), job_.style, reach};
    const auto seen = visible_sites(raster_, job_, pieces_, first, active);
    std::vector<std::uint32_t> hidden;
    for (std::size_t n = 0; n < active.size(); ++n) {
      if (seen[n] == 0 && may_go(active[n])) hidden.push_back(active[n]);
    }
    SlicePass again{slice, job_.slice_rect(), job_.style, reach + more, more, false};
    again.style.dilation += 1;
    const auto still = visible_sites(raster_, job_, pieces_, again, hidden);
    std::vector<std::uint8_t> goes(job_.sites.site.size(), 0);
    for (std::size_t n = 0; n < hidden.size(); ++n) goes[hidden[n]] = still[n] == 0;
    std::erase_if(active, [&](std::uint32_t place) { return goes[place] != 0; });
    std::ranges::reverse(active);
  }

  /// Does the site stay above and below the samples' voxels?
  [[nodiscard]] bool may_go(std::uint32_t place) const {
    const Sphere& s = job_.sites.sphere[place];
    for (int axis = 0; axis < 2; ++axis) {
      const double half = 0.5 * job_.grid.spacing[axis];
      const double lo = job_.grid.coordinate(axis, 0) - half;
      const double hi = job_.grid.coordinate(axis, job_.grid.size[axis] - 1) + half;
      if (s.centre[axis] - s.radius < lo || s.centre[axis] + s.radius > hi) return false;
    }
    return true;
  }

  double greatest_distance() {
    std::vector<double> distance(samples_);
    raster_.read_distances(distance);
    return *std::ranges::max_element(distance);
  }

  GlRaster& raster_;
  GlJob& job_;
  PieceBuffer pieces_;
  std::size_t samples_;
  double half_;
};

}  // namespace

bool draw_sweep(GlRaster& raster, GlJob& job, const UseProposals& use) {
  Sweep sweep(raster, job);
  for (const bool upwards : {true, false}) {
    std::vector<std::uint32_t> ids(job.grid.voxels(), kNoSite.value);
    if (!sweep.run(upwards, ids)) return false;
    use(ids);
  }
  return job.goes_on(1);
}

}  // namespace blum::detail
