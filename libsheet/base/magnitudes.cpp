// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/base/magnitudes.h"

#include <cmath>

#include "libsheet/base/error.h"

namespace sheet {

void check_magnitudes(const formats::Frame& frame) {
  constexpr double largest = 1e30;
  for (const char* name : {"position", "start_position", "velocity", "volume"}) {
    const formats::Array* array = frame.find(name);
    if (array == nullptr)
      continue;
    const auto values = array->values<double>();
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!(std::abs(values[i]) < largest))
        fail(ExitCode::bad_input,
             "array \"{}\", row {}: {:g} {} is too large to compute with; the sheet has blown up, or its unit is wrong",
             name, i / array->components, values[i], array->unit);
  }
}

} // namespace sheet
