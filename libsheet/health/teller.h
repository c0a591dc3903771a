// SPDX-License-Identifier: GPL-3.0-or-later
// How a stage tells of trouble: in the frame, and in words the first time.
#pragma once
#include <map>
#include <string_view>

#include "libsheet/health/record.h"

namespace sheet::health {

class Teller {
public:
  // Adds it to the frame's record; warns if it is the first of its kind here.
  void tell(formats::Frame& frame, const Observation& observation, std::string_view message);
  // The same of a number of vertices or triangles, or other things.
  void tell(formats::Frame& frame, Trouble trouble, std::size_t number, const Vector3& place, std::string_view message);
  // At the end: how often it was, where no sheet-loop tells it from the frame.
  void report() const;

private:
  std::map<Trouble, std::uint64_t> times_;
};

} // namespace sheet::health
