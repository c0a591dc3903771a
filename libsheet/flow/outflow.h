// SPDX-License-Identifier: GPL-3.0-or-later
// Outflow: what is wholly beyond one of the scene's [[outflow]] planes leaves the sheet, so that the mesh of a steady
// process stays bounded.
#pragma once
#include "libsheet/flow/put_fans.h"
#include "libsheet/scene/scene.h"

namespace sheet::flow {

// Takes away the triangles that reach beyond a plane and not a quarter of an edge inside, but for an inlet's strip
// (inlet.h); vertices of the others that are beyond go back to the plane, and their triangles lose volume with their
// area: so the sheet ends straight. A vertex that would turn a triangle over on its way leaves with all its triangles.
// With self-contact only what is wholly beyond is taken away, and no vertex goes to the plane, as layers that lie on
// each other would pass through each other: then the sheet ends ragged. Vertices at which what stays would only touch
// itself come apart, as in tearing; springs of contact and directors go with their vertices. What has left so far is in
// the frame's arrays `outflow.volume` [m³], `outflow.momentum` [kg m/s] and `outflow.energy` (kinetic) [J] (account.h).
// Drops (sheet/drops.h) leave when their middles are beyond. Bit for bit the same frame if nothing is beyond; one
// without triangles if all is. `triangles`: those taken away.
Dropped let_out(formats::Frame& frame, const Scene& scene);

} // namespace sheet::flow
