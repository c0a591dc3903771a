// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/base/parallel.h"

#include <optional>

#include <tbb/global_control.h>

#include "libsheet/base/error.h"

namespace sheet {

struct ThreadLimit::Impl {
  std::optional<tbb::global_control> control;
};

ThreadLimit::ThreadLimit(std::int64_t threads) : impl_(std::make_unique<Impl>()) {
  if (threads < 0 || threads > 1024)
    fail(ExitCode::usage, "--threads: {} is not between 0 and 1024", threads);
  if (threads > 0)
    impl_->control.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
}

ThreadLimit::~ThreadLimit() = default;

} // namespace sheet
