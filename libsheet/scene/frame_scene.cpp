// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/frame_scene.h"

#include "libsheet/base/error.h"
#include "libsheet/scene/read.h"

namespace sheet::scene {

const Scene& FrameScene::of(const formats::Frame& frame) {
  const formats::Array* array = frame.find("scene");
  if (array == nullptr)
    fail(ExitCode::bad_input, "the frame has no scene, so nothing is known of its material: make it with sheet-init");
  if (!scene_ || array->text() != text_) {
    scene_ = parse_scene(array->text(), "the frame's scene");
    text_ = array->text();
  }
  return *scene_;
}

} // namespace sheet::scene
