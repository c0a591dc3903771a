// SPDX-License-Identifier: GPL-3.0-or-later
// The frames of a stream as mesh files, one each.
#pragma once
#include <optional>
#include <string>

#include "libsheet/shape/union_mesh.h"

namespace sheet {

enum class ExportFormat { vtu, ply, obj, off, stl, glb, vdb };

struct ExportOptions {
  std::string input = "-", output; // output: a name, with %d or %04d for the number of the frame if there are several
  std::optional<ExportFormat> format; // absent: by the ending of the name
  bool solidify = false;              // the closed outer surface of the liquid instead of the mid-surface
  bool unite = false;                 // the outer surface of all layers as one body instead
  UnionSettings body;                 // of that; whether it is a level set goes by the format
};

// Errors: usage (no name, an ending that is no format, several frames for one name, settings that contradict each
// other), those of reading and writing.
void export_frames(const ExportOptions& options);

} // namespace sheet
