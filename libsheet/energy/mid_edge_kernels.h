// SPDX-License-Identifier: GPL-3.0-or-later
// The potential of mid_edge_shell.h for eight triangles at once, one in each lane of a vector: values, gradients and
// Hessians by the twelve unknowns (three corners' coordinates, three edges' angles).
#pragma once

namespace sheet {

class FlowCurve;

// As in material/flow_curve.h, of which a source for one instruction set can include nothing.
void flow_points(const FlowCurve& curve, int count, const double* squared_rates, double* potentials,
                 double* viscosities, double* slopes);

inline constexpr int lane_count = 8;

// A number of each triangle.
using LaneNumbers = double[lane_count];

// What stays during a stage. Edge k runs from corner k+1 to corner k+2, and so does its start direction `tangent`;
// `binormal` is what the director turns towards.
struct alignas(64) MidEdgeReference {
  LaneNumbers tangent[3][3], director[3][3], binormal[3][3];
  LaneNumbers trace[3], determinant;    // of the raised metric [1/m², m⁴]
  LaneNumbers curvature[3], lengths[3]; // references [m], [m²]
  LaneNumbers weight, membrane;         // V μ ĥ²/(6 τ) and V μ/(2 τ) [J], μ as predicted
  LaneNumbers stiffness[3], height[3];  // of caps, at their longest edge, else 0 [J/m²], [m]
  // Of directors that lean far: half a hinge by their angle, else 0 [J]; that angle; the part of the height that
  // counts.
  LaneNumbers folding[3], lean_cosine[3], lean_sine[3], upright[3];
  LaneNumbers volume, thickness; // for flow curves; the volume as stiffened; as crusts have it [m³], [m]
  LaneNumbers duration;          // likewise; τ, reduced by temperature (stage.h) [s]
  bool folded;                   // whether any lane has a director that leans far
};

// At points through the thickness, in each half two of Gauss [z/h, from the middle outwards].
inline constexpr int flow_points_through = 4;

// Of liquids that are not Newtonian: a stress p at each point (mid_edge_shell.h), as a form on edges [Pa m²].
struct alignas(64) MidEdgeStress {
  LaneNumbers at[flow_points_through][3];
};

// What a liquid does that is not Newtonian (curve: null if it is); the stress, once Newton has gone a step. Lanes that
// are of different liquids have their own curves.
struct MidEdgeFlow {
  const FlowCurve* curve = nullptr;
  const FlowCurve* const* lanes = nullptr;
  const MidEdgeStress* stress = nullptr;
};

struct alignas(64) MidEdgeState {
  LaneNumbers x[9];               // corners [m]
  LaneNumbers cosine[3], sine[3]; // of the edges' angles
};

// What a stage's references follow from, besides the frames in them and, in a second stage, the first one's result.
struct alignas(64) MidEdgeStart {
  LaneNumbers x[9];              // corners at the start of the step [m]
  LaneNumbers metric[3], volume; // squared lengths of the raised metric [m²], [m³]
  LaneNumbers rate, stiffening;  // μ/(2 τ), as stiffened, and by how much it is [Pa], [1]
  LaneNumbers sign[3];           // 1 where edge k runs from its lower to its higher vertex, else -1
  LaneNumbers held[3];           // 1 where edge k's director is held, else 0
  LaneNumbers duration, bending; // τ, reduced by temperature; by what bending differs (stage.h) [s], [1]
  double ratio;                  // of the stage, see stage.h
};

// What works on the area A within the arcs (area_loads.h).
struct alignas(64) MidEdgeLoads {
  LaneNumbers tension, thrust, work, start_area; // σ [N/m], T [J m²], w [J], A0 [m²]
  bool worked;                                   // whether w is not 0 in any lane
};

struct alignas(64) MidEdgeResult {
  LaneNumbers value;        // [J]
  LaneNumbers gradient[12]; // [N], [N m]
  LaneNumbers hessian[78];  // lower triangle, row by row
};

// loads: of arcs only; null: none. Flow curves are of arcs only, too.
using MidEdgeKernel = void (*)(const MidEdgeReference&, const MidEdgeState&, bool arcs, const MidEdgeLoads* loads,
                               const MidEdgeFlow& flow, MidEdgeResult&);

// From the stress that flow has, or without one from that of the flow itself, to that at the end of a step of the
// twelve unknowns.
using MidEdgeStressKernel = void (*)(const MidEdgeReference&, const MidEdgeState&, const LaneNumbers (&step)[12],
                                     const MidEdgeFlow& flow, MidEdgeStress&);

// What viscosity dissipates in the stage, caps and directors that lean apart [J].
using MidEdgeDissipatedKernel = void (*)(const MidEdgeReference&, const MidEdgeState&, bool arcs,
                                         const MidEdgeFlow& flow, LaneNumbers& energy);

// Fills a reference whose frames are set. previous: the first stage's result; it counts if the ratio is not 0.
using MidEdgeReferenceKernel = void (*)(const MidEdgeStart& start, const MidEdgeState& previous,
                                        MidEdgeReference& reference);

struct MidEdgeKernels {
  MidEdgeReferenceKernel reference;
  MidEdgeKernel value, gradient, hessian; // each with those before it
  MidEdgeKernel definite;                 // as `hessian`, with the positive semidefinite approximation
  MidEdgeStressKernel stress;
  MidEdgeDissipatedKernel dissipated;
};

// Those for this processor.
[[nodiscard]] const MidEdgeKernels& mid_edge_kernels();

} // namespace sheet
