// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/remesh/flows.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "libsheet/shape/shapes.h"
#include "tests/support/remesh/options.h"

namespace sheet::test {

namespace {

using std::numbers::pi;

Vector3 runge_kutta(const Flow& flow, const Vector3& x, double t, double dt) {
  const Vector3 a = flow.velocity(x, t), b = flow.velocity(x + dt / 2 * a, t + dt / 2),
                c = flow.velocity(x + dt / 2 * b, t + dt / 2), d = flow.velocity(x + dt * c, t + dt);
  return x + dt / 6 * (a + 2 * b + 2 * c + d);
}

TriangleMesh moved(TriangleMesh mesh, const Vector3& by) {
  for (Vector3& x : mesh.positions)
    x += by;
  return mesh;
}

double angle(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / pi; }

} // namespace

formats::Frame frame_of(const TriangleMesh& mesh, double thickness) {
  std::vector<double> volumes;
  for (const auto& t : mesh.triangles)
    volumes.push_back(
        thickness / 2 *
        (mesh.positions[t[1]] - mesh.positions[t[0]]).cross(mesh.positions[t[2]] - mesh.positions[t[0]]).norm());
  return make_frame(mesh.positions, mesh.triangles, volumes);
}

Flow vortex(double edge_length) {
  return {"vortex and back", frame_of(moved(make_disk(0.15, edges(edge_length)), {0.5, 0.75, 0}), 0.001), edge_length,
          8, [](const Vector3& x, double t) {
            const double back = std::cos(pi * t / 8), sx = std::sin(pi * x[0]), sy = std::sin(pi * x[1]);
            return Vector3(-sx * sx * std::sin(2 * pi * x[1]) * back, sy * sy * std::sin(2 * pi * x[0]) * back, 0);
          }};
}

Flow extension(double edge_length) {
  return {"extension by 50", frame_of(make_rectangle(1, 1, edges(edge_length)), 0.001), edge_length, std::log(50.0),
          [](const Vector3& x, double) { return Vector3(x[0], -x[1] / 2, 0); }};
}

Flow shear(double edge_length) {
  return {"shear by 20", frame_of(make_rectangle(1, 1, edges(edge_length)), 0.001), edge_length, 20,
          [](const Vector3& x, double) { return Vector3(x[1], 0, 0); }};
}

Flow inflation(double edge_length) {
  return {"inflation by 10", frame_of(make_sphere(0.1, edges(edge_length)), 0.001), edge_length, std::log(10.0),
          [](const Vector3& x, double) { return x; }};
}

Flow enright(double edge_length) {
  return {"deformation of a sphere", frame_of(moved(make_sphere(0.15, edges(edge_length)), {0.35, 0.35, 0.35}), 0.001),
          edge_length, 3, [](const Vector3& p, double t) {
            const double back = std::cos(pi * t / 3);
            const auto s = [](double v) { return std::sin(pi * v) * std::sin(pi * v); };
            const auto d = [](double v) { return std::sin(2 * pi * v); };
            return Vector3(2 * s(p[0]) * d(p[1]) * d(p[2]) * back, -d(p[0]) * s(p[1]) * d(p[2]) * back,
                           -d(p[0]) * d(p[1]) * s(p[2]) * back);
          }};
}

Angles angles_of(const formats::Frame& frame, double edge_length) {
  const auto x = positions(frame);
  // the sheet's own angle at each rim vertex, where it is the whole fan
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  std::vector<double> fan(frame.vertices, 0);
  const auto at = [&](const Corners& t, std::size_t i) {
    return angle(x[t[(i + 1) % 3]] - x[t[i]], x[t[(i + 2) % 3]] - x[t[i]]);
  };
  for (const Corners& t : triangles(frame))
    for (std::size_t i = 0; i < 3; ++i) {
      ++sides[std::minmax(t[i], t[(i + 1) % 3])];
      fan[t[i]] += at(t, i);
    }
  std::vector<bool> rim(frame.vertices, false);
  for (const auto& [side, count] : sides)
    if (count == 1)
      rim[side.first] = rim[side.second] = true;
  struct Corner {
    Vector3 tip;
    double reach;
  };
  std::vector<Corner> corners;
  for (std::size_t v = 0; v < fan.size(); ++v)
    if (rim[v] && fan[v] < 60)
      corners.push_back({x[v], edge_length / (2 * std::tan(fan[v] / 2 * pi / 180))});
  Angles result;
  std::vector<double> smallest;
  for (const Corners& t : triangles(frame)) {
    const bool corner = std::any_of(corners.begin(), corners.end(), [&](const Corner& c) {
      return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return (x[v] - c.tip).norm() <= c.reach; });
    });
    double least = 180, most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      least = std::min(least, at(t, i));
      most = std::max(most, at(t, i));
    }
    if (corner) {
      ++result.excepted;
      continue;
    }
    smallest.push_back(least);
    result.largest = std::max(result.largest, most);
  }
  if (smallest.empty())
    return result;
  std::sort(smallest.begin(), smallest.end());
  result.smallest = smallest.front();
  result.first_percentile = smallest[smallest.size() / 100];
  return result;
}

FlowResult run_flow(const Flow& flow, double courant, const remesh::Options& options,
                    const std::function<void(const formats::Frame&)>& watch) {
  formats::Frame frame = flow.start;
  FlowResult result;
  const auto total = [](const formats::Frame& f) {
    const auto v = volumes(f);
    return std::accumulate(v.begin(), v.end(), 0.0);
  };
  const double volume = total(frame);
  double t = 0;
  while (t < flow.duration) {
    double fastest = 0;
    for (const Vector3& x : positions(static_cast<const formats::Frame&>(frame)))
      fastest = std::max({fastest, flow.velocity(x, t).norm(), 0.01 * flow.edge_length});
    const double dt = std::min({courant * flow.edge_length / fastest, flow.duration / 50, flow.duration - t});
    for (Vector3& x : positions(frame))
      x = runge_kutta(flow, x, t, dt);
    t += dt;
    const auto start = std::chrono::steady_clock::now();
    result.edits += remesh::remesh(frame, nullptr, options).edits();
    result.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ++result.steps;
    const Angles angles = angles_of(frame, flow.edge_length);
    result.worst.smallest = std::min(result.worst.smallest, angles.smallest);
    result.worst.first_percentile = std::min(result.worst.first_percentile, angles.first_percentile);
    result.worst.largest = std::max(result.worst.largest, angles.largest);
    result.worst.excepted = std::max(result.worst.excepted, angles.excepted);
    if (watch)
      watch(frame);
  }
  result.triangles = frame.triangles;
  result.volume_error = std::abs(total(frame) / volume - 1);
  return result;
}

} // namespace sheet::test
