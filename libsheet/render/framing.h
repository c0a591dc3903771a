// SPDX-License-Identifier: GPL-3.0-or-later
// What there is to see in the frames that will be drawn, so that camera, ground and scale of a film stand still.
#pragma once
#include <limits>
#include <vector>

#include "libsheet/geometry/box.h"
#include "libsheet/render/looks.h"
#include "libsheet/render/solids.h"

namespace sheet::render {

// A box and the cameras, each with a direction of its own, that see all of some things.
struct Extent {
  Box box; // [m]
  std::vector<ViewFit> views;
  void add(const Vector3& center, double radius);
  void add(const Extent& other);
};

class Survey {
public:
  explicit Survey(const std::vector<ViewFit>& empty) : sheet_{{}, empty}, solids_{{}, empty} {}
  // `meshes`: of the frame's scene.
  void add(const formats::Frame& frame, const Scene* scene, const std::vector<SolidMesh>& meshes, Look look);
  // What the picture is about: the sheet, with half its thickness to all sides, and the finite solids unless they are
  // more than 4 times as large. Where nothing takes up what comes off the solids and [[hold]]s, liquid that has fallen
  // farther below them than they and the sheet (the root of its area) are large does not count, unless it still hangs
  // from what is held. Its box is empty if there is nothing at all.
  [[nodiscard]] Extent subject() const;
  [[nodiscard]] bool has_solids_in_picture() const;           // it is about these, too, or there are none
  [[nodiscard]] const Scale& scale() const { return scale_; } // of the look's values

private:
  Extent sheet_, solids_;
  Box held_;                                                     // what [[hold]]s have borne so far
  double lowest_held_ = std::numeric_limits<double>::infinity(); // of that, upward [m]
  Scale scale_ = Scale::nothing();
};

// The scene's upward direction; y without gravity or scene.
[[nodiscard]] Vector3 up_of(const Scene* scene);

// A ground for a scene that has no plane of its own, a little below the subject.
[[nodiscard]] Plane ground_below(const Box& subject, const Vector3& up);

// Whether a plane of the scene slopes, as one that goes down into a bath does.
[[nodiscard]] bool has_shore(const Scene& scene);

// The surface of a bath whose level [m] is measured along `up`; a little below the subject where that lies deeper, for
// the sheet displaces the bath, unless there is a shore: what runs down that goes under.
[[nodiscard]] Plane bath_surface(double level, const Box& subject, const Vector3& up, bool shore);

} // namespace sheet::render
