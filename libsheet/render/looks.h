// SPDX-License-Identifier: GPL-3.0-or-later
// Diagnostic looks: a quantity of the sheet in false colours, or its mesh, lit from the camera.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/render/draw.h"

namespace sheet::render {

enum class Look { material, thickness, curvature, speed, contacts, wireframe };
[[nodiscard]] const std::vector<std::string>& look_names();
// Whether it shows values, and so a scale or a key beside the sheet.
[[nodiscard]] bool has_scale(Look look);

// What a look shows, one value a triangle or one a vertex.
//   thickness  volume / area of each triangle [m], as sheet-info measures it
//   curvature  mean curvature at vertices [1/m], positive where the sheet bends away from its positive side:
//              H = Σ l β / (4 A), over the edges that meet there, l their lengths, β the angles between the normals at
//              them, A a third of the area around the vertex [Cohen-Steiner and Morvan 2003]; at the rim 0
//   speed      |velocity| at vertices [m/s]
//   contacts   at vertices: 0 none, 1 touches a solid, 2 has a contact spring
struct Values {
  bool per_triangle = false;
  std::vector<double> values;
};
[[nodiscard]] Values values_of(const formats::Frame& frame, Look look);

// The scale of false colours.
struct Scale {
  double low = 0, high = 0;
  void add(const Values& values);
  [[nodiscard]] bool empty() const { return !(low <= high); }
  static Scale nothing();
};
// As it is drawn: curvature symmetric about 0, never of no width.
[[nodiscard]] Scale widened(const Scale& scale, Look look);

// The colour at a place of the scale, 0 to 1: sRGB as displayed, 0 to 1. Dark to light for amounts, two-sided for
// curvature, three fields for contacts.
[[nodiscard]] Colour false_colour(float place, Look look);

// Draws `values` (of the frame that the world was made of). The camera's pixel angle sets the width of a wireframe's
// lines. The world must outlive the shader.
[[nodiscard]] Shader look_shader(const World& world, Look look, Values values, const Scale& scale, double pixel_angle);

} // namespace sheet::render
