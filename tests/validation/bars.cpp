// SPDX-License-Identifier: GPL-3.0-or-later
// The bars of accuracy: what each case must keep to, at a small size. Long ones (name Long...) have the published
// sizes.
#include <cmath>

#include <gtest/gtest.h>

#include "libsheet/base/parallel.h"
#include "libsheet/scene/read.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solve/step_stage.h"
#include "tests/validation/round_hole.h"
#include "tests/validation/table.h"

namespace sheet::validation {
namespace {

Settings settings(const std::string& name, double edge, int steps, int set = 1) {
  Settings s = find_case(name).defaults;
  s.edge = edge;
  s.steps = steps;
  s.set = set;
  return s;
}

double error(const std::string& name, const Settings& s) { return std::abs(run(find_case(name), s).error); }

double order_in_time(const std::string& name, Settings s, Scheme scheme) {
  s.scheme = scheme;
  return time_order(find_case(name), s).order;
}

TEST(Validation, SpheresTimeOrder) {
  for (const char* name : {"V1", "V2", "V3", "V4"}) {
    const Settings s = settings(name, 0.5, 40);
    EXPECT_GE(order_in_time(name, s, Scheme::sdirk2), 1.9) << name;
    Settings fine = s;
    fine.steps = 160;
    EXPECT_GE(order_in_time(name, fine, Scheme::backward_euler), 0.95) << name;
  }
}

TEST(Validation, SpheresSpaceOrder) {
  for (const char* name : {"V2", "V4"})
    EXPECT_GE(space_order(find_case(name), settings(name, 0.6, 10)).order, 1.9) << name;
}

TEST(Validation, PulledStripsTubeDiskHole) {
  for (const char* name : {"V5", "V6", "V7", "V8", "V9", "V17"}) {
    const double edge = std::string(name) == "V7" ? 0.4 : std::string(name) == "V17" ? 0.125 : 0.1;
    EXPECT_GE(order_in_time(name, settings(name, edge, 40), Scheme::sdirk2), 1.9) << name;
  }
  EXPECT_LT(error("V5", settings("V5", 0.1, 40)), 0.01);
  EXPECT_LT(error("V6", settings("V6", 0.1, 40)), 0.01);
  EXPECT_LT(error("V7", settings("V7", 0.2, 40)), 0.01);
  EXPECT_LT(error("V8", settings("V8", 0.15, 20)), 0.01);
  EXPECT_LT(error("V9", settings("V9", 0.08, 20, 1)), 0.01);
  EXPECT_LT(error("V16", settings("V16", 0.07, 1)), 0.01);
  EXPECT_LT(error("V17", settings("V17", 0.04, 64)), 0.01);
  EXPECT_LT(error("V13", settings("V13", 0.0625, 20)), 0.01);
}

// Tension crumples no film that bends, however long its edges are.
TEST(Validation, FreeDiskStaysSmooth) {
  for (const Shell shell : {Shell::arcs, Shell::mid_edge, Shell::hinge})
    for (const double edge : {0.2, 0.1, 0.05}) {
      Settings s = settings("V28", edge, 25);
      s.bending = shell;
      const Result r = run(find_case("V28"), s);
      EXPECT_GT(r.value, r.more[1].second - 0.001) << edge;
      EXPECT_LT(r.value, 1.001) << edge;
      EXPECT_LT(std::abs(r.more[0].second), 1e-4) << edge;
    }
}

// Tension of rims and slopes. What is not as near as one could wish stands in tests/validation/V38.
TEST(Validation, RimsAndSlopes) {
  const auto of = [](int set, double edge, int steps, Pattern pattern = Pattern::irregular) {
    Settings s = settings("V38", edge, steps, set);
    s.pattern = pattern;
    return run(find_case("V38"), s);
  };
  const Result strip = of(1, 0.5, 100);
  EXPECT_LT(std::abs(strip.error), 0.02);
  EXPECT_NEAR(strip.more[0].second, 1, 0.02); // energy of the thread
  for (const double edge : {0.5, 0.25, 0.12}) {
    EXPECT_NEAR(of(1, edge, 100).more[0].second, 1, 0.03) << edge;
    EXPECT_NEAR(of(2, edge, 100).more[0].second, 1, 0.05) << edge; // of a disk, the sphere's
  }
  EXPECT_LT(std::abs(of(1, 0.25, 100).error), 0.02);
  EXPECT_LT(std::abs(of(3, 1.0 / 12, 100, Pattern::equilateral).error), 0.015);
  EXPECT_LT(std::abs(of(4, 1.0 / 12, 100, Pattern::equilateral).error), 0.04);
  EXPECT_LT(std::abs(of(5, 1.0 / 12, 100, Pattern::equilateral).error), 0.03);
  Settings wave = settings("V38", 1.0 / 6, 200, 3);
  wave.pattern = Pattern::equilateral;
  EXPECT_GE(space_order(find_case("V38"), wave).order, 1.8);
  for (const int set : {6, 7}) {
    const Result rim = of(set, 1, 300);
    EXPECT_LT(std::abs(rim.error), 0.03) << set;
    EXPECT_LT(std::abs(rim.more[2].second), 1e-3) << set; // momentum
  }
  EXPECT_LT(std::abs(of(8, 1, 40).error), 0.03);
  EXPECT_LT(std::abs(of(9, 1, 200, Pattern::equilateral).error), 0.005);
  EXPECT_LT(std::abs(of(10, 1, 200, Pattern::equilateral).error), 0.03);
  EXPECT_LT(std::abs(of(11, 1, 200, Pattern::structured).error), 0.03); // equilateral 5.9 %: half a wave has 3 edges
  EXPECT_GT(of(13, 1.04, 60).value, 1.05);                              // the hole opens
}

// Holes at inclusions: Kolmogorov's test of 400 at the level of 5 %, and Poisson's numbers within two deviations.
TEST(Validation, HolesOpenByTheirLaw) {
  for (const double edge : {0.3, 0.15})
    for (const int steps : {25, 100})
      EXPECT_LT(run(find_case("V41"), settings("V41", edge, steps, 1)).value, 1.36 / std::sqrt(400)) << edge << steps;
  const Result number = run(find_case("V41"), settings("V41", 0.025, 25, 2));
  EXPECT_LT(std::abs(number.error), 2 / std::sqrt(number.more[0].second));
}

TEST(Validation, LongNumberOfHoles) {
  for (const double edge : {0.025, 0.0125, 0.00625}) {
    const Result number = run(find_case("V41"), settings("V41", edge, 50, 2));
    EXPECT_LT(std::abs(number.error), 2 / std::sqrt(number.more[0].second)) << edge;
  }
}

// A hole grows as the film in one dimension has it; a bar of 3 % is just missed with edges as long as its rim is thick.
TEST(Validation, HolesGrow) { EXPECT_LT(std::abs(run(find_case("V42"), settings("V42", 0.1, 200, 1)).error), 0.035); }

// That film: of rings half as wide it is the same, and a hole far from where it began opens at the speed of Taylor and
// Culick, a thin film's sooner.
TEST(Validation, HoleInOneDimension) {
  const auto part_of_culick = [](double thickness, double width) {
    const PiercedFilm film{.thickness = thickness,
                           .first = 2e-3,
                           .border = 2e-3,
                           .outer = 0.03,
                           .density = 1000,
                           .surface_tension = 0.07,
                           .viscosity = 0.05 * std::sqrt(0.07 * 1000 * thickness)};
    const std::vector<HoleRadius> growth = growth_of_hole(film, 0.02, width);
    return 0.01 / (time_at(growth, 0.02) - time_at(growth, 0.01)) / std::sqrt(2 * 0.07 / (1000 * thickness));
  };
  const double thick = part_of_culick(1e-3, 2e-4), thin = part_of_culick(2e-4, 2e-4);
  EXPECT_NEAR(thick, part_of_culick(1e-3, 4e-4), 0.005);
  EXPECT_NEAR(thin, part_of_culick(2e-4, 4e-4), 0.005);
  EXPECT_LT(thick, thin);
  EXPECT_NEAR(thin, 1, 0.05);
}

// With edges half as long as the rim is thick within 3 %, likewise at the speed of Taylor and Culick; so holes climb a
// slow curtain, and a fast one sweeps them away.
TEST(Validation, LongHolesGrow) {
  const Result hole = run(find_case("V42"), settings("V42", 0.025, 200, 2));
  EXPECT_LT(std::abs(hole.error), 0.03);
  ASSERT_EQ(hole.more[0].first, "of_culick");
  EXPECT_NEAR(hole.more[0].second, 1, 0.03);
  EXPECT_NEAR(run(find_case("V42"), settings("V42", 0.03, 200, 3)).value, 1 - std::sqrt(0.8), 0.03);
  EXPECT_NEAR(run(find_case("V42"), settings("V42", 0.03, 200, 4)).value, 1 - std::sqrt(1.25), 0.03);
}

// Sheets that cool, radiate and heat themselves while they flow. Their heat is in its accounts to round-off.
TEST(Validation, Heat) {
  for (const int set : {1, 2, 3, 4}) {
    EXPECT_GE(order_in_time("V39", settings("V39", 0.5, 20, set), Scheme::sdirk2), 1.9) << "set " << set;
    const Result fine = run(find_case("V39"), settings("V39", set == 3 ? 0.06 : 0.08, 40, set));
    EXPECT_LT(std::abs(fine.error), 1e-3) << "set " << set;
    EXPECT_LT(std::abs(fine.more[2].second), 1e-3) << "temperature, set " << set;
    EXPECT_LT(std::abs(fine.more[3].second), 1e-13) << "balance, set " << set;
  }
  EXPECT_GE(space_order(find_case("V39"), settings("V39", 0.3, 20, 1)).order, 1.9);
  Settings film = settings("V39", 1.0 / 16, 40, 5);
  film.pattern = Pattern::irregular;
  EXPECT_LT(error("V39", film), 2e-3);
  EXPECT_GE(order_in_time("V39", film, Scheme::sdirk2), 1.9);
  EXPECT_LT(error("V39", settings("V39", 0.05, 1, 6)), 1e-3);
  EXPECT_GE(space_order(find_case("V39"), settings("V39", 0.1, 1, 6)).order, 1.8);
}

// What remeshing adds. The tables of docs/remeshing.md go on to finer meshes.
TEST(Validation, RemeshedOnTheWay) {
  EXPECT_LT(error("V9r", settings("V9r", 0.05, 40)), 0.01);
  EXPECT_LT(error("V10", settings("V10", 0.02, 150)), 0.01);
}

TEST(Validation, CircularPlate) {
  for (const int set : {1, 2}) {
    EXPECT_LT(error("V11", settings("V11", 1.0 / 32, 1, set)), 0.01) << "set " << set;
    EXPECT_GE(space_order(find_case("V11"), settings("V11", 1.0 / 8, 1, set)).order, 1.8) << "set " << set;
  }
}

// A strip's R is half its span: the edge 1/64.
TEST(Validation, Strips) {
  for (const int set : {1, 2, 3, 4, 5}) {
    EXPECT_LT(error("V12", settings("V12", 1.0 / 64, 1, set)), 0.01) << "set " << set;
    EXPECT_GE(space_order(find_case("V12"), settings("V12", 1.0 / 16, 1, set)).order, 1.8) << "set " << set;
  }
}

// Rolled up to 1.5 rad: within 2 % below k l²/h = 0.5, whatever the mesh.
TEST(Validation, RolledPatch) {
  for (const int set : {2, 6, 10})
    for (const Pattern pattern : {Pattern::irregular, Pattern::structured}) {
      Settings s = settings("V14", 1.0 / 24, 1, set);
      s.pattern = pattern;
      EXPECT_LT(error("V14", s), 0.02) << "set " << set;
    }
}

// With 4 and 16 times the steps a result settles: what a sheet forgets from step to step would add up.
TEST(Validation, NothingGrowsAsStepsShrink) {
  struct Size {
    const char* name;
    double edge;
    int steps;
  };
  for (const Size& size : {Size{"V1", 0.5, 10},
                           {"V3", 0.5, 10},
                           {"V5", 0.1, 10},
                           {"V7", 0.4, 10},
                           {"V8", 0.3, 10},
                           {"V9", 0.2, 10},
                           {"V13", 0.125, 20},
                           {"V17", 0.125, 20}})
    for (const Shell shell : {Shell::arcs, Shell::mid_edge}) {
      double value[3];
      for (int k = 0; k < 3; ++k) {
        Settings s = settings(size.name, size.edge, size.steps << (2 * k));
        s.bending = shell;
        value[k] = run(find_case(size.name), s).error;
      }
      EXPECT_LE(std::abs(value[2] - value[1]), 0.5 * std::abs(value[1] - value[0]) + 1e-6)
          << size.name << (shell == Shell::arcs ? " with arcs: " : ": ") << value[0] << ' ' << value[1] << ' '
          << value[2];
    }
}

// Rolled up from the plane by steps, arcs keep to it however thin the sheet and however short the steps.
TEST(Validation, PatchRolledUpInSteps) {
  for (const int set : {2, 3, 4})
    for (const int steps : {10, 80}) {
      Settings s = settings("V14", 1.0 / 12, steps, set);
      s.bending = Shell::arcs;
      EXPECT_LT(error("V14", s), 0.01) << "set " << set << ", " << steps << " steps";
    }
}

TEST(Validation, WavesOnABath) {
  for (const int set : {1, 2, 3, 4, 5})
    EXPECT_LT(error("V15", settings("V15", 1.0 / 32, 1, set)), 0.03) << "set " << set;
}

TEST(Validation, RigidTurnCostsNothing) {
  for (const Shell shell : {Shell::mid_edge, Shell::arcs, Shell::hinge, Shell::none}) {
    Settings s = settings("V19", 0.15, 1, 1);
    s.bending = shell;
    EXPECT_LT(error("V19", s), 1e-14);
  }
  for (const int set : {2, 3})
    for (const Scheme scheme : {Scheme::sdirk2, Scheme::backward_euler}) {
      Settings s = settings("V19", 0.15, 1, set);
      s.scheme = scheme;
      EXPECT_LT(error("V19", s), 1e-13) << "set " << set;
    }
}

TEST(Validation, MomentumAndEnergy) {
  EXPECT_LT(error("V20", settings("V20", 0.15, 20, 1)), 1e-12);
  EXPECT_GE(order_in_time("V20", settings("V20", 0.3, 20, 2), Scheme::sdirk2), 1.9); // angular momentum
  EXPECT_GE(order_in_time("V20", settings("V20", 0.3, 20, 3), Scheme::sdirk2), 1.9); // balance of energy
  EXPECT_LT(error("V20", settings("V20", 0.15, 20, 3)), 3e-3);
}

TEST(Validation, LayersSpreadOnWalls) {
  const Result channel = run(find_case("V22"), settings("V22", 0.1, 200, 1));
  EXPECT_LT(std::abs(channel.error), 0.01);
  const Result disk = run(find_case("V22"), settings("V22", 0.1, 200, 2));
  EXPECT_LT(std::abs(disk.error), 0.015);
  ASSERT_EQ(disk.more.back().first, "scatter of the rim");
  EXPECT_LT(disk.more.back().second, 0.01);
  EXPECT_LT(error("V23", settings("V23", 0.1, 200)), 0.03);
  EXPECT_GE(space_order(find_case("V23"), settings("V23", 0.1, 200)).order, 0.9);
}

// Below and above the onset of draw resonance; finer: docs/scenes/film-casting.md.
TEST(Validation, FilmCasting) {
  for (const int set : {2, 4}) {
    const Result film = run(find_case("V26"), settings("V26", 0.04, 2000, set));
    EXPECT_LT(std::abs(film.error), 0.04) << set;
    ASSERT_EQ(film.more.front().first, "growth");
    EXPECT_LT(std::abs(film.more.front().second), 0.3) << set;
    EXPECT_LT(std::abs(film.more.back().second), 0.03) << set;
  }
}

TEST(Validation, EnclosedGas) {
  for (const int set : {1, 2, 3}) {
    const int steps = set == 2 ? 300 : 40;
    const double fine = error("V27", settings("V27", 0.08, steps, set));
    EXPECT_LT(fine, 1e-3) << set;
    EXPECT_LT(fine, error("V27", settings("V27", 0.16, steps, set)) / 3.1) << set; // 3.5 times fewer vertices
  }
  for (const int set : {2, 3}) // 1 forgets how it came there
    EXPECT_GE(order_in_time("V27", settings("V27", 0.5, set == 2 ? 200 : 160, set), Scheme::sdirk2), 1.9) << set;
}

// Theory's front is a step, and behind it the thickness is 1: the mesh keeps below twice that.
TEST(Validation, AThickLayerOverrunsAThinOne) {
  for (const double edge : {0.1, 0.05}) {
    const Result front = run(find_case("V25"), settings("V25", edge, 100));
    EXPECT_LT(std::abs(front.error), 0.07) << edge;
    ASSERT_EQ(front.more.front().first, "thickest");
    EXPECT_LT(front.more.front().second, 2) << edge;
    EXPECT_GT(front.more[1].second, 1) << edge; // degrees, the sharpest
  }
}

TEST(Validation, LayersOnWalls) {
  for (const int set : {1, 2, 7}) // down an incline, with slip; a puddle
    EXPECT_LT(error("V24", settings("V24", 0.1, 40, set)), 1e-6) << "set " << set;
  EXPECT_LT(error("V24", settings("V24", 0.1, 40, 3)), 1e-3);  // a plug stops
  EXPECT_LT(error("V24", settings("V24", 0.1, 40, 5)), 2e-3);  // on top of a cylinder
  EXPECT_LT(error("V24", settings("V24", 0.1, 160, 6)), 1e-3); // spin coating
  EXPECT_LT(error("V24", settings("V24", 0.1, 40, 8)), 1e-3);  // on a bath
  EXPECT_LT(error("V24", settings("V24", 0.1, 40, 9)), 1e-3);  // as a disk
  for (const int set : {3, 4, 5, 6, 8, 9})
    EXPECT_GE(order_in_time("V24", settings("V24", 0.1, 80, set), Scheme::sdirk2), 1.9) << "set " << set;
}

// Power laws and what yields, at the rates of flow and at rest.
TEST(Validation, LiquidsThatAreNotNewtonian) {
  for (int set = 1; set <= 16; ++set) {
    const Settings s = settings("V30", set > 8 ? 0.06 : 0.1, 64, set); // of tubes and balloons edges are most of it
    EXPECT_LT(error("V30", s), 1e-3) << "set " << set;
    EXPECT_GE(order_in_time("V30", settings("V30", set > 8 ? 0.25 : 0.1, 16, set), Scheme::sdirk2), 1.9)
        << "set " << set;
  }
  for (const int set : {1, 2, 3})
    EXPECT_LT(error("V31", settings("V31", 0.1, 40, set)), 1e-5) << "set " << set;
  for (const int set : {1, 2, 3, 4})
    EXPECT_LT(error("V32", settings("V32", 0.0625, 40, set)), 2e-3) << "set " << set;
  EXPECT_LT(error("V31", settings("V31", 0.1, 60, 4)), 0.02); // slumps to rest
  EXPECT_LT(error("V31", settings("V31", 0.1, 60, 5)), 0.02);
  EXPECT_LT(error("V31", settings("V31", 0.1, 60, 6)), 0.01); // of a thick layer
}

// The load from which on it flows, within 1 %. Where a part as short as an edge flows first, errors are of its order.
TEST(Validation, ThresholdsOfFlow) {
  const auto off = [](int set, double edge) { return error("V33", settings("V33", edge, 1, set)); };
  for (const int set : {1, 5, 7, 8, 9, 10}) // balloon, rim, incline, spans
    EXPECT_LT(off(set, 0.1), 0.01) << "set " << set;
  // A tube's: on some processors 2 of its solves do not end with such edges, 1.5 % then; 0.1 % with edges of 0.05.
  EXPECT_LT(off(2, 0.1), 0.02);
  for (const int set : {3, 4}) // hanging
    EXPECT_LT(off(set, 0.00625), 0.01) << "set " << set;
  EXPECT_LT(off(6, 0.03), 0.01);  // hole
  EXPECT_LT(off(11, 0.05), 0.01); // round plate, supported
  EXPECT_LT(off(12, 0.1), 0.05);  // clamped
  EXPECT_LT(off(12, 0.05), 0.025);
}

TEST(Validation, LongThresholdOfATube) { EXPECT_LT(error("V33", settings("V33", 0.05, 1, 2)), 0.01); }

TEST(Validation, LongThresholdOfAClampedPlate) { EXPECT_LT(error("V33", settings("V33", 0.025, 1, 12)), 0.01); }

// The draw ratio from which on power laws' films are unstable; how much one mesh says of it:
// docs/scenes/film-casting.md.
TEST(Validation, FilmCastingOfAPowerLaw) {
  const Result film = run(find_case("V34"), settings("V34", 0.04, 4000, 2));
  EXPECT_LT(std::abs(film.error), 0.02);
  ASSERT_EQ(film.more[2].first, "frequency");
  EXPECT_LT(std::abs(film.more[2].second), 0.01);
}

TEST(Validation, FilmCastingThatCools) {
  const Result film = run(find_case("V40"), settings("V40", 0.04, 4000, 1));
  EXPECT_LT(std::abs(film.error), 0.02);
  ASSERT_EQ(film.more[2].first, "frequency");
  EXPECT_LT(std::abs(film.more[2].second), 0.01);
}

TEST(Validation, LongFilmCastingThatCools) {
  for (const int set : {1, 2, 3}) {
    const Result film = run(find_case("V40"), settings("V40", 0.02, 8000, set));
    EXPECT_LT(std::abs(film.error), 0.01) << "set " << set;
    EXPECT_LT(std::abs(film.more[2].second), 0.01) << "set " << set;
  }
}

TEST(Validation, LongFilmCastingOfPowerLaws) {
  for (const int set : {1, 2, 4}) {
    const Result film = run(find_case("V34"), settings("V34", 0.01, 12000, set));
    EXPECT_LT(std::abs(film.error), 0.01) << "set " << set;
    EXPECT_LT(std::abs(film.more[2].second), 0.01) << "set " << set;
  }
}

TEST(Validation, StartSpeedsOfPowerLaws) {
  for (int set = 1; set <= 5; ++set) {
    EXPECT_LT(error("V35", settings("V35", 0.1, 1, set)), 0.01) << "set " << set;
    EXPECT_GE(space_order(find_case("V35"), settings("V35", 0.2, 1, set)).order, 1.9) << "set " << set;
  }
  for (int set = 1; set <= 6; ++set) {
    const Result r = run(find_case("V36"), settings("V36", 0.025, 1, set));
    EXPECT_LT(std::abs(r.error), 0.003) << "set " << set;
    for (const auto& [name, other] : r.more)
      EXPECT_LT(std::abs(other), 0.003) << "set " << set << ", " << name;
  }
}

// Edges below 2.3 of its thickness buckle nothing that floats.
TEST(Validation, IceOnTheSea) {
  EXPECT_GE(order_in_time("V37", settings("V37", 0.1, 10, 1), Scheme::sdirk2), 1.9); // a slab
  EXPECT_LT(error("V37", settings("V37", 0.1, 40, 1)), 1e-4);
  for (const double edge : {0.1, 0.025})
    EXPECT_LT(error("V37", settings("V37", edge, 1, 2)), 1e-4) << edge; // a disk, free all round
  EXPECT_LT(error("V37", settings("V37", 0.00625, 1, 3)), 1e-3);        // a wedge
  EXPECT_GE(space_order(find_case("V37"), settings("V37", 0.05, 1, 3)).order, 1.9);
  const Result shelf = run(find_case("V37"), settings("V37", 0.01, 1200, 4)); // with inflow: after 300 years
  EXPECT_LT(std::abs(shelf.error), 0.01);
  ASSERT_EQ(shelf.more.size(), 3u);
  for (const auto& [when, off] : shelf.more) // and after 50, 100, 200
    EXPECT_LT(std::abs(off), 0.01) << when;
}

// What is too thick for its gap by the pressure there is of the model, and no error of steps.
TEST(Validation, LayersBetweenWalls) {
  EXPECT_LT(error("V29", settings("V29", 0.1, 40, 1)), 1e-9);  // that slide past each other
  EXPECT_LT(error("V29", settings("V29", 0.1, 40, 2)), 5e-3);  // that close
  EXPECT_LT(error("V29", settings("V29", 0.05, 40, 3)), 3e-2); // a slider bearing
  EXPECT_GE(order_in_time("V29", settings("V29", 0.2, 10, 2), Scheme::sdirk2), 1.9);
}

TEST(Validation, FallingCurtain) {
  const Result r = run(find_case("V18"), settings("V18", 0.01, 350));
  EXPECT_LT(std::abs(r.error), 0.01);
  ASSERT_EQ(r.more.back().first, "volume");
  EXPECT_LT(std::abs(r.more.back().second), 1e-13);
}

// What inlets that fan out let in keeps to the closed form of bells. With edges of 3 mm errors are 1.1 to 2.0 %, with
// the 1.2 mm of the long version 0.3 to 0.8 % down to 30 mm, 0.65 % of the greatest radius; at 40 mm 1.5 %, which
// misses 1 %.
TEST(Validation, WaterBell) {
  const Result r = run(find_case("V44"), settings("V44", 0.6, 333, 2));
  EXPECT_LT(std::abs(r.error), 0.025);
  for (const auto& [name, error] : r.more)
    EXPECT_LT(std::abs(error), 0.025) << name;
}

TEST(Validation, LongWaterBells) {
  for (int set = 1; set <= 2; ++set) {
    const Result r = run(find_case("V44"), settings("V44", 0.24, 833, set));
    EXPECT_LT(std::abs(r.error), 0.01) << set;
    for (const auto& [name, error] : r.more)
      EXPECT_LT(std::abs(error), name == "at_40_mm" ? 0.02 : 0.01) << set << ", " << name;
  }
}

TEST(Validation, AirHoldsBack) {
  for (int set = 1; set <= find_case("V43").sets; ++set) {
    EXPECT_LT(error("V43", settings("V43", 0.5, 40, set)), 1e-3) << set;
    EXPECT_GE(order_in_time("V43", settings("V43", 0.5, 40, set), Scheme::sdirk2), 1.9) << set;
  }
}

// A step makes the strip narrower by 0.3 % at most.
TEST(Validation, StrandsPart) {
  for (const double edge : {1.0, 0.5}) { // over the width at the start
    const Result r = run(find_case("V45"), settings("V45", edge, 400, 1));
    EXPECT_LT(std::abs(r.error), 0.004) << edge;
    EXPECT_LT(std::abs(r.more[0].second), 1e-13) << edge;
  }
  EXPECT_LT(std::abs(run(find_case("V45"), settings("V45", 1, 400, 2)).error), 0.004);
}

// A waist goes to nothing as Papageorgiou has it, and parts where it is to, with the same bits on any threads.
void expect_thinning(double edge, int steps, double bar) {
  const Settings s = settings("V47", edge, steps);
  const Result r = run(find_case("V47"), s);
  EXPECT_LT(std::abs(r.error), bar) << edge;
  ASSERT_EQ(r.more.size(), 5u);
  EXPECT_NEAR(r.more[0].second, 1, bar) << edge;  // Papageorgiou's rate
  EXPECT_NEAR(r.more[1].second, 1, 0.03) << edge; // parts there; a step thins it by 2 % at most
  EXPECT_LT(std::abs(r.more[2].second), 1e-13) << edge;
  EXPECT_LT(r.more[3].second, 1e-13) << edge;
  EXPECT_GT(r.more[4].second, 10) << edge; // degrees
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    const Result again = run(find_case("V47"), s);
    EXPECT_EQ(again.value, r.value);
    EXPECT_EQ(again.more, r.more);
  }
}

TEST(Validation, ThreadsThinAndPart) { expect_thinning(1, 250, 0.03); }

// Edges shorter than it is wide, between which one row is made of two, leave it uneven: 1 to 10 % off.
TEST(Validation, LongThreadsThinAndPart) {
  expect_thinning(1, 1000, 0.03);
  for (const double edge : {0.9, 0.8, 0.7, 0.6})
    expect_thinning(edge, 500, 0.1);
}

TEST(Validation, RainIsTakenUp) {
  const Result r = run(find_case("V46"), settings("V46", 0.1, 60, 1));
  EXPECT_LT(std::abs(r.error), 1e-12);
  EXPECT_LT(std::abs(r.more[0].second), 1e-13);
  EXPECT_EQ(r.more[1].second, 0);
}

TEST(Validation, LongFallingCurtainRemeshed) {
  const Result r = run(find_case("V18"), settings("V18", 0.005, 700, 2));
  EXPECT_LT(std::abs(r.error), 0.01);
  ASSERT_EQ(r.more.front().first, "thickness");
  EXPECT_LT(std::abs(r.more.front().second), 0.01); // of any triangle
  EXPECT_LT(std::abs(r.more.back().second), 1e-13);
}

// Figures 6 and 7: 2,562 vertices, 100 steps, radius within 0.3 %.
TEST(Validation, LongFiguresOfThePaper) {
  for (const char* name : {"V1", "V2", "V3"})
    for (int set = 1; set <= find_case(name).sets; ++set)
      EXPECT_LT(error(name, settings(name, 0.075, 100, set)), 0.003) << name << " set " << set;
}

TEST(Validation, LongSpaceOrders) {
  for (const char* name : {"V1", "V2", "V3"})
    EXPECT_GE(space_order(find_case(name), settings(name, 0.3, 20)).order, 1.9) << name;
  EXPECT_GE(space_order(find_case("V9"), settings("V9", 0.1, 10)).order, 1.8);
  // With 10 steps the error in time still shows through its extrapolation: 1.72.
  EXPECT_GE(space_order(find_case("V7"), settings("V7", 0.4, 40)).order, 1.8);
  EXPECT_GE(space_order(find_case("V17"), settings("V17", 0.125, 32)).order, 1.8);
}

// V21: a small sheet that sags, 10,000 steps of the stage from frame to frame.
TEST(Validation, LongVolumeOfTenThousandSteps) {
  const Scene scene = parse_scene(R"(
    sheet = {shape = "rectangle", size = [1, 1], segments = [6, 3], pattern = "structured", thickness = 0.06}
    material = {viscosity = 0.0333, density = 0.1, surface_tension = 0.002}
    environment = {gravity = [0, -9.81, 0]}
    hold = [{region = "x_min", kind = "clamped"}, {region = "x_max", kind = "clamped"}]
  )",
                                  "the scene of this test");
  formats::Frame frame = build_frame(scene);
  const auto total = [&] {
    double sum = 0;
    for (const double v : volumes(frame))
      sum += v;
    return sum;
  };
  const double before = total();
  StepStageOptions options;
  options.dt = 4e-5;
  StepStage stage(options);
  for (int k = 0; k < 10000; ++k)
    stage.step(frame);
  EXPECT_EQ(frame.step, 10000u);
  EXPECT_NEAR(frame.time, 0.4, 1e-9);
  EXPECT_NEAR(total(), before, 1e-13 * before);
}

} // namespace
} // namespace sheet::validation
