/// Chooses the working frame of a solid.
#pragma once

#include <span>
#include <vector>

#include "blum/kernel/solid.hpp"

namespace blum {

struct FramedPoints {
  Frame frame;
  std::vector<Point3> working;
};

/// The largest |working coordinate| lies in (0.5, 1] (all points at the origin: exponent 0). An
/// axis is translated when the points lie far from 0, compared with their extent, and when all
/// differences are exact. Fails when scaling would lose bits of a tiny coordinate (underflow).
[[nodiscard]] Result<FramedPoints> choose_frame(std::span<const Point3> points);

}  // namespace blum
