// SPDX-License-Identifier: GPL-3.0-or-later
// Diagnostic looks: a quantity of the sheet in false colours, or its mesh, lit from the camera.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/quantities/fields.h"
#include "libsheet/render/draw.h"

namespace sheet::render {

// The sheet's material, its mesh, or a quantity of it.
struct Look {
  enum class Kind { material, wireframe, field };
  Kind kind = Kind::material;
  const Field* field = nullptr; // of the kind field

  [[nodiscard]] bool is_material() const { return kind == Kind::material; }
  // Whether it shows values, and so a scale or a key beside the sheet.
  [[nodiscard]] bool has_scale() const { return field != nullptr; }
  bool operator==(const Look&) const = default;
};
// Every look with its name: the material, the fields, the mesh.
[[nodiscard]] std::vector<std::pair<std::string, Look>> looks();

// The scale of false colours.
struct Scale {
  double low = 0, high = 0;
  void add(const std::vector<double>& values);
  [[nodiscard]] bool empty() const { return !(low <= high); }
  static Scale nothing();
};
// As it is drawn: as symmetric about 0 as its colours, never of no width.
[[nodiscard]] Scale widened(const Scale& scale, const Field& field);

// The colour of a palette at a place of the scale, 0 to 1: sRGB as displayed, 0 to 1.
[[nodiscard]] Colour false_colour(float place, const Palette& palette);

// What both of these draw where there is nothing but planes; and whether that is covered. The world must outlive it.
[[nodiscard]] Colour paper();
[[nodiscard]] Coverage covers_paper(const World& world);

// Draws the field's `values` (of the frame that the world was made of). The world must outlive the shader.
[[nodiscard]] Shader field_shader(const World& world, const Field& field, std::vector<double> values,
                                  const Scale& scale);

// Draws the mesh. The camera's pixel angle sets the width of the lines. The world must outlive the shader.
[[nodiscard]] Shader wireframe_shader(const World& world, double pixel_angle);

} // namespace sheet::render
