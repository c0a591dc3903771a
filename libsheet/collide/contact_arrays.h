// SPDX-License-Identifier: GPL-3.0-or-later
// Contact springs in a frame (formats/sheet.md, section 5, contact_*).
#pragma once
#include "formats/cpp/stream_frame.h"
#include "libsheet/collide/contact_springs.h"

namespace sheet::collide {

// None if the frame has no contact arrays.
[[nodiscard]] std::vector<ContactSpring> read_springs(const formats::Frame& frame);
// Replaces the frame's springs; without any, its contact arrays go.
void write_springs(formats::Frame& frame, std::span<const ContactSpring> springs);

} // namespace sheet::collide
