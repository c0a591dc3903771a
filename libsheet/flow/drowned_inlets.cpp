// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/drowned_inlets.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "libsheet/flow/crossings.h"
#include "libsheet/flow/inlet.h"
#include "libsheet/geometry/area.h"
#include "libsheet/scene/inlet_depth.h"
#include "libsheet/scene/prescribed.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::flow {

namespace {

// How far the layer is looked at: what enters is pushed against it, and is thinner than it for some rows.
constexpr int rows_before = 4;
constexpr double fastest = 1.05; // by how much a depth may change in a step

// The liquid before each vertex of a border, row by row: triangles belong to the nearest one.
class Columns {
public:
  Columns(std::span<const Vector3> origins, const InletChain& chain)
      : closed_(chain.closed), rows_(rows_before, std::vector<Part>(chain.border.size())) {
    for (const std::uint32_t v : chain.border)
      feet_.push_back(origins[v]);
  }

  void add(int row, const Vector3& middle, double volume, double area) {
    const auto distance = [&](const Vector3& foot) { return (foot - middle).squaredNorm(); };
    const auto i = std::ranges::min_element(feet_, {}, distance) - feet_.begin();
    rows_[static_cast<std::size_t>(row)][static_cast<std::size_t>(i)].add({volume, area}, 1);
  }

  // The greatest mean thickness of a row before the i-th vertex, with half of what is before its neighbours; at the
  // ends, beside which liquid runs away, that of all rows [m]. 0 where nothing lies.
  [[nodiscard]] double depth(std::size_t i) const {
    const std::size_t n = feet_.size();
    double greatest = 0;
    Part all;
    for (const std::vector<Part>& row : rows_) {
      Part part = row[i];
      if (closed_ || i > 0)
        part.add(row[(i + n - 1) % n], 0.5);
      if (closed_ || i + 1 < n)
        part.add(row[(i + 1) % n], 0.5);
      greatest = std::max(greatest, part.thickness());
      all.add(part, 1);
    }
    return !closed_ && (i == 0 || i + 1 == n) ? all.thickness() : greatest;
  }

private:
  struct Part {
    double volume = 0, area = 0;

    void add(const Part& other, double share) {
      volume += share * other.volume;
      area += share * other.area;
    }
    [[nodiscard]] double thickness() const { return area > 0 ? volume / area : 0; }
  };

  bool closed_;
  std::vector<Vector3> feet_;
  std::vector<std::vector<Part>> rows_; // for each its parts, by vertex
};

// What lies before a chain of an inlet.
struct LayerBefore {
  std::vector<double> depths;   // at each vertex of the border [m]
  std::int32_t wall = no_solid; // on which it lies; none: nothing does
};

class Drowning {
public:
  Drowning(formats::Frame& frame, const Scene& scene, const solid::Solids& solids, std::size_t number)
      : frame_(frame), scene_(scene), solids_(solids), number_(number), chains_(find_inlet(frame, number)) {}

  void run() {
    for (const InletChain& chain : chains_)
      if (!chain.row.empty())
        drown(chain);
    if (drowned_ > 0)
      scene::put_inlet_depth(frame_, scene_, number_, drowned_ / dry_);
  }

private:
  [[nodiscard]] std::span<Vector3> origins() const { return frame_.find("inlet_origin")->values<Vector3>(); }

  // Depths change by a factor of at most `fastest`; where the strip would meet what has come to lie there, none does.
  void drown(const InletChain& chain) {
    const LayerBefore layer = layer_before(chain);
    if (layer.wall == no_solid)
      return;
    const std::vector<double> before = scene::inlet_depths(frame_, scene_, number_, chain.border);
    std::vector<double> depths;
    for (std::size_t i = 0; i < before.size(); ++i)
      depths.push_back(std::clamp(std::max(thickness(), layer.depths[i]), before[i] / fastest, before[i] * fastest));
    if (depths != before) {
      raise(chain, layer.wall, before, depths);
      if (crosses()) {
        raise(chain, layer.wall, depths, before);
        depths = before;
      } else
        scene::put_inlet_depths(frame_, scene_, number_, chain.border, depths);
    }
    add_fluxes(chain, layer.wall, depths);
    if (std::ranges::any_of(depths, [&](double depth) { return depth > thickness(); }))
      put_on(chain, layer.wall);
  }

  // The strip touches the wall, even where the scene has it a little above: what has just entered would hang in the air
  // beside the layer, without drag and weight, until it has fallen.
  void put_on(const InletChain& chain, std::int32_t wall) {
    std::vector<std::int32_t> touched = touched_solids(frame_, scene_.solids.size());
    for (const auto* vertices : {&chain.border, &chain.row})
      for (const std::uint32_t v : *vertices)
        touched[v] = wall;
    put_touched_solids(frame_, touched, scene_.solids.size());
  }

