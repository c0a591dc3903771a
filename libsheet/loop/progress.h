// SPDX-License-Identifier: GPL-3.0-or-later
// One line on the terminal that tells how far the ring is and how long it will take.
#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace sheet {

// "45 s", "3:20 min", "2:05 h": a duration for people. `seconds` >= 0.
[[nodiscard]] std::string duration_text(double seconds);

class Progress {
public:
  // The run goes from this time and step to `until` and/or `steps`.
  Progress(double time, std::uint64_t step, std::optional<double> until, std::optional<std::int64_t> steps);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  // Writes the line anew, at most once a second, if stderr is a terminal and -q was not given.
  void show(double time, std::uint64_t step, std::uint64_t frames_kept);
  // The line without the terminal: "step 12, t = 0.5 of 2 s, 3 frames, 0.12 s a step, 18 s left".
  [[nodiscard]] std::string line(double time, std::uint64_t step, std::uint64_t frames_kept, double elapsed) const;
  void clear();

private:
  using Clock = std::chrono::steady_clock;
  double first_time_;
  std::uint64_t first_step_;
  std::optional<double> until_;
  std::optional<std::int64_t> steps_;
  Clock::time_point start_, shown_{};
  bool terminal_, visible_ = false;
};

} // namespace sheet
