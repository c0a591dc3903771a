// SPDX-License-Identifier: GPL-3.0-or-later
// What takes long to sum up of a liquid, kept until another liquid is asked for.
#pragma once
#include <memory>
#include <mutex>

#include "libsheet/material/liquid.h"

namespace sheet {

template <class Sum> class Kept {
public:
  template <class Make> std::shared_ptr<const Sum> of(const Liquid& liquid, Make make) {
    const std::scoped_lock lock(mutex_);
    if (!sum_ || !(liquid_ == liquid)) {
      sum_ = std::make_shared<const Sum>(make());
      liquid_ = liquid;
    }
    return sum_;
  }

private:
  std::mutex mutex_;
  Liquid liquid_;
  std::shared_ptr<const Sum> sum_;
};

} // namespace sheet