  // What flows in at the scene's velocity with these depths, and what with the inflow's thickness and the strip not
  // raised.
  void add_fluxes(const InletChain& chain, std::int32_t wall, std::span<const double> depths) {
    const scene::InletVelocity velocity = scene::inlet_velocity(scene_, scene_.inflows[number_]);
    const auto at = [&](std::size_t i) -> const Vector3& { return origins()[chain.border[i]]; };
    const auto dry = [&](std::size_t i) -> Vector3 {
      return at(i) - 0.5 * (depths[i] - thickness()) * out_of(wall, at(i));
    };
    for (std::size_t i = 0; i < chain.edges(); ++i) {
      const std::size_t next = chain.after(i);
      const Vector3 u = velocity.at(frame_.time, 0.5 * (at(i) + at(next)));
      drowned_ += 0.5 * (depths[i] + depths[next]) * (at(next) - at(i)).cross(u).norm();
      dry_ += (dry(next) - dry(i)).cross(u).norm();
    }
  }

  [[nodiscard]] double thickness() const { return scene_.inflows[number_].thickness; }

  [[nodiscard]] Vector3 out_of(std::int32_t wall, const Vector3& x) const {
    return solids_.at(static_cast<std::size_t>(wall), x, frame_.time).normal;
  }

  [[nodiscard]] LayerBefore layer_before(const InletChain& chain) const {
    const auto bits = masks(frame_, "inlet");
    const auto x = positions(frame_);
    const std::vector<std::int32_t> touched = touched_solids(frame_, scene_.solids.size());
    const auto flows = [&](std::uint32_t v) {
      return of_inlet(bits[v], number_) == 0 && touched[v] != no_solid &&
             scene_.solids[static_cast<std::size_t>(touched[v])].contact == SolidContact::flow;
    };
    std::vector<bool> reached(frame_.vertices, false); // by the rows so far
    for (const std::uint32_t v : chain.row)
      reached[v] = true;
    LayerBefore layer;
    Columns columns(origins(), chain);
    for (int row = 0; row < rows_before; ++row) {
      std::vector<std::uint32_t> next;
      for (std::size_t t = 0; t < frame_.triangles; ++t) {
        const Corners& c = triangles(frame_)[t];
        const auto known = std::ranges::count_if(c, [&](std::uint32_t v) { return reached[v]; });
        if (known == 0 || known == 3 ||
            !std::ranges::all_of(c, [&](std::uint32_t v) { return reached[v] || flows(v); }))
          continue;
        columns.add(row, (x[c[0]] + x[c[1]] + x[c[2]]) / 3, volumes(frame_)[t],
                    TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area);
        std::ranges::copy_if(c, std::back_inserter(next), flows);
      }
      for (const std::uint32_t v : next) {
        reached[v] = true;
        if (layer.wall == no_solid)
          layer.wall = touched[v];
      }
    }
    for (std::size_t i = 0; i < chain.border.size(); ++i)
      layer.depths.push_back(columns.depth(i));
    return layer;
  }

  // Moves the strip out of the wall, by half of what its depths grow by.
  void raise(const InletChain& chain, std::int32_t wall, std::span<const double> from, std::span<const double> to) {
    const auto x = positions(frame_);
    for (std::size_t i = 0; i < chain.border.size(); ++i) {
      const std::uint32_t above = chain.border[i], below = chain.row[i];
      const double rise = 0.5 * (to[i] - from[i]);
      origins()[above] += rise * out_of(wall, x[above]);
      origins()[below] = origins()[above];
      for (const std::uint32_t v : {above, below})
        x[v] += rise * out_of(wall, x[v]);
    }
  }

  // Whether triangles at the inlet's strip meet others.
  [[nodiscard]] bool crosses() const {
    std::vector<bool> moved;
    for (const auto own : masks(frame_, "inlet"))
      moved.push_back(of_inlet(own, number_) != 0);
    return moved_triangles_cross(positions(frame_), triangles(frame_), moved);
  }

  formats::Frame& frame_;
  const Scene& scene_;
  const solid::Solids& solids_;
  std::size_t number_;
  std::vector<InletChain> chains_;
  double drowned_ = 0, dry_ = 0; // fluxes, the latter over the thickness
};

} // namespace

void drown_inlets(formats::Frame& frame, const Scene& scene, const solid::Solids& solids) {
  if (frame.find("inlet") == nullptr)
    return;
  for (std::size_t i = 0; i < scene.inflows.size(); ++i)
    if (scene::in_force(scene.inflows[i], frame.time))
      Drowning(frame, scene, solids, i).run();
}

} // namespace sheet::flow
