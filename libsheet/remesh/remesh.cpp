// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/remesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>

#include "libsheet/base/error.h"
#include "libsheet/remesh/operations.h"

namespace sheet::remesh {

namespace {

const double cosine_2 = cosine_of_degrees(2), cosine_15 = cosine_of_degrees(15), cosine_20 = cosine_of_degrees(20),
             cosine_22 = cosine_of_degrees(22), cosine_35 = cosine_of_degrees(35);

constexpr double repair_thickness = 1.3; // see Limits::thickness
constexpr double pocket_thickness = 4;   // likewise
constexpr double steep_pocket = 2;       // its area over that of the triangle that closes it
constexpr double narrow_notch = 0.17;    // the cosine of its angle
constexpr double flat_enough = 0.1;      // of an edge: a flip may move the surface so far at any fold
constexpr double least_gain = 0.01;      // of the cosine of the smallest angle: about one degree
constexpr double most_triangles = 1e8;
constexpr double most_pieces = 1e4; // of an edge: squared, the triangles above
constexpr int most_passes = 5, most_repairs = 3;

class Remesher {
public:
  Remesher(EditableSheet& sheet, SizeField& size, const Options& options, bool tension, double wanted_triangles)
      : sheet_(sheet), mesh_(sheet.mesh()), size_(size), options_(options), tension_(tension),
        budget_(100 +
                static_cast<std::uint64_t>(4 * (wanted_triangles + static_cast<double>(mesh_.triangle_count())))) {}

  Report run() {
    for (int pass = 0; pass < most_passes; ++pass) {
      const std::uint64_t before = report_.splits + report_.collapses;
      split_long();
      close_pockets();
      fill_notches();
      collapse_short();
      flip_all();
      if (options_.smooth)
        smooth_sharp();
      for (int round = 0; round < most_repairs && repair() > 0; ++round)
        flip_all();
      const std::uint64_t changed = report_.splits + report_.collapses - before;
      if (changed * 50 <= mesh_.triangle_count() || report_.budget_reached)
        break;
    }
    for_triangles([&](std::uint32_t t) { report_.sharp += sheet_.shape(t).sharpest > cosine_20; });
    return report_;
  }

private:
  // An edge by its length over the wanted one. Vertices outlive the edge: whoever takes it from a queue looks it up.
  struct Candidate {
    double ratio;
    std::uint32_t a, b;
    bool operator<(const Candidate& o) const {
      return ratio != o.ratio ? ratio < o.ratio : std::pair(a, b) > std::pair(o.a, o.b);
    }
    bool operator>(const Candidate& o) const {
      return ratio != o.ratio ? ratio > o.ratio : std::pair(a, b) > std::pair(o.a, o.b);
    }
  };

  [[nodiscard]] double length(std::uint32_t a, std::uint32_t b) const { return (sheet_.at(b) - sheet_.at(a)).norm(); }
  [[nodiscard]] double ratio(std::uint32_t a, std::uint32_t b) const { return length(a, b) / size_.along(a, b); }
  [[nodiscard]] double excess(std::uint32_t a, std::uint32_t b) const { return length(a, b) / size_.coarsest(a, b); }
  [[nodiscard]] std::uint32_t edge(std::uint32_t a, std::uint32_t b) const {
    if (!mesh_.has_vertex(a) || !mesh_.has_vertex(b))
      return no_index;
    const std::uint32_t side = mesh_.find_side(a, b);
    return side != no_index ? side : mesh_.find_side(b, a);
  }
  template <class Visit> void for_triangles(Visit visit) const {
    for (std::uint32_t t = 0; t < mesh_.triangle_slots(); ++t)
      if (mesh_.has_triangle(t))
        visit(t);
  }
  template <class Visit> void for_edges(Visit visit) const {
    for (std::uint32_t side = 0; side < 3 * mesh_.triangle_slots(); ++side)
      if (mesh_.has_triangle(Mesh::triangle_of(side)) && (mesh_.twin(side) == no_index || side < mesh_.twin(side)))
        visit(side);
  }
  bool within_budget() {
    report_.budget_reached = report_.budget_reached || sheet_.edits() >= budget_;
    return !report_.budget_reached;
  }
  [[nodiscard]] Limits limits(double sharpest, double facing, double thickness, double gain = 0) const {
    return {.thickness = thickness,
            .sharpest = sharpest,
            .gain = gain,
            .facing = facing,
            .intersections = options_.intersections};
  }

