// `blum certificate`: what a certificate says, for people. It checks nothing: `blum verify` does.
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "commands.hpp"
#include "exit_code.hpp"
#include "report.hpp"

namespace blum::app {
namespace {

using Json = nlohmann::json;

/// Counts of what the records say.
struct Contents {
  Json header, complex, betti, pruned, end;
  std::size_t nodes = 0, leaves = 0, faces = 0, interfaces = 0, arcs = 0, exclusions = 0;
  std::size_t collapses = 0;
  std::map<std::string, std::size_t> by_theorem, by_claim, missing, events;

  void add_diagram(const Json& j) {
    for (const Json& p : j.at("parts")) ++by_claim[p.at(0)];
    arcs += j.at("graph").at("arcs").size();
    for (const Json& e : j.at("graph").at("events")) ++events[e.at(0)];
  }
  void add_leaf(const Json& j) {
    ++leaves;
    const std::string theorem = j.at("theorem");
    ++by_theorem[theorem];
    if (theorem == "undecided") ++missing[j.at("reason")];
    if (!j.contains("faces")) return;
    exclusions += j.at("excluded").size();
    for (const Json& f : j.at("faces")) {
      ++faces;
      add_diagram(f);
    }
  }
  void add(const std::string& name, const Json& j) {
    if (name == "header") header = j;
    if (name == "complex") complex = j;
    if (name == "betti") betti = j;
    if (name == "collapse") collapses += j.at("cells").size();
    if (name == "pruned") pruned = j;
    if (name == "end") end = j;
    if (name == "leaf") add_leaf(j);
    if (name == "node") {
      ++nodes;
      exclusions += j.at("excluded").size();
    }
    if (name == "interface") {
      ++interfaces;
      add_diagram(j);
    }
  }
};

void print(const char* title, const std::map<std::string, std::size_t>& counts, std::ostream& out) {
  out << title;
  const char* before = "";
  for (const auto& [name, n] : counts) {
    out << before << n << ' ' << name;
    before = ", ";
  }
  out << (counts.empty() ? "none\n" : "\n");
}

/// "title 3 arcs, 5 ties": from an object of numbers.
void print_cells(const char* title, const Json& cells, std::ostream& out) {
  std::map<std::string, std::size_t> counts;
  for (const auto& [name, n] : cells.items()) counts[name] = n;
  print(title, counts, out);
}

void print(const Contents& c, std::ostream& out) {
  const Json &model = c.header.at("model"), &options = c.header.at("options");
  out << "model           " << model.at("points") << " points, " << model.at("triangles")
      << " triangles, fingerprint " << model.at("fingerprint").get<std::string>() << '\n'
      << "options         seed " << options.at("seed")
      << (options.at("resolve") == true ? ", resolve" : "");
  if (options.at("max_leaf_diameter") != 0)
    out << ", leaves of at most " << options.at("max_leaf_diameter");
  out << "\ntree            " << c.nodes << " cuts, " << c.leaves << " leaves, " << c.exclusions
      << " exclusions\n";
  print("leaves          ", c.by_theorem, out);
  out << "diagrams        " << c.faces << " faces of leaves, " << c.interfaces
      << " interfaces between, " << c.arcs << " arcs\n";
  print("nodes           ", c.events, out);
  print("parts and cuts  ", c.by_claim, out);
  const auto exact = c.by_claim.find("exact");
  if (exact != c.by_claim.end())
    out << "note            " << exact->second
        << " parts were decided in ways for which `blum verify` may need exact algebra\n";
  if (c.end.at("certified") == true) {
    print_cells("complex         ", c.complex.at("cells"), out);
    out << "claims          Betti numbers " << c.betti.at(0) << ' ' << c.betti.at(1) << ' '
        << c.betti.at(2) << ", certified\n";
    if (!c.pruned.is_null()) {
      out << "pruned          by " << c.pruned.at("theta").get<double>()
          << " degrees: " << c.collapses << " collapses of pairs of cells\n";
      print_cells("left            ", c.pruned.at("cells"), out);
    }
  } else {
    out << "claims          nothing: the result is not certified\n";
    print("missing         leaves undecided: ", c.missing, out);
  }
}

int run_certificate(const std::string& file) {
  std::ifstream in(file);
  if (!in) return report(Error{ErrorCode::kFileNotFound, "cannot be opened", file, std::nullopt});
  Contents contents;
  std::size_t line = 0;
  try {
    for (std::string text; std::getline(in, text);) {
      ++line;
      const Json record = Json::parse(text);
      for (const auto& [name, content] : record.items()) contents.add(name, content);
    }
    if (line == 0 || contents.header.value("format", "") != "blum-certificate" ||
        contents.end.is_null() || contents.end.at("lines") != line) {
      std::cerr << "blum: error: " << file << ": not a certificate, or cut short\n";
      return kInput;
    }
    std::ostringstream text;  // nothing is printed of what turns out to be broken
    print(contents, text);
    std::cout << text.str();
  } catch (const Json::exception& problem) {
    std::cerr << "blum: error: " << file << ":" << line << ": " << problem.what() << '\n';
    return kInput;
  }
  return kSuccess;
}

}  // namespace

Command add_certificate_command(CLI::App& app) {
  CLI::App* certificate =
      app.add_subcommand("certificate", "Say what a certificate says (and check nothing)");
  const auto file = std::make_shared<std::string>();
  certificate->add_option("CERTIFICATE", *file, "Written by medial --certificate")->required();
  certificate->footer(R"(Exit codes: 0 read, 2 unreadable.

Examples:
  blum medial part.off --certificate part.cert
  blum certificate part.cert)");
  return [file] { return run_certificate(*file); };
}

}  // namespace blum::app
