// SPDX-License-Identifier: GPL-3.0-or-later
// Everything that is wrong with a scene, collected, so that a user can mend it at one go.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libsheet/scene/document.h"

namespace sheet::scene {

class Problems {
public:
  Problems(std::string name, std::span<const std::string> sets) : name_(std::move(name)), sets_(sets) {}

  void add(const Place& place, std::string text) { found_.push_back({place, std::move(text)}); }
  [[nodiscard]] bool any() const { return !found_.empty(); }

  // One Error (bad_input) with a line for each problem in the order of the file, those of --set last:
  //   scene.toml:12:5: unknown key "viscocity" in [material]; did you mean "viscosity"?
  void throw_if_any();

private:
  struct Problem {
    Place place;
    std::string text;
  };
  std::string name_;
  std::span<const std::string> sets_;
  std::vector<Problem> found_;
};

// "; did you mean "viscosity"?", or "; known: a, b, c" if nothing is near.
[[nodiscard]] std::string suggestion(std::string_view word, std::span<const std::string_view> known);

} // namespace sheet::scene
