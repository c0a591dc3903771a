// SPDX-License-Identifier: GPL-3.0-or-later
// The ring: sends a frame through a pipeline of stages, again and again, and keeps the frames that the user wants.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sheet {

struct LoopOptions {
  std::string pipeline;               // shell command: the stages, joined by pipes; "" with resume: the stream's own
  std::string input = "-";            // stream whose last frame is the start
  std::string output = "-";           // stream of the frames kept
  std::string resume;                 // stream to go on with, instead of input and output
  std::vector<std::string> sets;      // changes of the scene from the first frame on, KEY=VALUE (scene/change.h)
  std::optional<double> until;        // [s] end when the frame's time is there
  std::optional<double> fps;          // output times are the multiples of 1/fps [1/s]
  std::optional<std::int64_t> steps;  // end when the frame's step is there
  std::vector<std::string> stop_when; // end as soon as one of these holds (stop_condition.h)
  std::string keep;             // "output" | "last" | a number n, for every n-th step; "" is output with fps, else 1
  std::string checkpoint;       // file that always holds the newest frame as a stream of its own
  double checkpoint_every = 60; // [s] of the clock on the wall
  std::string progress;         // file that tells other programs how far the run is; "": none
  bool provenance = true;       // record the ring in the frames
};

// Checks the options against each other. Throws Error (usage), naming the option.
void check(const LoopOptions& options);

// Runs the ring. Throws Error when a stage fails (with the stage's exit code if it is one of ours, else internal), when
// the time stands still though `until` asks for it (usage), on damaged input; StreamError (io) when the output cannot
// be written; what changed_scene throws. In each case the output holds whole frames only, and the message says where it
// ended and how to go on.
// Returns 0, or the number of the signal (SIGINT, SIGTERM) that ended the run in good order.
[[nodiscard]] int run_loop(const LoopOptions& options);

// The k-th output time k/fps that comes after `time` [s]; a time that is one itself does not count.
// Throws Error (usage) where such times are too near to each other for numbers.
[[nodiscard]] double next_output_time(double time, double fps);

} // namespace sheet
