/// The camera of a picture: from model units to pixels. The box around everything fills the
/// picture.
#pragma once

#include "blum/kernel/point.hpp"
#include "blum/show/render.hpp"
#include "blum/show/scene.hpp"
#include "raster.hpp"

namespace blum::detail {

class Projection {
 public:
  Projection(const Scene& scene, const RenderOptions& options);

  [[nodiscard]] const Box3& box() const { return box_; }
  /// Without colour.
  [[nodiscard]] RasterVertex operator()(const Point3& p) const;
  /// How much light a triangle sends to the camera, both sides alike: 0 to 1.
  [[nodiscard]] double light(const Point3& a, const Point3& b, const Point3& c) const;
  /// The same vertex a little nearer, so that lines lie on their sheets.
  [[nodiscard]] RasterVertex nearer(RasterVertex v) const;

 private:
  void fit(const RenderOptions& options);

  Box3 box_;
  Point3 eye_, right_, up_, forward_, lamp_;
  double scale_ = 1, cx_ = 0, cy_ = 0;
  std::optional<Section> section_;
  double size_ = 1;
};

}  // namespace blum::detail
