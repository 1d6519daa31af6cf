/// The certificate of a medial axis: what blum/verify/verify.hpp needs to check it. Format:
/// docs/certificate.md.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "blum/kernel/site_geometry.hpp"
#include "blum/kernel/solid.hpp"
#include "blum/medial/medial_axis.hpp"
#include "blum/subdivision/engine_set.hpp"

namespace blum {

struct Assembly;

/// Writes the certificate of a result, line by line. The diagrams are computed again, with their
/// reasons: it takes about as long as the subdivision, and no memory to speak of. With theta_deg
/// the collapses of the filtration of lower values are in it (the result must have one). Returns
/// whether it is whole: false if the sink returned false, or if a diagram was not decided again.
/// What a result that is not certified lacks is in the certificate, too.
bool write_certificate(const SiteGeometry& geometry, const Subdivision& subdivision,
                       const Assembly& assembly, const MedialResult& result,
                       const SubdivisionOptions& options, std::optional<double> theta_deg,
                       EngineSet& engines, const CertificateSink& sink);

}  // namespace blum
