// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/arc_rest.h"

#include <algorithm>

#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

constexpr double longest_rest = 32;
constexpr const char *left_name = "step.flat_left", *run_name = "step.flat_run";

void put_or_erase(formats::Frame& frame, const char* name, double value) {
  if (value > 0)
    put_number(frame, name, "1", value);
  else
    frame.erase(name);
}

} // namespace

ArcRest::ArcRest(const formats::Frame& frame) : left_(number(frame, left_name, 0)), run_(number(frame, run_name, 0)) {}

void ArcRest::note(bool failed) {
  if (left_ > 0)
    left_ -= 1;
  else
    left_ = run_ = failed ? std::clamp(2 * run_, 1.0, longest_rest) : 0;
}

void ArcRest::put(formats::Frame& frame) const {
  put_or_erase(frame, left_name, left_);
  put_or_erase(frame, run_name, run_);
}

} // namespace sheet
