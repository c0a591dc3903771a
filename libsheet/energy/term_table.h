// SPDX-License-Identifier: GPL-3.0-or-later
// Every term that a model can have, once: its name, when a model has it, and why. Models are made of it, and scenes
// are explained by it.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "libsheet/energy/model.h"
#include "libsheet/energy/term.h"

namespace sheet {

class TermMaker;

struct TermEntry {
  std::string_view name;
  bool (*asked)(const Model&);
  std::string (*because)(const Model&);     // it is there
  std::string (*because_not)(const Model&); // it is not
  void (*make)(const Model&, TermMaker&);
};

// In the order in which their energies are summed.
[[nodiscard]] std::span<const TermEntry> term_table();

// Those that the model asks for; they refer to its contacts. Where edges are arcs, one term has all that works on
// stretching, bending and area. Throws Error (bad_input) where there are none.
[[nodiscard]] Terms make_terms(const Model& model, const std::shared_ptr<const Connectivity>& mesh);

} // namespace sheet
