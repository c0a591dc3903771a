// SPDX-License-Identifier: GPL-3.0-or-later
// The scene that travels in a stream's frames, for stages.
#pragma once
#include <optional>
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet::scene {

// Reads the text anew only where it differs from that of the frame before. What is returned is good until the next
// call.
class FrameScene {
public:
  // Null if the frame has no scene. Throws Error (bad_input) if it has one that cannot be read.
  const Scene* find(const formats::Frame& frame);
  // Throws Error (bad_input) if it has none, too.
  const Scene& of(const formats::Frame& frame);
  // Whether the last call met another text than the one before, so that what was made from the scene is out of date.
  [[nodiscard]] bool changed() const { return changed_; }

private:
  std::string text_;
  std::optional<Scene> scene_;
  bool changed_ = false;
};

} // namespace sheet::scene

namespace sheet {
using scene::FrameScene;
} // namespace sheet
