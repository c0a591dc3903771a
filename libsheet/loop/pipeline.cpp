// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/loop/pipeline.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <regex>
#include <sstream>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "libsheet/base/error.h"
#include "libsheet/base/files.h"
#include "libsheet/base/filter.h"
#include "libsheet/loop/process_state.h"

namespace sheet {

namespace {

// The descriptor on which shell and stages report; out of the way of what people redirect.
constexpr int report_descriptor = 19;

std::array<int, 2> make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    fail(ExitCode::io, "cannot make a pipe: {}", std::strerror(errno));
  return ends;
}

void close_if_open(int& descriptor) {
  if (descriptor >= 0)
    ::close(descriptor);
  descriptor = -1;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\n"), last = text.find_last_not_of(" \t\n");
  return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

std::string path_with_own_folder() {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  const char* path = std::getenv("PATH");
  return (path == nullptr ? "/usr/bin:/bin" : path) + (error ? std::string() : ":" + self.parent_path().string());
}

// A stage of Sheet's own that writes to a file: the ring would wait for its frames for ever.
void refuse_output_to_file(const std::string& stage) {
  static const std::regex to_file(
      R"(sheet-(collide|emit|merge|pass|remesh|step|tear|watch)\s(.*\s)?(-o\s*|--output[\s=]+))"
      R"((?!-(\s|$)|/dev/stdout|\s)\S.*)");
  if (std::regex_match(stage, to_file))
    fail(ExitCode::usage,
         "stage \"{}\" writes to a file, and the ring waits for its frames: leave that option out; sheet-loop -o keeps "
         "frames",
         stage);
}

} // namespace

std::vector<std::string> split_pipeline(const std::string& command) {
  const auto refuse = [](std::string_view what) {
    fail(ExitCode::usage, "{} in the pipeline: give stages joined by |, and put other commands into a script", what);
  };
  std::vector<std::string> stages(1);
  const std::string text = trimmed(command);
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    std::string& stage = stages.back();
    if (c == '\\' && i + 1 < text.size()) {
      stage += c;
      stage += text[++i];
    } else if (c == '\'' || c == '"') {
      std::size_t end = i + 1;
      while (end < text.size() && text[end] != c)
        end += text[end] == '\\' && c == '"' ? 2 : 1;
      stage += text.substr(i, end - i + 1);
      i = end;
    } else if (depth == 0 && c == '|') {
      if (i + 1 < text.size() && (text[i + 1] == '|' || text[i + 1] == '&'))
        refuse(text.substr(i, 2));
      stages.emplace_back();
    } else if (depth == 0 &&
               (c == ';' || c == '\n' || (c == '&' && (i == 0 || (text[i - 1] != '>' && text[i - 1] != '<'))))) {
      refuse(c == '\n' ? "a line break" : std::string(1, c));
    } else {
      depth += (c == '(' || c == '{') ? 1 : (c == ')' || c == '}') ? -1 : 0;
      stage += c;
    }
  }
  for (std::string& stage : stages)
    if ((stage = trimmed(stage)).empty())
      refuse("an empty stage");
  return stages;
}

Pipeline::Pipeline(const std::string& command) {
  for (const std::string& stage : split_pipeline(command)) {
    refuse_output_to_file(stage);
    stages_.push_back({stage, -1, false, false, 0, 0});
  }
  auto [first_read, first_write] = make_pipe();
  auto [report_read, report_write] = make_pipe();
  input_ = first_write;
  report_ = report_read;
  widen_pipe(input_);
  int from = first_read;
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    auto [read_end, write_end] = make_pipe();
    widen_pipe(read_end);
    start_stage(i, from, write_end, report_write);
    ::close(from);
    ::close(write_end);
    from = read_end;
  }
  ::close(report_write);
  output_ = from;
}

void Pipeline::start_stage(std::size_t index, int from, int to, int report) {
  const std::string path = path_with_own_folder();
  const std::string descriptor = std::to_string(report_descriptor);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0)
    fail(ExitCode::io, "cannot start stage \"{}\": {}", stages_[index].command, std::strerror(errno));
  if (child == 0) {
    ::setpgid(0, group_);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent)
      ::_exit(1);
    for (const int signal : {SIGPIPE, SIGINT, SIGTERM})
      std::signal(signal, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    if (::dup2(from, STDIN_FILENO) < 0 || ::dup2(to, STDOUT_FILENO) < 0 || ::dup2(report, report_descriptor) < 0)
      ::_exit(1);
    ::setenv("PATH", path.c_str(), 1);
    ::setenv(report_descriptor_variable, descriptor.c_str(), 1);
    ::execl("/bin/bash", "bash", "-c", stages_[index].command.c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }
  stages_[index].process = child;
  if (group_ == 0)
    group_ = child;
  ::setpgid(child, group_); // both sides do it: whoever is first
}

