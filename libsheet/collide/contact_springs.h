// SPDX-License-Identifier: GPL-3.0-or-later
// The springs between near features of a sheet that hold layers apart, and together, in the next steps [Batty et al.
// 2012, section 3.5]: where they come and go, and how stiff they are. Their energy is that of
// libsheet/energy/contact.h. SI units.
//
// A vertex and a triangle whose distance falls below the mean of their thicknesses, or contact.distance where the
// scene says one, get a spring, the nearest triangle first and none that shares a corner with one that the vertex has
// already; so do two edges between whose vertices there is no such contact. The normal part is at rest at the distance
// that they have, the tangential part at the offset that they have. A spring goes with its features: its normal and
// anchor turn by the smallest rotation that takes the features' normal from before the step to after it, so turning as
// a whole costs nothing.
//
// Stiffness [N/m] of both parts, unless the scene says one, for a spring that stands for the area A = half of the area
// of its vertex (the vertices of both layers get springs; edges: half of the mean of their vertices'):
//   k = A rho h / T²  +  200 A rho g h / d  +  mu h / (2 T),   T = sqrt(d/g)/10, without gravity d/v/10
// with h the mean thickness, d the contact distance, v the speed of approach. Terms: inertia (if it is modelled): what
// falls from a height of d is stopped within a tenth of it; weight: ten layers compress by a twentieth of d; viscosity:
// as stiff as the sheet itself is against stretching within T, so that what a viscous sheet presses together does not
// go through either; mu of two liquids is 2/(1/mu + 1/mu'), as one is behind the other. Where layers flow (layers_flow)
// the tangential part is 0 (contact_shear.h has it), the rest distance follows their mean thickness, and springs slide
// with the layers (spring_feet.h). The length of the step does not matter (where neither g nor v is, T is that), nor,
// under gravity, how fast the features came, as impulses take that speed away, else the error of a step would not fall
// with it.
#pragma once
#include "libsheet/collide/self_search.h"
#include "libsheet/collide/sheet_layers.h"
#include "libsheet/collide/step_path.h"
#include "libsheet/scene/scene.h"
#include "libsheet/sheet/contact_spring.h"

namespace sheet::collide {

// The sheet at the end of a step, as springs see it; one value a vertex.
struct SpringSheet {
  std::span<const Vector3> start, end;        // [m]
  std::span<const double> reach;              // contact distance [m]
  std::span<const double> thickness;          // [m]
  std::span<const double> area;               // a third of the area of its triangles [m²]
  std::vector<Axes> fixed;                    // pairs of fixed vertices alone get no spring
  double step = 0;                            // its length [s]
  std::span<const double> end_thickness = {}; // where layers flow; their springs rest at what they thin to [m]
  std::span<const double> shift = {};         // a_T by which temperature shifts the flow curve; empty: 1
  std::span<const std::uint32_t> liquid = {}; // its number in `liquids`; empty: 0
  std::span<const Liquid> liquids = {};       // of the scene (scene::liquids_of)
  const Connectivity* mesh = nullptr;         // given where layers flow
  std::span<const double> volumes = {};       // of its triangles [m³]
};

// Takes away the springs within one layer, by the positions and contact distances at the start: those of a layer that
// has become thicker than the loop between them is long, and those of streams from before layers were told apart.
void drop_within_layers(std::vector<ContactSpring>& springs, const SheetLayers& layers, const SpringSheet& sheet);

// Turns the springs with their features and takes away those that parted: whose features passed each other or became
// parallel edges, and whose tension [Pa] exceeds the scene's adhesion. Without `adhesion` in the scene none parts, and
// welds never do.
// Returns of each that is left the energy that it had at the step's end before impulses and what carries or pulls back
// vertices corrected that, `uncorrected`: turned, and, if they moved its features, no more than as it was [J].
[[nodiscard]] std::vector<double> follow(std::vector<ContactSpring>& springs, const Scene& scene,
                                         const SpringSheet& sheet, std::span<const Vector3> uncorrected);

// [J].
[[nodiscard]] double energy_of(std::span<const ContactSpring> springs, const Scene& scene,
                               std::span<const Vector3> positions);

// What has moved vertices, or has put the force of one spring on another, has done no work: all springs that it has
// strained give up the same part of that strain's energy, so that springs get no more of it than other springs gave and
// `given` [J]. Their rest and anchor follow, so that they push and pull less from where they are. `had`: the energy
// of the first springs before; those behind are new.
void ease_strained(std::vector<ContactSpring>& springs, std::span<const double> had, double given, const Scene& scene,
                   std::span<const Vector3> positions);

// Where the scene merges layers, or some springs have dates, those without one have come to be now [s].
void date(std::vector<ContactSpring>& springs, const Scene& scene, double now);

// Adds springs for near pairs of two layers, at the end of the step, that have none.
void add_springs(std::vector<ContactSpring>& springs, SelfSearch& search, const Scene& scene, const SpringSheet& sheet);

// What comes to touch does not bounce: takes away the velocity of each new spring's features along its normal, relative
// to each other, by impulses between them, so momentum stays and kinetic energy does not grow (a number of sweeps of
// Gauss-Seidel: nearly all of it in small piles). Where the scene's adhesion is 0, only that of approach. `mass` [kg];
// along fixed axes it is infinite. Where nearly all of a contact is fixed, so that the rest would have to change by
// more than longest_lever times the rate, it is left as it is: it would be thrown.
void level_velocities(std::span<const ContactSpring> springs, const Scene& scene, std::span<const double> mass,
                      const std::vector<Axes>& fixed, std::span<Vector3> velocity);

} // namespace sheet::collide
