// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/loop/progress.h"

#include <algorithm>

#include <fmt/core.h>
#include <unistd.h>

#include "libsheet/base/log.h"

namespace sheet {

std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::max(0.0, seconds) + 0.5);
  if (whole < 60)
    return fmt::format("{} s", whole);
  if (whole < 3600)
    return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole % 3600 / 60);
}

Progress::Progress(double time, std::uint64_t step, std::optional<double> until, std::optional<std::int64_t> steps)
    : first_time_(time), first_step_(step), until_(until), steps_(steps), start_(Clock::now()),
      terminal_(::isatty(STDERR_FILENO) != 0 && log::level() != log::Level::quiet) {}

Progress::~Progress() { clear(); }

std::string Progress::line(double time, std::uint64_t step, std::uint64_t frames_kept, double elapsed) const {
  double done = 0; // the share of the run that lies behind us
  if (until_ && *until_ > first_time_)
    done = (time - first_time_) / (*until_ - first_time_);
  if (steps_ && static_cast<std::uint64_t>(*steps_) > first_step_)
    done = std::max(done, static_cast<double>(step - first_step_) / static_cast<double>(*steps_ - first_step_));
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

void Progress::show(double time, std::uint64_t step, std::uint64_t frames_kept) {
  const auto now = Clock::now();
  if (!terminal_ || (visible_ && now - shown_ < std::chrono::seconds(1)))
    return;
  shown_ = now;
  visible_ = true;
  const std::string text =
      fmt::format("\r\x1b[K{}: {}", log::program(),
                  line(time, step, frames_kept, std::chrono::duration<double>(now - start_).count()));
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
