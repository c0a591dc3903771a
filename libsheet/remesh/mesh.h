// SPDX-License-Identifier: GPL-3.0-or-later
// Connectivity that can be edited: an oriented triangle manifold with rims, without pinched vertices. Numbers of
// vertices and triangles are slots: they stay while others come and go, and freed ones are used again.
//
// Side s = 3 t + i of triangle t goes from its corner i to its corner i + 1, counter-clockwise; its twin runs the other
// way in the neighbour. The sides out of a vertex, counter-clockwise from side_at(v), are its fan; at a rim the fan
// starts at the side on the rim.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/sheet/sheet.h"

namespace sheet::remesh {

class Mesh {
public:
  // Errors: bad_input for indices out of range, repeated corners, edges of three or more triangles, triangles of
  // opposite orientation, pinched vertices.
  Mesh(std::size_t vertices, std::span<const Corners> triangles);

  [[nodiscard]] std::size_t vertex_slots() const { return side_at_.size(); }
  [[nodiscard]] std::size_t triangle_slots() const { return corners_.size(); }
  [[nodiscard]] std::size_t triangle_count() const { return triangles_; }
  // False: the slot is free. A vertex without triangles lives until it is removed.
  [[nodiscard]] bool has_triangle(std::uint32_t t) const { return corners_[t][0] != no_index; }
  [[nodiscard]] bool has_vertex(std::uint32_t v) const { return lives_[v]; }

  [[nodiscard]] const Corners& corners(std::uint32_t t) const { return corners_[t]; }
  [[nodiscard]] std::span<const Corners> triangles() const { return corners_; } // of all slots
  [[nodiscard]] static std::uint32_t triangle_of(std::uint32_t side) { return side / 3; }
  [[nodiscard]] static std::uint32_t next(std::uint32_t side) { return side % 3 == 2 ? side - 2 : side + 1; }
  [[nodiscard]] static std::uint32_t previous(std::uint32_t side) { return side % 3 == 0 ? side + 2 : side - 1; }
  [[nodiscard]] std::uint32_t from(std::uint32_t side) const { return corners_[side / 3][side % 3]; }
  [[nodiscard]] std::uint32_t to(std::uint32_t side) const { return from(next(side)); }
  [[nodiscard]] std::uint32_t apex(std::uint32_t side) const { return from(previous(side)); }
  [[nodiscard]] std::uint32_t twin(std::uint32_t side) const { return twin_[side]; } // none on a rim
  [[nodiscard]] std::uint32_t side_at(std::uint32_t v) const { return side_at_[v]; } // none: v has no triangle
  [[nodiscard]] bool on_rim(std::uint32_t v) const { return side_at_[v] != no_index && twin_[side_at_[v]] == no_index; }

  // The next side out of the same vertex, counter-clockwise; none behind the last at a rim.
  [[nodiscard]] std::uint32_t turn(std::uint32_t side) const { return twin_[previous(side)]; }
  // visit(side) for each side out of v, counter-clockwise.
  template <class Visit> void for_fan(std::uint32_t v, Visit visit) const {
    const std::uint32_t start = side_at_[v];
    for (std::uint32_t side = start; side != no_index;) {
      visit(side);
      side = turn(side);
      if (side == start)
        break;
    }
  }
  // visit(w) for each neighbour of v.
  template <class Visit> void for_neighbours(std::uint32_t v, Visit visit) const {
    for_fan(v, [&](std::uint32_t side) {
      visit(to(side));
      if (twin_[previous(side)] == no_index)
        visit(from(previous(side)));
    });
  }
  [[nodiscard]] std::uint32_t find_side(std::uint32_t a, std::uint32_t b) const; // from a to b; none if there is none
  [[nodiscard]] bool adjacent(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] std::size_t degree(std::uint32_t v) const; // number of triangles

  // A vertex without triangles, in the slot that next_vertex() foretold; one that is removed must have none.
  [[nodiscard]] std::uint32_t next_vertex() const { return static_cast<std::uint32_t>(side_at_.size()); }
  std::uint32_t add_vertex();
  void remove_vertex(std::uint32_t v);

  // Takes triangles away and puts others into the hole, whose slots it returns in `slots`. Sides meet by their
  // vertices. Precondition: the result is an oriented manifold without pinched vertices.
  void replace(std::span<const std::uint32_t> removed, std::span<const Corners> added,
               std::vector<std::uint32_t>& slots);

private:
  std::vector<Corners> corners_;
  std::vector<std::uint32_t> twin_, side_at_, free_triangles_;
  std::vector<bool> lives_;
  std::size_t triangles_ = 0;
  struct Open {
    std::uint32_t from, to, twin;
  };
  std::vector<Open> open_; // of replace
};

} // namespace sheet::remesh
