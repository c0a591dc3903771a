// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/frame_scene.h"

#include "libsheet/base/error.h"
#include "libsheet/scene/read.h"

namespace sheet::scene {

const Scene* FrameScene::find(const formats::Frame& frame) {
  const formats::Array* array = frame.find("scene");
  changed_ = array == nullptr ? scene_.has_value() : !scene_ || array->text() != text_;
  if (changed_) {
    scene_.reset();
    if (array != nullptr) {
      scene_ = parse_scene(array->text(), "the frame's scene");
      text_ = array->text();
    }
  }
  return scene_ ? &*scene_ : nullptr;
}

const Scene& FrameScene::of(const formats::Frame& frame) {
  const Scene* scene = find(frame);
  if (scene == nullptr)
    fail(ExitCode::bad_input, "the frame has no scene, so nothing is known of its material: make it with sheet-init, "
                              "of a scene whose [sheet] "
                              "has shape = \"mesh\" and this stream as its file");
  return *scene;
}

} // namespace sheet::scene
