// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/contact_shear.h"

#include "libsheet/energy/layers.h"
#include "libsheet/energy/walls.h"

namespace sheet {

namespace {

// The sites of a feature's corners and its mean thickness.
struct Feature {
  double thickness = 0;
  const WallSite* site = nullptr; // of one of its corners
};

Feature feature(const ContactSpring& s, std::size_t first, std::size_t end, const Stage& stage,
                std::span<const double> thickness) {
  Feature f{s.mean_of_corners(first, end, thickness)};
  for (std::size_t i = first; i < end; ++i)
    if (const WallSite* site = site_at(stage, s.vertices[i]))
      f.site = site;
  return f;
}

} // namespace

void ContactShear::begin(const Stage& stage) {
  const LayerShares shares = layer_shares(stage);
  const std::vector<double> viscosities = vertex_means(stage, stage.viscosity);
  const std::vector<double> shifts = stage.shift.empty() ? std::vector<double>{} : vertex_means(stage, stage.shift);
  links_.assign(springs_.size(), {});
  liquid_ = stage.liquid;
  flow_ = stage.flow;
  own_force_.clear();
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const ContactSpring& s = springs_[i];
    if (s.welded())
      continue;
    const std::size_t middle = s.second_feature();
    const Feature one = feature(s, 0, middle, stage, shares.thickness);
    const Feature other = feature(s, middle, 4, stage, shares.thickness);
    // Where both touch walls, or none, neither carries the other one.
    const bool on_wall = (one.site == nullptr) != (other.site == nullptr);
    const Feature& lower = one.site != nullptr ? one : other;
    const Feature& upper = one.site != nullptr ? other : one;
    const LayerShear shear = on_wall ? shear_on_wall(lower.thickness, upper.thickness, lower.site->slip_length)
                                     : shear_in_stack(lower.thickness, upper.thickness);
    Link& link = links_[i];
    const double rate = s.area(shares.area) * mean_between(s, viscosities) / stage.duration;
    link.shear = rate / shear.depth;
    link.area = s.area(shares.area);
    link.depth = shear.depth;
    link.time = shifts.empty() ? stage.duration : stage.duration / mean_between(s, shifts);
    link.squeeze = 3 * rate / ((lower.thickness + upper.thickness) / 2);
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
  if (flow_.newtonian())
    return;
  std::vector<Vector3> next(springs_.size(), Vector3::Zero());
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    if (links_[i].area == 0)
      continue;
    const ContactSpring& s = springs_[i];
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
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const ContactSpring& s = springs_[i];
    VectorN<12> x;
    for (int c = 0; c < 4; ++c)
      x.segment<3>(3 * c) = Stage::position(u, s.vertices[static_cast<std::size_t>(c)]);
    for (std::size_t c = 0; c < 4; ++c)
      force[s.vertices[c]] -=
          (links_[i].weights[c] - s.weights[c]) * drag_of(links_[i], way(i, x)).stiffness * way(i, x);
  }
}

} // namespace sheet
