// SPDX-License-Identifier: GPL-3.0-or-later
// The random numbers of a path. They depend on the pixel and on the number of the sample alone, so that pictures do not
// depend on the number of threads, and the grain of a film's frames does not move.
//
// Each pair of dimensions is the two-dimensional Sobol sequence, shuffled and scrambled by Owen's nested uniform
// scrambling as a hash [Burley 2020, Practical Hash-based Owen Scrambling; Laine and Karras 2011].
//
// Each pixel may have a sequence of its own; or one sequence goes through the whole picture, along Morton's curve
// [Ahmed and Wonka 2020, Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of
// Pixels]. Then the samples of pixels next to each other are well spread among them, and means over them have little
// noise.
#pragma once
#include <bit>
#include <cstdint>

namespace sheet::render {

struct Point2 {
  float x, y; // in [0, 1)
};

class Sampler {
public:
  Sampler(std::uint32_t pixel, std::uint32_t sample) : seed_(mix(pixel + 0x9e3779b9U)), sample_(reversed(sample)) {}

  // Of the sequence for the whole picture. `together`: so many samples of a pixel are to be well spread among
  // themselves and with those of its neighbours, the next ones likewise.
  static Sampler on_screen(std::uint32_t x, std::uint32_t y, std::uint32_t sample, std::uint32_t together) {
    constexpr int block_bits = 6, round_bits = 2; // 8 x 8 pixels; rounds before the next blocks
    const int own_bits = std::bit_width(together - 1);
    const std::uint32_t place = spaced(x) | (spaced(y) << 1), round = sample >> own_bits;
    const std::uint32_t own = sample & ((1U << own_bits) - 1), in_block = place & ((1U << block_bits) - 1);
    const std::uint32_t index = own | (in_block << own_bits) | ((round & 3U) << (own_bits + block_bits)) |
                                ((place >> block_bits) << (own_bits + block_bits + round_bits));
    return {round >> round_bits, index};
  }

  // The next point of the path.
  Point2 point() {
    const std::uint32_t seed = mix(seed_ + 0x85ebca6bU * ++dimension_);
    const std::uint32_t index = scrambled(sample_, seed);
    return {unit(scrambled(index, mix(seed ^ 0x55555555U))),
            unit(scrambled(reversed(second_sobol(index)), mix(seed ^ 0xaaaaaaaaU)))};
  }
  float number() { return point().x; }

private:
  static std::uint32_t mix(std::uint32_t x) { // a bijection whose every output bit depends on every input bit
    x = (x ^ (x >> 16)) * 0x7feb352dU;
    x = (x ^ (x >> 15)) * 0x846ca68bU;
    return x ^ (x >> 16);
  }
  static std::uint32_t spaced(std::uint32_t x) { // its lower 16 bits at the even places
    x &= 0xffffU;
    x = (x | (x << 8)) & 0x00ff00ffU;
    x = (x | (x << 4)) & 0x0f0f0f0fU;
    x = (x | (x << 2)) & 0x33333333U;
    return (x | (x << 1)) & 0x55555555U;
  }
  static std::uint32_t reversed(std::uint32_t x) {
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00ff00ffU) << 8) | ((x & 0xff00ff00U) >> 8);
    x = ((x & 0x0f0f0f0fU) << 4) | ((x & 0xf0f0f0f0U) >> 4);
    x = ((x & 0x33333333U) << 2) | ((x & 0xccccccccU) >> 2);
    return ((x & 0x55555555U) << 1) | ((x & 0xaaaaaaaaU) >> 1);
  }
  // Owen scrambling of a number whose bits stand in reverse: lower bits decide the flips of higher ones. The result
  // stands the right way round.
  static std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeaU;
    x += seed;
    x *= (seed >> 16) | 1;
    x ^= x * 0x05526c56U;
    x ^= x * 0x53a22864U;
    return reversed(x);
  }
  static std::uint32_t second_sobol(std::uint32_t index) {
    std::uint32_t result = 0;
    for (std::uint32_t direction = 1U << 31; index != 0; index >>= 1, direction ^= direction >> 1)
      if ((index & 1) != 0)
        result ^= direction;
    return result;
  }
  static float unit(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24F; }

  std::uint32_t seed_, sample_, dimension_ = 0;
};

} // namespace sheet::render
