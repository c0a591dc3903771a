// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/loop/kept_stream.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "formats/cpp/stream_reader.h"
#include "libsheet/base/error.h"
#include "libsheet/base/file_lock.h"
#include "libsheet/base/file_roles.h"
#include "libsheet/base/log.h"
#include "libsheet/base/whole_file.h"

namespace sheet {

using formats::Frame;
using formats::StreamError;
using formats::StreamReader;
using formats::StreamWriter;

std::unique_ptr<KeptStream> KeptStream::resume(const std::string& path, Frame& last) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0)
    fail(ExitCode::io, "cannot open {} for writing: {}{}", path, std::strerror(errno),
         errno == ENOENT ? ": --resume goes on with a stream that is there; -o FILE begins one" : "");
  lock_for_writing(descriptor, path); // what another run still writes must not be taken for a torn end
  std::uint64_t frames = 0, bytes = 0;
  {
    const InputFile input(path);
    StreamReader reader(input.descriptor(), input.name());
    Frame frame;
    try {
      while (reader.read(frame)) {
        std::swap(frame, last);
        frames = reader.frames_since_end();
      }
    } catch (const StreamError& error) {
      if (error.kind() == StreamError::Kind::io)
        throw;
      // A run that was cut off leaves a torn last frame, or no end mark: mended. Damage before that is not ours to
      // drop.
      const off_t damage = ::lseek(input.descriptor(), 0, SEEK_CUR);
      const bool torn = damage == ::lseek(input.descriptor(), 0, SEEK_END);
      if (!torn && reader.frames() == 0)
        fail(ExitCode::corrupt, "{}; there is nothing to go on with: start the run anew, or give another stream",
             error.what());
      if (!torn)
        fail(ExitCode::corrupt,
             "{}; more follows behind it, so the file is left as it is: save what is before with "
             "sheet-select --first {} and resume that",
             error.what(), reader.frames());
      log::detail("{}; going on from the frame before", error.what());
    }
    bytes = reader.bytes_of_frames();
    if (reader.frames() == 0)
      fail(ExitCode::bad_input, "{} holds no whole frame: start the run anew", path);
  }
  release_file(path, FileRole::input);
  claim_file(path, FileRole::output);
  return std::unique_ptr<KeptStream>(new KeptStream(descriptor, path, frames, static_cast<off_t>(bytes)));
}

std::unique_ptr<KeptStream> KeptStream::create(const std::string& path) {
  auto file = std::make_unique<OutputFile>(path, OutputFile::Content::binary);
  file->keep_earlier();
  return std::unique_ptr<KeptStream>(new KeptStream(std::move(file)));
}

KeptStream::KeptStream(std::unique_ptr<OutputFile> file)
    : created_(std::move(file)), writer_(created_->descriptor(), created_->name()) {}

KeptStream::KeptStream(int descriptor, std::string path, std::uint64_t frames, off_t bytes)
    : path_(std::move(path)), resumed_(descriptor), bytes_(bytes), writer_(descriptor, path_, frames) {}

KeptStream::~KeptStream() {
  if (resumed_ >= 0)
    ::close(resumed_);
}

void KeptStream::write(const Frame& frame) {
  start();
  writer_.write(frame);
}

void KeptStream::end() {
  start();
  writer_.end();
  if (created_)
    created_->close();
  if (resumed_ >= 0 && ::close(std::exchange(resumed_, -1)) != 0)
    fail(ExitCode::io, "cannot finish writing: {}", std::strerror(errno));
}

void KeptStream::start() {
  if (std::exchange(started_, true))
    return;
  if (created_)
    created_->start();
  else if (::ftruncate(resumed_, bytes_) != 0 || ::lseek(resumed_, 0, SEEK_END) < 0)
    fail(ExitCode::io, "cannot go on with {}: {}", path_, std::strerror(errno));
}

void write_checkpoint(const std::string& path, const Frame& frame) {
  release_file(path, FileRole::output);
  write_whole_file(path, [&](OutputFile& file) {
    file.start();
    StreamWriter writer(file.descriptor(), file.name());
    writer.write(frame);
    writer.end();
  });
  claim_file(path, FileRole::output);
}

Frame read_last_frame(const InputFile& input) {
  StreamReader reader(input.descriptor(), input.name());
  Frame frame, last;
  while (reader.read(frame))
    std::swap(frame, last);
  if (reader.frames() == 0)
    fail(ExitCode::bad_input, "{} holds no frame to start from", input.name());
  return last;
}

} // namespace sheet
