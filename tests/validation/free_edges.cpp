// SPDX-License-Identifier: GPL-3.0-or-later
// V38: tension of rims and slopes ([model] faces): strips and disks that become round, waves of thickness, threads,
// holes, a film that retracts. Energies and lengths are those of geometry/faces.h.
#include <algorithm>

#include <fmt/core.h>

#include "libsheet/geometry/area.h"
#include "libsheet/geometry/faces.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/scene/free_faces.h"
#include "libsheet/scene/read.h"
#include "libsheet/sheet/sheet.h"
#include "tests/validation/setup.h"
#include "tests/validation/stages.h"

namespace sheet::validation {

namespace {

constexpr double gamma = 0.05; // [N/m]

constexpr LeastSlope every{-1, -1}; // slope is above that

// Those rims, and every slope.
void put_faces(const State& s, const FreeFaces& faces, Model& m) {
  m.faces = ModelFaces{faces.rims, sloped_edges(*s.mesh, s.positions, s.volumes, faces, every)};
}

// Whose rims where `closed` holds for both ends are none.
FreeFaces faces_beyond(const State& s, const Where& closed) {
  FreeFaces faces = all_free(*s.mesh);
  for (std::size_t e = 0; e < s.mesh->edges.size(); ++e)
    if (closed(s.positions[s.mesh->edges[e][0]]) && closed(s.positions[s.mesh->edges[e][1]]))
      faces.rims[e] = 0;
  return faces;
}

// Ends of a strip along x from 0 to `length`.
Where ends(double length) {
  return [length](const Vector3& x) { return x.x() < 1e-9 * length || x.x() > length * (1 - 1e-9); };
}

Model flat_film(const State& s, const Settings& settings, double viscosity, double density) {
  Model m = viscous(viscosity, settings);
  m.bending = Bending::none;
  m.liquid.surface_tension = gamma;
  m.liquid.density = density;
  m.inertia = density > 0;
  m.holds.push_back(hold(
      s, [](const Vector3&) { return true; }, axis_bit(2), false));
  return m;
}

// As thick as `thickness` says at the middles of the triangles.
void set_thickness(State& s, const std::function<double(const Vector3&)>& thickness) {
  for (std::size_t t = 0; t < s.volumes.size(); ++t) {
    const Corners& c = s.mesh->triangles[t];
    const Vector3 middle = (s.positions[c[0]] + s.positions[c[1]] + s.positions[c[2]]) / 3;
    s.volumes[t] = thickness(middle) * TriangleArea(s.positions[c[0]], s.positions[c[1]], s.positions[c[2]]).area;
  }
}

// Flat, without inertia, remeshed to edges of s.edge: to rest.
Staged comes_to_rest(const std::string& shape, const Settings& s, double thickness, double until) {
  return run_stages(
      fmt::format("[sheet]\n{}plane = \"xy\"\nedge_length = {}\nthickness = {}\nseed = {}\n[material]\n"
                  "viscosity = 1\nsurface_tension = {}\n[model]\ninertia = false\nbending = false\n"
                  "faces = true\n[[hold]]\nregion = {{box = [[-1, -1, -1], [1, 1, 1]]}}\naxes = \"z\"\n"
                  "{}",
                  shape, s.edge, thickness, s.seed, gamma,
                  shape.find("disk") == std::string::npos
                      ? "[[hold]]\nregion = \"x_min\"\naxes = \"x\"\n[[hold]]\nregion = \"x_max\"\naxes = \"x\"\n"
                      : ""),
      s, until);
}

// Area, volume, and what tension has in them over γ [m², m³, m²].
struct Faces {
  double area = 0, volume = 0, energy = 0;
  explicit Faces(const formats::Frame& frame) {
    const Connectivity mesh = connect(frame.vertices, triangles(frame));
    const Scene scene = parse_scene(frame.find("scene")->text(), "validation case");
    const auto x = positions(frame);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Corners& c = mesh.triangles[t];
      area += TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area;
      volume += volumes(frame)[t];
    }
    energy = 2 * area + extra_area(mesh, x, volumes(frame), scene::free_faces(scene, frame, mesh));
  }
};

// A strip of 30 x 6 x 0.5 mm, its ends guided, comes to rest as half a round thread is: w = π h/4. Value: w/h over
// that; energy: over the thread's, 2 γ √(π a) L.
Result strip_at_rest(const Settings& s) {
  constexpr double length = 0.03, width = 0.006, h = 0.0005;
  Settings own = s;
  own.edge = s.edge * width;
  const Staged run = comes_to_rest(fmt::format("shape = \"rectangle\"\nsize = [{}, {}]\n", length, width), own, h, 0.3);
  const Faces end(run.frame);
  Result r = result_of(run, own, end.area * end.area / (length * end.volume) / (pi / 4));
  r.edge = s.edge;
  r.more = {{"energy", end.energy / (2 * std::sqrt(pi * end.volume * length))}};
  return r;
}

// A free disk of V = π 4² 0.5 mm³ comes to rest at R = V^(1/3)/2.
Result disk_at_rest(const Settings& s) {
  constexpr double radius = 0.004, h = 0.0005;
  Settings own = s;
  own.edge = s.edge * radius;
  const Staged run = comes_to_rest(fmt::format("shape = \"disk\"\nradius = {}\n", radius), own, h, 0.5);
  const Faces end(run.frame);
  Result r = result_of(run, own, std::sqrt(end.area / pi) / (std::cbrt(end.volume) / 2));
  r.edge = s.edge;
  r.more = {{"energy_over_spheres", end.energy / std::cbrt(36 * pi * end.volume * end.volume)}};
  return r;
}

// Half a wave of thickness in a strip of length 1 along x, its sides guided: a displacement ξ = a(t) sin(k x) thickens
// by -h k a cos(k x).
struct Wave {
  State state;
  Model model;
  double k = pi, width;

