// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/loop/loop.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <limits>
#include <memory>

#include <fmt/core.h>

#include "formats/cpp/stream_reader.h"
#include "formats/cpp/stream_writer.h"
#include "libsheet/base/error.h"
#include "libsheet/base/file_roles.h"
#include "libsheet/base/files.h"
#include "libsheet/base/filter.h"
#include "libsheet/base/log.h"
#include "libsheet/base/named_files.h"
#include "libsheet/base/shell_words.h"
#include "libsheet/loop/health_watch.h"
#include "libsheet/loop/kept_stream.h"
#include "libsheet/loop/pipeline.h"
#include "libsheet/loop/pipeline_end.h"
#include "libsheet/loop/progress.h"
#include "libsheet/loop/recorded_ring.h"
#include "libsheet/loop/same_run.h"
#include "libsheet/loop/signals.h"
#include "libsheet/loop/stop_condition.h"
#include "libsheet/scene/change.h"
#include "libsheet/scene/frame_scene.h"
#include "libsheet/scene/ring.h"
#include "libsheet/sheet/drops.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

using formats::Frame;
using formats::StreamError;
using formats::StreamReader;
using formats::StreamWriter;
using Clock = std::chrono::steady_clock;

namespace {

// Which frames are kept.
struct Keep {
  bool output_times = false, last_only = false;
  std::uint64_t every = 1;
};

Keep parse_keep(const LoopOptions& options) {
  Keep keep;
  if (options.keep.empty()) {
    keep.output_times = options.fps.has_value();
  } else if (options.keep == "output") {
    if (!options.fps)
      fail(ExitCode::usage, "--keep output needs --fps");
    keep.output_times = true;
  } else if (options.keep == "last") {
    keep.last_only = true;
  } else {
    const char* end = options.keep.data() + options.keep.size();
    const auto [stop, error] = std::from_chars(options.keep.data(), end, keep.every);
    if (error != std::errc{} || stop != end || keep.every == 0)
      fail(ExitCode::usage, "--keep: \"{}\" is not \"output\", \"last\" or a number of steps", options.keep);
  }
  return keep;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

// None where there is none: less than one frame in all times that there are.
void stamp_next_output_time(Frame& frame, const LoopOptions& options) {
  double next = options.until.value_or(infinity);
  if (options.fps)
    next = std::min(next, next_output_time(frame.time, *options.fps));
  if (std::isinf(next)) {
    frame.erase("next_output_time");
    return;
  }
  put_number(frame, "next_output_time", next);
}

class Ring {
public:
  explicit Ring(const LoopOptions& options) : options_(options) {}

  int run() {
    start();
    const Signals signals; // from here on an interrupt ends the ring in good order
    Pipeline pipeline(options_.pipeline);
    StreamReader returned(pipeline.output(), "the pipeline's output");
    StreamWriter sent(pipeline.input(), "the pipeline's input");
    Progress progress(frame_.time, frame_.step, options_.until, options_.steps, options_.progress);
    const auto begin = Clock::now();
    auto checkpointed = begin;
    std::uint64_t rounds = 0;
    bool slow = true;
    while (!done()) {
      stamp_next_output_time(frame_, options_);
      const auto round_begin = Clock::now();
      if (slow)
        pipeline.begin_round();
      if (!round(pipeline, signals, sent, returned)) {
        progress.clear();
        const int signal = signals.take();
        interrupted(pipeline, signals, sent, returned, rounds,
                    std::chrono::duration<double>(Clock::now() - begin).count());
        progress.end(frame_.time, frame_.step, output_->frames(), "interrupted");
        return signal;
      }
      ++rounds;
      slow = Clock::now() - round_begin > std::chrono::milliseconds(100); // else it would cost too much to watch
      find_stop();
      write_first();
      const bool wanted = is_wanted();
      health_.follow(back_, frame_, wanted);
      if (const std::string serious = health_.become_serious(frame_); !serious.empty()) {
        progress.clear();
        log::warning(serious);
      }
      if (wanted)
        write_frame();
      progress.show(frame_.time, frame_.step, output_->frames());
      if (!options_.checkpoint.empty() &&
          std::chrono::duration<double>(Clock::now() - checkpointed).count() >= options_.checkpoint_every) {
        save_state();
        checkpointed = Clock::now();
      }
    }
    progress.clear();
    const double elapsed = std::chrono::duration<double>(Clock::now() - begin).count();
    write_first();
    if (!kept_)
      write_frame();
    save_state();
    finish(pipeline, sent, returned, rounds, elapsed);
    output_->end();
    progress.end(frame_.time, frame_.step, output_->frames(), "done");
    tell_of_end(rounds);
    tell_of_health();
    return 0;
  }

private:
  // Why the run has ended, where its options do not say.
  void tell_of_end(std::uint64_t rounds) const {
    if (nothing_left_)
      log::note("{}", all_has_left());
    else if (stop_)
      log::note("stopped at step {}, t = {} s, as --stop-when says: {}", frame_.step, frame_.time, *stop_);
    else if (rounds == 0 && begins_beyond_end())
      log::note("nothing was left to do: it starts at step {}, t = {} s; give a later --until, or more --steps",
                frame_.step, frame_.time);
  }

  // Reads the first frame, opens the output.
  void start() {
    if (!options_.resume.empty()) {
      claim_checkpoint(); // other than the stream
      output_ = KeptStream::resume(options_.resume, frame_);
      kept_ = true;
      if (!options_.checkpoint.empty() && std::filesystem::exists(options_.checkpoint))
        take_checkpoint();
      log::detail("going on with {} at step {}, t = {} s", options_.resume, frame_.step, frame_.time);
      if (options_.pipeline.empty())
        take_recorded_ring();
      keep_ = parse_keep(options_);
      record_scene_and_ring();
    } else {
      const InputFile input(options_.input);
      frame_ = read_last_frame(input);
      claim_checkpoint();
      output_ = KeptStream::create(options_.output);
      keep_ = parse_keep(options_);
      record_scene_and_ring();
      if (!keep_.last_only)
        first_ = frame_;
      kept_ = first_.has_value();
    }
    for (const std::string& condition : options_.stop_when)
      conditions_.emplace_back(condition);
    find_stop();
    warn_of_missing_stages();
    tell_stages_where_the_streams_are();
  }

  // The pipeline that has made the stream, with the options that go with it but for those that are given. A stream that
  // somebody else has made shall not run commands.
  void take_recorded_ring() {
    const std::optional<RecordedRing> ring = recorded_ring(frame_);
    if (!ring)
      fail(ExitCode::usage,
           "{} does not tell the pipeline that made it: give the stages behind --, as in -- "
           "'sheet-remesh | sheet-step'",
           options_.resume);
    if (!is_harmless(ring->pipeline))
      fail(ExitCode::usage,
           "the ring of {} has more than Sheet's own stages, so it is not run unasked: if it is yours, or you trust "
           "it, give it behind --, as in -- {}",
           options_.resume, shell_quoted(ring->pipeline));
    options_.pipeline = ring->pipeline;
    if (!options_.fps)
      options_.fps = ring->fps;
    if (options_.keep.empty())
      options_.keep = ring->keep;
    check(options_);
    log::note("the ring is that of {}: {}{}-- {}", options_.resume,
              options_.fps ? fmt::format("--fps {} ", *options_.fps) : "",
              options_.keep.empty() ? "" : fmt::format("--keep {} ", options_.keep), shell_quoted(options_.pipeline));
  }

  // A run that is gone on with by the same ring has it in its record already.
  void record_scene_and_ring() {
    const bool changed = change_scene();
    const RecordedRing ring{without_threads(options_.pipeline), options_.fps, options_.keep};
    if (!options_.provenance)
      return;
    if (changed)
      record_change(frame_, ring, options_.sets);
    else
      record_ring(frame_, ring);
  }

  // They read a pipe, and meshes that frames name may lie beside the stream, as what belongs to the run shall.
  void tell_stages_where_the_streams_are() const {
    const auto tell = [](const char* variable, const std::string& stream) {
      if (stream != "-")
        ::setenv(variable, std::filesystem::absolute(stream).parent_path().c_str(), 1);
    };
    tell(stream_folder_variable, options_.resume.empty() ? options_.input : options_.resume);
    if (const std::string& made = stream_path(); std::filesystem::is_regular_file(made)) // and no device
      tell(run_folder_variable, made);
  }

  // By --set; false if nothing changes, as in a run that is gone on with by the same command.
  bool change_scene() {
    if (options_.sets.empty())
      return false;
    const formats::Array* old = frame_.find("scene");
    if (old == nullptr)
      fail(ExitCode::usage, "--set: the frame has no scene to change");
    if (frame_.step == 0)
      fail(ExitCode::usage, "--set: the run has not begun; give --set to sheet-init");
    const std::string scene = scene::changed_scene(old->text(), options_.sets, frame_.time);
    if (scene == old->text()) {
      log::detail("the scene is as --set wants it");
      return false;
    }
    if (done())
      fail(ExitCode::usage, "--set: the run is at its end, step {}, t = {} s; give a later --until, or more --steps",
           frame_.step, frame_.time);
    frame_.put_text("scene", scene);
    return true;
  }

  // What the scene says and no stage does would go wrong silently.
  void warn_of_missing_stages() const try {
    if (frame_.find("scene") == nullptr)
      return;
    FrameScene scenes;
    if (const std::string missing = scene::missing_stages(scenes.of(frame_), options_.pipeline); !missing.empty())
      log::warning(missing);
  } catch (const Error&) { // a scene that cannot be read is refused by the stage that needs it
  }

  void claim_checkpoint() const {
    if (!options_.checkpoint.empty())
      claim_file(options_.checkpoint, FileRole::output);
  }

  // The frame of the checkpoint, if it is newer than the stream's last one.
  void take_checkpoint() {
    release_file(options_.checkpoint, FileRole::output);
    {
      const InputFile input(options_.checkpoint);
      Frame newer = read_last_frame(input);
      const bool is_newer = newer.step > frame_.step;
      if (!same_run(is_newer ? frame_ : newer, is_newer ? newer : frame_))
        fail(ExitCode::usage,
             "--checkpoint {} holds a frame of another run than {}: name another file, or remove it if nobody needs it",
             options_.checkpoint, options_.resume);
      if (is_newer) {
        frame_ = std::move(newer);
        kept_ = false;
      }
    }
    release_file(options_.checkpoint, FileRole::input);
    claim_checkpoint();
  }

  // The first of the conditions that holds in the newest frame, or that there is nothing more to follow.
  void find_stop() {
    nothing_left_ = frame_.triangles == 0 && frame_.step > 0 && volume_of_drops(frame_) == 0 && !more_enters();
    for (StopCondition& condition : conditions_)
      if (!stop_)
        stop_ = condition.holds(frame_);
  }

  // Whether a sheet of the scene is still to come.
  [[nodiscard]] bool more_enters() const {
    if (frame_.find("scene") == nullptr)
      return false;
    FrameScene scenes;
    const auto come =
        std::ranges::count_if(scenes.of(frame_).sheets, [](auto& sheet) { return sheet.enters.has_value(); });
    return number(frame_, "entered", 0) < static_cast<double>(come);
  }

  [[nodiscard]] std::string all_has_left() const {
    std::string text =
        fmt::format("nothing is left of the sheet at step {}, t = {} s, so the run ends", frame_.step, frame_.time);
    const std::pair<const char*, const char*> accounts[] = {{"outflow.volume", "have flowed out"},
                                                            {"tear.volume", "have been torn away"}};
    for (const auto& [account, way] : accounts)
      if (const double volume = number(frame_, account, 0); volume > 0)
        text += fmt::format("; {:.6g} m^3 {}", volume, way);
    return text;
  }

  [[nodiscard]] bool done() const {
    return nothing_left_ || stop_ || (options_.until && frame_.time >= *options_.until) ||
           (options_.steps && frame_.step >= static_cast<std::uint64_t>(*options_.steps));
  }

  [[nodiscard]] bool begins_beyond_end() const {
    return (options_.until && frame_.time > *options_.until) ||
           (options_.steps && frame_.step > static_cast<std::uint64_t>(*options_.steps));
  }

  // One frame through all stages; false if the user interrupted. Sends from a thread of its own: a stage may answer
  // before it has read everything, and neither end may wait for the other.
  bool round(Pipeline& pipeline, const Signals& signals, StreamWriter& sent, StreamReader& returned) {
    std::future<void> sending = std::async(std::launch::async, [&] { sent.write(frame_); });
    const bool readable = signals.wait_readable(pipeline.output(), [&] { tell_of_silence(pipeline); });
    std::string error;
    if (readable) {
      try {
        if (!returned.read(back_))
          error = "the pipeline ended its stream too early";
      } catch (const StreamError& e) {
        error = e.what();
      }
    }
    if ((!readable || !error.empty()) &&
        !(sent_ = sending.wait_for(std::chrono::seconds(readable ? 5 : 1)) == std::future_status::ready))
      pipeline.kill();
    try {
      sending.get();
    } catch (const StreamError& e) {
      if (error.empty() && readable)
        error = e.what();
    }
    if (!readable)
      return false;
    if (!error.empty())
      fail_round(pipeline, error);
    if (back_.step == frame_.step)
      ++back_.step; // a ring without sheet-step counts rounds
    if (options_.until && !(back_.time > frame_.time))
      fail(ExitCode::usage,
           "the pipeline did not advance the time (t = {} s after step {}): --until needs sheet-step in it; "
           "give --steps for a ring without",
           back_.time, back_.step);
    std::swap(frame_, back_);
    kept_ = false;
    return true;
  }

  // A stage that waits for more frames before it answers would keep the ring waiting for ever.
  void tell_of_silence(const Pipeline& pipeline) {
    const std::string stage = told_of_silence_ ? "" : pipeline.silent_stage();
    if (stage.empty())
      return;
    log::warning("stage \"{}\" has taken its frame, gives none and does nothing: a stage must answer each frame before "
                 "the next one comes (sheet-loop goes on waiting; interrupt it to end)",
                 stage);
    told_of_silence_ = true;
  }

  [[nodiscard]] bool is_wanted() const {
    return keep_.last_only      ? false
           : keep_.output_times ? frame_.time >= number(back_, "next_output_time", infinity)
                                : frame_.step % keep_.every == 0;
  }

  void tell_of_health() {
    if (const std::string report = health_.at_the_end(frame_); !report.empty())
      log::note(report);
  }

  // The first frame is written when the first round has gone well: a ring that cannot start leaves an earlier result
  // as it is.
  void write_first() {
    if (!first_)
      return;
    write(*first_);
    first_.reset();
  }

  void write_frame() {
    write(frame_);
    kept_ = true;
  }

  void write(const Frame& frame) {
    try {
      output_->write(frame);
    } catch (const StreamError& error) {
      if (error.kind() == StreamError::Kind::closed)
        throw;
      try_to_save_state();
      fail(ExitCode::io, "{}; at {}", error.what(), whereabouts());
    }
  }

  // Where the stream that is made goes.
  [[nodiscard]] const std::string& stream_path() const {
    return options_.resume.empty() ? options_.output : options_.resume;
  }

  // How to go on, for messages.
  [[nodiscard]] std::string whereabouts() const {
    std::string text = fmt::format("step {}, t = {} s; ", frame_.step, frame_.time);
    if (first_)
      return text + "nothing was written";
    text += fmt::format("{} whole frames kept", output_->frames());
    const std::string& path = stream_path();
    text +=
        path == "-" ? "; go on with --resume FILE if they are in one" : fmt::format("; go on with --resume {}", path);
    return text;
  }

  // Where something has gone wrong already, which a full disk must not hide.
  void try_to_save_state() const {
    try {
      save_state();
    } catch (const std::exception& error) {
      log::warning("the checkpoint could not be written: {}", error.what());
    }
  }

  void save_state() const {
    if (!options_.checkpoint.empty())
      write_checkpoint(options_.checkpoint, frame_);
  }

  [[noreturn]] void fail_round(Pipeline& pipeline, const std::string& error) {
    pipeline.note_early_ends();
    const PipelineEnd end = pipeline.finish(5);
    try_to_save_state();
    tell_of_health();
    if (const StageStatus* stage = first_failure(end, true))
      fail(exit_code_of(*stage), "{} in the step after {}", describe(*stage), whereabouts());
    fail(ExitCode::corrupt, "{}; in the step after {}", error, whereabouts());
  }

  void interrupted(Pipeline& pipeline, const Signals& signals, StreamWriter& sent, StreamReader& returned,
                   std::uint64_t rounds, double elapsed) {
    write_first();
    save_state();
    log::warning("interrupted in the step after {}", whereabouts());
    output_->end();
    wind_down(pipeline, signals, sent, returned);
    if (rounds > 0)
      report_times(pipeline.finish(2), rounds, elapsed);
    tell_of_health();
  }

  // Lets the stages end their step and tell what they have to tell, if they do soon and no further signal comes.
  void wind_down(Pipeline& pipeline, const Signals& signals, StreamWriter& sent, StreamReader& returned) {
    constexpr auto patience = std::chrono::seconds(5);
    if (!sent_)
      return pipeline.kill();
    const std::future<void> ending = std::async(std::launch::async, [&] {
      try {
        sent.end();
        pipeline.close_input();
        while (returned.read(back_))
          continue;
      } catch (const StreamError&) { // a stage that has died has told why
      }
    });
    const auto deadline = Clock::now() + patience;
    while (ending.wait_for(std::chrono::milliseconds(10)) != std::future_status::ready)
      if (signals.come() || Clock::now() > deadline)
        return pipeline.kill();
  }

  // Ends the stream to the pipeline and sees every stage end well.
  void finish(Pipeline& pipeline, StreamWriter& sent, StreamReader& returned, std::uint64_t rounds, double elapsed) {
    std::string error;
    try {
      sent.end();
      pipeline.close_input();
      if (returned.read(back_))
        error = "the pipeline sent more frames than it got";
    } catch (const StreamError& e) {
      error = e.what();
    }
    const PipelineEnd end = pipeline.finish(60);
    if (const StageStatus* stage = first_failure(end, false))
      fail(exit_code_of(*stage), "{} at the end of the stream, after {}", describe(*stage), whereabouts());
    if (!error.empty())
      fail(ExitCode::corrupt, "{}; after {}", error, whereabouts());
    if (rounds > 0)
      report_times(end, rounds, elapsed);
  }

  LoopOptions options_;
  Keep keep_;
  std::unique_ptr<KeptStream> output_;
  std::optional<Frame> first_; // not yet written
  Frame frame_, back_;         // the newest state; the one that comes back (after a round: the one before)
  HealthWatch health_;
  std::vector<StopCondition> conditions_;
  std::optional<std::string> stop_; // what ends the run
  bool nothing_left_ = false;       // likewise
  bool told_of_silence_ = false;
  bool sent_ = false; // where a round was broken off: the stages have its whole frame
  bool kept_ = false; // the newest state is in the output
};

} // namespace

void check(const LoopOptions& options) {
  const auto positive = [](const char* name, const std::optional<double>& value) {
    if (value && !(*value > 0 && std::isfinite(*value)))
      fail(ExitCode::usage, "{}: {} is not a positive number", name, *value);
  };
  positive("--fps", options.fps);
  positive("--checkpoint-every", options.checkpoint_every);
  if (options.until && !std::isfinite(*options.until))
    fail(ExitCode::usage, "--until: {} is not finite", *options.until);
  if (options.steps && *options.steps < 0)
    fail(ExitCode::usage, "--steps: {} is negative", *options.steps);
  for (const std::string& condition : options.stop_when)
    static_cast<void>(StopCondition(condition));
  if (!options.until && !options.steps && options.stop_when.empty())
    fail(ExitCode::usage, "when does it end? give --until SECONDS, --steps N or --stop-when CONDITION");
  if (options.resume.empty() && options.pipeline.find_first_not_of(" \t\n") == std::string::npos)
    fail(ExitCode::usage, "no pipeline: give the stages behind --, as in -- 'sheet-remesh | sheet-step'");
  if (!options.resume.empty() && (options.input != "-" || options.output != "-"))
    fail(ExitCode::usage, "--resume FILE is input and output at once: give neither INPUT nor -o with it");
  if (options.pipeline.empty()) // the stream tells it, and the options that go with it
    return;
  [[maybe_unused]] const Keep keep = parse_keep(options);
  [[maybe_unused]] const std::vector<std::string> stages = split_pipeline(options.pipeline);
}

double next_output_time(double time, double fps) {
  double k = std::floor(time * fps);
  constexpr double most = 0x1p52; // beyond, k and k + 1 are the same number, or give the same time
  if (!(std::abs(k) < most))
    fail(ExitCode::usage,
         "--fps: {} frames a second are so many at t = {} s that their times are the same numbers: give fewer", fps,
         time);
  while (k / fps <= time)
    ++k;
  while ((k - 1) / fps > time)
    --k;
  return k / fps;
}

int run_loop(const LoopOptions& options) {
  check(options);
  return Ring(options).run();
}

} // namespace sheet
