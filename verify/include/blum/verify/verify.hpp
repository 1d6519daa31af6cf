/// The independent checker of certificates (docs/certificate.md): it shares numbers with the rest
/// of the program and nothing that decides, but for exact algebra where its own bounds do not
/// suffice; Answer says how often.
///
/// Every statement is checked against the model itself: that the leaves tile a box around the
/// solid, that no site was excluded which governs something, that the diagrams on the faces of
/// cells are right, that each leaf satisfies the theorem it claims, and that the complex glued from
/// them here has the Betti numbers claimed. Statements are named after docs/proofs.md.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>

#include "blum/kernel/point.hpp"

namespace blum::verify {

/// A closed, embedded, consistently oriented triangle surface, vertex-manifold, normals outwards,
/// in the working frame of kernel/solid.hpp (coordinates of at most 1).
struct Model {
  std::span<const Point3> point;
  std::span<const std::array<std::uint32_t, 3>> triangle;
};

/// Of docs/certificate.md. Versions 2, which had no pruning, and 3 are read too.
inline constexpr int kFormatVersion = 4;

/// Identifies a model in certificates. Not cryptographic: a certificate is checked against the
/// model given, whatever it says.
[[nodiscard]] std::string fingerprint(const Model& model);

struct Answer {
  enum class Outcome : std::uint8_t {
    kVerified,
    kFalse,  ///< `statement` is the first that does not hold, or, if it starts with "not shown",
             ///< that this checker cannot tell about
    kUnreadable,  ///< not a certificate, or cut short; `statement` says where
  };
  Outcome outcome = Outcome::kUnreadable;
  std::string statement;
  std::size_t line = 0;  ///< of the certificate, where it matters
  std::size_t leaves = 0, faces = 0, parts = 0, exclusions = 0;
  /// Parts, and stretches of segments, that rest on the exact algebra that the program uses, too.
  std::size_t exact_parts = 0, exact_segments = 0;
  std::array<long, 3> betti{};  ///< kVerified
  /// Pruning, where the certificate has it: cells that go in pairs; of the pieces of sheets among
  /// them, those whose angle was compared with the cost (docs/certificate.md), and all.
  std::optional<double> theta_deg;
  std::size_t collapses = 0, angles = 0, pieces = 0;
};

/// Reads the certificate once, line by line. progress(fraction of leaves' volume) may return false
/// to give up: the answer is then kUnreadable with the statement "interrupted".
[[nodiscard]] Answer verify(const Model& model, std::istream& certificate,
                            const std::function<bool(double)>& progress = {});

}  // namespace blum::verify
