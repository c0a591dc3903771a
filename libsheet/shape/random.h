// SPDX-License-Identifier: GPL-3.0-or-later
// Random numbers that are the same on every machine (the distributions of <random> are not).
#pragma once
#include <cstdint>

namespace sheet {

// SplitMix64 [Steele, Lea, Flood 2014: Fast splittable pseudorandom number generators].
class Random {
public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }
  // Uniform in [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  // Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

private:
  std::uint64_t state_;
};

} // namespace sheet
