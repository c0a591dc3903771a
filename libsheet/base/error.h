// SPDX-License-Identifier: GPL-3.0-or-later
// The one table of error classes and their exit codes.
#pragma once
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/core.h>

namespace sheet {

enum class ExitCode : int {
  ok = 0,
  internal = 1,      // a defect of ours
  usage = 2,         // the command line
  bad_input = 3,     // a scene, mesh or frame that says something impossible
  corrupt = 4,       // a stream cut short or damaged
  not_converged = 5, // the numerical solution failed
  io = 6,            // reading or writing failed
};

// Every error that a user may cause carries its exit code; what() names file, place and remedy.
class Error : public std::runtime_error {
public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ExitCode code() const noexcept { return code_; }

private:
  ExitCode code_;
};

// Throws Error with a formatted message.
template <class... Args> [[noreturn]] void fail(ExitCode code, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(code, fmt::format(format, std::forward<Args>(args)...));
}

} // namespace sheet
