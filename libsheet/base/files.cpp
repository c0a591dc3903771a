// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/base/files.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "formats/cpp/stream_writer.h"
#include "formats/cpp/text_start.h"
#include "libsheet/base/error.h"
#include "libsheet/base/file_lock.h"
#include "libsheet/base/file_roles.h"
#include "libsheet/base/log.h"
#include "libsheet/base/named_files.h"

namespace sheet {

InputFile::InputFile(const std::string& path) : name_(path == "-" ? "standard input" : path) {
  claim_file(path, FileRole::input);
  if (path == "-") {
    if (::isatty(STDIN_FILENO) != 0)
      fail(ExitCode::usage, "standard input is a terminal: give a file, or pipe a stream in");
    descriptor_ = STDIN_FILENO;
  } else {
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0)
      fail(ExitCode::io, "cannot open {}: {}", path, std::strerror(errno));
    struct stat status {};
    if (::fstat(descriptor_, &status) == 0 && S_ISDIR(status.st_mode)) {
      ::close(descriptor_);
      fail(ExitCode::io, "cannot read {}: it is a folder", path);
    }
    look_beside(path);
  }
  widen_pipe(descriptor_);
}

InputFile::~InputFile() {
  if (descriptor_ > STDERR_FILENO)
    ::close(descriptor_);
}

OutputFile::OutputFile(const std::string& path, Content content)
    : path_(path), name_(path == "-" ? "standard output" : path) {
  claim_file(path, FileRole::output);
  if (path == "-") {
    if (content == Content::binary && ::isatty(STDOUT_FILENO) != 0)
      fail(ExitCode::usage, "standard output is a terminal and the stream is binary: give -o FILE, or pipe it on");
    descriptor_ = STDOUT_FILENO;
    if (content == Content::binary)
      lock_for_writing(descriptor_, name_);
    widen_pipe(descriptor_);
    return;
  }
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  created_ = descriptor_ >= 0;
  if (!created_)
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    fail(ExitCode::io, "cannot open {} for writing: {}", path, std::strerror(errno));
  lock_for_writing(descriptor_, name_);
}

OutputFile::~OutputFile() {
  if (created_ && !started_)
    ::unlink(path_.c_str());
  if (descriptor_ > STDERR_FILENO)
    ::close(descriptor_);
  else if (descriptor_ >= 0) // which whoever started this program may go on with
    unlock(descriptor_);
  release_file(path_, FileRole::output);
  if (!earlier_.empty())
    release_file(earlier_, FileRole::output);
}

bool OutputFile::has_content() const {
  struct stat status {};
  return path_ != "-" && ::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0;
}

void OutputFile::keep_earlier() {
  if (!has_content())
    return;
  std::error_code error;
  const auto real = std::filesystem::canonical(path_, error); // so that a link to the file stays one
  earlier_ = (error ? path_ : real.string()) + "~";
  claim_file(earlier_, FileRole::output);
}

// The file becomes the earlier one, and a new one takes its name and this descriptor.
void OutputFile::put_aside() {
  const std::string path = earlier_.substr(0, earlier_.size() - 1);
  struct stat status {};
  ::fstat(descriptor_, &status);
  release_file(path_, FileRole::output);
  release_file(earlier_, FileRole::output);
  if (::rename(path.c_str(), earlier_.c_str()) != 0)
    fail(ExitCode::io, "cannot keep {} as {}: {}; move it away, or write to another file", path_, earlier_,
         std::strerror(errno));
  const int fresh = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, status.st_mode & 07777);
  if (fresh < 0 || ::dup3(fresh, descriptor_, O_CLOEXEC) < 0)
    fail(ExitCode::io, "cannot open {} for writing: {}; what it had is in {}", path_, std::strerror(errno), earlier_);
  ::close(fresh);
  lock_for_writing(descriptor_, name_);
  claim_file(path_, FileRole::output);
  log::note("{} was there: it is kept as {}", path_, path == path_ ? path_ + "~" : earlier_);
}

void OutputFile::start() {
  if (std::exchange(started_, true) || path_ == "-")
    return;
  if (!earlier_.empty())
    return put_aside();
  struct stat status {};
  if (::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode) && ::ftruncate(descriptor_, 0) != 0)
    fail(ExitCode::io, "cannot empty {}: {}", path_, std::strerror(errno));
}

void OutputFile::write(std::string_view text) {
  start();
  formats::write_all(descriptor_, std::as_bytes(std::span(text)), name_);
}

void OutputFile::close() {
  start();
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0)
    fail(ExitCode::io, "cannot finish writing {}: {}", name_, std::strerror(errno));
}

std::string read_text_file(const std::string& path, std::size_t limit) {
  const InputFile file(path);
  std::string text;
  std::size_t size = 0;
  for (;;) {
    text.resize(std::max<std::size_t>(1 << 16, 2 * size));
    const ssize_t got = ::read(file.descriptor(), text.data() + size, text.size() - size);
    if (got < 0 && errno == EINTR)
      continue;
    if (got < 0)
      fail(ExitCode::io, "cannot read {}: {}", file.name(), std::strerror(errno));
    if (got == 0)
      break;
    size += static_cast<std::size_t>(got);
    if (size > limit)
      fail(ExitCode::io, "cannot read {}: it is longer than {} bytes", file.name(), limit);
  }
  text.resize(size);
  return text;
}

std::string read_utf8_file(const std::string& path, std::size_t limit) {
  std::string text = read_text_file(path, limit);
  if (const std::string error = formats::find_no_text(text); !error.empty())
    fail(ExitCode::bad_input, "{}: {}", path == "-" ? "standard input" : path, error);
  text.erase(0, text.size() - formats::without_mark(text).size());
  return text;
}

void widen_pipe(int descriptor) {
  constexpr int bytes = 1 << 20;
  // Refused on other kinds of files and above the user's limit: then the pipe stays as it is.
  ::fcntl(descriptor, F_SETPIPE_SZ, bytes);
}

} // namespace sheet
