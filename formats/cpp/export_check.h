// SPDX-License-Identifier: MIT
// What every exporter asks of its mesh first.
#pragma once
#include "formats/cpp/foreign_mesh.h"

namespace sheet::formats {

// Throws std::invalid_argument if an index is out of range or an array has the wrong length.
void check_export(const ForeignMesh& mesh);

} // namespace sheet::formats
