// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles taken away from a sheet, such that what stays is a manifold that does not pass through itself.
#pragma once
#include <functional>
#include <vector>

#include "libsheet/flow/put_fans.h"

namespace sheet::flow {

// Told which triangles leave in the end, before they do.
using BeforeLeaving = std::function<void(const std::vector<bool>&)>;

// Takes these triangles away. Vertices at which what stays would only touch itself come apart, as in tearing. Parts of
// a crumpled sheet that hang together by such triangles alone, and would cross when they come apart, stay together for
// now: what joins them leaves later. Gives what has left; bit for bit the same frame if nothing has.
Dropped drop(formats::Frame& frame, std::vector<bool> leaves, const Scene& scene, const BeforeLeaving& before = {});

} // namespace sheet::flow