Pipeline::~Pipeline() {
  kill();
  reap(0);
  close_if_open(input_);
  close_if_open(output_);
  close_if_open(report_);
}

void Pipeline::begin_round() {
  for (Stage& stage : stages_)
    stage.written = bytes_written(stage.process);
}

std::string Pipeline::silent_stage() const {
  for (const Stage& stage : stages_)
    if (const auto now = bytes_written(stage.process); now && stage.written && *now == *stage.written)
      return is_asleep(stage.process) ? stage.command : "";
  return "";
}

void Pipeline::close_input() { close_if_open(input_); }

void Pipeline::kill() {
  for (const Stage& stage : stages_)
    if (!stage.ended && stage.process > 0) {
      ::kill(-group_, SIGKILL); // their own children too
      break;
    }
}

// Notes the stages that have ended; waits for all of them unless options is WNOHANG.
void Pipeline::reap(int options) {
  for (Stage& stage : stages_) {
    int status = 0;
    pid_t got = 0;
    while (!stage.ended && stage.process > 0 && (got = ::waitpid(stage.process, &status, options)) < 0 &&
           errno == EINTR) {
    }
    if (stage.ended || got != stage.process)
      continue;
    stage.ended = true;
    stage.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
}

void Pipeline::note_early_ends() {
  constexpr int pause = 10; // [ms]
  for (int wait = 0; wait < 50; ++wait) {
    reap(WNOHANG);
    if (stages_.back().ended)
      break;
    ::poll(nullptr, 0, pause);
  }
  // A process that dies closes its files before it has ended: those that end of it may be seen first.
  ::poll(nullptr, 0, 2 * pause);
  reap(WNOHANG);
  for (Stage& stage : stages_)
    stage.early = stage.ended;
}

PipelineEnd Pipeline::finish(double patience) {
  close_if_open(input_);
  close_if_open(output_);
  // The report's end is reached when every stage has gone.
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience);
  std::string report;
  for (bool killed = false;;) {
    const std::chrono::duration<double, std::milli> left = deadline - std::chrono::steady_clock::now();
    pollfd poll_report{report_, POLLIN, 0};
    const int ready = ::poll(&poll_report, 1, killed ? 1000 : std::max(0, static_cast<int>(left.count())));
    if (ready < 0 && errno == EINTR)
      continue;
    if (ready == 0) {
      if (killed)
        break;
      reap(WNOHANG); // so that those keep their codes who ended before we lost patience
      kill();
      killed = true;
      continue;
    }
    std::array<char, 4096> buffer{};
    const ssize_t got = ::read(report_, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR)
      continue;
    if (got <= 0)
      break;
    report.append(buffer.data(), static_cast<std::size_t>(got));
  }
  reap(0);

  PipelineEnd end;
  for (const Stage& stage : stages_)
    end.stages.push_back({stage.command, stage.code, stage.early});
  std::istringstream lines(report);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    pid_t process = 0;
    StageTime time;
    if (!(words >> kind >> process >> time.name >> time.frames >> time.seconds) || kind != "time")
      continue;
    // bash replaces itself by a simple command; what a stage starts beside that counts as the pipeline's last
    const auto it =
        std::find_if(stages_.begin(), stages_.end(), [&](const Stage& stage) { return stage.process == process; });
    time.stage = static_cast<std::size_t>(it - stages_.begin());
    end.times.push_back(std::move(time));
  }
  std::stable_sort(end.times.begin(), end.times.end(),
                   [](const StageTime& a, const StageTime& b) { return a.stage < b.stage; });
  return end;
}

const StageStatus* first_failure(const PipelineEnd& end, bool only_early) {
  constexpr int closed_pipe = 128 + SIGPIPE;
  const auto failed = [only_early](const StageStatus& s) {
    return s.code != 0 && s.code != closed_pipe && (s.early || !only_early);
  };
  const auto it = std::find_if(end.stages.begin(), end.stages.end(), failed);
  return it == end.stages.end() ? nullptr : &*it;
}

} // namespace sheet
