// SPDX-License-Identifier: GPL-3.0-or-later
// accident_at STEP: a pass-through stage that runs the shell command in $accident when it sees the frame of that step.
// The command knows the stage's own process id as $stage.
#include <cstdlib>
#include <string>

#include <unistd.h>

#include "libsheet/base/filter.h"

int main(int argc, char** argv) {
  sheet::Tool tool("accident_at", "a stage to which something happens", "");
  std::string step;
  tool.required_argument("STEP", step, "when");
  return tool.run(argc, argv, [&] {
    sheet::FilterOptions options;
    options.no_provenance = true;
    sheet::run_filter(tool, options, [&](sheet::formats::Frame& frame) {
      if (frame.step != std::stoull(step))
        return;
      ::setenv("stage", std::to_string(::getpid()).c_str(), 1);
      const char* command = std::getenv("accident");
      if (command == nullptr || std::system(command) < 0)
        sheet::fail(sheet::ExitCode::internal, "the accident did not happen");
    });
  });
}
