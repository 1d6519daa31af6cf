// Exact vectors, redundancy of ties and point-in-solid parity.
#include "blum/kernel/check.hpp"
#include "brute_setting.hpp"

namespace blum::brute {

Vector exact(const Point3& p) { return {Rational(p.x), Rational(p.y), Rational(p.z)}; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Rational dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

bool is_zero(const Vector& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

namespace {

std::vector<Vector> corners(const Solid& solid, SiteId s) {
  const SiteIndex index(solid);
  const std::uint32_t k = index.element(s);
  std::vector<Vector> out;
  const auto add = [&](std::uint32_t v) { out.push_back(exact(solid.point[v])); };
  switch (index.kind(s)) {
    case SiteKind::kVertex:
      add(k);
      break;
    case SiteKind::kEdge:
      for (const auto v : solid.edge[k].vertex) add(v);
      break;
    case SiteKind::kFace:
      for (const auto v : solid.triangle[k].vertex) add(v);
      break;
  }
  return out;
}

/// Does the carrier spanned by `span` (1 to 3 points) contain p?
bool carrier_contains(const std::vector<Vector>& span, const Vector& p) {
  const Vector w = p - span[0];
  if (span.size() == 1) return is_zero(w);
  const Vector a = span[1] - span[0];
  if (span.size() == 2) return is_zero(cross(a, w));
  return dot(cross(a, span[2] - span[0]), w) == 0;
}

int volume_sign(const Vector& a, const Vector& b, const Vector& c) {
  return sgn(dot(cross(a, b), c));
}

}  // namespace

bool redundant(const Solid& solid, SiteId a, SiteId b) {
  std::vector<Vector> big = corners(solid, a), small = corners(solid, b);
  if (big.size() < small.size()) std::swap(big, small);
  for (const Vector& p : small)
    if (!carrier_contains(big, p)) return false;
  return true;
}

bool inside(const Solid& solid, const Vector& p) {
  std::vector<Vector> relative;
  for (const Point3& q : solid.point) relative.push_back(exact(q) - p);
  for (int attempt = 1;; ++attempt) {
    // Any sequence that is not on an algebraic surface leaves all edges sooner or later.
    const Vector ray = {Rational(1009), Rational(attempt * attempt * 37 + 5 * attempt - 311),
                        Rational(attempt * attempt * attempt * 11 - 700)};
    bool odd = false, generic = true;
    for (const SolidTriangle& t : solid.triangle) {
      const Vector &a = relative[t.vertex[0]], &b = relative[t.vertex[1]],
                   &c = relative[t.vertex[2]];
      const int ab = volume_sign(a, b, ray), bc = volume_sign(b, c, ray);
      if (ab * bc < 0) continue;
      const int ca = volume_sign(c, a, ray);
      if (ab * ca < 0 || bc * ca < 0) continue;
      if (ab == 0 || bc == 0 || ca == 0) {  // the line may meet the border of the triangle
        generic = false;
        break;
      }
      // The line pierces the triangle; on the ray's side iff p is on the other side of the plane.
      const int side = volume_sign(a, b, c);
      BLUM_CHECK(side != 0);
      if (side == ab) odd = !odd;
    }
    if (generic) return odd;
    BLUM_CHECK(attempt < 1000);
  }
}

}  // namespace blum::brute
