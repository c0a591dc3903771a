// SPDX-License-Identifier: GPL-3.0-or-later
// Two streams compared frame by frame.
#pragma once
#include <string>

#include "libsheet/measure/compare.h"

namespace sheet {

// True if the streams in these files ("-": standard input) differ; prints how, a line each, unless the log is quiet.
[[nodiscard]] bool streams_differ(const std::string& first, const std::string& second, const CompareOptions& options);

} // namespace sheet
