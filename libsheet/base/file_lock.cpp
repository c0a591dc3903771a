// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/base/file_lock.h"

#include <cerrno>
#include <fstream>
#include <sstream>

#include <sys/file.h>
#include <sys/stat.h>

#include "libsheet/base/error.h"

namespace sheet {

namespace {

// Who holds the lock, for messages: "process 123 (sheet-loop)". Each line of /proc/locks reads
// "1: FLOCK ADVISORY WRITE PROCESS MAJOR:MINOR:INODE START END".
std::string holder_of(ino_t inode) {
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, mode, access, process, file;
    words >> number >> kind >> mode >> access >> process >> file;
    if (kind != "FLOCK" || !file.ends_with(":" + std::to_string(inode)))
      continue;
    std::string name;
    std::getline(std::ifstream("/proc/" + process + "/comm"), name);
    return fmt::format("process {}{}", process, name.empty() ? "" : fmt::format(" ({})", name));
  }
  return "another program";
}

} // namespace

void lock_for_writing(int descriptor, const std::string& name) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode))
    return;
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    fail(ExitCode::io, "{} is being written by {}: wait until it has ended, or choose another output", name,
         holder_of(status.st_ino));
}

void unlock(int descriptor) { ::flock(descriptor, LOCK_UN); }

} // namespace sheet
