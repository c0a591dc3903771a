// SPDX-License-Identifier: GPL-3.0-or-later
// Validation cases: closed forms against the mesh code. A case runs once for given settings and says by how much it
// misses its closed form, and what that cost.
#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "libsheet/shape/shapes.h"
#include "libsheet/solve/step.h"

namespace sheet::validation {

// How the sheet bends. Cases without bending ignore it.
enum class Shell { mid_edge, arcs, hinge, hinge_paper, none };

struct Settings {
  int set = 1;     // of the case's parameter sets
  double edge = 0; // target edge length over the case's length (a radius, a span); 0: the case's own
  int steps = 0;   // of the whole run; 0: the case's own
  Scheme scheme = Scheme::sdirk2;
  Thickness thickness = Thickness::coupled;
  Shell bending = Shell::mid_edge;
  Pattern pattern = Pattern::irregular;
  std::uint64_t seed = 1;
};

struct Result {
  double value = 0;   // measured over exact; what it is, Case::quantity says
  double error = 0;   // value - 1 unless Case::quantity says otherwise
  double seconds = 0; // wall time of stepping, analysis included, meshing and measuring not
  std::size_t vertices = 0;
  double edge = 0;                                  // mean edge length over the case's length
  int steps = 0, iterations = 0;                    // of Newton, all steps together
  int failed = 0;                                   // attempts that did not converge and were done in halves
  std::vector<std::pair<std::string, double>> more; // further figures of the case
  std::vector<std::vector<double>> series;          // of the run, columns as in Case::series
};

struct Case {
  std::string name, title, quantity, series;
  int sets;
  Settings defaults;
  bool in_time, in_space; // whether it has an order to observe
  Result (*run)(const Settings&);
};

[[nodiscard]] const std::vector<Case>& cases();
[[nodiscard]] const Case& find_case(const std::string& name); // fails with usage

// Fills what the settings leave open and runs.
[[nodiscard]] Result run(const Case& c, Settings settings);

} // namespace sheet::validation
