// SPDX-License-Identifier: GPL-3.0-or-later
// What the module does of solid::unite (slab_union.h): all but the weights of the origins.
#pragma once
#include "libsheet/solid/slab_union.h"

namespace sheet::solid {

[[nodiscard]] SlabUnion unite_slabs(const Slabs& slabs, const UnionOptions& options);

} // namespace sheet::solid
