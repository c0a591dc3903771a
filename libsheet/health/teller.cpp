// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/health/teller.h"

#include "libsheet/base/filter.h"
#include "libsheet/base/log.h"

namespace sheet::health {

void Teller::tell(formats::Frame& frame, const Observation& observation, std::string_view message) {
  note(frame, observation);
  if (times_[observation.trouble]++ == 0)
    log::warning("{} (told once, then counted)", message);
}

void Teller::tell(formats::Frame& frame, Trouble trouble, std::size_t number, const Vector3& place,
                  std::string_view message) {
  const auto amount = static_cast<double>(number);
  tell(frame, {.trouble = trouble, .value = amount, .amount = amount, .place = place}, message);
}

void Teller::report() const {
  if (in_ring())
    return;
  for (const auto& [trouble, times] : times_)
    if (times > 1)
      log::warning("{}: {} times in all", kind_of(trouble).name, times);
}

} // namespace sheet::health
