// SPDX-License-Identifier: GPL-3.0-or-later
// Picks frames of a stream while it flows: only frames whose fate the rest of the stream decides are kept in memory.
#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"

namespace sheet {

// Frames from `first` to `last`, both included; negative ones count from the end, -1 being the last frame.
struct IndexRange {
  std::int64_t first = 0, last = 0;
  // In a stream of so many frames.
  [[nodiscard]] bool has(std::int64_t index, std::int64_t total) const;
  // Whether one must know how many frames there are to say what it has.
  [[nodiscard]] bool needs_total() const { return first < 0 || last < -1; }
};

// Frames between the times [s], ends included; or the one nearest to a time (the first of them), if that is `nearest`.
struct TimeRange {
  double first = 0, last = 0;
  bool nearest = false;
};

// "0,5,10-20,30-,-3--1": throws Error (usage). Blanks around the commas count for nothing.
[[nodiscard]] std::vector<IndexRange> parse_indices(const std::string& text);
// What parse_indices reads, in words, for the options that take it.
inline constexpr const char* indices_help =
    "counted from 0: 0,5,10-20. Negative ones count from the end, -1 being the last: -3--1; 10- goes to the end";
// "0.5,1:2,3:": throws Error (usage).
[[nodiscard]] std::vector<TimeRange> parse_times(const std::string& text);

struct SelectOptions {
  std::vector<IndexRange> indices;   // frames that any of these names; if there are none at all,
  std::vector<TimeRange> times;      // and none of these either, all frames
  std::int64_t every = 1;            // of those, the first and each N-th after it
  std::optional<std::int64_t> first; // of those, the first N
};

class Selector {
public:
  using Write = std::function<void(const formats::Frame&)>;
  // Calls `write` with each frame that is picked, in the order of the stream.
  Selector(SelectOptions options, Write write);

  // Takes the next frame. False if no frame to come can be picked: there is no need to read on.
  [[nodiscard]] bool add(formats::Frame&& frame);
  // The stream was cut short or is damaged from here on: picks what is asked for of the frames that have come.
  void cut_short() { settle(true); }
  // The stream is at its end. Throws Error (bad_input), with the range there is, if no frame has been picked.
  void end();

private:
  enum class Fate { out, in, open };
  struct Pending {
    std::int64_t index;
    formats::Frame frame;
    Fate fate;
  };
  // What is known about a frame when `seen` frames have come.
  [[nodiscard]] Fate fate_of(std::int64_t index, double time, std::int64_t seen, bool ended) const;
  [[nodiscard]] bool wants_more() const;
  void settle(bool ended);
  void pick(const formats::Frame& frame);

  SelectOptions options_;
  Write write_;
  std::deque<Pending> pending_;       // from the first frame whose fate is open
  std::vector<std::int64_t> nearest_; // the best frame so far for each of options_.times
  std::vector<double> distance_;      // and how far from the time it is [s]
  std::int64_t seen_ = 0, matched_ = 0, written_ = 0;
  double earliest_ = 0, latest_ = 0; // times seen [s]
};

} // namespace sheet
