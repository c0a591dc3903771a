// SPDX-License-Identifier: GPL-3.0-or-later
// The decoders behind read_picture, one source a library. `name` stands for the file in messages. Throw Error
// (bad_input).
#pragma once
#include <string>

#include "libsheet/render/image.h"

namespace sheet::render {

inline constexpr int longest_side = 16384; // of a picture that is read or drawn [pixels]

[[nodiscard]] Image decode_png(const std::string& bytes, const std::string& name);
// Radiance's, in rows from the upper left, with or without run lengths [Ward 1991, Real Pixels].
[[nodiscard]] Image decode_hdr(const std::string& bytes, const std::string& name);
[[nodiscard]] Image decode_exr(const std::string& bytes, const std::string& name);

} // namespace sheet::render
