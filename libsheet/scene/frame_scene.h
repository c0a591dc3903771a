// SPDX-License-Identifier: GPL-3.0-or-later
// The scene that travels in a stream's frames, for stages.
#pragma once
#include <optional>
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet::scene {

// Reads the text anew only where it differs from that of the frame before.
class FrameScene {
public:
  // Throws Error (bad_input) if the frame has no scene, or one that cannot be read.
  const Scene& of(const formats::Frame& frame);

private:
  std::string text_;
  std::optional<Scene> scene_;
};

} // namespace sheet::scene

namespace sheet {
using scene::FrameScene;
} // namespace sheet
