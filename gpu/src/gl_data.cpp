#include "gl_data.hpp"

#include <bit>
#include <cmath>

namespace blum::detail {

GlFrame gl_frame(const ScanSites& sites, const SiteSet& set, const VoxelGrid& grid) {
  const Box3 samples = grid.sample_box();
  GlFrame frame;
  for (int axis = 0; axis < 3; ++axis) {
    const double lo = std::min(set.box().lo[axis], samples.lo[axis]);
    frame.centre[axis] = lo + 0.5 * (std::max(set.box().hi[axis], samples.hi[axis]) - lo);
  }
  int exponent = 0;
  (void)std::frexp(sites.reach, &exponent);
  frame.scale = std::ldexp(1, -exponent - 1);
  return frame;
}

std::vector<float> site_texels(const ScanSites& sites, const GlFrame& frame, bool all) {
  std::vector<float> out;
  const std::uint32_t most = all ? kMostConditions : 3;
  out.reserve(sites.site.size() * 4 * (2 + most));
  for (const ScanSite& s : sites.site) {
    const std::uint32_t count = all ? s.count : own_conditions(s.shape);
    const auto add = [&out](const Point3& p, double scale, double w) {
      for (int k = 0; k < 3; ++k) out.push_back(static_cast<float>(scale * p[k]));
      out.push_back(static_cast<float>(w));
    };
    add({s.base.x - frame.centre.x, s.base.y - frame.centre.y, s.base.z - frame.centre.z},
        frame.scale,
        s.shape == SiteKind::kVertex ? 0
        : s.shape == SiteKind::kEdge ? 1
                                     : 2);
    add(s.unit, 1, count);
    for (std::uint32_t k = 0; k < most; ++k) {
      if (k < count) {
        const Condition& c = sites.condition[s.first + k];
        add(c.w, 1, frame.scale * c.limit);
      } else {
        add({}, 0, 0);
      }
    }
  }
  return out;
}

void PieceBuffer::add(const SlicePiece& piece, std::uint32_t place, std::uint32_t id) {
  const ConvexPolygon& p = piece.polygon;
  const auto corner = [&](int k) {
    const auto number = [this](double x) {
      words_.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(x)));
    };
    number(p[k][0]);
    number(p[k][1]);
    words_.push_back(place);
    words_.push_back(id);
    if (method_ == FieldMethod::kFragments) return;
    for (const PixelAffine& a : piece.vector) number(frame_.scale * a.at);
    for (const PixelAffine& a : piece.vector) number(frame_.scale * a.x);
    for (const PixelAffine& a : piece.vector) number(frame_.scale * a.y);
  };
  for (int k = 1; k + 1 < p.size(); ++k) {
    corner(0);
    corner(k);
    corner(k + 1);
  }
  area_ += p.area();
}

}  // namespace blum::detail
