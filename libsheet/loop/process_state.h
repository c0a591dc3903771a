// SPDX-License-Identifier: GPL-3.0-or-later
// What the system knows of a process that runs.
#pragma once
#include <cstdint>
#include <optional>

#include <sys/types.h>

namespace sheet {

// Bytes that it has written so far; absent where the system does not say.
[[nodiscard]] std::optional<std::uint64_t> bytes_written(pid_t process);

// True if it waits for something rather than computes.
[[nodiscard]] bool is_asleep(pid_t process);

} // namespace sheet
