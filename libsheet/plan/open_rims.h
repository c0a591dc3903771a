// SPDX-License-Identifier: GPL-3.0-or-later
// Gas in a sheet that starts with an open rim, which counts as closed (model.md): who does not know that waits for the
// gas to leave.
#pragma once
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// Of the widest hole that nothing but its cap closes in what encloses an amount of gas; "" if there is none, or the gas
// has a leak.
[[nodiscard]] std::string open_rim_warning(const Scene& scene, const formats::Frame& first);

} // namespace sheet
