// SPDX-License-Identifier: GPL-3.0-or-later
// How far the ring is and how long it will take: as a line on the terminal, and in a file for other programs.
#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sheet {

// "45 s", "3:20 min", "2:05 h": a duration for people. `seconds` >= 0.
[[nodiscard]] std::string duration_text(double seconds);

class Progress {
public:
  // The run goes from this time and step to `until` and/or `steps`. `file`: for other programs, "" for none.
  Progress(double time, std::uint64_t step, std::optional<double> until, std::optional<std::int64_t> steps,
           std::string file = "");
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  // Writes the line anew, at most once a second, if stderr is a terminal and -q was not given, and the file, at most
  // five times a second.
  void show(double time, std::uint64_t step, std::uint64_t frames_kept);
  // Writes the file with the run's last state: "done" or "interrupted"; a run that fails leaves "running".
  void end(double time, std::uint64_t step, std::uint64_t frames_kept, std::string_view state);
  // The line without the terminal: "step 12, t = 0.5 of 2 s, 3 frames, 0.12 s a step, 18 s left".
  [[nodiscard]] std::string line(double time, std::uint64_t step, std::uint64_t frames_kept, double elapsed) const;
  // The file's text, an object of JSON in one line: state ("running", "done", "interrupted"), time [s], until [s],
  // step, steps, frames, elapsed [s], left [s]; null where something is not known.
  [[nodiscard]] std::string json(double time, std::uint64_t step, std::uint64_t frames_kept, double elapsed,
                                 std::string_view state) const;
  void clear();

private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] double share(double time, std::uint64_t step) const; // of the run that lies behind us
  [[nodiscard]] double elapsed() const;                              // [s]
  void write(double time, std::uint64_t step, std::uint64_t frames_kept, std::string_view state);
  double first_time_;
  std::uint64_t first_step_;
  std::optional<double> until_;
  std::optional<std::int64_t> steps_;
  std::string file_;
  Clock::time_point start_, shown_{}, written_{};
  bool terminal_, visible_ = false;
};

} // namespace sheet
