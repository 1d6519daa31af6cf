/// The exit codes of `blum`, part of its public interface (README.md lists them).
#pragma once

namespace blum::app {

enum ExitCode : int {
  kSuccess = 0,
  kUsage = 1,
  kInput = 2,
  kNotCertified = 3,
  kFalse = 4,  ///< verify: a statement of the certificate does not hold
  kOutput = 5,
  kInternal = 70,
  kSignalBase = 128,  ///< plus the signal: 130 for SIGINT, 143 for SIGTERM
};

}  // namespace blum::app
