/// Where one looks from.
#pragma once

namespace blum {

/// Looks at the centre of the scene, z upwards.
struct Camera {
  double azimuth_deg = -55;   ///< of the camera, from the x axis towards the y axis
  double elevation_deg = 28;  ///< above the xy plane, in (-90, 90)
};

}  // namespace blum
