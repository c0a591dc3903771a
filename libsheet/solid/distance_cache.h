// SPDX-License-Identifier: GPL-3.0-or-later
// Fields of distances kept on disk between runs, by what they were made from.
//
// They lie in $SHEET_CACHE_DIR, else $XDG_CACHE_HOME/sheet, else ~/.cache/sheet; an empty SHEET_CACHE_DIR means none.
// A file is written under another name and renamed when whole, so runs at the same time do no harm. One that is
// damaged, of another version or of another surface is made anew; one that cannot be written is done without. Any of
// them may be deleted at any time.
#pragma once
#include <optional>
#include <string>

#include "libsheet/solid/distance_field.h"

namespace sheet::solid {

// The name of a field's file: a hash of the surface (all coordinates and corners), the voxel size, the band and the
// versions of OpenVDB and of this format.
[[nodiscard]] std::string cache_key(const SolidSurface& surface, double voxel_size, double band);

// The field of that key, if it is there and whole.
[[nodiscard]] std::optional<DistanceField> load_field(const std::string& key);

void store_field(const std::string& key, const DistanceField& field);

} // namespace sheet::solid
