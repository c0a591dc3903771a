// SPDX-License-Identifier: GPL-3.0-or-later
// Prescribed flows that stretch, shear and fold a mesh, for tests of remeshing. Lengths and times have no unit.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "libsheet/geometry/types.h"
#include "libsheet/remesh/remesh.h"
#include "libsheet/shape/triangle_mesh.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::test {

// A sheet of this thickness, at rest.
[[nodiscard]] formats::Frame frame_of(const TriangleMesh& mesh, double thickness);

struct Flow {
  std::string name;
  formats::Frame start;
  double edge_length;
  double duration;
  std::function<Vector3(const Vector3& x, double t)> velocity;
};

// Disk of radius 0.15 at (0.5, 0.75) in a vortex that turns back after half of the time [LeVeque 1996, T = 8].
[[nodiscard]] Flow vortex(double edge_length);
// A square film drawn out to 50 times its length, width and thickness shrinking alike.
[[nodiscard]] Flow extension(double edge_length);
// A square film sheared by 20 times its height.
[[nodiscard]] Flow shear(double edge_length);
// A sphere blown up to 10 times its radius; edges stay as long as they are.
[[nodiscard]] Flow inflation(double edge_length);
// Sphere of radius 0.15 at (0.35, 0.35, 0.35) in the deformation field that turns back after half of the time, T = 3
// [Enright et al. 2002].
[[nodiscard]] Flow enright(double edge_length);

// Angles over all triangles, those in geometric corners of the rim excepted: where the sheet's own angle a at a rim
// vertex is below 60 degrees, the triangles that reach into the part of the wedge that is narrower than an edge, within
// edge_length / (2 tan(a/2)) of its tip. No mesh of such edges has better angles there.
struct Angles {
  double smallest = 180, first_percentile = 180, largest = 0; // [degrees]
  std::uint64_t excepted = 0;                                 // triangles in corners
};
[[nodiscard]] Angles angles_of(const formats::Frame& frame, double edge_length);

struct FlowResult {
  Angles worst;                                      // over all steps
  std::uint64_t edits = 0, steps = 0, triangles = 0; // at the end
  double volume_error = 0;                           // relative, at the end
  double seconds = 0;                                // of remeshing
};
// Advects the vertices by the flow (fourth-order Runge-Kutta), `courant` edge lengths a step at most, and remeshes
// after each step. `watch` sees each frame, if given.
FlowResult run_flow(const Flow& flow, double courant, const remesh::Options& options,
                    const std::function<void(const formats::Frame&)>& watch = {});

} // namespace sheet::test