  bool split(std::uint32_t side) {
    const std::uint32_t a = mesh_.from(side), b = mesh_.to(side);
    propose_split(sheet_, side, edit_);
    // A midpoint in its own triangles meets nothing that they did not meet.
    if (!sheet_.make(edit_, {.thickness = 1.1, .sharpest = 1, .facing = -1, .intersections = false}))
      return false;
    size_.set_between(edit_.vertex, a, b);
    ++report_.splits;
    return true;
  }

  bool collapse(std::uint32_t side, const Limits& limits, double longest, std::uint32_t onto = no_index) {
    const std::uint32_t a = mesh_.from(side), b = mesh_.to(side);
    if (!propose_collapse(sheet_, side, most_pay * size_.along(a, b), edit_, onto))
      return false;
    for (const Corners& t : edit_.added) // what is collapsed here must not be split there
      for (const std::uint32_t v : t)
        if (v != edit_.vertex && (sheet_.at(v) - edit_.position).norm() > longest * size_.coarsest(v, edit_.vertex))
          return false;
    if (!sheet_.make(edit_, limits))
      return false;
    size_.set_between(edit_.vertex, a, b);
    ++report_.collapses;
    return true;
  }

  // Between the lines a b and c d: how far a flip moves the surface.
  [[nodiscard]] double diagonal_distance(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    const Vector3 across = (sheet_.at(b) - sheet_.at(a)).cross(sheet_.at(d) - sheet_.at(c));
    const double length = across.norm();
    return length > 0 ? std::abs(across.dot(sheet_.at(c) - sheet_.at(a))) / length : 0;
  }

  // The diagonal is turned only if that enlarges the smallest angle of the two triangles.
  bool flip(std::uint32_t side, double least_facing, double thickness) {
    const std::uint32_t twin = mesh_.twin(side);
    if (twin == no_index)
      return false;
    const TriangleShape one = sheet_.shape(Mesh::triangle_of(side)), two = sheet_.shape(Mesh::triangle_of(twin));
    const double sharpest = std::max(one.sharpest, two.sharpest);
    if (sharpest < cosine_35)
      return false;
    const std::uint32_t a = mesh_.from(side), b = mesh_.to(side), c = mesh_.apex(side), d = mesh_.apex(twin);
    if (one.normal.dot(two.normal) < least_facing && diagonal_distance(a, b, c, d) > flat_enough * size_.along(a, b))
      return false;
    const TriangleShape left(sheet_.at(a), sheet_.at(d), sheet_.at(c)), right(sheet_.at(d), sheet_.at(b), sheet_.at(c));
    if (std::max(left.sharpest, right.sharpest) > better_cosine(sharpest, least_gain))
      return false;
    if (!propose_flip(sheet_, side, edit_) || !sheet_.make(edit_, limits(1, 0, thickness)))
      return false;
    ++report_.flips;
    return true;
  }

  bool smooth(std::uint32_t v, double thickness) {
    if (!propose_smooth(sheet_, v, most_pay * size_.at(v), edit_))
      return false;
    double before = 0, after = 0;
    for (std::size_t i = 0; i < edit_.removed.size(); ++i) {
      before = std::max(before, sheet_.shape(edit_.removed[i]).sharpest);
      const Corners& c = edit_.added[i];
      after = std::max(after, TriangleShape(edit_.position, sheet_.at(c[1]), sheet_.at(c[2])).sharpest);
    }
    if (after > better_cosine(before, least_gain) || !sheet_.make(edit_, limits(1, 0.5, thickness)))
      return false;
    ++report_.smoothed;
    return true;
  }

