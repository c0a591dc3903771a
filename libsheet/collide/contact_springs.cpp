// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/contact_springs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libsheet/base/each.h"
#include "libsheet/collide/spring_feet.h"
#include "libsheet/geometry/area.h"
#include "libsheet/material/flow_curve.h"

namespace sheet::collide {

namespace {

// Unit normal of the triangle, or of both edges; none where they nearly degenerate.
std::optional<Vector3> normal_of(const ContactSpring& s, std::span<const Vector3> x) {
  const auto& v = s.vertices;
  const Vector3 a = s.of_vertex() ? x[v[2]] - x[v[1]] : x[v[1]] - x[v[0]];
  const Vector3 b = s.of_vertex() ? x[v[3]] - x[v[1]] : x[v[3]] - x[v[2]];
  const Vector3 n = a.cross(b);
  const double length = n.norm();
  if (!(length > 1e-3 * a.norm() * b.norm()))
    return std::nullopt;
  return n / length;
}

// The time in which a contact acts: a tenth of that of falling by its distance d, without gravity of coming by it. Of
// the step only where nothing falls or comes, so that a contact is the same in short steps as in long ones.
double time_of(const ContactSpring& s, double g, double d, const SpringSheet& sheet) {
  const double coming = s.normal.dot(s.offset(sheet.start) - s.offset(sheet.end)) / sheet.step;
  if (g > 0)
    return 0.1 * std::sqrt(d / g);
  return coming > 0 ? 0.1 * d / coming : sheet.step;
}

// Of the liquids of its two features.
double stiffness_of(const ContactSpring& s, const Scene& scene, const SpringSheet& sheet) {
  if (scene.contact && scene.contact->stiffness)
    return *scene.contact->stiffness;
  const auto liquid_at = [&](std::size_t corner) -> const Liquid& {
    return sheet.liquid.empty() ? scene.material : sheet.liquids[sheet.liquid[s.vertices[corner]]];
  };
  const Liquid &one = liquid_at(0), &other = liquid_at(3);
  const double area = s.area(sheet.area), h = s.mean(sheet.thickness), d = s.mean(sheet.reach);
  const double mass = area * (0.5 * (one.density + other.density)) * h;
  const double g = scene.environment.gravity ? scene.environment.gravity->norm() : 0;
  const double time = time_of(s, g, d, sheet);
  const double inertia = scene.model.inertia ? mass / (time * time) : 0;
  const double shift = sheet.shift.empty() ? 1 : s.mean(sheet.shift);
  const StrainRate rate{shift * shift / (time * time)};
  const auto one_behind_the_other = [](double a, double b) { return 2 * a * b / (a + b); };
  const double viscosity =
      shift * (&one == &other ? viscosity_of(one, rate)
                              : one_behind_the_other(viscosity_of(one, rate), viscosity_of(other, rate)));
  return inertia + 200 * mass * g / d + 0.5 * viscosity * h / time;
}

// By how much its features, together, are thicker at the end of the step.
double thickening(const ContactSpring& s, const SpringSheet& sheet) {
  const Corners corners{s.vertices[1], s.vertices[2], s.vertices[3]};
  const std::uint32_t t = s.of_vertex() ? triangle_of(*sheet.mesh, corners) : no_index;
  const double volume = t == no_index ? 0 : sheet.volumes[t];
  const auto area = [&](std::span<const Vector3> x) {
    return TriangleArea(x[corners[0]], x[corners[1]], x[corners[2]]).area;
  };
  const double before = area(sheet.start);
  return s.thickness(sheet.end_thickness, volume, before, area(sheet.end)) /
         s.thickness(sheet.thickness, volume, before, before);
}

// Goes with its features; false where it parts.
bool follows(ContactSpring& s, const Scene& scene, const SpringSheet& sheet) {
  const auto before = normal_of(s, sheet.start), after = normal_of(s, sheet.end);
  if (!before || !after)
    return s.welded();
  const auto turn = Eigen::Quaterniond::FromTwoVectors(*before, *after);
  s.normal = (turn * s.normal).normalized();
  s.anchor = turn * s.anchor;
  if (!sheet.end_thickness.empty() && s.rest_of_layers() > 0)
    s.rest *= thickening(s, sheet);
  const double gap = s.normal.dot(s.offset(sheet.end));
  if (s.welded())
    return true;
  if (!(gap > 0))
    return false;
  if (!scene.contact || !scene.contact->adhesion)
    return true;
  return s.stiffness[0] * (gap - s.rest) <= *scene.contact->adhesion * s.area(sheet.area);
}

double energy_of(const ContactSpring& s, const Scene& scene, std::span<const Vector3> x) {
  return s.energy(s.offset(x), contacts_adhere(scene));
}

// Takes away the springs of whose number gone(i) is true.
template <class Gone> void erase(std::vector<ContactSpring>& springs, const Gone& gone) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < springs.size(); ++i)
    if (!gone(i))
      springs[kept++] = springs[i];
  springs.resize(kept);
}

// Leaves the spring this part of its strain.
void ease(ContactSpring& s, double part, std::span<const Vector3> x) {
  const Vector3 c = s.offset(x);
  s.rest = s.normal.dot(c) + part * (s.rest - s.normal.dot(c));
  s.anchor = c + part * (s.anchor - c);
}

} // namespace

void drop_within_layers(std::vector<ContactSpring>& springs, const SheetLayers& layers, const SpringSheet& sheet) {
  std::vector<std::uint8_t> within(springs.size());
  each_in_parallel(springs.size(), [&](std::size_t i) {
    const ContactSpring& s = springs[i];
    within[i] =
        !s.welded() && layers.one(sheet.start, s.vertices, s.weights, SheetLayers::of_kept, s.mean(sheet.reach));
  });
  erase(springs, [&](std::size_t i) { return within[i] != 0; });
}

