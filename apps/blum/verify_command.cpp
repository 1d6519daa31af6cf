// `blum verify`: checks a certificate against a model, independently of what made it.
#include <chrono>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <memory>

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/solid.hpp"
#include "blum/medial/summary.hpp"
#include "blum/verify/verify.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "progress_bar.hpp"
#include "report.hpp"

namespace blum::app {
namespace {

struct VerifyArguments {
  std::string model, certificate;
};

int run_verify(const VerifyArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const Result<PolygonMesh> mesh = read_mesh(arguments.model);
  if (!mesh) return report(mesh.error());
  const Result<Solid> solid = build_solid(mesh.value());
  if (!solid) return report_no_solid(solid.error(), arguments.model, mesh.value());
  std::ifstream certificate(arguments.certificate);
  if (!certificate) {
    return report(Error{ErrorCode::kFileNotFound, "cannot be opened", arguments.certificate, {}});
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const SolidTriangle& t : solid.value().triangle) triangles.push_back(t.vertex);

  defer_interrupts();
  const auto check = [&] {
    ProgressBar bar;
    std::size_t leaves = 0;
    return verify::verify({solid.value().point, triangles}, certificate, [&](double done) {
      bar.show({++leaves, done});
      return interrupted_by() == 0;
    });
  };
  const verify::Answer answer = check();
  if (interrupted_by() != 0) {
    return report_interrupted();
  }
  using Outcome = verify::Answer::Outcome;
  if (answer.outcome == Outcome::kUnreadable) {
    std::cerr << "blum: error: " << arguments.certificate << ":" << answer.line << ": "
              << answer.statement << '\n';
    return kInput;
  }
  std::cout << "checked         " << answer.leaves << " leaves, " << answer.faces << " diagrams of "
            << answer.parts << " parts and cuts, " << answer.exclusions << " exclusions\n"
            << "exact algebra   decided " << answer.exact_parts << " of "
            << (answer.parts + answer.faces) / 2 << " parts and " << answer.exact_segments
            << " stretches of lines; blum medial uses it, too\n"
            << "needed          " << std::fixed << std::setprecision(3)
            << std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()
            << " s, " << std::setprecision(1) << static_cast<double>(peak_memory_bytes()) / 1e6
            << " MB at most\n"
            << std::defaultfloat << std::setprecision(6);
  if (answer.outcome == Outcome::kFalse) {
    std::cout << "FALSE           " << answer.statement << " (" << arguments.certificate << ":"
              << answer.line << ")\n";
    return kFalse;
  }
  std::cout << "Betti numbers   " << answer.betti[0] << " " << answer.betti[1] << " "
            << answer.betti[2] << ", as the solid's\n";
  if (answer.theta_deg) {
    std::cout << "pruned          by " << *answer.theta_deg << " degrees: " << answer.collapses
              << " collapses of pairs of cells replayed\nangles          of " << answer.angles
              << " of " << answer.pieces
              << " pieces of sheets, those between two faces, at most what their collapse costs\n";
  }
  std::cout << "verified\n";
  return kSuccess;
}

}  // namespace

Command add_verify_command(CLI::App& app) {
  CLI::App* verify = app.add_subcommand("verify", "Check a certificate against its model");
  const auto arguments = std::make_shared<VerifyArguments>();
  verify->add_option("MODEL", arguments->model, "OFF, OBJ, STL or PLY")->required();
  verify->add_option("CERTIFICATE", arguments->certificate, "Written by medial --certificate")
      ->required();
  verify->footer(
      R"(Shares numbers and the mesh reader with the rest of blum, and nothing that decides but
exact algebra, where its own bounds do not suffice: it says how often.
Exit codes: 0 verified; 4 false, or not to be shown: the first such statement is printed;
2 unreadable.

Examples:
  blum medial part.off --certificate part.cert
  blum verify part.off part.cert)");
  return [arguments] { return run_verify(*arguments); };
}

}  // namespace blum::app