  // Whether the proposed triangle, which closes a pocket of three, is better than they are: they stand out steeply, or
  // one of them is sharper than it.
  [[nodiscard]] bool better_closed() const {
    const Corners& c = edit_.added[0];
    const TriangleShape closed(sheet_.at(c[0]), sheet_.at(c[1]), sheet_.at(c[2]));
    double area = 0, sharpest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      area += sheet_.shape(edit_.removed[i]).area;
      sharpest = std::max(sharpest, sheet_.shape(edit_.removed[i]).sharpest);
    }
    return area > steep_pocket * closed.area || (sharpest > cosine_22 && sharpest > closed.sharpest);
  }

  // Pockets are what crumpled sheets leave of folds smaller than their edges, and what becomes of threads. The liquid
  // in them has no shape that triangles could tell: it may get much thicker, and the triangle may face anywhere.
  void close_pockets() {
    for (std::uint32_t v = 0; v < mesh_.vertex_slots() && within_budget(); ++v)
      if (mesh_.has_vertex(v) && mesh_.side_at(v) != no_index && propose_removal(sheet_, v, edit_) && better_closed() &&
          sheet_.make(edit_, limits(cosine_2, -1, pocket_thickness)))
        ++report_.collapses;
  }

  // Where two parts of a rim that flow along a wall have come nearer than edges are long, from a vertex on, the liquid
  // between them has met: what is left is no shape of the liquid, and would fold and be crushed.
  void fill_notches() {
    for (std::uint32_t v = 0; v < mesh_.vertex_slots() && within_budget(); ++v) {
      if (!mesh_.has_vertex(v) || !propose_fill(sheet_, v, edit_))
        continue;
      const Corners& notch = edit_.added.back();
      const Vector3 one = sheet_.at(notch[0]) - sheet_.at(v), other = sheet_.at(notch[2]) - sheet_.at(v);
      if (one.dot(other) > narrow_notch * one.norm() * other.norm() && ratio(notch[0], notch[2]) < split_above &&
          sheet_.make(edit_, limits(1, 0.5, repair_thickness)))
        ++report_.filled;
    }
  }

  bool absorb(std::uint32_t rim_side) {
    if (!propose_absorb(sheet_, rim_side, edit_) ||
        !sheet_.make(edit_, limits(cosine_22, 0.5, repair_thickness, least_gain)))
      return false;
    ++report_.absorbed;
    return true;
  }

  // A sliver at the rim that nothing else has cured: a lip folded over onto the sheet, or, where tension draws it in
  // before an edge could tell, a corner narrower than an edge; without tension a pointed end may be somebody's shape,
  // unless it flows along a wall.
  bool trim(std::uint32_t t) {
    if (sheet_.shape(t).sharpest < cosine_15 || !(tension_ || on_wall(t) || in_crease(t)) ||
        !propose_trim(sheet_, t, edit_) || !sheet_.make(edit_, limits(1, -1, pocket_thickness)))
      return false;
    ++report_.absorbed;
    return true;
  }

  // Whether a triangle at the side has an edge that is longer against its size: as the longest are split first, that
  // one may not be split (an inlet's strip), and halving the others would only squeeze the triangle towards it.
  [[nodiscard]] bool beside_longer(std::uint32_t side) const {
    const auto longer = [&](std::uint32_t s) {
      const double own = excess(mesh_.from(s), mesh_.to(s)) * (1 + 1e-9);
      const std::uint32_t a = mesh_.from(s), b = mesh_.to(s), c = mesh_.apex(s);
      return excess(b, c) > own || excess(c, a) > own;
    };
    return longer(side) || (mesh_.twin(side) != no_index && longer(mesh_.twin(side)));
  }

  void split_long() {
    std::priority_queue<Candidate> queue; // longest first
    const auto push = [&](std::uint32_t a, std::uint32_t b) {
      if (const double r = excess(a, b); r > split_above)
        queue.push({r, a, b});
    };
    for_edges([&](std::uint32_t side) { push(mesh_.from(side), mesh_.to(side)); });
    while (!queue.empty() && within_budget()) {
      const Candidate longest = queue.top();
      queue.pop();
      const std::uint32_t side = edge(longest.a, longest.b);
      if (side == no_index || beside_longer(side) || !split(side))
        continue;
      const std::uint32_t m = edit_.vertex;
      mesh_.for_neighbours(m, [&](std::uint32_t w) { push(m, w); });
    }
  }

