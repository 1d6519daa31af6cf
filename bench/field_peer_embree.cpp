// Embree 3 point queries, hinted: the search radius starts at the last distance plus the step.
#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "blum/kernel/parallel.hpp"
#include "field_peers.hpp"

namespace blum::bench {
namespace {

struct Query {
  const Point3* points;
  const std::array<std::uint32_t, 3>* triangles;
  float best;
};

/// Ericson, Real-Time Collision Detection, section 5.1.5, in float.
float distance_to_triangle(const float p[3], const Point3& A, const Point3& B, const Point3& C) {
  float ab[3], ac[3], ap[3];
  for (int k = 0; k < 3; ++k) {
    ab[k] = static_cast<float>(B[k] - A[k]);
    ac[k] = static_cast<float>(C[k] - A[k]);
    ap[k] = p[k] - static_cast<float>(A[k]);
  }
  const auto dot = [](const float* a, const float* b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  const auto at = [&](float s, float t) {
    float d[3];
    for (int k = 0; k < 3; ++k) d[k] = ap[k] - s * ab[k] - t * ac[k];
    return std::sqrt(dot(d, d));
  };
  const float d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return at(0, 0);
  const float abab = dot(ab, ab), abac = dot(ab, ac), acac = dot(ac, ac);
  const float d3 = d1 - abab, d4 = d2 - abac, d5 = d1 - abac, d6 = d2 - acac;
  if (d3 >= 0 && d4 <= d3) return at(1, 0);
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return at(d1 / (d1 - d3), 0);
  if (d6 >= 0 && d5 <= d6) return at(0, 1);
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return at(0, d2 / (d2 - d6));
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const float w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return at(1 - w, w);
  }
  const float sum = va + vb + vc;
  return at(vb / sum, vc / sum);
}

bool on_triangle(RTCPointQueryFunctionArguments* arguments) {
  auto& query = *static_cast<Query*>(arguments->userPtr);
  const auto& t = query.triangles[arguments->primID];
  const float p[3] = {arguments->query->x, arguments->query->y, arguments->query->z};
  const float d =
      distance_to_triangle(p, query.points[t[0]], query.points[t[1]], query.points[t[2]]);
  query.best = std::min(query.best, d);
  if (d >= arguments->query->radius) return false;
  arguments->query->radius = d;
  return true;
}

}  // namespace

std::vector<float> embree_distances(const SiteSet& sites, const VoxelGrid& grid, int threads) {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* corners = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                              RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                              sites.points().size()));
  for (const Point3& p : sites.points()) {
    for (int k = 0; k < 3; ++k) *corners++ = static_cast<float>(p[k]);
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto& t : sites.triangles()) triangles.push_back(t.point);
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), triangles.size()));
  for (const auto& t : triangles) indices = std::copy(t.begin(), t.end(), indices);
  rtcSetGeometryPointQueryFunction(geometry, on_triangle);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);

  std::vector<float> out(grid.voxels());
  for_each_in_parallel(threads, grid.size[2], [&](int, std::size_t k) {
    for (std::uint32_t j = 0; j < grid.size[1]; ++j) {
      float radius = std::numeric_limits<float>::infinity();
      for (std::uint32_t i = 0; i < grid.size[0]; ++i) {
        const Point3 p = grid.point(i, j, static_cast<std::uint32_t>(k));
        Query mine = {sites.points().data(), triangles.data(),
                      std::numeric_limits<float>::infinity()};
        RTCPointQuery query = {static_cast<float>(p.x), static_cast<float>(p.y),
                               static_cast<float>(p.z), 0, radius};
        RTCPointQueryContext context;
        rtcInitPointQueryContext(&context);
        rtcPointQuery(scene, &query, &context, nullptr, &mine);
        out[grid.index(i, j, static_cast<std::uint32_t>(k))] = mine.best;
        radius = (mine.best + static_cast<float>(grid.spacing.x)) * 1.001F;
      }
    }
  });
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
  return out;
}

}  // namespace blum::bench
