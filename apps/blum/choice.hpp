/// Options that are one of a few words.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <type_traits>

namespace blum::app {

/// Turns a word into its value. CLI::CheckedTransformer does the same, but shows small values of
/// enumerations as characters.
template <class Value>
[[nodiscard]] CLI::Validator choice(const std::map<std::string, Value>& values) {
  std::string words;
  for (const auto& [word, value] : values) words += (words.empty() ? "" : ",") + word;
  CLI::Validator v(
      [values, words](std::string& input) -> std::string {
        const auto it = values.find(input);
        if (it == values.end()) return "'" + input + "' is none of " + words;
        input = std::to_string(static_cast<int>(it->second));
        return "";
      },
      "{" + words + "}");
  return v;
}

}  // namespace blum::app
