// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene will model and what not, and why (sheet-init --check): the terms of its energy, as term_table.h has
// them, and what else stages do.
#pragma once
#include <vector>

#include "libsheet/scene/explain.h"

namespace sheet {

[[nodiscard]] std::vector<scene::ModelledPart> modelled(const Scene& scene);

} // namespace sheet
