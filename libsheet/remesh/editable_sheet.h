// SPDX-License-Identifier: GPL-3.0-or-later
// A sheet whose mesh is being edited. Each edit is checked, then made: connectivity, volumes (thickness.h), velocities
// (velocity.h), directors (side_directors.h), and every other array by its transfer rule. Sums over the sheet that no
// edit changes: volume, momentum of free vertices, amounts (rule conserve), and enclosed volume less what the vertices'
// ledgers hold (swept()).
#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "libsheet/geometry/overlap.h"
#include "libsheet/geometry/triangle_grid.h"
#include "libsheet/remesh/edit.h"
#include "libsheet/remesh/side_directors.h"
#include "libsheet/remesh/thickness.h"
#include "libsheet/remesh/triangle_shape.h"
#include "libsheet/remesh/velocity.h"
#include "libsheet/scene/scene.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::remesh {

// What an edit must keep to.
struct Limits {
  double thickness = 1.1; // largest factor by which an edit may change thickness beyond the old range
  // Cosine of the smallest angle that new triangles may have; where the old ones had a smaller angle, one that is
  // better by that gain (better_cosine).
  double sharpest = 1;
  double gain = 0;
  double facing = 0;         // least cosine between a triangle's normal and its former one, or the mean of the old ones
  bool intersections = true; // new triangles must not intersect others
};

class EditableSheet {
public:
  // Copies what it needs from the frame. `scene`, which outlives this, says which axes its holds hold; without it they
  // hold all. Errors: bad_input as Mesh.
  explicit EditableSheet(const formats::Frame& frame, const Scene* scene = nullptr);

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }
  [[nodiscard]] const std::vector<Vector3>& positions() const { return position_; }
  [[nodiscard]] const Vector3& at(std::uint32_t v) const { return position_[v]; }
  [[nodiscard]] const TriangleShape& shape(std::uint32_t t) const { return shape_[t]; }
  [[nodiscard]] double volume(std::uint32_t t) const { return volume_[t]; }
  [[nodiscard]] double temperature(std::uint32_t t) const;                           // [K]; 0: there is none
  [[nodiscard]] std::uint32_t liquid(std::uint32_t t) const;                         // its number
  [[nodiscard]] std::span<const double> triangle_volumes() const { return volume_; } // of all slots
  [[nodiscard]] Vector3 velocity(std::uint32_t v) const { return velocity_.empty() ? Vector3::Zero() : velocity_[v]; }
  // Of a third of each triangle around v [m³].
  [[nodiscard]] double carried(std::uint32_t v) const { return carried_[v]; }
  // What holds a vertex: any array with the rule common (hold, touch, ...). True if whatever holds u holds v, too.
  [[nodiscard]] bool held_within(std::uint32_t u, std::uint32_t v) const;
  // Whether it is a solid that it touches, and nothing else.
  [[nodiscard]] bool held_by_touch(std::uint32_t v) const { return grips_[grip(v)].by_touch; }
  [[nodiscard]] bool free(std::uint32_t v) const { return grip(v) == 0; } // of all that
  // The solid along which it flows, if that is the only one that it touches; else no_index.
  [[nodiscard]] std::uint32_t wall(std::uint32_t v) const { return grips_[grip(v)].wall; }
  [[nodiscard]] bool held_alike(std::uint32_t u, std::uint32_t v) const { return grip(u) == grip(v); }
  // The coordinates in which a vertex is held.
  [[nodiscard]] Axes held_axes(std::uint32_t v) const { return grips_[grip(v)].axes; }
  [[nodiscard]] bool fixed(std::uint32_t v) const { return held_axes(v) == all_axes; }
  // Whether the frame marks a vertex as one of an inlet's strip (inlet.h).
  [[nodiscard]] bool at_inlet(std::uint32_t v) const { return v < at_inlet_.size() && at_inlet_[v]; }
  // A triangle of the strip: all its corners are marked.
  [[nodiscard]] bool in_strip(std::uint32_t t) const;
  // By how much edits at this vertex have made the enclosed volume grow, not yet paid back [m³].
  [[nodiscard]] double swept(std::uint32_t v) const { return swept_[v]; }

  // Makes the edit, unless it breaks the limits or makes a triangle without area; then nothing changes. Where the edit
  // has no overlap yet, it is found by projecting the patch along its mean normal. Triangles of an inlet's strip
  // (inlet.h) stay as they are.
  [[nodiscard]] bool make(Edit& edit, const Limits& limits);
  [[nodiscard]] std::uint64_t edits() const { return edits_; }

  // The frame with the edited mesh; untouched if there was no edit.
  void put(formats::Frame& frame);

