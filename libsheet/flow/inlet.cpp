// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/inlet.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "libsheet/base/error.h"

namespace sheet::flow {

using Eigen::Vector3d;
using formats::Frame;

namespace {

using Place = std::array<double, 3>;
Place place(const Vector3d& x) { return {x[0], x[1], x[2]}; }

// What the marks say, gone through once.
struct Marked {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> sides; // between vertices of the border -> triangle
  std::map<Corners, std::uint32_t> in_strip; // triangles, corners ascending, all of whose vertices are marked
  std::map<Place, std::uint32_t> rows;       // vertices of first rows, by origin
};

Marked marked(const Frame& frame, std::span<const std::uint64_t> bits, std::span<const Vector3d> origins) {
  Marked m;
  const auto corners = triangles(frame);
  const auto on_border = [&](std::uint32_t v) { return (bits[v] & at_inlet_border) != 0; };
  for (std::uint32_t t = 0; t < corners.size(); ++t) {
    Corners c = corners[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = c[i], b = c[(i + 1) % 3];
      if (on_border(a) && on_border(b) && !m.sides.emplace(std::pair(a, b), t).second)
        fail(
            ExitCode::bad_input,
            "edge ({}, {}) of the inlet: two triangles run along it in the same direction: turn the faces the same way",
            a, b);
    }
    if (bits[c[0]] != 0 && bits[c[1]] != 0 && bits[c[2]] != 0) {
      std::sort(c.begin(), c.end());
      m.in_strip.emplace(c, t);
    }
  }
  for (std::uint32_t v = 0; v < bits.size(); ++v)
    if ((bits[v] & (behind_inlet | at_inlet_border)) == behind_inlet)
      m.rows.emplace(place(origins[v]), v);
  return m;
}

std::vector<InletChain> chains_of(const Marked& m) {
  std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> next; // vertex -> the one after it, triangle
  std::set<std::uint32_t> entered;                                       // vertices that have one before them
  for (const auto& [side, triangle] : m.sides) {
    const auto [a, b] = side;
    if (m.sides.contains({b, a}))
      continue; // not a border
    if (!next.emplace(a, std::pair(b, triangle)).second || !entered.insert(b).second)
      fail(ExitCode::bad_input, "the inlet is pinched at an end of its edge ({}, {}): sheet-tear takes vertices apart",
           a, b);
  }
  std::vector<InletChain> chains;
  const auto follow = [&](std::uint32_t start, bool closed) {
    InletChain chain;
    chain.closed = closed;
    std::uint32_t v = start;
    for (auto at = next.find(v); at != next.end(); at = next.find(v)) {
      chain.border.push_back(v);
      chain.behind.push_back(at->second.second);
      v = at->second.first;
      next.erase(at);
    }
    if (!closed)
      chain.border.push_back(v);
    chains.push_back(std::move(chain));
  };
  std::vector<std::uint32_t> starts;
  for (const auto& [v, side] : next)
    if (!entered.contains(v))
      starts.push_back(v);
  for (const std::uint32_t v : starts)
    follow(v, false);
  while (!next.empty())
    follow(next.begin()->first, true);
  return chains;
}

std::optional<std::uint32_t> triangle_at(const Marked& m, Corners c) {
  std::sort(c.begin(), c.end());
  const auto at = m.in_strip.find(c);
  return at == m.in_strip.end() ? std::nullopt : std::optional(at->second);
}

// Fills in row and strip, if they are there.
void add_strip(const Marked& m, std::span<const Vector3d> origins, InletChain& chain) {
  std::vector<std::uint32_t> row;
  for (const std::uint32_t v : chain.border) {
    const auto at = m.rows.find(place(origins[v]));
    if (at == m.rows.end())
      return;
    row.push_back(at->second);
  }
  std::vector<std::array<std::uint32_t, 2>> strip;
  for (std::size_t i = 0; i < chain.edges(); ++i) {
    const std::size_t j = chain.after(i);
    const std::uint32_t above = chain.border[i], above_next = chain.border[j];
    auto at_border = triangle_at(m, {above, above_next, row[j]});
    auto at_row = triangle_at(m, {above, row[i], row[j]});
    if (!at_border) {
      at_border = triangle_at(m, {above, above_next, row[i]});
      at_row = triangle_at(m, {above_next, row[i], row[j]});
    }
    if (!at_border || !at_row)
      return;
    strip.push_back({*at_border, *at_row});
  }
  chain.row = std::move(row);
  chain.strip = std::move(strip);
}

} // namespace

std::vector<InletChain> find_inlet(const Frame& frame, std::size_t number) {
  const auto all = masks(frame, "inlet");
  std::vector<std::uint64_t> bits(all.begin(), all.end());
  for (std::uint64_t& b : bits)
    b = of_inlet(b, number);
  if (std::all_of(bits.begin(), bits.end(), [](std::uint64_t b) { return b == 0; }))
    return {};
  const formats::Array* origin = frame.find("inlet_origin");
  if (origin == nullptr)
    fail(ExitCode::bad_input, "the frame marks an inlet, but has no array \"inlet_origin\": make it with sheet-init");
  const auto origins = origin->values<Vector3d>();
  const Marked m = marked(frame, bits, origins);
  std::vector<InletChain> chains = chains_of(m);
  for (InletChain& chain : chains)
    add_strip(m, origins, chain);
  return chains;
}

} // namespace sheet::flow
