// SPDX-License-Identifier: GPL-3.0-or-later
// How long edges shall be, at each vertex [m]: the same everywhere, or by what the sheet does.
#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "libsheet/remesh/editable_sheet.h"
#include "libsheet/scene/scene.h"

namespace sheet::remesh {

// Edges longer than this times the wanted length are split, those shorter than that are collapsed.
inline constexpr double split_above = 1.4, collapse_below = 0.6;

struct SizeOptions {
  double edge_length = 0;                   // [m], positive; with `chord_error` only the bounds' default
  std::optional<double> chord_error;        // adaptive: the distance that an edge may have from the curved sheet [m]
  std::optional<double> min_edge, max_edge; // bounds [m]; absent: edge_length; adaptive: a quarter, four times
  std::vector<double> scale;                // at vertices: factors on all these lengths; empty: 1
  std::vector<double> inner_faces;          // at vertices: how many of their faces, 0 to 2, lie on layers that flow
                                            // with them (scene/inner_faces.h); empty: none
  // Error(usage) if a value is not positive and finite, or the upper bound is below twice the lower one while adaptive.
  void check() const;
  // The least edge that a strip gets [m].
  [[nodiscard]] double shortest_in_strips() const;
};

// Lengths are `edge_length`, or adaptive ones, times `scale`. Adaptive length at a vertex, the least of these, but
// not below h, within the bounds, growing by at most 0.4 of the distance:
// - sqrt(8 ε / |k|): chord error of the largest principal curvature k [Cohen-Steiner, Morvan 2003], at rims also of
// theirs;
// - proportional to g^-½, g how unevenly the sheet stretches and bends (flow_error.h), so that triangles, as many as
//   there would be with edges of `edge_length` everywhere, stand where they make the flow's error least; at rest
//   `edge_length`;
// - l τ h / |Δh|: the jump of the thickness, where no layer that flows with it lies on either face: a pile moves as one
//   body, however uneven its layers are;
// - an eighth of a wave about to buckle (buckling.h), which also gets its share beforehand.
// What has layers that flow with it on both faces needs no edges below `edge_length`: it moves as a part of the pile.
//
// A strip from rim to rim (strip_width.h) gets a row of good triangles of its own: edges of twice its width at most,
// which need no angle below 19 degrees as long as they are not split, but not below h, nor below `min_edge`, absent: an
// sixteenth of `edge_length`, growing as above. Where tension makes rims round ([model] faces) such strips are threads,
// and get good triangles: edges of 1.5 times the width, down to h/2. A strand of two rows that is as thick as it is
// wide, and six times as long, gets such edges also where shorter ones are asked for, unless lengths are adaptive: of
// one row it has no noise of its mesh, of two, between uneven triangles, it thins twice as fast as it should (V47).
// Likewise a neck (necks.h), its width that of the least of the edges round it; but as long edges as its triangles need
// to carry a hundredth of what triangles do in the mean.
//
// A layer on the one wall along which it flows has edges of half its thickness at least, growing as above, unless
// lengths are adaptive: columns of liquid that are higher than wide fold over each other where it is pushed together.
//
// Where some of the sheet is thicker than the longest wanted length, no edge is split that is not too long for h, too,
// where nothing holds the sheet and no solid carries it: a shell model says nothing about what is shorter.
class SizeField {
public:
  SizeField(const EditableSheet& sheet, const Scene* scene, const SizeOptions& options);
  [[nodiscard]] double at(std::uint32_t v) const { return size_.empty() ? uniform_ : size_[v]; }
  [[nodiscard]] double along(std::uint32_t a, std::uint32_t b) const { return 0.5 * (at(a) + at(b)); }
  // What an edge is measured by before it is split: the wanted length, or what the sheet is thick.
  [[nodiscard]] double coarsest(std::uint32_t a, std::uint32_t b) const {
    return thick_.empty() ? along(a, b) : std::max(along(a, b), 0.5 * (thick_[a] + thick_[b]));
  }
  [[nodiscard]] double shortest() const;
  // A vertex between two others, or one that takes the place of two.
  void set_between(std::uint32_t v, std::uint32_t a, std::uint32_t b);

private:
  void adapt(const EditableSheet& sheet, const Scene* scene, const SizeOptions& options);
  void fit_strips(const EditableSheet& sheet, const SizeOptions& options, bool round);
  void multiply(const EditableSheet& sheet, const std::vector<double>& scale);
  void coarsen_deep_layers(const EditableSheet& sheet);
  void note_thick(const EditableSheet& sheet, double longest);

  double uniform_;
  std::vector<double> size_;  // empty: uniform_ everywhere
  std::vector<double> thick_; // thickness where it counts, 0 elsewhere [m]; empty: nowhere above the longest length
};

} // namespace sheet::remesh
