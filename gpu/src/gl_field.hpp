/// The OpenGL backends: they propose the owner of every sample, and nothing else.
#pragma once

#include <optional>

#include "block_cull.hpp"
#include "blum/gpu/field.hpp"
#include "gl_raster.hpp"

namespace blum::detail {

/// As scan_field; the error says what the driver lacks, or kInterrupted.
[[nodiscard]] std::optional<Error> gl_field(const SiteSet& sites, const FieldOptions& options,
                                            DistanceField& field);

/// What the ways of drawing share. Their results are proposals: an id a sample, none where nothing
/// was drawn.
struct GlJob {
  const ScanSites& sites;
  const FieldOptions& options;
  const VoxelGrid& grid;
  GlFrame frame;
  SliceStyle style;
  double slack = 0;  ///< more than any computed distance of a covered sample errs by
  FieldStatistics& statistics;

  [[nodiscard]] PixelRect slice_rect() const {
    return {0, 0, static_cast<double>(grid.size[0]), static_cast<double>(grid.size[1])};
  }
  [[nodiscard]] bool goes_on(double part) const {
    return !options.on_progress || options.on_progress(part);
  }
};

/// Each returns false if interrupted. `use`: takes the proposals for the whole grid, perhaps
/// several times; the nearest of all counts.
using UseProposals = std::function<void(const std::vector<std::uint32_t>&)>;
[[nodiscard]] bool draw_tiles(GlRaster& raster, GlJob& job, const UseProposals& use);
[[nodiscard]] bool draw_sweep(GlRaster& raster, GlJob& job, const UseProposals& use);
[[nodiscard]] bool draw_ranges(GlRaster& raster, GlJob& job, const UseProposals& use);
[[nodiscard]] bool gather(GlContext& context, GlJob& job, std::string& problem,
                          const UseProposals& use);

/// How sites are drawn into a slice, or the part of it that `rect` is.
struct SlicePass {
  const Slice& slice;
  PixelRect rect;
  SliceStyle style;
  double reach = 0;    ///< see Slice::add_pieces
  double nearer = 0;   ///< see GlRaster::visible
  bool writes = true;  ///< see GlRaster::visible
};
/// Draws the sites one after the other: which are visible? Counts them, too.
[[nodiscard]] std::vector<std::uint8_t> visible_sites(GlRaster& raster, GlJob& job,
                                                      PieceBuffer& pieces, const SlicePass& pass,
                                                      std::span<const std::uint32_t> places);

/// Boxes of at most `side` samples along every axis and what may own a sample of them, by rank;
/// without culling.blocks: all sites. In increasing order of z.
struct CullTile {
  CullNode node;
  std::vector<std::uint32_t> places;
};
[[nodiscard]] std::vector<CullTile> make_cull_tiles(const GlJob& job, std::uint32_t side);

/// How many different ids there are among the samples of a box.
[[nodiscard]] std::uint64_t count_owners(const std::vector<std::uint32_t>& ids,
                                         const VoxelGrid& grid,
                                         const std::array<std::uint32_t, 3>& begin,
                                         const std::array<std::uint32_t, 3>& end);

}  // namespace blum::detail
