// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene will model, what not and why (plan/modelled.h says it), and the dimensionless numbers that say what
// matters (sheet-init --check).
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libsheet/scene/scene.h"

namespace sheet::scene {

struct ModelledPart {
  std::string_view name;
  bool modelled;
  std::string why; // why it is there or is not
};

// A length, time or speed by which the scene is judged.
struct Scale {
  std::string_view symbol, name;
  double value; // SI
  std::string_view unit;
  std::string source; // formula, or where in the scene it comes from
};

struct DimensionlessNumber {
  std::string_view name, formula;
  double value;
  std::string meaning; // a sentence about this value
};

struct Explanation {
  std::vector<ModelledPart> parts;
  std::string judged; // the sheet, the first one, whose scales and numbers these are; "": there is no other
  std::vector<Scale> scales;
  std::vector<DimensionlessNumber> numbers;
  std::vector<std::string> warnings; // a modelling choice that looks wrong
  std::vector<std::string> left_out; // what the model never has, where this scene might make one expect it
};

// What the first frame says about a sheet and the scene cannot know.
struct Measured {
  std::optional<double> length, thickness, curvature; // [m], [m], [1/m]
  // Of each solid, or of none: the part of gravity along it where the sheet is steepest on it [m/s²].
  std::vector<std::optional<double>> along = {};
  bool lies = false;     // all of it, on solids along which it flows
  double above_bath = 0; // its lowest vertex; 0 where some of it is in the bath, or there is none [m]
};

// measured: of each sheet, or of none. Warnings are of all sheets.
[[nodiscard]] Explanation explain(const Scene& scene, std::span<const Measured> measured = {},
                                  std::vector<ModelledPart> parts = {});

// Plain text for a terminal.
[[nodiscard]] std::string to_text(const Explanation& explanation);

} // namespace sheet::scene
