// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/loop/pipeline_end.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/core.h>

#include "libsheet/base/log.h"

namespace sheet {

ExitCode exit_code_of(const StageStatus& stage) {
  constexpr int command_not_found = 127, not_executable = 126;
  if (stage.code == command_not_found || stage.code == not_executable)
    return ExitCode::usage;
  return stage.code >= 1 && stage.code <= 6 ? static_cast<ExitCode>(stage.code) : ExitCode::internal;
}

std::string describe(const StageStatus& stage) {
  if (stage.code == 127)
    return fmt::format("stage \"{}\" was not found (exit code 127)", stage.command);
  if (stage.code > 128)
    return fmt::format("stage \"{}\" was ended by signal {} ({})", stage.command, stage.code - 128,
                       strsignal(stage.code - 128));
  return fmt::format("stage \"{}\" failed with exit code {}", stage.command, stage.code);
}

void report_times(const PipelineEnd& end, std::uint64_t rounds, double elapsed) {
  std::string text = fmt::format("{} steps in {:.3g} s", rounds, elapsed);
  double known = 0;
  for (const StageTime& time : end.times) {
    known += time.seconds;
    text += fmt::format("\n  {:<16} {:10.3f} s {:9.3f} ms a step {:5.1f} %", time.name, time.seconds,
                        1e3 * time.seconds / static_cast<double>(std::max<std::uint64_t>(1, time.frames)),
                        100 * time.seconds / elapsed);
  }
  // A stage writes while the next one reads, so that the sum may exceed the whole.
  const double others = elapsed - known;
  text += fmt::format("\n  {:<16} {:10.3f} s {:9.3f} ms a step {:5.1f} %",
                      others >= 0 ? "pipes and others" : "at the same time", std::abs(others),
                      1e3 * std::abs(others) / static_cast<double>(std::max<std::uint64_t>(1, rounds)),
                      100 * std::abs(others) / elapsed);
  log::note("{}", text);
}

} // namespace sheet
