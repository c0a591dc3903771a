// SPDX-License-Identifier: GPL-3.0-or-later
// The stream of the frames that a ring keeps, and its checkpoint.
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include <sys/types.h>

#include "formats/cpp/stream_frame.h"
#include "formats/cpp/stream_writer.h"
#include "libsheet/base/files.h"

namespace sheet {

// A new one, or one that a run before has left. Errors: io; corrupt, bad_input for what cannot be gone on with.
class KeptStream {
public:
  // Reads what is there, and leaves the last whole frame in `last`. What is behind it is cut off before the first frame
  // is added.
  [[nodiscard]] static std::unique_ptr<KeptStream> resume(const std::string& path, formats::Frame& last);
  // What the file has had stays beside it, as OutputFile::keep_earlier says.
  [[nodiscard]] static std::unique_ptr<KeptStream> create(const std::string& path);
  ~KeptStream();
  KeptStream(const KeptStream&) = delete;
  KeptStream& operator=(const KeptStream&) = delete;

  void write(const formats::Frame& frame);
  void end();
  [[nodiscard]] std::uint64_t frames() const { return writer_.frames(); }

private:
  explicit KeptStream(std::unique_ptr<OutputFile> file);
  KeptStream(int descriptor, std::string path, std::uint64_t frames, off_t bytes);
  void start();

  std::unique_ptr<OutputFile> created_;
  std::string path_;
  int resumed_ = -1;
  off_t bytes_ = 0; // of the whole frames that are there
  bool started_ = false;
  formats::StreamWriter writer_;
};

// Replaces the file, as a whole, by a stream of this frame.
void write_checkpoint(const std::string& path, const formats::Frame& frame);

// Error (bad_input) if there is none.
[[nodiscard]] formats::Frame read_last_frame(const InputFile& input);

} // namespace sheet
