// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/loop/progress.h"

#include <algorithm>
#include <exception>
#include <utility>

#include <fmt/core.h>
#include <unistd.h>

#include "libsheet/base/files.h"
#include "libsheet/base/log.h"
#include "libsheet/base/whole_file.h"

namespace sheet {

std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::max(0.0, seconds) + 0.5);
  if (whole < 60)
    return fmt::format("{} s", whole);
  if (whole < 3600)
    return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole % 3600 / 60);
}

Progress::Progress(double time, std::uint64_t step, std::optional<double> until, std::optional<std::int64_t> steps,
                   std::string file)
    : first_time_(time), first_step_(step), until_(until), steps_(steps), file_(std::move(file)), start_(Clock::now()),
      terminal_(::isatty(STDERR_FILENO) != 0 && log::level() != log::Level::quiet) {}

Progress::~Progress() { clear(); }

double Progress::elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

double Progress::share(double time, std::uint64_t step) const {
  double done = 0;
  if (until_ && *until_ > first_time_)
    done = (time - first_time_) / (*until_ - first_time_);
  if (steps_ && static_cast<std::uint64_t>(*steps_) > first_step_)
    done = std::max(done, static_cast<double>(step - first_step_) / static_cast<double>(*steps_ - first_step_));
  return done;
}

std::string Progress::json(double time, std::uint64_t step, std::uint64_t frames_kept, double elapsed,
                           std::string_view state) const {
  const double done = share(time, step);
  const auto known = [](const auto& value) { return value ? fmt::format("{}", *value) : std::string("null"); };
  return fmt::format("{{\"state\": \"{}\", \"time\": {}, \"until\": {}, \"step\": {}, \"steps\": {}, \"frames\": {}, "
                     "\"elapsed\": {:.3f}, \"left\": {}}}\n",
                     state, time, known(until_), step, known(steps_), frames_kept, elapsed,
                     done > 0 ? fmt::format("{:.3f}", elapsed * std::max(0.0, 1 - done) / done) : "null");
}

std::string Progress::line(double time, std::uint64_t step, std::uint64_t frames_kept, double elapsed) const {
  const double done = share(time, step);
  std::string text = fmt::format("step {}", step);
  if (steps_)
    text += fmt::format(" of {}", *steps_);
  text += fmt::format(", t = {:.6g}", time);
  if (until_)
    text += fmt::format(" of {:.6g}", *until_);
  text += fmt::format(" s, {} frames", frames_kept);
  if (step > first_step_)
    text += fmt::format(", {:.3g} s a step", elapsed / static_cast<double>(step - first_step_));
  if (done > 0 && done < 1)
    text += fmt::format(", {} left", duration_text(elapsed * (1 - done) / done));
  return text;
}

void Progress::write(double time, std::uint64_t step, std::uint64_t frames_kept, std::string_view state) {
  if (file_.empty())
    return;
  written_ = Clock::now();
  try {
    write_whole_file(file_, [&](OutputFile& file) { file.write(json(time, step, frames_kept, elapsed(), state)); });
  } catch (const std::exception& error) { // no such folder, a full disk: the run is worth more
    log::warning("--progress: {}", error.what());
    file_.clear();
  }
}

void Progress::end(double time, std::uint64_t step, std::uint64_t frames_kept, std::string_view state) {
  clear();
  write(time, step, frames_kept, state);
}

void Progress::show(double time, std::uint64_t step, std::uint64_t frames_kept) {
  if (file_.empty() && !terminal_)
    return;
  const auto now = Clock::now();
  if (now - written_ >= std::chrono::milliseconds(200))
    write(time, step, frames_kept, "running");
  if (!terminal_ || (visible_ && now - shown_ < std::chrono::seconds(1)))
    return;
  shown_ = now;
  visible_ = true;
  const std::string text = fmt::format("\r\x1b[K{}: {}", log::program(), line(time, step, frames_kept, elapsed()));
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, text.data(), text.size());
}

void Progress::clear() {
  if (!visible_)
    return;
  visible_ = false;
  constexpr std::string_view erase = "\r\x1b[K";
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, erase.data(), erase.size());
}

} // namespace sheet
