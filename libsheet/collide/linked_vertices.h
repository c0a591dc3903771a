// SPDX-License-Identifier: GPL-3.0-or-later
// Which vertices contact springs join already: pairs (of the first feature, of the second one), in a hash table with
// open addressing [Knuth 1998, 6.4].
#pragma once
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/sheet/contact_spring.h"

namespace sheet::collide {

class LinkedVertices {
public:
  explicit LinkedVertices(std::span<const ContactSpring> springs) : slots_(64, none) {
    for (const ContactSpring& s : springs)
      add(s);
  }

  void add(const ContactSpring& s) {
    const std::size_t first = s.second_feature();
    for (std::size_t a = 0; a < first; ++a)
      for (std::size_t b = first; b < 4; ++b)
        insert(key(s.vertices[a], s.vertices[b]));
  }

  // Whether a pair of features has vertices in common with a spring between the same layers. From a vertex to a
  // triangle only springs from that vertex count: the other way, from a vertex of the triangle to this one, is another
  // spring.
  [[nodiscard]] bool join(const std::array<std::uint32_t, 4>& v, bool of_vertex) const {
    if (of_vertex)
      return contains(key(v[0], v[1])) || contains(key(v[0], v[2])) || contains(key(v[0], v[3]));
    for (std::size_t a = 0; a < 2; ++a)
      for (std::size_t b = 2; b < 4; ++b)
        if (contains(key(v[a], v[b])) || contains(key(v[b], v[a])))
          return true;
    return false;
  }

private:
  static constexpr std::uint64_t none = ~std::uint64_t{0};
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }

  // The slot of a key, or the empty one in which it belongs.
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const {
    constexpr std::uint64_t golden = 0x9E3779B97F4A7C15; // 2^64 over the golden ratio
    std::size_t slot = key * golden >> (64 - std::countr_zero(slots_.size()));
    while (slots_[slot] != none && slots_[slot] != key)
      slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  [[nodiscard]] bool contains(std::uint64_t key) const { return slots_[slot_of(key)] == key; }

  void insert(std::uint64_t key) {
    std::uint64_t& slot = slots_[slot_of(key)];
    if (slot == key)
      return;
    slot = key;
    if (++count_ * 2 > slots_.size())
      grow();
  }
  void grow() {
    std::vector<std::uint64_t> old(2 * slots_.size(), none);
    old.swap(slots_);
    for (const std::uint64_t key : old)
      if (key != none)
        slots_[slot_of(key)] = key;
  }

  std::vector<std::uint64_t> slots_; // a power of two
  std::size_t count_ = 0;
};

} // namespace sheet::collide