  Wave(const Settings& s, double h, double mu, double rho)
      : width(2 * std::sqrt(3.0) * s.edge) { // of whole rows of equilateral triangles
    state = film(strip_mesh(s, 1, width), h);
    model = flat_film(state, s, mu, rho);
    model.holds.push_back(hold(state, ends(1), axis_bit(0), false));
    model.holds.push_back(hold(
        state, [this](const Vector3& x) { return x.y() < 1e-9 || x.y() > width - 1e-9; }, axis_bit(1), false));
    FreeFaces faces{std::vector<double>(state.mesh->edges.size(), 0), {}};
    put_faces(state, faces, model);
    at_rest_ = state.positions;
  }
  // Moves what lies flat by a sin(k x), with speeds `rate` times as fast.
  void displace(double a, double rate) {
    for (std::size_t v = 0; v < at_rest_.size(); ++v) {
      const Vector3 way = a * std::sin(k * at_rest_[v].x()) * Vector3::UnitX();
      state.positions[v] += way;
      state.velocities[v] = rate * way;
    }
  }
  [[nodiscard]] double amplitude(const State& s) const {
    double up = 0, down = 0;
    for (std::size_t v = 0; v < at_rest_.size(); ++v) {
      const double mode = std::sin(k * at_rest_[v].x());
      up += mode * (s.positions[v].x() - at_rest_[v].x()), down += mode * mode;
    }
    return up / down;
  }

private:
  std::vector<Vector3> at_rest_;
};

// ω = k² √(γ h/(2 ρ)) of a film without viscosity, from the first zero of the mode.
Result varicose_wave(const Settings& s) {
  constexpr double h = 0.01, rho = 1, a = 1e-3;
  Wave wave(s, h, 0, rho);
  const double omega = wave.k * wave.k * std::sqrt(gamma * h / (2 * rho));
  wave.displace(a, 0);
  double before = a, time = 0, zero = 0;
  Run run(wave.state, wave.model, s, 2); // a whole wave
  run.advance(0.6 * pi / omega, s.steps, [&](const State& at) {
    const double now = wave.amplitude(at);
    if (zero == 0 && now <= 0)
      zero = time + (at.time - time) * before / (before - now);
    before = now, time = at.time;
  });
  return run.result(pi / 2 / omega / zero);
}

// A film that decays: the slower root of σ² + 4 ν k² σ + γ h k⁴/(2 ρ) = 0, over three of its times.
Result damped_wave(const Settings& s) {
  constexpr double h = 0.01, rho = 1, a = 1e-3;
  const double k = pi, elastic = gamma * h * std::pow(k, 4) / (2 * rho), nu = std::sqrt(elastic) / (k * k); // of twice
  const double damping = 2 * nu * k * k, rate = damping - std::sqrt(damping * damping - elastic);
  Wave wave(s, h, nu * rho, rho);
  wave.displace(a, -rate);
  const double until = 1 / rate;
  Run run(wave.state, wave.model, s, 2);
  run.advance(until, s.steps);
  return run.result(-std::log(wave.amplitude(run.state()) / a) / until / rate);
}

// On a wall: γ h³ k⁴/(3 μ).
Result wave_on_wall(const Settings& s) {
  constexpr double h = 0.005, mu = 1, a = 1e-2;
  Wave wave(s, h, mu, 0);
  Wall wall;
  for (std::uint32_t v = 0; v < wave.state.positions.size(); ++v)
    wall.vertices.push_back(v);
  wall.nearest = [](double, const Vector3& x) { return WallPoint{x.z() + h / 2, Vector3::UnitZ()}; };
  wave.model.walls.push_back(std::move(wall));
  std::erase_if(wave.model.holds, [](const Hold& hold) { return hold.axes == axis_bit(2); });
  FreeFaces faces{std::vector<double>(wave.state.mesh->edges.size(), 0),
                  std::vector<double>(wave.state.positions.size(), 1)};
  put_faces(wave.state, faces, wave.model);
  wave.displace(a, 0);
  const double rate = gamma * h * h * h * std::pow(wave.k, 4) / (3 * mu), until = 1 / rate;
  const auto thickness_mode = [&](const State& at) {
    double up = 0, down = 0;
    for (std::size_t t = 0; t < at.volumes.size(); ++t) {
      const Corners& c = at.mesh->triangles[t];
      const double mode = std::cos(wave.k * (at.positions[c[0]] + at.positions[c[1]] + at.positions[c[2]]).x() / 3);
      const double area = TriangleArea(at.positions[c[0]], at.positions[c[1]], at.positions[c[2]]).area;
      up += mode * at.volumes[t], down += mode * mode * area;
    }
    return up / down;
  };
  const double start = thickness_mode(wave.state);
  Run run(wave.state, wave.model, s, 2);
  run.advance(until, s.steps);
  return run.result(-std::log(thickness_mode(run.state()) / start) / until / rate);
}

// A thread at rest in its section: 2 r thick, π r/2 wide. Sides of the strip at y = 0 and the width.
State thread(const Settings& s, double length, double r) {
  Settings mesh = s;
  mesh.edge = s.edge * pi * r / 2 / length;
  return film(strip_mesh(mesh, length, pi * r / 2), 2 * r);
}

// A free thread of r = 1 mm, which no force holds out: γ π r = 3 μ a ε̇ shortens it, and r grows by γ/(6 μ).
Result free_thread(const Settings& s) {
  constexpr double r = 1e-3, length = 0.04, mu = 1;
  State start = thread(s, length, r);
  Model m = flat_film(start, s, mu, 0);
  const Where guided = [](const Vector3& x) { return x.x() < 1e-9; };
  m.holds.push_back(hold(start, guided, axis_bit(0), false));
  m.holds.push_back(hold(
      start, [](const Vector3& x) { return x.norm() < 1e-9; }, axis_bit(1), false));
  put_faces(start, faces_beyond(start, guided), m);
  const std::vector<std::uint32_t> middle =
      hold(
          start, [&](const Vector3& x) { return std::abs(x.x() / length - 0.5) < 0.1; }, 0, false)
          .vertices;
  const auto way = [&](const State& at) { // of its middle from the end that is held
    double sum = 0;
    for (const auto v : middle)
      sum += at.positions[v].x();
    return sum / static_cast<double>(middle.size());
  };
  const double from = way(start), until = 1.2 * mu * r / gamma; // 20 %
  Run run(std::move(start), m, s, r);
  run.advance(until / 2, s.steps / 2);
  const double half = std::sqrt(from / way(run.state()));
  run.advance(until / 2, s.steps / 2);
  return run.result(r * (std::sqrt(from / way(run.state())) - half) / (gamma / (6 * mu) * until / 2));
}

// A thread of r = 1 mm, 1 Pa s, 1000 kg/m³ grows beads of the wave number k r = 0.25, 0.5, 0.7, at the rate of slender
// jets [Eggers and Dupont 1994]: σ = √(γ x² (1 - x²)/(2 ρ r³) + 9 ν² x⁴/(4 r⁴)) - 3 ν x²/(2 r²), x = k r.
Result growing_beads(const Settings& s, double x) {
  constexpr double r = 1e-3, mu = 1, rho = 1000, nu = mu / rho, a = 0.001;
  const double k = x / r, length = pi / k, over = x * x / (r * r);
  const double rate =
      std::sqrt(gamma * x * x * (1 - x * x) / (2 * rho * r * r * r) + 2.25 * nu * nu * over * over) - 1.5 * nu * over;
  State start = thread(s, length, r);
  Model m = flat_film(start, s, mu, rho);
  m.holds.push_back(hold(start, ends(length), axis_bit(0), false));
  m.holds.push_back(hold(
      start, [](const Vector3& v) { return v.norm() < 1e-9; }, axis_bit(1), false));
  put_faces(start, faces_beyond(start, ends(length)), m);
  // The section's area as 1 + 2 a cos(k x), width and thickness as its root.
  const double width = pi * r / 2;
  set_thickness(start, [&](const Vector3& v) { return 2 * r * (1 + 2 * a * std::cos(k * v.x())); });
  for (Vector3& v : start.positions)
    v.y() = width / 2 + (v.y() - width / 2) * (1 + a * std::cos(k * v.x()));
  const auto mode = [&](const State& at) {
    double sum = 0;
    for (std::size_t t = 0; t < at.volumes.size(); ++t) {
      const Corners& c = at.mesh->triangles[t];
      sum += at.volumes[t] * std::cos(k * (at.positions[c[0]] + at.positions[c[1]] + at.positions[c[2]]).x() / 3);
    }
    return sum;
  };
  Run run(std::move(start), m, s, width);
  const int half = s.steps / 2;
  run.advance(2 / rate, half); // until the section and the mode have found their shapes
  const double before = mode(run.state());
  run.advance(0.5 / rate, half);
  return run.result(std::log(mode(run.state()) / before) / 0.5);
}

// A hole in a sheet 1 mm thick, 0.3 or 0.5 of that in radius: the energy 2 γ (-π R²) + (π/4) γ h 2 π R rises with R up
// to R = π h/8, so the first closes, the second opens. Value: the radius at the end over that at the start.
Result hole(const Settings& s, double over_thickness) {
  constexpr double h = 1e-3, mu = 1;
  const double radius = over_thickness * h, outer = 3 * h;
  State start = film(make_annulus(radius, outer, mesh_options(s, radius)), h);
  Model m = flat_film(start, s, mu, 0);
  const Where rim = [&](const Vector3& x) { return x.norm() > outer * (1 - 1e-9); };
  m.holds.push_back(hold(start, rim, all_axes, false));
  put_faces(start, faces_beyond(start, rim), m);
  const double area = pi * outer * outer - sheet_area(start);
  const double until = 0.5 * mu * h / gamma;
  Run run(std::move(start), m, s, radius);
  run.advance(until, s.steps);
  return run.result(std::sqrt((pi * outer * outer - sheet_area(run.state())) / area));
}

// Half of a film that retracts to t u/h = 15, u = √(2 γ/(ρ h)), as V10, remeshed with edges of h. Oh = μ/√(γ ρ h).
// Value: the greatest thickness around a vertex over h, over that of a resolved solution in one dimension: 4.70 (Oh
// 0.05), 3.58 (Oh 1).
Result retracting_rim(const Settings& s, double ohnesorge, double thickest) {
  constexpr double rho = 1000, h = 1e-3, tension = 0.05, length = 0.035;
  const double width = 4 * s.edge * h, speed = std::sqrt(2 * tension / (rho * h)), until = 15 * h / speed;
  const double mu = ohnesorge * std::sqrt(tension * rho * h);
  const std::string scene = fmt::format(
      "[sheet]\nshape = \"rectangle\"\nplane = \"xy\"\nsize = [{}, {}]\nedge_length = {}\nthickness = {}\nseed = {}\n"
      "[material]\nviscosity = {}\ndensity = {}\nsurface_tension = {}\n[model]\nbending = false\nfaces = true\n"
      "[[hold]]\nregion = \"x_min\"\naxes = \"xz\"\n[[hold]]\nregion = \"y_min\"\naxes = \"yz\"\n"
      "[[hold]]\nregion = \"y_max\"\naxes = \"yz\"\n[[hold]]\nregion = {{box = [[-1, -1, -1], [1, 1, 1]]}}\naxes = "
      "\"z\"\n",
      length, width, s.edge * h, h, s.seed, mu, rho, tension);
  Settings own = s;
  own.edge = s.edge * h;
  double worst = 0;
  const Staged run = run_stages(scene, own, until, [&](const formats::Frame& frame) {
    double momentum = 0;
    const auto v = velocities(frame);
    const auto volume = volumes(frame);
    for (std::size_t t = 0; t < frame.triangles; ++t)
      for (const auto c : triangles(frame)[t])
        momentum -= rho * volume[t] / 3 * v[c].x();
    const double off = momentum / (2 * tension * width * frame.time) - 1;
    worst = std::abs(off) > std::abs(worst) ? off : worst;
  });
  const auto x = positions(run.frame);
  const auto corners = triangles(run.frame);
  const auto area = [&](std::uint32_t t) {
    return TriangleArea(x[corners[t][0]], x[corners[t][1]], x[corners[t][2]]).area;
  };
  const double most = std::ranges::max(thickness_around(run.frame.vertices, corners, volumes(run.frame), area));
  double bead = 0;
  for (std::uint32_t t = 0; t < run.frame.triangles; ++t)
    if (const double volume = volumes(run.frame)[t]; volume > 1.2 * h * area(t))
      bead += volume / width;
  Result r = result_of(run, own, most / h / thickest);
  r.edge = s.edge;
  r.more = {{"thickest", most / h}, {"round_bead", 2 * std::sqrt(bead / pi) / h}, {"momentum_error", worst}};
  return r;
}

} // namespace

Result v38(const Settings& s) {
  switch (s.set) {
  case 1:
    return strip_at_rest(s);
  case 2:
    return disk_at_rest(s);
  case 3:
    return varicose_wave(s);
  case 4:
    return damped_wave(s);
  case 5:
    return wave_on_wall(s);
  case 6:
    return retracting_rim(s, 0.05, 4.70);
  case 7:
    return retracting_rim(s, 1, 3.58);
  case 8:
    return free_thread(s);
  case 9:
    return growing_beads(s, 0.25);
  case 10:
    return growing_beads(s, 0.5);
  case 11:
    return growing_beads(s, 0.7);
  case 12:
    return hole(s, 0.3);
  default:
    return hole(s, 0.5);
  }
}

} // namespace sheet::validation