  void collapse_short() {
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue; // shortest first
    const auto push = [&](std::uint32_t a, std::uint32_t b) {
      if (const double r = ratio(a, b); r < collapse_below)
        queue.push({r, a, b});
    };
    for_edges([&](std::uint32_t side) { push(mesh_.from(side), mesh_.to(side)); });
    while (!queue.empty() && within_budget()) {
      const Candidate shortest = queue.top();
      queue.pop();
      const std::uint32_t side = edge(shortest.a, shortest.b);
      if (side == no_index || ratio(shortest.a, shortest.b) >= collapse_below)
        continue;
      if (!collapse(side, limits(cosine_22, 0.3, 1.1), split_above))
        continue;
      const std::uint32_t kept = edit_.vertex;
      mesh_.for_neighbours(kept, [&](std::uint32_t w) { push(kept, w); });
    }
  }

  void flip_all() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> stack;
    for_edges([&](std::uint32_t side) {
      if (mesh_.twin(side) != no_index)
        stack.emplace_back(mesh_.from(side), mesh_.to(side));
    });
    std::reverse(stack.begin(), stack.end());
    while (!stack.empty() && within_budget()) {
      const auto [a, b] = stack.back();
      stack.pop_back();
      const std::uint32_t side = mesh_.find_side(a, b);
      if (side == no_index || !flip(side, 0.94, 1.1)) // 20 degrees
        continue;
      for (const Corners& t : edit_.added)
        for (std::size_t i = 0; i < 3; ++i)
          stack.emplace_back(t[i], t[(i + 1) % 3]);
    }
  }

  void smooth_sharp() {
    for (std::uint32_t v = 0; v < mesh_.vertex_slots() && within_budget(); ++v) {
      if (!mesh_.has_vertex(v) || mesh_.side_at(v) == no_index || mesh_.on_rim(v))
        continue;
      double sharpest = 0;
      mesh_.for_fan(v, [&](std::uint32_t side) {
        sharpest = std::max(sharpest, sheet_.shape(Mesh::triangle_of(side)).sharpest);
      });
      if (sharpest > cosine_35)
        static_cast<void>(smooth(v, 1.1));
    }
  }

  // Each bad triangle gets the first of these that helps: its longest edge flipped, its shortest or another one
  // collapsed, a flat one at the rim absorbed, its corners moved. Returns how many were helped.
  std::uint64_t repair() {
    std::vector<std::uint32_t> bad;
    for_triangles([&](std::uint32_t t) {
      if (sheet_.shape(t).sharpest > cosine_22)
        bad.push_back(t);
    });
    std::uint64_t helped = 0;
    for (const std::uint32_t t : bad) {
      if (!within_budget())
        break;
      if (mesh_.has_triangle(t) && sheet_.shape(t).sharpest > cosine_22)
        helped += help(t);
    }
    return helped;
  }