std::vector<double> follow(std::vector<ContactSpring>& springs, const Scene& scene, const SpringSheet& sheet,
                           std::span<const Vector3> uncorrected) {
  SpringSheet free = sheet;
  free.end = uncorrected;
  constexpr double parts = -1; // no energy
  std::vector<double> had(springs.size(), parts);
  each_in_parallel(springs.size(), [&](std::size_t i) {
    ContactSpring &s = springs[i], without = s;
    const double as_it_was = energy_of(s, scene, free.end);
    if (!follows(s, scene, sheet))
      return;
    follows(without, scene, free); // its energy is sought, whether it parts or not
    const double turned = energy_of(without, scene, free.end);
    const bool corrected =
        std::ranges::any_of(s.vertices, [&](std::uint32_t v) { return sheet.end[v] != free.end[v]; });
    had[i] = corrected ? std::min(as_it_was, turned) : turned;
  });
  erase(springs, [&](std::size_t i) { return had[i] == parts; });
  std::erase(had, parts);
  return had;
}

double energy_of(std::span<const ContactSpring> springs, const Scene& scene, std::span<const Vector3> positions) {
  double energy = 0;
  for (const ContactSpring& s : springs)
    energy += energy_of(s, scene, positions);
  return energy;
}

void ease_strained(std::vector<ContactSpring>& springs, std::span<const double> had, double given, const Scene& scene,
                   std::span<const Vector3> positions) {
  const auto change_of = [&](std::size_t i) {
    return energy_of(springs[i], scene, positions) - (i < had.size() ? had[i] : 0);
  };
  double grown = 0;
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const double change = change_of(i);
    (change > 0 ? grown : given) += std::abs(change);
  }
  if (grown <= given)
    return;
  for (std::size_t i = 0; i < springs.size(); ++i)
    if (const double change = change_of(i); change > 0) {
      const double energy = energy_of(springs[i], scene, positions);
      ease(springs[i], std::sqrt(std::max(0.0, 1 - (1 - given / grown) * change / energy)), positions);
    }
}

void level_velocities(std::span<const ContactSpring> springs, const Scene& scene, std::span<const double> mass,
                      const std::vector<Axes>& fixed, std::span<Vector3> velocity) {
  constexpr int sweeps = 30;
  const bool sticks = contacts_adhere(scene);
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (const ContactSpring& s : springs) {
      double rate = 0, compliance = 0, farthest = 0;
      std::array<Vector3, 4> share;
      for (std::size_t i = 0; i < 4; ++i) {
        const std::uint32_t v = s.vertices[i];
        rate += s.weights[i] * s.normal.dot(velocity[v]);
        share[i] = s.weights[i] / mass[v] * free_part(fixed[v]).cwiseProduct(s.normal);
        compliance += s.weights[i] * s.normal.dot(share[i]);
        farthest = std::max(farthest, share[i].norm());
      }
      if (compliance > 0 && farthest <= longest_lever * compliance && (sticks || rate < 0))
        for (std::size_t i = 0; i < 4; ++i)
          velocity[s.vertices[i]] -= rate / compliance * share[i];
    }
}

void date(std::vector<ContactSpring>& springs, const Scene& scene, double now) {
  const auto dated = [](const ContactSpring& s) { return s.since != ContactSpring::undated; };
  if (!scene.merge && std::ranges::none_of(springs, dated))
    return;
  for (ContactSpring& s : springs)
    if (!dated(s))
      s.since = now;
}

namespace {
// As it would be between the features of a near pair; none where nothing shall hold them apart.
std::optional<ContactSpring> spring_of(const NearPair& pair, const SheetLayers& layers, const Scene& scene,
                                       const SpringSheet& sheet) {
  ContactSpring s;
  s.vertices = pair.pair.vertices;
  s.weights = pair.closest.weights;
  if (std::ranges::all_of(s.vertices, [&](auto v) { return sheet.fixed[v] == all_axes; }) || !normal_of(s, sheet.end) ||
      layers.one(sheet.end, s.vertices, s.weights, SheetLayers::of_new, s.mean(sheet.reach)))
    return std::nullopt;
  if (sheet.mesh != nullptr && s.of_vertex() && beside_border(*sheet.mesh, s.vertices, sheet.end))
    return std::nullopt;
  s.anchor = pair.closest.offset;
  s.rest = s.anchor.norm();
  s.normal = s.anchor / s.rest;
  s.stiffness[0] = stiffness_of(s, scene, sheet);
  s.stiffness[1] = layers_flow(scene) ? 0 : s.stiffness[0];
  return s;
}
} // namespace

void add_springs(std::vector<ContactSpring>& springs, SelfSearch& search, const Scene& scene,
                 const SpringSheet& sheet) {
  LinkedVertices linked(springs);
  const std::vector<NearPair> near = search.near(sheet.end, sheet.reach, linked);
  std::vector<std::optional<ContactSpring>> found(near.size());
  each_in_parallel(near.size(), [&](std::size_t i) { found[i] = spring_of(near[i], search.layers(), scene, sheet); });
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i])
      order.push_back(i);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    const bool edges_a = near[a].pair.features == Features::edge_edge,
               edges_b = near[b].pair.features == Features::edge_edge;
    return edges_a != edges_b ? edges_b : found[a]->anchor.squaredNorm() < found[b]->anchor.squaredNorm();
  });
  for (const std::size_t i : order)
    if (const ContactSpring& s = *found[i]; !linked.join(s.vertices, s.of_vertex())) {
      springs.push_back(s);
      linked.add(s);
    }
}

} // namespace sheet::collide
