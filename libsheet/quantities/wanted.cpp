// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/quantities/wanted.h"

#include <string>

#include <fmt/format.h>

#include "libsheet/base/error.h"
#include "libsheet/base/units.h"
#include "libsheet/quantities/fields.h"

namespace sheet {

void declare_wanted(Tool& tool, std::optional<double>& wanted) {
  tool.custom(
      "--wanted", "LENGTH",
      "the thickness that is wanted, such as 2mm: there is a quantity more, the deviation from it",
      [&wanted](const std::string& text) {
        wanted = parse_quantity(text, quantity::length);
        if (!(*wanted > 0))
          fail(ExitCode::usage, "{} is not positive", text);
      },
      [&wanted] { return wanted ? fmt::format("{}", *wanted) : std::string(); });
}

void want_thickness(formats::Frame& frame, double wanted) {
  const Field& deviation = field_named("deviation");
  std::vector<double> values = values_of(frame, field_named("thickness"));
  formats::Array array = formats::make_array(deviation.name, deviation.where, formats::Type::float64, 1, deviation.unit,
                                             formats::Transfer::drop, values.size());
  for (std::size_t t = 0; t < values.size(); ++t)
    array.values<double>()[t] = values[t] - wanted;
  frame.put(std::move(array));
}

} // namespace sheet
