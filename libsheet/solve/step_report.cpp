// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/step_report.h"

#include <algorithm>

namespace sheet {

StepReport& StepReport::operator+=(const StepReport& later) {
  substeps += later.substeps;
  failed += later.failed;
  rejected += later.rejected;
  euler_fallbacks += later.euler_fallbacks;
  flat_fallbacks += later.flat_fallbacks;
  unfinished += later.unfinished;
  inaccurate += later.inaccurate;
  newton += later.newton;
  if (later.error > error) {
    error = later.error;
    worst = later.worst;
  }
  reactions = later.reactions;
  seconds_analysis += later.seconds_analysis;
  for (const TermTime& term : later.terms)
    if (const auto it = std::ranges::find(terms, term.name, &TermTime::name); it != terms.end())
      it->seconds += term.seconds;
    else
      terms.push_back(term);
  return *this;
}

} // namespace sheet