private:
  [[nodiscard]] bool check_shapes(const Edit& edit, const Limits& limits);
  void flatten_old(const Edit& edit, const PlaneFrame& plane);
  void find_overlap(Edit& edit, const PlaneFrame& plane, bool given);
  void find_all_rises(std::span<const ValueSlope> slopes, std::size_t new_count, std::vector<double>& rise);
  [[nodiscard]] bool degenerate(const Corners& corners, const TriangleShape& shape) const;
  [[nodiscard]] bool intersects(const Edit& edit);
  void place(const Edit& edit);
  void commit(const Edit& edit);
  void write_vertex_rows(const Edit& edit);
  void write_triangle_rows(const Edit& edit);
  // What is new between parents that each flow along a solid is on one of those: row_, its row of `touch`.
  void keep_on_walls(formats::Array& touch, std::span<const Parent> parents);
  void write_means(const Edit& edit);
  void make_grid();
  [[nodiscard]] Box box_of(const Corners& corners) const;
  struct Grip {
    std::vector<std::byte> masks; // one after the other
    Axes axes = 0;
    std::uint32_t wall = no_index; // the one solid that it touches, if liquid flows along that
    bool by_touch = false;         // and by nothing else
  };
  [[nodiscard]] std::uint32_t grip(std::uint32_t v) const { return grip_.empty() ? 0 : grip_[v]; }
  [[nodiscard]] std::uint32_t grip_of(std::uint32_t v);
  [[nodiscard]] Axes axes_of(std::uint32_t v);
  [[nodiscard]] double carried_volume(std::uint32_t v) const;

  const Scene* scene_;
  Mesh mesh_;
  std::vector<Vector3> position_, velocity_; // velocity_: empty in a frame at rest
  std::vector<double> volume_, swept_, carried_;
  std::vector<TriangleShape> shape_;
  SideDirectors directors_;
  std::vector<std::uint32_t> grip_;                         // of vertices, indices of grips_; empty: nothing is held
  std::vector<Grip> grips_ = std::vector<Grip>(1);          // the first: free
  std::vector<bool> at_inlet_;                              // marked vertices of the frame; empty: there is no inlet
  std::vector<formats::Array> vertex_rows_, triangle_rows_; // all other arrays, by slot
  struct Mean {
    std::size_t array; // of triangle_rows_
    std::uint32_t component;
    std::vector<ValueSlope> slopes; // of the old triangles, scratch of make()
  };
  std::vector<Mean> means_;                        // numbers of triangles with the rule mean
  std::size_t temperature_ = none, liquid_ = none; // of triangle_rows_
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<std::uint32_t> successor_; // of removed vertices; itself: still there
  std::optional<TriangleGrid> grid_;
  std::uint64_t edits_ = 0;

  // scratch of make()
  std::vector<TriangleShape> old_shapes_, new_shapes_;
  std::vector<double> old_areas_, new_areas_, old_volumes_;
  std::vector<FlatTriangle> old_flat_, new_flat_;
  std::vector<ValueSlope> slopes_;    // of the old triangles' thickness
  std::vector<Eigen::Vector2d> ways_; // from the middles of old triangles to what new ones cover of them
  std::vector<double> rises_, column_;
  std::vector<std::uint32_t> patch_, slots_;
  std::vector<std::byte> row_;
  std::vector<MovingVertex> moving_;
  Vector3 facing_ = Vector3::Zero(); // mean normal of the old patch
  Vector3 old_position_ = Vector3::Zero();
};

} // namespace sheet::remesh
