// SPDX-License-Identifier: GPL-3.0-or-later
// Options of meshes and of remeshing by the length of edges [m].
#pragma once
#include "libsheet/remesh/remesh.h"
#include "libsheet/shape/shapes.h"

namespace sheet::test {

inline MeshOptions edges(double length) {
  MeshOptions options;
  options.edge_length = length;
  return options;
}

inline remesh::Options options(double edge_length, bool smooth = true) {
  remesh::Options o;
  o.size.edge_length = edge_length;
  o.smooth = smooth;
  return o;
}

} // namespace sheet::test
