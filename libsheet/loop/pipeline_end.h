// SPDX-License-Identifier: GPL-3.0-or-later
// How the stages of a pipeline ended, in words and as an exit code, and what time they took.
#pragma once
#include <cstdint>
#include <string>

#include "libsheet/base/error.h"
#include "libsheet/loop/pipeline.h"

namespace sheet {

// The stage's own if it is one of ours; usage where there is no such command; else internal.
[[nodiscard]] ExitCode exit_code_of(const StageStatus& stage);
[[nodiscard]] std::string describe(const StageStatus& stage);
// Prints the table of times. elapsed: of all rounds [s].
void report_times(const PipelineEnd& end, std::uint64_t rounds, double elapsed);

} // namespace sheet
