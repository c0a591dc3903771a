// SPDX-License-Identifier: GPL-3.0-or-later
// The files that a program makes of a stream, one a frame.
#pragma once
#include <cstdint>
#include <string>

#include "libsheet/base/numbered_name.h"

namespace sheet {

// A name without a number is for one frame. Its file is written by finish(), when it is known that no second one comes:
// that mistake leaves an earlier file as it is.
class FrameFiles {
public:
  // `name` as -o has it; `picker` is what picks one frame, for the message. Throws Error (usage).
  FrameFiles(std::string name, std::string picker);
  [[nodiscard]] const NumberedName& names() const { return names_; }
  // The next frame's file, whose folder is made. Throws Error: usage (it would be the second of one name), io.
  [[nodiscard]] std::string next(std::uint64_t index);
  // The file that next() has named, whole or not at all. Throws Error (io).
  void write(const std::string& bytes);
  // To be called when the stream has ended, well or not.
  void finish();

private:
  NumberedName names_;
  std::string name_, picker_, path_, held_;
  bool any_ = false, holds_ = false;
};

} // namespace sheet
