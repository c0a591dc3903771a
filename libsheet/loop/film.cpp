// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/loop/film.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "formats/cpp/stream_reader.h"
#include "libsheet/base/error.h"
#include "libsheet/base/files.h"
#include "libsheet/base/log.h"
#include "libsheet/loop/progress.h"
#include "libsheet/loop/select.h"

namespace sheet {
namespace {

using Clock = std::chrono::steady_clock;

// Which frames of the stream are wanted.
class Wanted {
public:
  explicit Wanted(const std::string& text) {
    if (!text.empty())
      ranges_ = parse_indices(text);
  }
  [[nodiscard]] bool needs_total() const { return std::ranges::any_of(ranges_, &IndexRange::needs_total); }
  void set_total(std::uint64_t total) { total_ = static_cast<std::int64_t>(total); }
  [[nodiscard]] bool has(std::uint64_t index) const {
    const auto i = static_cast<std::int64_t>(index);
    return ranges_.empty() || std::ranges::any_of(ranges_, [&](const IndexRange& r) { return r.has(i, total_); });
  }

private:
  std::vector<IndexRange> ranges_;
  std::int64_t total_ = 0;
};

// The line on the terminal.
class FilmProgress {
public:
  explicit FilmProgress(std::optional<std::uint64_t> total)
      : total_(total), terminal_(::isatty(STDERR_FILENO) != 0 && log::level() != log::Level::quiet) {}
  ~FilmProgress() { clear(); }
  FilmProgress(const FilmProgress&) = delete;
  FilmProgress& operator=(const FilmProgress&) = delete;

  void show(double part) {
    const auto now = Clock::now();
    if (!terminal_ || now - shown_ < std::chrono::milliseconds(200))
      return;
    shown_ = now;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double done = static_cast<double>(finished_) + part,
                 all = static_cast<double>(total_.value_or(finished_ + 1));
    write(fmt::format("\r\x1b[K{}: picture {}{}, {:.0f} %, {} left{}", log::program(), finished_ + 1,
                      total_ ? fmt::format(" of {}", *total_) : "", 100 * part,
                      done > 0 ? duration_text(elapsed * (all - done) / done) : "?", total_ ? "" : " for this one"));
  }
  void finish_picture() {
    ++finished_;
    clear();
  }
  void clear() {
    if (shown_ != Clock::time_point{} && terminal_)
      write("\r\x1b[K");
  }

private:
  static void write(std::string_view text) {
    [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, text.data(), text.size());
  }
  std::optional<std::uint64_t> total_;
  bool terminal_;
  std::uint64_t finished_ = 0;
  Clock::time_point start_ = Clock::now(), shown_{};
};

bool is_file(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

// Calls `work` with every frame that is wanted; an Error gets the frame's number. Frames of the stream.
template <class F>
std::uint64_t for_each_frame(int descriptor, const std::string& name, const Wanted& wanted, F&& work) {
  formats::StreamReader reader(descriptor, name);
  formats::Frame frame;
  while (reader.read(frame)) {
    const std::uint64_t index = reader.frames() - 1;
    if (!wanted.has(index))
      continue;
    try {
      work(frame, index);
    } catch (const Error& error) {
      if (error.code() == ExitCode::usage)
        throw;
      fail(error.code(), "{}: frame {} (step {}, time {} s): {}", name, index, frame.step, frame.time, error.what());
    }
  }
  return reader.frames();
}

} // namespace

void run_film(
    const FilmOptions& options, const std::function<void(const formats::Frame&)>& survey,
    const std::function<std::string(const formats::Frame&, std::uint64_t, const std::function<void(double)>&)>& draw) {
  Wanted wanted(options.frames), surveyed(options.view.empty() ? options.frames : options.view);
  std::optional<std::uint64_t> total;
  const InputFile input(options.input);
  if (options.input != "-" && is_file(input.descriptor())) {
    if (wanted.needs_total() || surveyed.needs_total()) {
      const InputFile counted(options.input);
      formats::StreamReader reader(counted.descriptor(), counted.name());
      formats::Frame frame;
      try {
        while (reader.read(frame)) {
        }
      } catch (const formats::StreamError&) { // a run that failed: its whole frames count
      }
      wanted.set_total(reader.frames());
      surveyed.set_total(reader.frames());
    }
    const InputFile first(options.input);
    total = 0;
    bool any = options.view.empty();
    try {
      for_each_frame(first.descriptor(), first.name(), Wanted(""),
                     [&](const formats::Frame& frame, std::uint64_t index) {
                       if (wanted.has(index))
                         ++*total;
                       if (surveyed.has(index)) {
                         survey(frame);
                         any = true;
                       }
                     });
    } catch (const formats::StreamError&) { // what is whole is drawn; then the same error comes again
    }
    if (!any)
      fail(ExitCode::bad_input, "--view-of {}: {} has no such frames", options.view, input.name());
  } else if (!options.view.empty()) {
    fail(ExitCode::usage, "--view-of {}: {} can be read only once; give a file", options.view, input.name());
  } else if (wanted.needs_total()) {
    fail(ExitCode::usage, "--frames {}: the end of {} is not known; give a file to count from its end", options.frames,
         input.name());
  }
  FilmProgress progress(total ? std::max(*total, options.least) : total);
  std::uint64_t drawn = 0;
  std::optional<std::pair<formats::Frame, std::uint64_t>> last;
  const auto draw_one = [&](const formats::Frame& frame, std::uint64_t index) {
    const auto start = Clock::now();
    const std::string line = draw(frame, index, [&](double part) { progress.show(part); });
    progress.finish_picture();
    log::detail("frame {}: {}, {:.3g} s", index, line, std::chrono::duration<double>(Clock::now() - start).count());
    ++drawn;
  };
  const std::uint64_t frames =
      for_each_frame(input.descriptor(), input.name(), wanted, [&](const formats::Frame& frame, std::uint64_t index) {
        draw_one(frame, index);
        if (drawn < options.least)
          last.emplace(frame, index);
      });
  while (last && drawn < options.least)
    draw_one(last->first, last->second);
  if (frames == 0)
    log::warning("{} has no frames: nothing is drawn", input.name());
  else if (drawn == 0)
    fail(ExitCode::bad_input, "--frames {}: {} has frames 0 to {}", options.frames, input.name(), frames - 1);
}

} // namespace sheet