  bool help(std::uint32_t t) {
    std::array<std::uint32_t, 3> sides = {3 * t, 3 * t + 1, 3 * t + 2};
    std::sort(sides.begin(), sides.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(length(mesh_.from(a), mesh_.to(a)), a) < std::pair(length(mesh_.from(b), mesh_.to(b)), b);
    });
    const Corners corners = mesh_.corners(t);
    if (flip(sides[2], 0.5, repair_thickness))
      return true;
    for (const std::uint32_t side : sides)
      if (collapse(side, limits(cosine_22, 0, repair_thickness, least_gain), 1.3 * split_above))
        return true;
    if (mesh_.twin(sides[2]) == no_index && absorb(sides[2]))
      return true;
    bool moved = false;
    for (const std::uint32_t v : corners)
      moved = smooth(v, repair_thickness) || moved;
    return moved || collapse_to_an_end(t) || trim(t);
  }

  [[nodiscard]] bool on_wall(std::uint32_t t) const {
    return std::ranges::all_of(mesh_.corners(t), [&](std::uint32_t v) { return sheet_.wall(v) != no_index; });
  }

  // Whether the sheet turns by more than 60 degrees at one of its sides.
  [[nodiscard]] bool in_crease(std::uint32_t t) const {
    return std::ranges::any_of(std::array{3 * t, 3 * t + 1, 3 * t + 2}, [&](std::uint32_t side) {
      const std::uint32_t twin = mesh_.twin(side);
      return twin != no_index && sheet_.shape(t).normal.dot(sheet_.shape(Mesh::triangle_of(twin)).normal) < 0.5;
    });
  }

  // In a crease the point that is best for the volume lies outside, and would turn triangles over.
  bool collapse_to_an_end(std::uint32_t t) {
    if (sheet_.shape(t).sharpest < cosine_15 || !in_crease(t))
      return false;
    const Corners corners = mesh_.corners(t);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = corners[i], b = corners[(i + 1) % 3];
      for (const std::uint32_t end : {a, b})
        if (collapse(mesh_.find_side(a, b), limits(cosine_15, -1, repair_thickness, least_gain), 1.3 * split_above,
                     end))
          return true;
    }
    return false;
  }

  static constexpr double most_pay = 0.02; // of an edge: how far a vertex moves at most to pay back swept volume
  EditableSheet& sheet_;
  const Mesh& mesh_;
  SizeField& size_;
  const Options& options_;
  bool tension_;
  std::uint64_t budget_;
  Edit edit_;
  Report report_;
};

// Triangles of a mesh of the wanted size: equilateral ones cover sqrt(3)/4 l².
double wanted_triangles(const EditableSheet& sheet, const SizeField& size) {
  double sum = 0;
  for (std::uint32_t t = 0; t < sheet.mesh().triangle_slots(); ++t) {
    const Corners& c = sheet.mesh().corners(t);
    const double length = std::min({size.at(c[0]), size.at(c[1]), size.at(c[2])});
    sum += sheet.shape(t).area / (std::sqrt(3.0) / 4 * length * length);
  }
  return sum;
}

// A vertex far away, as a step that has gone wrong leaves it, would be reached by needles of millions of pieces.
void check_lengths(const EditableSheet& sheet, const SizeField& size) {
  for (std::uint32_t t = 0; t < sheet.mesh().triangle_slots(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = sheet.mesh().corners(t)[i], b = sheet.mesh().corners(t)[(i + 1) % 3];
      const Vector3 &x = sheet.at(a), &y = sheet.at(b);
      const double length = (y - x).norm(), wanted = std::min(size.at(a), size.at(b));
      if (!(length <= most_pieces * wanted))
        fail(
            ExitCode::bad_input,
            "the edge from vertex {} at ({:.6g}, {:.6g}, {:.6g}) to vertex {} at ({:.6g}, {:.6g}, {:.6g}) is {:.3g} m "
            "long, more than {:g} times the edges of {:g} m asked for: the sheet has blown up (shorter steps help), or "
            "ask for longer edges",
            a, x.x(), x.y(), x.z(), b, y.x(), y.y(), y.z(), length, most_pieces, wanted);
    }
}

} // namespace

Report& Report::operator+=(const Report& later) {
  splits += later.splits;
  collapses += later.collapses;
  flips += later.flips;
  smoothed += later.smoothed;
  filled += later.filled;
  absorbed += later.absorbed;
  sharp = later.sharp;
  budget_reached = later.budget_reached;
  return *this;
}

Report remesh(formats::Frame& frame, const Scene* scene, const Options& options) {
  options.size.check();
  if (frame.triangles == 0)
    return {};
  EditableSheet sheet(frame, scene);
  SizeField size(sheet, scene, options.size);
  const double wanted = wanted_triangles(sheet, size);
  if (!(wanted <= most_triangles))
    fail(ExitCode::usage,
         "edges of {:g} m would cut this sheet into {:.2g} triangles, more than {:.2g}: ask for longer edges",
         size.shortest(), wanted, most_triangles);
  check_lengths(sheet, size);
  const bool tension = scene != nullptr && std::ranges::any_of(liquids_of(*scene), [](const Liquid& liquid) {
                         return liquid.surface_tension > 0;
                       });
  const Report report = Remesher(sheet, size, options, tension, wanted).run();
  sheet.put(frame);
  return report;
}

} // namespace sheet::remesh
