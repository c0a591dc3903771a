// SPDX-License-Identifier: GPL-3.0-or-later
// The colours and names by which the sheets of a scene are told apart.
#pragma once
#include <string>
#include <vector>

#include "libsheet/quantities/palette.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// By their numbers, as the array "sheet" counts; "sheet 1", ... are those without a name of their own.
[[nodiscard]] std::vector<std::string> sheet_names(const Scene& scene);

class SheetKinds {
public:
  // Colours come again from the first where there are more sheets than colours.
  explicit SheetKinds(std::vector<std::string> names);
  SheetKinds(const SheetKinds&) = delete;
  SheetKinds& operator=(const SheetKinds&) = delete;
  [[nodiscard]] const Palette& palette() const { return palette_; }

private:
  std::vector<std::string> names_;
  std::vector<PaletteKind> kinds_;
  Palette palette_;
};

} // namespace sheet
