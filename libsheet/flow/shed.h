// SPDX-License-Identifier: GPL-3.0-or-later
// What becomes of liquid that comes off a tearing sheet in parts too small for triangles: threads, crumbs, small
// pieces. With [tear] drops it flies on as balls (sheet/drops.h), else it is lost, and in the frame's accounts.
//
// A part that hangs together becomes one drop, or, where it is long, several in a row: a thread of the radius r parts
// into pieces as long as the wave that grows fastest on it, 2 √2 π r √(1 + 3 Oh), Oh = μ/√(2 ρ γ r) [Weber 1931]. Each
// drop has the volume, the momentum and the centre of mass of its triangles, whose corners carry a third each; their
// relative motion and their turning end. Volume and momentum stay to round-off.
#pragma once
#include <cstdint>
#include <vector>

#include "libsheet/flow/put_fans.h"
#include "libsheet/sheet/drops.h"

namespace sheet::flow {

struct Shed {
  Dropped sum;
  std::vector<Drop> drops; // none without [tear] drops
};

// What these triangles become when they have left.
[[nodiscard]] Shed what_becomes_of(const formats::Frame& frame, const std::vector<bool>& leaves, const Scene& scene);
// Adds it, when they have, to the frame's drops, or to its arrays `tear.volume` [m³], `tear.momentum` [kg m/s] and
// `tear.heat` [J] (account.h). Nothing if none have.
void put_shed(const Shed& shed, const Scene& scene, formats::Frame& frame);

// Takes triangles away (drop.h), and puts what they become.
Shed shed_off(formats::Frame& frame, std::vector<bool> leaves, const Scene& scene);

// Pieces of the sheet that tension has made round, or soon will: of fewer than 100 triangles, open, within a ball about
// their centre of mass of three times the radius of one with their volume, which nothing holds, no inlet makes longer,
// and that touch no solid and no other layer; but for the largest piece of all. The triangles of each; none without
// [tear] drops.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> round_pieces(const formats::Frame& frame, const Scene& scene);

// They become drops. Nothing without [tear] drops.
Shed shed_round_pieces(formats::Frame& frame, const Scene& scene);

} // namespace sheet::flow
