// blum-cgal-engine: answers face and segment problems with CGAL's arrangements, one JSON document a
// line (blum/arrangement/engine_json.hpp), until its input ends. Assertions are on. Whatever goes
// wrong inside CGAL is answered as "undecided" and ends the program: the caller starts a new one.
#include <CGAL/assertions_behaviour.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "arrange.hpp"
#include "blum/arrangement/engine_json.hpp"
#include "face_map.hpp"
#include "labelled_cells.hpp"
#include "segment_diagram.hpp"

namespace blum::cgal {
namespace {

enum class Method { kAlgebraic, kEnvelope, kConic };

struct Options {
  Method method = Method::kAlgebraic;
  double cpu_s = 0;  ///< for each request; 0: no limit
};

/// Envelope_3 compares the envelopes of parts of the sites, where pairs may tie that never govern.
Relevant with_all_pairs(const Forms& forms, Relevant relevant) {
  for (std::size_t i = 0; i < forms.site.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (relevant.site[i] && relevant.site[j])
        for (const Curve& c :
             zeros(forms.site[i].squared_distance - forms.site[j].squared_distance).on)
          relevant.curves.add(c);
  return relevant;
}

class Session {
 public:
  explicit Session(const Options& options) : options_(options) {}

  std::string answer(const EngineRequest& r) {
    if (r.kind == EngineRequest::Kind::kSolid) {
      solid_ = r.solid;
      inside_.emplace(*solid_);
      return failure_answer(FaceStatus::kUndecided, "solid");
    }
    if (!solid_) return failure_answer(FaceStatus::kUndecided, "no solid");
    for (const SiteId s : r.candidates)
      if (s.value >= SiteIndex(*solid_).size())
        return failure_answer(FaceStatus::kUndecided, "no such site");
    for (const std::uint32_t t : r.triangles)
      if (t >= solid_->triangle.size())
        return failure_answer(FaceStatus::kUndecided, "no such triangle");
    try {
      if (r.kind == EngineRequest::Kind::kSegment)
        return segment_answer(
            segment_diagram(*solid_, r.segment, r.candidates, r.triangles, &*inside_));
      return face_answer(face(r));
    } catch (const BadPosition& e) {
      return failure_answer(FaceStatus::kBadPosition, e.what());
    }
  }

 private:
  FaceDiagram face(const EngineRequest& r) {
    const InsideTest* test = r.interior ? nullptr : &*inside_;
    require_general_position(r);
    FaceDiagram out;
    out.rect = r.rect;
    for (int s = 0; s < 4; ++s)
      out.side[static_cast<std::size_t>(s)] = std::make_shared<const SegmentDiagram>(
          segment_diagram(*solid_, side_segment(r.rect, s), r.candidates, r.triangles, test));
    const Forms forms = rect_forms(*solid_, r.rect, r.candidates, r.triangles);
    const Window window{{Rational(r.rect.u0), Rational(r.rect.u1)},
                        {Rational(r.rect.v0), Rational(r.rect.v1)}};
    Relevant relevant = relevant_curves(forms, window);
    if (options_.method == Method::kEnvelope)
      relevant = with_all_pairs(forms, with_domains(forms, relevant));
    const PlanarCells cells = arrange(forms, relevant, window);
    read_map(forms, cells, label(forms, relevant, cells, test), out);
    return out;
  }

  PlanarCells arrange(const Forms& forms, const Relevant& relevant, const Window& window) const {
    if (options_.method == Method::kEnvelope) return arrange_envelope(forms, relevant, window);
    if (options_.method == Method::kConic) return arrange_conic(relevant, window);
    return arrange_algebraic(relevant, window);
  }

  void require_general_position(const EngineRequest& r) const {
    const int u = u_axis(r.rect.axis), v = v_axis(r.rect.axis);
    for (const std::uint32_t t : r.triangles)
      for (const std::uint32_t k : solid_->triangle[t].vertex) {
        const Point3& p = solid_->point[k];
        if (p[r.rect.axis] == r.rect.level && r.rect.u0 <= p[u] && p[u] <= r.rect.u1 &&
            r.rect.v0 <= p[v] && p[v] <= r.rect.v1)
          throw BadPosition("a boundary vertex lies on the rectangle");
      }
  }

  Options options_;
  std::optional<Solid> solid_;
  std::optional<InsideTest> inside_;
};

/// From now on the process may use this much more processor time.
void allow_cpu(double seconds) {
  if (!(seconds > 0)) return;
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  rlimit limit{};
  getrlimit(RLIMIT_CPU, &limit);
  limit.rlim_cur = static_cast<rlim_t>(
      static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + std::ceil(seconds) + 1);
  setrlimit(RLIMIT_CPU, &limit);
}

std::optional<Options> read_options(int argc, char** argv) {
  const std::map<std::string, Method> methods{{"algebraic", Method::kAlgebraic},
                                              {"envelope", Method::kEnvelope},
                                              {"conic", Method::kConic}};
  Options out;
  for (int k = 1; k < argc; k += 2) {
    const std::string name = argv[k], value = k + 1 < argc ? argv[k + 1] : "";
    if (name == "--method" && methods.count(value) != 0) {
      out.method = methods.at(value);
    } else if (name == "--cpu-seconds" && std::atof(value.c_str()) > 0) {
      out.cpu_s = std::atof(value.c_str());
    } else {
      return std::nullopt;
    }
  }
  return out;
}

int serve(const Options& options) {
  Session session(options);
  for (std::string line; std::getline(std::cin, line);) {
    allow_cpu(options.cpu_s);
    const Result<EngineRequest> request = read_request(line);
    try {
      std::cout << (request ? session.answer(request.value())
                            : failure_answer(FaceStatus::kUndecided, request.error().message))
                << std::endl;
    } catch (const std::exception& e) {
      std::cout << failure_answer(FaceStatus::kUndecided, e.what()) << std::endl;
      return EXIT_FAILURE;  // CGAL's caches may be in any state
    }
  }
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace blum::cgal

int main(int argc, char** argv) {
  const auto options = blum::cgal::read_options(argc, argv);
  if (!options) {
    std::cerr << "usage: blum-cgal-engine [--method algebraic|envelope|conic]"
                 " [--cpu-seconds N] < REQUESTS > ANSWERS\n";
    return 1;
  }
  CGAL::set_error_behaviour(CGAL::THROW_EXCEPTION);
  return blum::cgal::serve(*options);
}
