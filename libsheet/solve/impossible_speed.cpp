// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/impossible_speed.h"

#include <algorithm>
#include <cmath>

#include "libsheet/geometry/area.h"
#include "libsheet/geometry/faces.h"
#include "libsheet/geometry/vertex_shares.h"

namespace sheet {

namespace {

std::vector<double> masses(const Model& model, const State& state) {
  return vertex_shares(state.positions.size(), state.mesh->triangles,
                       [&](std::uint32_t t) { return model.density(state, t) * state.volumes[t]; });
}

double area_of(const State& state, const Corners& c) {
  return TriangleArea(state.positions[c[0]], state.positions[c[1]], state.positions[c[2]]).area;
}

// By how much liquid may be faster than the walls that squeeze it: the sheet's width over its thickness.
double squeezed(const Model& model, const State& state) {
  double area = 0, volume = 0;
  for (std::size_t t = 0; t < state.volumes.size() && model.walls.size() > 1; ++t) {
    area += area_of(state, state.mesh->triangles[t]);
    volume += state.volumes[t];
  }
  return volume > 0 ? std::max(1.0, std::sqrt(area) * area / volume) : 1;
}

// Of what holds, walls and the wind move, at the end [m/s].
double fastest_prescribed(const Model& model, const State& end) {
  double fastest = model.air ? model.air->wind(end.time).norm() : 0;
  for (const Hold& hold : model.holds)
    for (const auto v : hold.vertices)
      fastest = std::max(fastest, hold.velocity_at(end.time, end.positions[v]).norm());
  for (const Wall& wall : model.walls)
    for (const Wall& touched : model.walls) // what one faces touches another one
      if (wall.velocity && (&wall == &touched || wall.vertices.empty()))
        for (const auto v : touched.vertices)
          fastest = std::max(fastest, wall.velocity(end.time, end.positions[v]).norm());
  return squeezed(model, end) * fastest;
}

// Of what moves by no more than the last digits of where it is, in a sheet at rest that nothing drives [m/s].
double speed_of_round_off(const State& start, const State& end) {
  constexpr double digits = 1e-12; // of a coordinate: some thousand times its last one
  double farthest = 0;             // [m]
  for (const Vector3& x : start.positions)
    farthest = std::max(farthest, x.cwiseAbs().maxCoeff());
  return digits * farthest / (end.time - start.time);
}

// Of gravity on all vertices, as if none had lost what another one gained, and of what the bath carries.
double work_of_gravity(const Model& model, const State& start, const State& end, const std::vector<double>& mass) {
  double lightest = model.liquid.density;
  for (const Liquid& other : model.other_liquids)
    lightest = std::min(lightest, other.density);
  const double lift = model.bath ? 1 + model.bath->density / lightest : 1;
  double work = 0;
  for (std::size_t v = 0; v < mass.size(); ++v)
    work += lift * mass[v] * std::abs(model.gravity.dot(end.positions[v] - start.positions[v]));
  return work;
}

// Of tension, on rims and slopes all that they have, of pressure, and of the weight of layers that spread.
double work_on_area(const Model& model, const State& start, const State& end) {
  double pressure = 0;
  for (const PressureLaw& law : model.pressures)
    pressure = std::max(pressure, std::abs(law.value));
  for (const Gas& gas : end.gas)
    pressure = std::max(pressure, std::abs(gas.pressure));
  double work = 0, tension = model.greatest_tension();
  for (std::size_t t = 0; t < start.temperatures.size(); ++t) {
    const std::size_t number = model.other_liquids.empty() ? 0 : start.liquids[t];
    tension = std::max(tension, model.liquid_of(number).surface_tension_at(start.temperatures[t]));
  }
  if (model.faces)
    work += tension * extra_area(*start.mesh, start.positions, start.volumes, FreeFaces{model.faces->rims, {}});
  for (std::size_t t = 0; t < start.volumes.size(); ++t) {
    const Corners& c = start.mesh->triangles[t];
    const double before = area_of(start, c), after = area_of(end, c);
    double way = 0;
    for (const auto v : c)
      way = std::max(way, (end.positions[v] - start.positions[v]).norm());
    work += 2 * tension * std::max(0.0, before - after) + pressure * std::max(before, after) * way;
    if (!model.walls.empty() || model.bath)
      work += model.density(start, t) * model.gravity.norm() * start.volumes[t] * start.volumes[t] / before;
  }
  return work;
}

double energy_of_contacts(const Model& model, const State& start) {
  double energy = 0;
  for (const ContactSpring& s : model.contacts)
    energy += s.energy(s.offset(start.positions), model.contacts_adhere);
  return energy;
}

bool bounds_nothing(const Model& model) {
  return !model.has_inertia() || std::ranges::any_of(model.pressures, [](const PressureLaw& law) {
    return law.kind == PressureLaw::Kind::inverse_square || law.kind == PressureLaw::Kind::draining;
  });
}

} // namespace

std::optional<ImpossibleSpeed> impossible_speed(const Model& model, const State& start, const State& end) {
  if (bounds_nothing(model))
    return std::nullopt;
  const std::vector<double> mass = masses(model, end);
  ImpossibleSpeed fastest;
  double kinetic = 0, whole = 0;
  for (std::size_t v = 0; v < mass.size(); ++v) {
    kinetic += 0.5 * mass[v] * start.velocities[v].squaredNorm();
    whole += mass[v];
    const double own = 0.5 * mass[v] * end.velocities[v].squaredNorm();
    if (own > fastest.energy) {
      fastest.vertex = v;
      fastest.energy = own;
    }
  }
  if (fastest.energy <= kinetic) // nearly always: no need to reckon
    return std::nullopt;
  const double prescribed = std::max(fastest_prescribed(model, end), speed_of_round_off(start, end));
  fastest.work = kinetic + 0.5 * whole * prescribed * prescribed + work_of_gravity(model, start, end, mass) +
                 work_on_area(model, start, end) + energy_of_contacts(model, start);
  return fastest.energy > fastest.work ? std::optional(fastest) : std::nullopt;
}

} // namespace sheet
