// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/loop/pipeline.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <sstream>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "libsheet/base/error.h"
#include "libsheet/base/files.h"
#include "libsheet/base/filter.h"

namespace sheet {

namespace {

// The descriptor on which shell and stages report; out of the way of what people redirect.
constexpr int report_descriptor = 19;

void set_close_on_exec(int descriptor) { ::fcntl(descriptor, F_SETFD, FD_CLOEXEC); }

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
  return (error ? std::string() : self.parent_path().string() + ":") + (path == nullptr ? "/usr/bin:/bin" : path);
}

} // namespace

std::vector<std::string> split_pipeline(const std::string& command) {
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
      if (i + 1 < text.size() && text[i + 1] == '|')
        return {};
      stages.emplace_back();
    } else if (depth == 0 && (c == ';' || c == '\n' || (c == '&' && (i == 0 || text[i - 1] != '>')))) {
      return {};
    } else {
      depth += (c == '(' || c == '{') ? 1 : (c == ')' || c == '}') ? -1 : 0;
      stage += c;
    }
  }
  for (std::string& stage : stages)
    stage = trimmed(stage);
  return stages;
}

Pipeline::Pipeline(const std::string& command) : command_(command) {
  auto [in_read, in_write] = make_pipe();
  auto [out_read, out_write] = make_pipe();
  auto [report_read, report_write] = make_pipe();
  widen_pipe(in_write);
  widen_pipe(out_read);
  const std::string script =
      command + "\nstatus=(\"${PIPESTATUS[@]}\")\necho \"status ${status[*]}\" >&" + std::to_string(report_descriptor);
  const std::string path = path_with_own_folder();
  const std::string report = std::to_string(report_descriptor);
  const pid_t parent = ::getpid();
  shell_ = ::fork();
  if (shell_ < 0)
    fail(ExitCode::io, "cannot start the pipeline: {}", std::strerror(errno));
  if (shell_ == 0) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent)
      ::_exit(1);
    for (const int signal : {SIGPIPE, SIGINT, SIGTERM})
      std::signal(signal, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    if (::dup2(in_read, STDIN_FILENO) < 0 || ::dup2(out_write, STDOUT_FILENO) < 0 ||
        ::dup2(report_write, report_descriptor) < 0)
      ::_exit(1);
    ::setenv("PATH", path.c_str(), 1);
    ::setenv(report_descriptor_variable, report.c_str(), 1);
    ::execl("/bin/bash", "bash", "-c", script.c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ::setpgid(shell_, shell_); // both sides do it: whoever is first
  ::close(in_read);
  ::close(out_write);
  ::close(report_write);
  input_ = in_write;
  output_ = out_read;
  report_ = report_read;
  for (const int descriptor : {input_, output_, report_})
    set_close_on_exec(descriptor);
}

Pipeline::~Pipeline() {
  if (shell_ > 0) {
    kill();
    ::waitpid(shell_, nullptr, 0);
  }
  close_if_open(input_);
  close_if_open(output_);
  close_if_open(report_);
}

void Pipeline::close_input() { close_if_open(input_); }

void Pipeline::kill() { ::kill(-shell_, SIGKILL); }

PipelineEnd Pipeline::finish(double patience) {
  close_if_open(input_);
  close_if_open(output_);
  // The report's end is reached when the shell and every stage have gone.
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
  int status = 0;
  while (::waitpid(shell_, &status, 0) < 0 && errno == EINTR) {
  }
  shell_ = -1;

  PipelineEnd end;
  end.shell_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  const std::vector<std::string> commands = split_pipeline(command_);
  std::istringstream lines(report);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "time") {
      StageTime time;
      if (words >> time.process >> time.name >> time.frames >> time.seconds)
        end.times.push_back(std::move(time));
    } else if (kind == "status") {
      std::vector<int> codes;
      for (int code = 0; words >> code;)
        codes.push_back(code);
      for (std::size_t i = 0; i < codes.size(); ++i)
        end.stages.push_back({codes.size() == commands.size() ? commands[i] : command_, codes[i]});
    }
  }
  // bash starts stages from left to right
  std::sort(end.times.begin(), end.times.end(),
            [](const StageTime& a, const StageTime& b) { return a.process < b.process; });
  return end;
}

const StageStatus* first_failure(const PipelineEnd& end) {
  constexpr int closed_pipe = 128 + SIGPIPE;
  const auto failed = [](const StageStatus& s) { return s.code != 0 && s.code != closed_pipe; };
  const auto it = std::find_if(end.stages.begin(), end.stages.end(), failed);
  return it == end.stages.end() ? nullptr : &*it;
}

} // namespace sheet
