// SPDX-License-Identifier: GPL-3.0-or-later
// Films: where a sheet is thinner than a tenth of its mean thickness. They are next to no liquid, move in ways that
// nobody sees, and rule neither the length of steps nor iterations.
#pragma once
#include <vector>

#include "libsheet/energy/stage.h"

namespace sheet {

inline constexpr double film_thickness = 0.1; // of the mean one: films are thinner

// By how much the viscosity of each triangle is raised in a first stage, 1 or more; empty where no film needs it.
// Surface tension γ [N/m] draws a film of thickness h together in a time of μ h/γ, or √(ρ h A/γ) if inertia resists, A
// the area of its triangles. In longer steps these shrink to points, as the viscous potential is finite there (strain
// -1/2), and where area has a kink no Newton iteration converges. A film is therefore at least so stiff that tension
// shortens it by a tenth in a stage of duration τ:
//   μ' h/(4 τ) = 2 γ - (3/100) ρ h A/τ²,
// the first from the strip's balance of W = (3/8) μ' h (a - 1)²/τ per area with 2 γ √a, a its stretch squared, the
// second from a free triangle's with its inertia. Steps that resolve the film have μ' < μ, and do not know of it; pulls
// of films at rest are as they were. Towards the films' greatest thickness it goes continuously to nothing.
[[nodiscard]] std::vector<double> stiffened_films(const Stage& stage, bool inertia);

} // namespace sheet
