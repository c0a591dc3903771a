// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/contact_shear.h"

#include "libsheet/energy/layers.h"
#include "libsheet/energy/walls.h"

namespace sheet {

namespace {

// What the terms need to know of the vertices.
struct VertexMeans {
  std::vector<double> thickness, viscosities, shifts; // [m], [Pa s], of curves by temperature (none: 1)
};

// The sites of a feature's corners and its means.
struct Feature {
  double thickness = 0;
  const WallSite* site = nullptr; // of one of its corners
  double viscosity = 0, shift = 1;
  std::uint32_t liquid = 0; // by its number
};

Feature feature(const ContactSpring& s, std::size_t first, std::size_t end, const Stage& stage,
                const VertexMeans& means) {
  const auto mean = [&](const std::vector<double>& of) {
    return s.mean_of_corners(first, end, std::span<const double>(of));
  };
  Feature f{mean(means.thickness)};
  for (std::size_t i = first; i < end; ++i)
    if (const WallSite* site = site_at(stage, s.vertices[i]))
      f.site = site;
  if (stage.liquids.size() > 1) {
    f.viscosity = mean(means.viscosities);
    f.shift = means.shifts.empty() ? 1 : mean(means.shifts);
    f.liquid = stage.vertex_liquids[s.vertices[first]];
  }
  return f;
}

// What takes the place of one liquid between two: of the softer, in such a depth.
struct Softer {
  std::uint32_t liquid;
  double depth, viscosity, shift, squeezed; // [m], [Pa s], 1, [Pa s]
};

Softer softer_of(const Feature& lower, const Feature& upper, const LayerShear& shear) {
  const bool above = upper.viscosity < lower.viscosity;
  const Feature &soft = above ? upper : lower, &stiff = above ? lower : upper;
  const double part = above ? shear.upper : shear.depth - shear.upper;
  return {soft.liquid, part + (shear.depth - part) * soft.viscosity / stiff.viscosity, soft.viscosity, soft.shift,
          (lower.thickness + upper.thickness) /
              (lower.thickness / lower.viscosity + upper.thickness / upper.viscosity)};
}

} // namespace

void ContactShear::begin(const Stage& stage) {
  LayerShares shares = layer_shares(stage);
  const VertexMeans means{std::move(shares.thickness), vertex_means(stage, stage.viscosity),
                          stage.shift.empty() ? std::vector<double>{} : vertex_means(stage, stage.shift)};
  links_.assign(size(), {});
  flows_.begin(stage);
  own_force_.clear();
  for (std::size_t i = 0; i < size(); ++i) {
    const ContactSpring& s = spring(i);
    if (s.welded())
      continue;
    const std::size_t middle = s.second_feature();
    const Feature one = feature(s, 0, middle, stage, means), other = feature(s, middle, 4, stage, means);
    // Where both touch walls, or none, neither carries the other one.
    const bool on_wall = (one.site == nullptr) != (other.site == nullptr);
    const Feature& lower = one.site != nullptr ? one : other;
    const Feature& upper = one.site != nullptr ? other : one;
    const LayerShear shear = on_wall ? shear_on_wall(lower.thickness, upper.thickness, lower.site->slip_length)
                                     : shear_in_stack(lower.thickness, upper.thickness);
    Link& link = links_[i];
    link.area = s.area(shares.area);
    double viscosity = mean_between(s, means.viscosities), squeezed = viscosity;
    link.depth = shear.depth;
    link.time = means.shifts.empty() ? stage.duration : stage.duration / mean_between(s, means.shifts);
    link.liquid = lower.liquid;
    if (lower.liquid != upper.liquid) {
      const Softer softer = softer_of(lower, upper, shear);
      link.liquid = softer.liquid;
      link.depth = softer.depth;
      link.time = stage.duration / softer.shift;
      viscosity = softer.viscosity;
      squeezed = softer.squeezed;
    }
    link.shear = link.area * viscosity / stage.duration / link.depth;
    link.squeeze = 3 * (link.area * squeezed / stage.duration) / ((lower.thickness + upper.thickness) / 2);
    link.before.setZero();
    for (std::size_t c = 0; c < 4; ++c) {
      const Vector3 before = reference_position(stage, s.vertices[c]);
      link.weights[c] = s.weights[c];
      link.before += s.weights[c] * before;
      link.thickness += s.weights[c] * s.normal.dot(before);
      const WallSite* site = site_at(stage, s.vertices[c]);
      if (!on_wall || site == nullptr)
        continue;
      link.weights[c] *= shear.carries;
      link.before += (link.weights[c] - s.weights[c]) * site->carried;
    }
  }
}

void ContactShear::follow(const Unknowns& u, const Unknowns& step) {
  if (flows_.newtonian())
    return;
  std::vector<Vector3> next(size(), Vector3::Zero());
  for (std::size_t i = 0; i < size(); ++i) {
    if (links_[i].area == 0)
      continue;
    const ContactSpring& s = spring(i);
    VectorN<12> at, by;
    for (int c = 0; c < 4; ++c) {
      at.segment<3>(3 * c) = Stage::position(u, s.vertices[static_cast<std::size_t>(c)]);
      by.segment<3>(3 * c) = Stage::position(step, s.vertices[static_cast<std::size_t>(c)]);
    }
    const Vector3 slid = way(i, at), along = s.along(weighted_sum(links_[i].weights, by));
    next[i] = drag_of(links_[i], slid).followed(slid, along, own_force(i));
  }
  own_force_ = std::move(next);
}

void ContactShear::add_wall_forces(const Unknowns& u, std::span<Vector3> force) const {
  for (std::size_t i = 0; i < size(); ++i) {
    const ContactSpring& s = spring(i);
    VectorN<12> x;
    for (int c = 0; c < 4; ++c)
      x.segment<3>(3 * c) = Stage::position(u, s.vertices[static_cast<std::size_t>(c)]);
    for (std::size_t c = 0; c < 4; ++c)
      force[s.vertices[c]] -=
          (links_[i].weights[c] - s.weights[c]) * drag_of(links_[i], way(i, x)).stiffness * way(i, x);
  }
}

} // namespace sheet
