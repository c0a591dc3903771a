// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/known_triangles.h"

#include <algorithm>
#include <bit>

#include "libsheet/geometry/connectivity.h"

namespace sheet::collide {

namespace {

// Relative to the longest side, squared: thinner triangles may have their corners on a line.
constexpr double thin = 1e-12;

bool same_bits(const Vector3& a, const Vector3& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

std::size_t hash_of(const Vector3& x) {
  std::uint64_t hash = 0;
  for (const double value : x)
    hash = (std::rotl(hash, 23) ^ std::bit_cast<std::uint64_t>(value)) * 0x9e3779b97f4a7c15U;
  return hash ^ hash >> 32;
}

// The slot of the table of a place: where a vertex at this place is, or an empty one.
std::size_t slot_of(const std::vector<std::uint32_t>& table, std::span<const Vector3> positions, const Vector3& x) {
  std::size_t slot = hash_of(x) & (table.size() - 1);
  while (table[slot] != no_index && !same_bits(positions[table[slot]], x))
    slot = (slot + 1) & (table.size() - 1);
  return slot;
}

bool is_thin(std::span<const Vector3> x, const Corners& c) {
  const Vector3 u = x[c[1]] - x[c[0]], v = x[c[2]] - x[c[0]];
  const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
  return !(u.cross(v).squaredNorm() > thin * longest * longest);
}

Corners ascending(Corners c) {
  std::sort(c.begin(), c.end());
  return c;
}

} // namespace

void KnownTriangles::forget() { triangles_.clear(); }

void KnownTriangles::remember(std::span<const Corners> triangles, std::span<const Vector3> start,
                              std::span<const Vector3> end) {
  positions_.assign(end.begin(), end.end());
  table_.assign(std::bit_ceil(2 * positions_.size() + 1), no_index);
  std::vector<std::uint8_t> twice(positions_.size(), 0); // another vertex stands there
  for (std::uint32_t v = 0; v < positions_.size(); ++v) {
    std::uint32_t& there = table_[slot_of(table_, positions_, positions_[v])];
    if (there == no_index)
      there = v;
    else
      twice[v] = twice[there] = 1;
  }
  first_.assign(positions_.size() + 1, 0);
  std::vector<Corners> kept;
  for (const Corners& t : triangles)
    if (twice[t[0]] == 0 && twice[t[1]] == 0 && twice[t[2]] == 0 && !is_thin(start, t) && !is_thin(end, t)) {
      kept.push_back(ascending(t));
      ++first_[kept.back()[0] + 1];
    }
  for (std::size_t v = 0; v < positions_.size(); ++v)
    first_[v + 1] += first_[v];
  triangles_.resize(kept.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end());
  for (const Corners& t : kept)
    triangles_[next[t[0]]++] = t;
}

// Of each place the vertex that stood there; no_index where none did, or where several stand now.
std::vector<std::uint32_t> KnownTriangles::find_again(std::span<const Vector3> positions) const {
  std::vector<std::uint32_t> found(positions.size()), visitors(positions_.size(), 0);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const bool stays = v < positions_.size() && same_bits(positions[v], positions_[v]);
    found[v] = stays ? static_cast<std::uint32_t>(v) : table_[slot_of(table_, positions_, positions[v])];
    if (found[v] != no_index)
      ++visitors[found[v]];
  }
  for (std::uint32_t& v : found)
    if (v != no_index && visitors[v] > 1)
      v = no_index;
  return found;
}

std::vector<std::uint8_t> KnownTriangles::unknown(std::span<const Corners> triangles,
                                                  std::span<const Vector3> positions) const {
  std::vector<std::uint8_t> result(triangles.size(), 1);
  if (triangles_.empty())
    return result;
  const std::vector<std::uint32_t> old = find_again(positions);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Corners corners = ascending({old[triangles[t][0]], old[triangles[t][1]], old[triangles[t][2]]});
    if (corners[2] == no_index)
      continue;
    const auto begin = triangles_.begin() + first_[corners[0]], end = triangles_.begin() + first_[corners[0] + 1];
    result[t] = std::find(begin, end, corners) == end;
  }
  return result;
}

} // namespace sheet::collide
