// SPDX-License-Identifier: GPL-3.0-or-later
// What sheet-check prints.
#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "libsheet/measure/check.h"

namespace sheet {

// Every kind of finding and what it means, a line each.
[[nodiscard]] std::string check_kinds();

// A line for each finding, lines for its examples; nothing if there are no findings. `index`: the frame's, in its
// stream.
[[nodiscard]] std::string findings_text(const formats::Frame& frame, std::uint64_t index,
                                        std::span<const Finding> findings);

// One JSON object without a newline: frame, step, time, findings: [{kind, text, count, examples}].
[[nodiscard]] std::string findings_json(const formats::Frame& frame, std::uint64_t index,
                                        std::span<const Finding> findings);

} // namespace sheet
