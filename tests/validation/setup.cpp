// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/validation/setup.h"

#include <ctime>

#include "libsheet/geometry/area.h"
#include "libsheet/sheet/drops.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::validation {

MeshOptions mesh_options(const Settings& s, double length) {
  MeshOptions o;
  o.pattern = s.pattern;
  o.edge_length = s.edge * length;
  o.seed = s.seed;
  return o;
}

TriangleMesh strip_mesh(const Settings& s, double length, double width) {
  TriangleMesh mesh = make_rectangle(length, width, mesh_options(s, length));
  for (Vector3& x : mesh.positions)
    x += Vector3(length / 2, width / 2, 0);
  return mesh;
}

State film(const TriangleMesh& mesh, double thickness) {
  State s;
  s.mesh = std::make_shared<const Connectivity>(connect(mesh.positions.size(), mesh.triangles));
  s.positions = mesh.positions;
  s.velocities.assign(mesh.positions.size(), Vector3::Zero());
  for (const Corners& t : mesh.triangles)
    s.volumes.push_back(thickness * TriangleArea(s.positions[t[0]], s.positions[t[1]], s.positions[t[2]]).area);
  return s;
}

Model viscous(double viscosity, const Settings& s) {
  Model m;
  m.liquid.viscosity = viscosity;
  m.inertia = false;
  m.arcs = s.bending == Shell::arcs;
  m.bending = s.bending == Shell::none          ? Bending::none
              : s.bending == Shell::hinge       ? Bending::hinge
              : s.bending == Shell::hinge_paper ? Bending::hinge_paper
                                                : Bending::mid_edge;
  return m;
}

Hold hold(const State& s, const Where& at, Axes axes, bool clamped) {
  Hold h;
  h.axes = axes;
  for (std::uint32_t v = 0; v < s.positions.size(); ++v)
    if (at(s.positions[v]))
      h.vertices.push_back(v);
  if (clamped)
    for (std::uint32_t e = 0; e < s.mesh->edges.size(); ++e)
      if (s.mesh->on_rim(e) && at(s.positions[s.mesh->edges[e][0]]) && at(s.positions[s.mesh->edges[e][1]]))
        h.clamped_edges.push_back(e);
  return h;
}

Hold clamp_by_ears(State& s, const Where& at) {
  Hold h = hold(s, at, all_axes, false);
  std::vector<Corners> triangles = s.mesh->triangles;
  for (std::size_t t = 0; t < s.mesh->triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Corners v = s.mesh->triangles[t];
      const auto a = v[(k + 1) % 3], b = v[(k + 2) % 3];
      if (!s.mesh->on_rim(s.mesh->triangle_edges[t][k]) || !at(s.positions[a]) || !at(s.positions[b]))
        continue;
      const Vector3 along = (s.positions[b] - s.positions[a]).normalized(), arm = s.positions[v[k]] - s.positions[a];
      const auto ear = static_cast<std::uint32_t>(s.positions.size());
      s.positions.push_back(s.positions[a] + 2 * arm.dot(along) * along - arm);
      s.velocities.push_back(Vector3::Zero());
      s.volumes.push_back(s.volumes[t]);
      triangles.push_back({b, a, ear});
      h.vertices.push_back(ear);
    }
  s.mesh = std::make_shared<const Connectivity>(connect(s.positions.size(), triangles));
  return h;
}

Hold clamp(State& s, const Settings& settings, const Where& at) {
  if (settings.bending == Shell::hinge || settings.bending == Shell::hinge_paper)
    return clamp_by_ears(s, at);
  return hold(s, at, all_axes, true);
}

// Of this process: the same on a machine that has other work to do, nearly.
static double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Run::Run(State start, Model model, const Settings& settings, double length)
    : state_(std::move(start)), model_(std::move(model)), settings_(settings), length_(length) {}

void Run::advance(double duration, int steps, const std::function<void(const State&)>& each) {
  StepOptions options;
  options.scheme = settings_.scheme;
  options.thickness = settings_.thickness;
  options.newton.tolerance = tolerance;
  Stepper stepper(model_, options);
  for (int k = 0; k < steps; ++k) {
    const double before = processor_seconds();
    const StepReport r = stepper.step(state_, duration / steps);
    seconds_ += processor_seconds() - before;
    iterations_ += r.newton.iterations;
    failed_ += r.failed;
    if (each)
      each(state_);
  }
  steps_ += steps;
}

Result Run::result(double value) const {
  Result r;
  r.value = value;
  r.error = value - 1;
  r.seconds = seconds_;
  r.vertices = state_.positions.size();
  r.edge = mean_edge(state_) / length_;
  r.steps = steps_;
  r.iterations = iterations_;
  r.failed = failed_;
  return r;
}

namespace {

// Mean over the mass: each corner of a triangle weighs a third of it.
template <class F> double weighted_mean(const State& s, F&& f) {
  double sum = 0, weight = 0;
  for (std::size_t t = 0; t < s.volumes.size(); ++t)
    for (const auto v : s.mesh->triangles[t])
      sum += s.volumes[t] * f(v), weight += s.volumes[t];
  return sum / weight;
}

} // namespace

double volume_of_all(const formats::Frame& frame) {
  double sum = volume_of_drops(frame);
  for (const double volume : volumes(frame))
    sum += volume;
  return sum;
}

StepStageOptions equal_steps(const Settings& s, double duration) {
  StepStageOptions options;
  options.dt = duration / s.steps;
  options.scheme = s.scheme;
  options.failed = "";
  return options;
}

double since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double mean_radius(const State& s) {
  return weighted_mean(s, [&](std::uint32_t v) { return s.positions[v].norm(); });
}

double radial_speed(const State& s) {
  return weighted_mean(s, [&](std::uint32_t v) { return s.velocities[v].dot(s.positions[v].normalized()); });
}

double sheet_area(const State& s) {
  double sum = 0;
  for (const Corners& t : s.mesh->triangles)
    sum += TriangleArea(s.positions[t[0]], s.positions[t[1]], s.positions[t[2]]).area;
  return sum;
}

double mean_edge(const State& s) {
  double sum = 0;
  for (const Edge& e : s.mesh->edges)
    sum += (s.positions[e[1]] - s.positions[e[0]]).norm();
  return sum / static_cast<double>(s.mesh->edges.size());
}

} // namespace sheet::validation
