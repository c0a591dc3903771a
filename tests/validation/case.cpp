// SPDX-License-Identifier: GPL-3.0-or-later
// The list of cases. Defaults are the sizes that the tests run at.
#include "tests/validation/case.h"

#include "libsheet/base/error.h"
#include "tests/validation/setup.h"

namespace sheet::validation {

namespace {

Settings at(double edge, int steps, Pattern pattern = Pattern::irregular) {
  Settings s;
  s.edge = edge;
  s.steps = steps;
  s.pattern = pattern;
  return s;
}

Settings instant(double edge) { // of a sheet that bends
  Settings s = at(edge, 1);
  s.scheme = Scheme::backward_euler;
  s.bending = Shell::arcs;
  return s;
}

} // namespace

const std::vector<Case>& cases() {
  static const std::vector<Case> list = {
      {"V1", "balloon, constant pressure, to 80 % of blow-up (set 1: h 0.1, p 0.1; 2: h 0.3, p 0.15)", "radius",
       "t,r,speed,x,y", 2, at(0.15, 40, Pattern::equilateral), true, true, v1},
      {"V2", "balloon, pressure as 1/r², to twice the radius (set 1: h 0.1, p 0.2; 2: h 0.3, p 0.3)", "radius",
       "t,r,speed,x,y", 2, at(0.15, 40, Pattern::equilateral), true, true, v2},
      {"V3", "inviscid sphere contracts to cos 1.2 (Fig. 7's four sets)", "radius", "t,r,speed,x,y", 4,
       at(0.15, 40, Pattern::equilateral), true, true, v3},
      {"V4", "sphere with viscosity, inertia, surface tension and pressure", "radius", "", 1,
       at(0.15, 40, Pattern::equilateral), true, true, v4},
      {"V5", "strip pulled by a force, sides free, to twice the length", "length", "", 1, at(0.0833, 40), true, false,
       v5},
      {"V6", "strip pulled by a force, width held, to twice the length", "length", "", 1, at(0.0833, 40), true, false,
       v6},
      {"V7", "tube under pressure, to twice the radius", "radius", "", 1, at(0.2, 40), true, true, v7},
      {"V8", "free disk contracts to half its radius", "square root of the area", "", 1, at(0.15, 40), true, false, v8},
      {"V9", "a hole opens (set 1: 0.3 of the radius; 2: 0.1)", "radius of the hole", "", 2, at(0.08, 40), true, true,
       v9},
      {"V9r", "a hole opens to ten times its radius, remeshed", "radius of the hole", "", 1, at(0.04, 80), true, true,
       v9_remeshed},
      {"V10", "half of a film retracts, remeshed", "momentum, worst over the run", "", 1, at(0.01, 200), false, false,
       v10},
      {"V11", "circular plate under its weight (set 1: clamped; 2: simply supported)", "start speed near the centre",
       "", 2, at(1.0 / 16, 1), false, true, v11},
      {"V12",
       "strip under its weight (1 clamped, 2 supported, 3 cantilever, 4 quarter-cylinder cantilever, 5 "
       "quarter-cylinder "
       "arch)",
       "start speed of the middle or tip", "", 5, at(1.0 / 16, 1), false, true, v12},
      {"V13", "viscous catenary, sag from 0.25 to 0.5 %", "sag", "", 1, at(1.0 / 16, 40), true, true, v13},
      {"V14", "patch rolled up: h/edge 1, 0.1, 0.01, 0.001, mesh turned by 0 (1-4), 30 (5-8), 45 degrees (9-12)",
       "dissipated power", "", 12, at(1.0 / 16, 1), false, true, v14},
      {"V15", "growth of waves in a compressed strip on a bath (k over the fastest: 0.8, 0.9, 1, 1.25, 1.6)",
       "growth rate", "", 5, at(1.0 / 16, 1), false, true, v15},
      {"V16", "annulus sheared in its plane", "torque", "", 1, at(0.08, 1), false, true, v16},
      {"V17", "pinned square film oscillates for one period", "1 + greatest deviation of the mode over its amplitude",
       "", 1, at(1.0 / 16, 64), true, true, v17},
      {"V18", "falling curtain, planar, with inflow, 1 m (set 2: remeshed)",
       "1 + greatest error of the speed, from 5 cm on", "", 2, at(0.01, 350), false, true, v18},
      {"V19", "quarter turn in one step (set 1: forces at the turned state; 2: the step itself; 3: from rest)",
       "1 + force over mu V/(dt edge), or greatest relative change of an edge", "", 3, at(0.15, 1), false, false, v19},
      {"V20", "thrown disk (set 1: linear momentum; 2: angular momentum; 3: energy balance)", "1 + relative defect", "",
       3, at(0.15, 20), true, false, v20},
      {"V22", "a layer spreads on a plane (set 1: in a channel; 2: as a disk)", "length or radius", "", 2, at(0.1, 200),
       true, true, v22},
      {"V23", "a block flows down an incline, its upper end held", "length", "", 1, at(0.1, 200), true, true, v23},
      {"V24",
       "layers on walls (set 1: down an incline; 2: with slip; 3: a plug stops; 4: spreads without drag; 5: on top of "
       "a cylinder; 6: spin coating; 7: a puddle; 8: spreads on a bath; 9: as a disk)",
       "1, 2, 3: way; else thickness", "", 9, at(0.1, 40), true, false, v24},
      {"V25", "a layer on an incline overruns a tenth as thick one, remeshed", "place of the front", "", 1,
       at(0.1, 100), false, true, v25},
      {"V26", "film casting, draw ratio 10, 15, 20, 25, 30 (sets 1 to 5)", "force of the roll", "", 5, at(0.02, 4000),
       false, true, v26},
      {"V27", "sphere that encloses gas (set 1: comes to rest; 2: oscillates; 3: leaks)", "1, 3: radius; 2: frequency",
       "", 3, at(0.08, 100, Pattern::equilateral), true, true, v27},
      {"V28", "free disk with noise contracts, bending", "root mean square of its height over that at the start", "", 1,
       at(0.1, 25), false, false, v28},
      {"V29",
       "a layer between two walls (set 1: that slide past each other, one with slip; 2: round plates that close; 3: a "
       "slider bearing)",
       "1: way; 2: radius; 3: flux", "", 3, at(0.1, 40), true, false, v29},
      {"V30",
       "liquids that are not Newtonian: power law 1/3, 1/2, 3/2, Bingham (sets 1-4: strip pulled, sides free; 5-8: "
       "width held; 9-12: tube, 13-16: balloon under pressure)",
       "length or radius", "", 16, at(0.1, 32), true, false, v30},
      {"V31",
       "liquids that are not Newtonian on walls (set 1: Herschel-Bulkley down an incline; 2: with slip; 3: power law "
       "1/3; 4: Bingham slumps in a plane until it rests; 5: as a disk; 6: as 4, a tenth as thick as wide)",
       "1 to 3: way; 4, 6: length; 5: radius", "", 6, at(0.1, 40), true, false, v31},
      {"V32", "viscous catenary, power law 1/3, 1/2, 3/2, Bingham (sets 1 to 4)", "sag", "", 4, at(1.0 / 16, 40), true,
       true, v32},
      {"V33",
       "load from which on a Bingham liquid flows (set 1: balloon; 2: tube; 3: hanging strip; 4: its width held; 5: "
       "straight rim; 6: hole; 7: incline; 8: cantilever; 9, 10: span, supported and clamped; 11, 12: round plate, "
       "supported and clamped)",
       "load", "", 12, instant(0.05), false, true, v33},
      {"V34", "film casting of power laws 0.5, 0.8, 1, 1.2 (sets 1 to 4)", "draw ratio from which on disturbances grow",
       "", 4, at(0.02, 4000), false, true, v34},
      {"V35", "hole in an endless film of power laws 1/3, 1/2, 0.7, 1, 3/2 (sets 1 to 5)", "start speed of its rim", "",
       5, instant(0.1), false, true, v35},
      {"V36",
       "films of power laws 1, 1/3, 0.1 in their plane (sets 1 to 3: half plane with a wave on its border; 4 to 6: "
       "indenter of Houseman and England)",
       "1 to 3: depth of half the speed; 4 to 6: speed within", "", 6, instant(0.05), false, true, v36},
      {"V37",
       "ice on the sea (set 1: a slab, its width held; 2: a free disk; 3: a wedge; 4: a shelf with inflow, PISM's test "
       "V)",
       "1: thickness; 2: speed of the rim; 3: speed of the front; 4: front", "", 4, at(0.1, 40), true, false, v37},
      {"V38",
       "tension of rims and slopes (set 1: a strip rests; 2: a disk; 3: a varicose wave; 4: with viscosity; 5: on a "
       "wall; 6, 7: a rim retracts, Oh 0.05, 1; 8: a free thread; 9, 10, 11: it beads, k r = 0.25, 0.5, 0.7; 12, 13: a "
       "hole of 0.3 and 0.5 h)",
       "1 width over thickness; 2 radius; 3 frequency; 4, 5, 9 to 11 rate; 6, 7 thickness; 8 speed of its radius; 12, "
       "13 radius over that at the start",
       "", 13, at(0.2, 100), true, true, v38},
      {"V39",
       "sheets that cool (set 1: balloon, by transfer; 2: by radiation; 3: power law 1/2; 4: heated by its own "
       "viscosity; 5: viscous catenary; 6: tension that changes along a strip)",
       "1 to 4: radius; 5: sag; 6: speed of the middle", "", 6, at(0.15, 40, Pattern::equilateral), true, true, v39},
      {"V40", "film casting of a film that cools, (St, k) = (0.1, 1), (0.3, 1), (0.1, 3) (sets 1 to 3)",
       "draw ratio from which on disturbances grow", "", 3, at(0.02, 4000), false, true, v40},
      {"V41", "holes at inclusions (set 1: when the first opens; 2: how many open)",
       "1 Kolmogorov's distance from the law; 2 number of holes", "", 2, at(0.3, 25), false, false, v41},
      {"V42",
       "a hole grows (set 1: in a film at rest, to 22 times its thickness; 2: to 110; 3, 4: in a curtain of Weber "
       "number "
       "0.8, 1.25)",
       "1, 2 speed of its rim; 3, 4 speed at which its upper rim climbs", "", 4, at(0.05, 200), false, false, v42},
      {"V43",
       "sheets that air holds back (sets 1 to 4: level ones of 0.05, 0.2, 1, 2.5 mm fall; 5: one is thrown along "
       "itself)",
       "1 + greatest deviation of the speed over the terminal one, or that at the start", "", 5, at(0.5, 40), true,
       false, v43},
      {"V44", "water bell, with inflow and outflow, remeshed (set 1: without gravity; 2: with it)", "greatest radius",
       "", 2, at(0.6, 333), false, true, v44},
      {"V45", "a strip is drawn out, remeshed, until it parts (set 1: at half its width; 2: at a third)",
       "its width then", "", 2, at(1, 400), false, false, v45},
      {"V46", "a disk that flies is rained on", "speed at the end", "", 1, at(0.1, 60), false, false, v46},
      {"V47", "a thread thins by its tension, remeshed, until it parts", "rate at which its waist thins", "", 1,
       at(1, 500), false, false, v47},
  };
  return list;
}

const Case& find_case(const std::string& name) {
  for (const Case& c : cases())
    if (c.name == name)
      return c;
  fail(ExitCode::usage, "there is no case {}: see validate --list", name);
}

Result run(const Case& c, Settings settings) {
  if (settings.edge == 0)
    settings.edge = c.defaults.edge;
  if (settings.steps == 0)
    settings.steps = c.defaults.steps;
  if (settings.set < 1 || settings.set > c.sets)
    fail(ExitCode::usage, "{} has the sets 1 to {}, not {}", c.name, c.sets, settings.set);
  return c.run(settings);
}

} // namespace sheet::validation
