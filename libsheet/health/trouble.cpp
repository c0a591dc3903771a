// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/health/trouble.h"

#include <algorithm>
#include <limits>

namespace sheet::health {

namespace {

constexpr std::array table{
    Kind{.trouble = Trouble::thin,
         .name = "thin",
         .least = true,
         .told = Told::plainly,
         .what = "the sheet is down to {} of its thickness at the start",
         .counted = "",
         .noted = {.worst = 1e-2, .share = 0, .times = 1},
         .serious = {.worst = 1e-4, .share = 0, .times = 1},
         .remedy = "a real film tears there: say from what thickness on by [tear] below, with sheet-tear in the ring; "
                   "what hangs by such films is right until then"},
    Kind{.trouble = Trouble::sharp,
         .name = "sharp triangles",
         .least = true,
         .told = Told::plainly,
         .what = "triangles have angles down to {} degrees",
         .counted = "",
         .noted = {.worst = 5, .share = 0, .times = 3},
         .serious = {.worst = 0.5, .share = 0, .times = 3, .of_steps = 0.01},
         .remedy = "put sheet-remesh --smooth first into the ring; if it is there: shorter edges (edge_length), or "
                   "[tear], as strands of the width of a triangle stay sharp"},
    Kind{.trouble = Trouble::coarse_fold,
         .name = "edges longer than folds",
         .least = false,
         .told = Told::plainly,
         .what = "the sheet turns by up to {} degrees over one edge",
         .counted = "",
         .noted = {.worst = 90, .share = 0.02, .times = 3},
         .serious = {.worst = 90, .share = 0.2, .times = 3},
         .remedy = "shorter edges: edge_length in [sheet], or --edge-length of sheet-remesh; the folds' width is the "
                   "mesh's until then"},
    Kind{.trouble = Trouble::coarse_solid,
         .name = "edges longer than a solid",
         .least = false,
         .told = Told::plainly,
         .what = "edges that lie on a solid are up to {} times as long as it is wide",
         .counted = "",
         .noted = {.worst = 1, .share = 0, .times = 3},
         .serious = {.worst = 2, .share = 0, .times = 3},
         .remedy = "shorter edges: edge_length in [sheet], or --edge-length of sheet-remesh; triangles span the solid "
                   "instead of lying on it"},
    Kind{.trouble = Trouble::short_steps,
         .name = "short steps",
         .least = true,
         .told = Told::plainly,
         .what = "steps are down to {} of the time in which the scene flows",
         .counted = "",
         .noted = {.worst = 1e-3, .share = 0, .times = 3, .of_steps = 0.01},
         .serious = {.worst = 1e-5, .share = 0, .times = 3, .of_steps = 0.01},
         .remedy = "look at what moves there (sheet-render --look speed, or sheet-view): mend what else is told here, "
                   "or ask for less by sheet-step --tolerance"},
    Kind{.trouble = Trouble::held_back,
         .name = "intersections waited for",
         .least = false,
         .told = Told::plainly,
         .what = "up to {} vertices on solids or held stayed behind in a step, or the sheet would pass through itself",
         .counted = "vertices",
         .noted = {.worst = 1, .share = 0, .times = 1},
         .serious = {.worst = 1, .share = 0, .times = 20, .of_steps = 0.1},
         .remedy = "if it goes on step after step: give the sheet more room between solids and [[hold]]s, or "
                   "shorter edges"},
    Kind{.trouble = Trouble::close_to_solid,
         .name = "triangles too close to solids",
         .least = false,
         .told = Told::plainly,
         .what = "up to {} triangles in a step came too close to solids",
         .counted = "triangles",
         .noted = {.worst = 1, .share = 0, .times = 1},
         .serious = {.worst = 1, .share = 0, .times = 20, .of_steps = 0.1},
         .remedy = "if it goes on step after step: shorter edges than the solids' details, or shorter steps"},
    Kind{.trouble = Trouble::not_converged,
         .name = "steps not converged",
         .least = false,
         .told = Told::plainly,
         .what = "up to {} parts of a step were taken before Newton's iterations had converged",
         .counted = "parts",
         .noted = {.worst = 1, .share = 0, .times = 1},
         .serious = {.worst = 1, .share = 0, .times = 5, .of_steps = 0.01},
         .remedy = "shorter steps (sheet-step --tolerance, --dt), or sheet-remesh --smooth first in the ring"},
    Kind{.trouble = Trouble::above_tolerance,
         .name = "steps above the tolerance",
         .least = false,
         .told = Told::plainly,
         .what = "the error of a step is up to {} of an edge, and no shorter step was better",
         .counted = "",
         .noted = {.worst = 0, .share = 0, .times = 1},
         .serious = {.worst = 0.1, .share = 0, .times = 5, .of_steps = 0.01},
         .remedy = "sheet-remesh --smooth first in the ring, or shorter edges there"},
    Kind{.trouble = Trouble::edits_due,
         .name = "remeshing behind",
         .least = false,
         .told = Told::plainly,
         .what = "up to {} edits were made in one go, and more were due",
         .counted = "",
         .noted = {.worst = 1, .share = 0, .times = 1},
         .serious = {.worst = 1, .share = 0, .times = 20, .of_steps = 0.1},
         .remedy = "nothing to do at the start; else the edges that sheet-remesh is asked for do not fit the mesh: see "
                   "its --edge-length"},
    Kind{.trouble = Trouble::crumbs,
         .name = "crumbs",
         .least = false,
         .told = Told::in_percent,
         .what = "{} of the volume has been dropped as crumbs and threads",
         .counted = "",
         .noted = {.worst = 0.01, .share = 0, .times = 1},
         .serious = {.worst = 0.1, .share = 0, .times = 1},
         .remedy =
             "take shorter edges, let them fly on (drops = true in [tear]), or leave crumbs = \"drop\" out: crumbs "
             "are pieces of a triangle or two, threads strands narrower than a thirty-second of an edge"},
    Kind{.trouble = Trouble::volume,
         .name = "volume",
         .least = false,
         .told = Told::in_percent,
         .what = "{} of the volume was won or lost in one step, and no stage says where it went",
         .counted = "m^3",
         .noted = {.worst = 1e-9, .share = 0, .times = 1},
         .serious = {.worst = 1e-3, .share = 0, .times = 1},
         .remedy = "look at the stages of your own: what leaves or enters belongs into the frame's accounts "
                   "(formats/sheet.md, section 5)"},
    Kind{.trouble = Trouble::two_solids,
         .name = "between two solids",
         .least = false,
         .told = Told::in_percent,
         .what = "up to {} of the vertices lay between two solids less than half as far apart as the sheet is thick",
         .counted = "vertices",
         .noted = {.worst = 0, .share = 0, .times = 3},
         .serious = {.worst = 0.05, .share = 0, .times = 20, .of_steps = 0.1},
         .remedy =
             "leave what is squeezed a way out, and edges shorter than that way; slower solids or a wider gap have no "
             "such places"},
    Kind{.trouble = Trouble::crushed,
         .name = "crushed",
         .least = false,
         .told = Told::plainly,
         .what = "triangles are up to {} times as thick as the sheet at its start or inlet, and thicker than twice "
                 "their longest edge",
         .counted = "",
         .noted = {.worst = 4, .share = 0, .times = 3},
         .serious = {.worst = 10, .share = 0, .times = 3},
         .remedy = "what should fold does not, or has no room: contact = \"flow\" on what it is poured on, [[sheet]] "
                   "perturbation where all is symmetric about the sheet's plane (sheet-init --check), more room, or "
                   "shorter edges; what surface tension has drawn to a lump is no sheet any more: end before"},
    Kind{.trouble = Trouble::gas_escapes,
         .name = "gas escapes",
         .least = false,
         .told = Told::plainly,
         .what = "gas has left what enclosed it through holes of up to {} m^2",
         .counted = "m^3",
         .noted = {.worst = 0, .share = 0, .times = 1},
         .serious = {.worst = std::numeric_limits<double>::infinity(), .share = 0, .times = 1},
         .remedy = "nothing to do where it is to burst; else [tear] below and sites, and what closes the rims"},
    Kind{.trouble = Trouble::threads,
         .name = "threads",
         .least = true,
         .told = Told::plainly,
         .what = "strands, one triangle wide, are down to {} times as wide as they are thick",
         .counted = "",
         .noted = {.worst = 1, .share = 0, .times = 3},
         .serious = {.worst = 0, .share = 0, .times = 3},
         .remedy = "a sheet so narrow is a thread, which tension parts into drops: say from what width on by [tear] "
                   "snap, with sheet-tear in the ring, and faces = true in [model] makes it round; else it is drawn "
                   "out until sheet-remesh cuts it, where edges get no shorter"},
};

} // namespace

std::span<const Kind> kinds() { return table; }

const Kind& kind_of(Trouble trouble) { return *find_kind(static_cast<double>(trouble)); }

const Kind* find_kind(double number) {
  const auto it = std::ranges::find(table, number, [](const Kind& k) { return static_cast<double>(k.trouble); });
  return it == table.end() ? nullptr : &*it;
}

} // namespace sheet::health
