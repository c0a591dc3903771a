// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/loop/signals.h"

#include <sys/signalfd.h>
#include <unistd.h>

namespace sheet {

Signals::Signals() {
  sigemptyset(&set_);
  sigaddset(&set_, SIGINT);
  sigaddset(&set_, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &set_, &old_);
  descriptor_ = ::signalfd(-1, &set_, SFD_CLOEXEC | SFD_NONBLOCK);
  if (descriptor_ < 0)
    fail(ExitCode::io, "cannot wait for signals: {}", std::strerror(errno));
}

Signals::~Signals() {
  ::close(descriptor_);
  pthread_sigmask(SIG_SETMASK, &old_, nullptr);
}

bool Signals::come() const {
  pollfd waited{descriptor_, POLLIN, 0};
  return ::poll(&waited, 1, 0) > 0;
}

int Signals::take() const {
  signalfd_siginfo info{};
  return ::read(descriptor_, &info, sizeof info) == sizeof info ? static_cast<int>(info.ssi_signo) : SIGINT;
}

} // namespace sheet
