// SPDX-License-Identifier: GPL-3.0-or-later
// The names of files that hold a frame each.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace sheet {

// File names that number the frames: "out/frame_%04d.vtu".
class NumberedName {
public:
  // At most one of %d, %4d, %04d; %% is a percent sign. Throws Error (usage).
  explicit NumberedName(const std::string& pattern);
  [[nodiscard]] bool has_number() const { return number_.has_value(); }
  [[nodiscard]] std::string of(std::uint64_t index) const;
  // The name of a collection of all of them: the pattern without its number, "out/frame.pvd".
  [[nodiscard]] std::string collection(const std::string& ending) const;

private:
  struct Number {
    std::size_t width = 0;
    char fill = ' ';
  };
  std::string before_, after_;
  std::optional<Number> number_;
};

} // namespace sheet
