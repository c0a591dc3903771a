// SPDX-License-Identifier: GPL-3.0-or-later
// Cases whose mesh is remade on the way, through the stages sheet-step, sheet-remesh and sheet-emit.
#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "formats/cpp/stream_frame.h"
#include "tests/validation/case.h"

namespace sheet::validation {

struct Staged {
  formats::Frame frame;
  double seconds = 0;
  std::uint64_t edits = 0;
};

// From a scene, `s.steps` equal steps, each remeshed to `s.edge`, before them sheet-emit where the scene has inflow.
// `prepare` sees the first frame, `each` every later one.
[[nodiscard]] Staged run_stages(const std::string& scene_text, const Settings& s, double duration,
                                const std::function<void(const formats::Frame&)>& each = {},
                                const std::function<void(formats::Frame&)>& prepare = {});

[[nodiscard]] Result result_of(const Staged& run, const Settings& s, double value);

} // namespace sheet::validation
