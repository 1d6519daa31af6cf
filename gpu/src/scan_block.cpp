#include "scan_block.hpp"

#include <limits>

// One row of a block is one vector. The compiler splits it where the processor's are shorter; the
// version for the processor at hand is chosen when the program starts. (Sanitizers run before that
// choice can be made.)
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define BLUM_FOR_EACH_PROCESSOR __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define BLUM_FOR_EACH_PROCESSOR
#endif

namespace blum::detail {
namespace {

using Row = double __attribute__((vector_size(8 * kBlock), may_alias));

}  // namespace

BLUM_FOR_EACH_PROCESSOR
void scan_block(Block& block, const ScanSites& sites, std::span<const Sphere> list) {
  Row x;
  for (int i = 0; i < kBlock; ++i) x[i] = block.x[i];
  Row* const squared = reinterpret_cast<Row*>(block.squared);
  Row* const owner = reinterpret_cast<Row*>(block.owner);
  const Row far = (x - x) + std::numeric_limits<double>::infinity();
  for (std::size_t place = 0; place < list.size(); ++place) {
    const ScanSite& site = sites.site[list[place].site];
    const Condition* const condition = sites.condition.data() + site.first;
    const std::uint32_t conditions = site.count;
    const Row dx = x - site.base.x;
    const Row udx = dx * site.unit.x;
    Row wdx[kMostConditions];
    for (std::uint32_t c = 0; c < conditions; ++c) wdx[c] = dx * condition[c].w.x;
    const Row id = (dx - dx) + static_cast<double>(place);
    for (int k = 0; k < block.nz; ++k) {
      const double dz = block.z[k] - site.base.z;
      for (int j = 0; j < block.ny; ++j) {
        const double dy = block.y[j] - site.base.y;
        Row excess = dx - dx;
        for (std::uint32_t c = 0; c < conditions; ++c) {
          const Row value =
              wdx[c] + ((condition[c].w.y * dy + condition[c].w.z * dz) - condition[c].limit);
          excess = value > excess ? value : excess;
        }
        Row d;
        if (site.shape == SiteKind::kVertex) {
          d = dx * dx + (dy * dy + dz * dz);
        } else {
          const Row along = udx + (site.unit.y * dy + site.unit.z * dz);
          if (site.shape == SiteKind::kFace) {
            d = along * along;
          } else {
            const Row rx = dx - along * site.unit.x, ry = dy - along * site.unit.y,
                      rz = dz - along * site.unit.z;
            d = rx * rx + (ry * ry + rz * rz);
          }
        }
        const int row = j + kBlock * k;
        d = excess > 0.0 ? far : d;
        owner[row] = d < squared[row] ? id : owner[row];
        squared[row] = d < squared[row] ? d : squared[row];
      }
    }
  }
}

}  // namespace blum::detail
