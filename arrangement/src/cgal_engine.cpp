#include "blum/arrangement/cgal_engine.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "blum/arrangement/engine_json.hpp"
#include "helper_process.hpp"

namespace blum {
namespace {

bool in(SiteId s, std::span<const SiteId> candidates) {
  return std::binary_search(candidates.begin(), candidates.end(), s);
}

bool in(std::span<const SiteId> sites, std::span<const SiteId> candidates) {
  return std::is_sorted(sites.begin(), sites.end()) &&
         std::all_of(sites.begin(), sites.end(), [&](SiteId s) { return in(s, candidates); });
}

/// Speaks the answer of nothing but what was asked about?
bool fits(const SegmentDiagram& d, const Segment& asked, std::span<const SiteId> candidates,
          std::span<const std::uint32_t> triangles) {
  if (d.segment != asked) return false;
  for (const Breakpoint& b : d.breakpoint)
    if (b.kind == Breakpoint::Kind::kTie
            ? !in(b.below, candidates) || !in(b.above, candidates)
            : !std::binary_search(triangles.begin(), triangles.end(), b.triangle))
      return false;
  return std::all_of(d.interval.begin(), d.interval.end(),
                     [&](const auto& i) { return !i.inside || in(i.witness, candidates); });
}

bool fits(const FaceDiagram& d, const FaceProblem& p) {
  if (d.rect != p.rect) return false;
  for (int s = 0; s < 4; ++s)
    if (!fits(*d.side[static_cast<std::size_t>(s)], side_segment(p.rect, s), p.candidates,
              p.triangles))
      return false;
  for (const FaceNode& n : d.node)
    if (!in(n.governors, p.candidates) || n.boundary_edge >= p.solid->edge.size()) return false;
  for (const FaceArc& a : d.arc)
    if (!in(a.left, p.candidates) || !in(a.right, p.candidates)) return false;
  for (const FaceRegion& r : d.region)
    if (r.labels.empty() || !in(r.labels, p.candidates)) return false;
  for (const FaceTrace& t : d.trace)
    if (!std::binary_search(p.triangles.begin(), p.triangles.end(), t.triangle)) return false;
  return std::all_of(d.trace_point.begin(), d.trace_point.end(), [&](const FaceTracePoint& t) {
    return t.boundary_edge < p.solid->edge.size();
  });
}

}  // namespace

const char* cgal_method_name(CgalMethod method) {
  switch (method) {
    case CgalMethod::kAlgebraic:
      return "algebraic";
    case CgalMethod::kEnvelope:
      return "envelope";
    case CgalMethod::kConic:
      break;
  }
  return "conic";
}

std::optional<std::filesystem::path> find_cgal_helper() {
  namespace fs = std::filesystem;
  std::error_code ignored;
  fs::path path;
  if (const char* set = std::getenv("BLUM_CGAL_ENGINE"); set != nullptr) {
    path = set;
  } else {
    path = fs::read_symlink("/proc/self/exe", ignored).parent_path() / "blum-cgal-engine";
  }
  if (!fs::is_regular_file(path, ignored) || access(path.c_str(), X_OK) != 0) return std::nullopt;
  return path;
}

struct CgalEngine::Impl {
  const Solid& solid;
  std::vector<std::string> command;
  CgalLimits limits;
  const std::atomic<bool>* stop = nullptr;
  CgalCounts counts;
  std::unique_ptr<HelperProcess> helper;
  int answered = 0;  // by the present helper

  Impl(const Solid& s, const std::filesystem::path& path, CgalMethod method, const CgalLimits& l)
      : solid(s),
        command{path.string(), "--method", cgal_method_name(method), "--cpu-seconds",
                std::to_string(l.cpu_s)},
        limits(l) {}

  /// The answer, or null with a reason.
  std::optional<std::string> ask(const std::string& request, const char*& reason) {
    ++counts.requests;
    std::string answer;
    if (helper != nullptr && answered >= limits.requests) helper.reset();
    if (helper == nullptr) {
      ++counts.started;
      answered = 0;
      helper = std::make_unique<HelperProcess>(command, limits.memory_bytes);
      if (!survives(helper->ask(solid_request(solid), limits.wall_s, stop, answer), reason))
        return std::nullopt;
    }
    ++answered;
    if (!survives(helper->ask(request, limits.wall_s, stop, answer), reason)) return std::nullopt;
    return answer;
  }

  bool survives(HelperProcess::Failure failure, const char*& reason) {
    switch (failure) {
      case HelperProcess::Failure::kNone:
        return true;
      case HelperProcess::Failure::kTimeout:
        ++counts.timeouts;
        reason = "cgal: no answer in time";
        break;
      case HelperProcess::Failure::kGone:
        ++counts.crashes;
        reason = "cgal: the helper crashed or reached a limit";
        break;
      case HelperProcess::Failure::kStopped:
        reason = "stopped";
        break;
    }
    helper.reset();
    return false;
  }

  const char* malformed() {
    ++counts.malformed;
    helper.reset();
    return "cgal: malformed answer";
  }
};

CgalEngine::CgalEngine(const Solid& solid, std::filesystem::path helper, CgalMethod method,
                       const CgalLimits& limits)
    : impl_(std::make_unique<Impl>(solid, helper, method, limits)) {}
CgalEngine::~CgalEngine() = default;

void CgalEngine::stop_on(const std::atomic<bool>* stop) { impl_->stop = stop; }
const CgalCounts& CgalEngine::counts() const { return impl_->counts; }

SegmentAnswer CgalEngine::segment(const Segment& segment, std::span<const SiteId> candidates,
                                  std::span<const std::uint32_t> triangles) {
  SegmentAnswer out{FaceStatus::kUndecided, "", nullptr};
  const auto text = impl_->ask(segment_request(segment, candidates, triangles), out.reason);
  if (!text) return out;
  const auto reply = read_segment_answer(*text);
  if (!reply || (reply.value().diagram != nullptr &&
                 !fits(*reply.value().diagram, segment, candidates, triangles))) {
    out.reason = impl_->malformed();
    return out;
  }
  out.status = reply.value().status;
  out.diagram = reply.value().diagram;
  if (out.status == FaceStatus::kBadPosition) out.reason = "segment in bad position";
  if (out.status == FaceStatus::kUndecided) out.reason = "cgal: gave up on a segment";
  return out;
}

FaceDiagram CgalEngine::face(const FaceProblem& problem,
                             const std::array<std::shared_ptr<const SegmentDiagram>, 4>&) {
  FaceDiagram failed;
  failed.rect = problem.rect;
  failed.status = FaceStatus::kUndecided;
  const char* reason = "";
  const auto text = impl_->ask(face_request(problem), reason);
  failed.reason = reason;
  if (!text) return failed;
  const auto reply = read_face_answer(*text);
  if (!reply || (reply.value().status == FaceStatus::kDecided && !fits(reply.value(), problem))) {
    failed.reason = impl_->malformed();
    return failed;
  }
  FaceDiagram out = reply.value();
  out.rect = problem.rect;
  return out;
}

}  // namespace blum
