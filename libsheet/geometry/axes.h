// SPDX-License-Identifier: GPL-3.0-or-later
// A set of coordinate axes, as those along which a motion is prescribed: bit a for axis a (x: 0).
#pragma once
#include <concepts>
#include <cstdint>

namespace sheet {

using Axes = std::uint8_t;
inline constexpr Axes all_axes = 7;
[[nodiscard]] constexpr bool has_axis(Axes axes, std::integral auto a) { return (axes >> a & 1) != 0; }
[[nodiscard]] constexpr Axes axis_bit(std::integral auto a) { return static_cast<Axes>(1 << a); }

} // namespace sheet
