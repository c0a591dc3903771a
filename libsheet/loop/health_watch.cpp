// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/loop/health_watch.h"

#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "libsheet/base/error.h"
#include "libsheet/health/look.h"
#include "libsheet/health/report.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

using formats::Frame;

namespace {

void check_volume(const Frame& before, Frame& after) {
  const double change = health::unexplained_volume(before, after);
  const auto v = volumes(after);
  const double whole = std::accumulate(v.begin(), v.end(), 0.0), part = std::abs(change) / whole;
  if (std::isfinite(part) && part > health::kind_of(health::Trouble::volume).noted.worst)
    health::note(after, {.trouble = health::Trouble::volume, .value = part, .amount = change});
}

} // namespace

void HealthWatch::follow(const Frame& before, Frame& after, bool kept) {
  check_volume(before, after);
  if (kept || after.step % every == 0)
    look_at(after);
}

std::string HealthWatch::become_serious(const Frame& frame) {
  std::string text;
  for (const health::Row& row : health::rows(frame))
    if (health::verdict(row, frame.step) == health::Verdict::serious && told_.insert(row.kind).second)
      text += fmt::format("{}serious: {}\n  remedy: {}", text.empty() ? "" : "\n", health::sentence(row),
                          health::remedy(row));
  return text;
}

std::string HealthWatch::at_the_end(const Frame& frame) {
  Frame last = frame;
  look_at(last);
  return health::report(last);
}

void HealthWatch::look_at(Frame& frame) {
  const Scene* scene = nullptr;
  try {
    scene = scenes_.find(frame);
  } catch (const Error&) { // a scene that cannot be read is refused by the stage that needs it
  }
  for (const health::Observation& seen : health::look(frame, scene))
    health::note(frame, seen);
}

} // namespace sheet
