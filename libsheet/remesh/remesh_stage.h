// SPDX-License-Identifier: GPL-3.0-or-later
// The stage sheet-remesh.
#pragma once
#include <optional>
#include <string>

#include "libsheet/remesh/remesh.h"

namespace sheet::remesh {

class RemeshStage {
public:
  // Error(usage) if the options say something impossible.
  explicit RemeshStage(const Options& options);
  void remesh(formats::Frame& frame); // errors as remesh::remesh; a scene that cannot be read: bad_input
  void report() const;                // with -v: how many edits of each kind, over all frames

private:
  Options options_;
  std::string scene_text_;
  std::optional<Scene> scene_;
  Report total_;
  std::uint64_t frames_ = 0;
};

} // namespace sheet::remesh
