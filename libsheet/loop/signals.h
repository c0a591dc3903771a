// SPDX-License-Identifier: GPL-3.0-or-later
// SIGINT and SIGTERM as something to wait for.
#pragma once
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <poll.h>

#include "libsheet/base/error.h"

namespace sheet {

// From construction on; as before after destruction.
class Signals {
public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  // Waits until `descriptor` can be read (true) or a signal has come (false). Calls `patience_ends` every now and then.
  template <class F> [[nodiscard]] bool wait_readable(int descriptor, F&& patience_ends) const {
    constexpr int patience = 5000; // [ms]
    for (;;) {
      std::array<pollfd, 2> waited{pollfd{descriptor, POLLIN, 0}, pollfd{descriptor_, POLLIN, 0}};
      const int ready = ::poll(waited.data(), waited.size(), patience);
      if (ready == 0)
        patience_ends();
      if (ready < 0 && errno != EINTR)
        fail(ExitCode::io, "cannot wait for the ring: {}", std::strerror(errno));
      if (ready <= 0)
        continue;
      if (waited[1].revents != 0)
        return false;
      if (waited[0].revents != 0)
        return true;
    }
  }
  // Whether one has come that was not taken.
  [[nodiscard]] bool come() const;
  // The signal that wait_readable saw.
  [[nodiscard]] int take() const;

private:
  sigset_t set_{}, old_{};
  int descriptor_ = -1;
};

} // namespace sheet
