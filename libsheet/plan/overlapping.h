// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets that start in each other: their middles apart, but less than they are thick.
#pragma once
#include <string>

#include "libsheet/scene/scene.h"

namespace sheet {

// Of the two sheets of a scene, both there from the start, that overlap most where they lie face to face, by more than
// a quarter of their mean thickness: how far they are apart, and how far they should be; else "".
[[nodiscard]] std::string overlapping_warning(const Scene& scene);

} // namespace sheet
