// SPDX-License-Identifier: GPL-3.0-or-later
// The figures of a frame: one table, from which text, JSON, CSV, the page of a run that goes on and the Python package
// take what they tell. Counts (vertices, topology) and forces, whose number differs from scene to scene, stand apart.
#pragma once
#include <string>
#include <vector>

#include "libsheet/measure/measure.h"
#include "libsheet/quantities/fields.h"
#include "libsheet/scene/scene.h"

namespace sheet {

struct Figure {
  enum class Form {
    scalar,
    vector,      // x, y, z
    range,       // least, mean and greatest value
    percentiles, // those of measure.h
    ends,        // least and greatest value
    box          // least x, y, z, then the greatest
  };
  std::string name;    // in JSON, and of columns of CSV
  std::string caption; // in text and beside curves
  std::string unit;    // SI but for angles, which are in degrees
  Form form;
  std::vector<double> (*get)(const Measurements&, const Figure&);
  std::string panel = {}; // on the page of a run, of the curves that are drawn together; "": it is not drawn
  bool printed = true;    // in text, JSON and CSV
  bool needs_density = false;
  std::size_t field = 0;        // number of its field among those that are measured
  Needs needs = Needs::nothing; // what frames have of which it is printed

  // Of its values, in their order.
  [[nodiscard]] std::vector<std::string> columns() const;
  // NaN where a value does not exist.
  [[nodiscard]] std::vector<double> values(const Measurements& measured) const { return get(measured, *this); }
};

// In the order of text and JSON.
[[nodiscard]] const std::vector<Figure>& figures();

// All that is measured, a line each, for programs: name (of a field) or column (of a figure), where it is (triangle,
// vertex or frame), SI unit, caption, the units in which it is easy to read, "m 1, mm 0.001, ...", and the stops of its
// palette, "0 0.12 0.05 0.28, ..." (place, red, green, blue as displayed); separated by tabs.
[[nodiscard]] std::string list_of_quantities();

} // namespace sheet
