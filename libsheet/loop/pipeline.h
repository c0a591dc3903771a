// SPDX-License-Identifier: GPL-3.0-or-later
// A shell pipeline as a child process, with both its ends, the exit status of each of its stages and their times.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace sheet {

// How one stage ended.
struct StageStatus {
  std::string command; // as written in the pipeline
  int code = 0;        // exit code; 128 + signal if a signal ended it
  bool early = false;  // it ended of itself, before its input was closed
};

// What a stage that knows how (run_filter) says of its own time.
struct StageTime {
  std::size_t stage = 0; // its place in the pipeline
  std::string name;
  std::uint64_t frames = 0;
  double seconds = 0; // wall-clock, from a frame's arrival to its departure, all frames
};

struct PipelineEnd {
  std::vector<StageStatus> stages;
  std::vector<StageTime> times; // in the order of the pipeline
};

// Splits a command at its top-level pipes: "a 'x|y' | b" gives "a 'x|y'" and "b". Throws Error (usage) if it is more
// than one pipeline (;, &&, ||, &, newline outside quotes and brackets) or a stage is empty: what else a user wants to
// run belongs into a script.
[[nodiscard]] std::vector<std::string> split_pipeline(const std::string& command);

// Every stage is a process (bash -c STAGE) of its own, so that the death of one is seen at once: no shell keeps its
// pipes open.
class Pipeline {
public:
  // Starts `command` under bash in a process group of its own, with this program's folder last in PATH. Throws Error
  // (io).
  explicit Pipeline(const std::string& command);
  // Ends whatever still runs.
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  [[nodiscard]] int input() const noexcept { return input_; }   // write frames here
  [[nodiscard]] int output() const noexcept { return output_; } // read frames here
  void close_input();

  // A round begins: notes what each stage has written until now.
  void begin_round();
  // The first stage that has written nothing in this round and does nothing either, as it stands in the pipeline; "" if
  // there is none, or the system does not say.
  [[nodiscard]] std::string silent_stage() const;

  // The output has ended: notes which stages ended early, waiting a moment for the last one to be gone.
  void note_early_ends();

  // Closes both ends and waits until all stages have ended; those that have not after `patience` seconds are killed.
  [[nodiscard]] PipelineEnd finish(double patience);
  // Kills all stages now.
  void kill();

private:
  void start_stage(std::size_t index, int from, int to, int report);
  void reap(int options);

  struct Stage {
    std::string command;
    pid_t process = -1;
    bool ended = false, early = false;
    int code = 0;
    std::optional<std::uint64_t> written; // bytes, when the round began
  };
  std::vector<Stage> stages_;
  int input_ = -1, output_ = -1, report_ = -1;
  pid_t group_ = 0;
};

// The stage to blame for a pipeline's end: the first from the left with a code other than 0 and SIGPIPE's, for those
// before it saw a closed pipe and those behind it a stream that was cut short. Where the pipeline broke down, only
// stages that ended early count: the others died of it. Null if there is none.
[[nodiscard]] const StageStatus* first_failure(const PipelineEnd& end, bool only_early);

} // namespace sheet
