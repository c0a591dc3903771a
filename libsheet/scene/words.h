// SPDX-License-Identifier: GPL-3.0-or-later
// The words that scene files use for the library's alternatives, each list in the order of its enum or variant.
#pragma once
#include <array>
#include <string_view>

namespace sheet::scene::words {

inline constexpr std::array<std::string_view, 7> sheet_shapes{"rectangle", "disk", "annulus", "sphere",
                                                              "cap",       "tube", "mesh"};
inline constexpr std::array<std::string_view, 3> patterns{"structured", "equilateral", "irregular"};
inline constexpr std::array<std::string_view, 3> planes{"xy", "xz", "yz"};
inline constexpr std::array<std::string_view, 2> places{"vertex", "face"};
inline constexpr std::array<std::string_view, 2> perturbed{"position", "thickness"};
inline constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
inline constexpr std::array<std::string_view, 4> directions{"x", "y", "z", "radial"};
inline constexpr std::array<std::string_view, 8> flow_laws{"newtonian",        "power",  "carreau", "cross", "bingham",
                                                           "herschel_bulkley", "casson", "table"};
inline constexpr std::array<std::string_view, 6> temperature_laws{"constant", "arrhenius", "exponential",
                                                                  "vft",      "wlf",       "table"};
inline constexpr std::array<std::string_view, 4> pressures{"constant", "inverse_square", "draining", "gas"};
inline constexpr std::array<std::string_view, 9> borders{"rim",   "inner_rim", "outer_rim", "x_min", "x_max",
                                                         "y_min", "y_max",     "z_min",     "z_max"};
inline constexpr std::array<std::string_view, 2> holds{"pinned", "clamped"};
inline constexpr std::array<std::string_view, 4> motions{"fixed", "translating", "rotating", "keyframed"};
inline constexpr std::array<std::string_view, 3> interpolations{"smooth", "linear", "step"};
inline constexpr std::array<std::string_view, 6> solid_shapes{"sphere", "box", "capsule", "cylinder", "plane", "mesh"};
inline constexpr std::array<std::string_view, 3> solid_contacts{"stick", "flow", "slip"};
inline constexpr std::array<std::string_view, 2> crumbs{"keep", "drop"};
inline constexpr std::array<std::string_view, 2> merges{"all", "solids"};

} // namespace sheet::scene::words
