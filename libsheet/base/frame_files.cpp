// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/base/frame_files.h"

#include <filesystem>
#include <utility>

#include "libsheet/base/error.h"
#include "libsheet/base/whole_file.h"

namespace sheet {

namespace {

void write_file(const std::string& path, const std::string& bytes) {
  write_whole_file(path, [&](OutputFile& file) { file.write(bytes); });
}

} // namespace

FrameFiles::FrameFiles(std::string name, std::string picker)
    : names_(name), name_(std::move(name)), picker_(std::move(picker)) {}

std::string FrameFiles::next(std::uint64_t index) {
  if (any_ && !names_.has_number())
    fail(ExitCode::usage,
         "-o {} names one file and there are several frames: number them, as in frame_%04d{}, or pick one with {}",
         name_, std::filesystem::path(name_).extension().string(), picker_);
  any_ = true;
  path_ = names_.of(index);
  make_folder_of(path_);
  return path_;
}

void FrameFiles::write(const std::string& bytes) {
  if (names_.has_number())
    return write_file(path_, bytes);
  held_ = bytes;
  holds_ = true;
}

void FrameFiles::finish() {
  if (std::exchange(holds_, false))
    write_file(path_, held_);
}

} // namespace sheet
