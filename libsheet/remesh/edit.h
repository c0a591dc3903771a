// SPDX-License-Identifier: GPL-3.0-or-later
// One change of the mesh as a value: what goes, what comes, and from where. Splits, collapses, flips and movements of
// vertices are all written so; one function makes room for them, carries every array and keeps liquid and momentum
// (editable_sheet.h).
#pragma once
#include <cstdint>
#include <vector>

#include "libsheet/geometry/types.h"
#include "libsheet/remesh/mesh.h"
#include "libsheet/sheet/transfer.h"

namespace sheet::remesh {

struct Edit {
  enum class Kind { split, collapse, flip, smooth };
  Kind kind = Kind::flip;
  std::vector<std::uint32_t> removed; // triangles
  std::vector<Corners> added;         // their corners; `vertex` may be among them

  // former[i]: which of the removed triangles added triangle i was before, where its corners only moved; else empty.
  std::vector<std::size_t> former;

  // At most one vertex is new (split), takes the place of two (collapse) or moves (smooth).
  std::uint32_t vertex = no_index;
  Vector3 position = Vector3::Zero();      // of `vertex` afterwards [m]
  std::vector<Parent> parents;             // of `vertex`
  bool keeps_hold = false;                 // what holds `vertex` goes on holding it, whatever its parents
  std::uint32_t removed_vertex = no_index; // collapse

  // overlap[i * removed.size() + j]: the area of added triangle i that covers removed triangle j [m²]
  std::vector<double> overlap;
  std::vector<double> rise; // by how much the old thickness there differs from its mean [m], by EditableSheet
  // Volume between the sheet after and before, by which the enclosed volume grows [m³].
  double swept = 0;

  std::vector<double> volumes; // of the added triangles [m³], by the thickness rule

  void clear() {
    removed.clear();
    added.clear();
    former.clear();
    parents.clear();
    overlap.clear();
    rise.clear();
    volumes.clear();
    vertex = removed_vertex = no_index;
    swept = 0;
    keeps_hold = false;
  }
};

} // namespace sheet::remesh
