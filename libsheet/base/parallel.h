// SPDX-License-Identifier: GPL-3.0-or-later
// Threads of the whole program. TBB does the work; results must not depend on their number.
#pragma once
#include <cstdint>
#include <memory>

namespace sheet {

// Limits TBB to `threads` for as long as it lives; 0 means one for each core. Throws Error (usage) below 0 or above
// 1024.
class ThreadLimit {
public:
  explicit ThreadLimit(std::int64_t threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace sheet
