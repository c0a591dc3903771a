// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/base/frame_files.h"

#include <cstdint>
#include <filesystem>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "libsheet/base/error.h"
#include "libsheet/base/files.h"

namespace sheet {
namespace {

class FilesOfFrames : public testing::Test {
protected:
  FilesOfFrames() { std::filesystem::remove_all(folder); }
  ~FilesOfFrames() override { std::filesystem::remove_all(folder); }
  FilesOfFrames(const FilesOfFrames&) = delete;
  FilesOfFrames& operator=(const FilesOfFrames&) = delete;
  [[nodiscard]] std::string path(const std::string& name) const { return (folder / "deep" / name).string(); }
  [[nodiscard]] std::ptrdiff_t count() const {
    const std::filesystem::directory_iterator files(folder / "deep");
    return std::distance(begin(files), end(files));
  }
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("sheet-frame-files-" + std::to_string(::getpid()));
};

void write_one(const std::string& name, const std::string& bytes) {
  FrameFiles files(name, "--frames");
  static_cast<void>(files.next(0));
  files.write(bytes);
  files.finish();
}

TEST_F(FilesOfFrames, AreWholeOrNotThere) {
  write_one(path("a.png"), "one");
  write_one(path("a.png"), "two");
  EXPECT_EQ(read_text_file(path("a.png")), "two");
  EXPECT_EQ(count(), 1);
  EXPECT_THROW(write_one(path("a.png/b.png"), "three"), Error); // the folder is a file
}

TEST_F(FilesOfFrames, OfOneNameAreOneOrTheEarlierStays) {
  write_one(path("a.png"), "earlier");
  FrameFiles files(path("a.png"), "--frames");
  EXPECT_EQ(files.next(3), path("a.png"));
  files.write("new");
  EXPECT_THROW(static_cast<void>(files.next(4)), Error);
  EXPECT_EQ(read_text_file(path("a.png")), "earlier");
  EXPECT_EQ(count(), 1);
}

TEST_F(FilesOfFrames, WithNumbersAreThereAtOnce) {
  FrameFiles files(path("%02d.png"), "--frames");
  for (const std::uint64_t i : {3, 11}) {
    static_cast<void>(files.next(i));
    files.write(std::to_string(i));
  }
  EXPECT_EQ(read_text_file(path("03.png")), "3");
  EXPECT_EQ(read_text_file(path("11.png")), "11");
}

} // namespace
} // namespace sheet
