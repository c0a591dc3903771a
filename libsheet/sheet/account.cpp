// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/sheet/account.h"

#include <algorithm>

#include "libsheet/base/error.h"

namespace sheet {

using formats::Array;

void add_to_account(formats::Frame& frame, std::string_view name, std::string_view unit,
                    std::span<const double> amounts) {
  const std::size_t n = amounts.size();
  Array* account = frame.find(name);
  if (account == nullptr)
    account = &frame.put(formats::make_array(name, formats::Place::frame, formats::Type::float64,
                                             static_cast<std::uint32_t>(n), unit, formats::Transfer::copy, 2));
  if (account->place != formats::Place::frame || account->type != formats::Type::float64 || account->components != n ||
      account->rows != 2)
    fail(ExitCode::bad_input, "array \"{}\" is no account: it must be frame[2] float64 {}, sums and remainders", name,
         n);
  const auto values = account->values<double>();
  for (std::size_t i = 0; i < n; ++i) {
    const double old = values[i], amount = amounts[i] + values[n + i];
    const double sum = old + amount;
    const double part = sum - old; // of the amount that has arrived
    values[i] = sum;
    values[n + i] = (old - (sum - part)) + (amount - part);
  }
}

} // namespace sheet
