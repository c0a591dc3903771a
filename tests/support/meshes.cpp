// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/meshes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "libsheet/geometry/area.h"

namespace sheet::test {

namespace {

void jitter(Mesh& mesh, double length, double shift) {
  const Connectivity c = connect(mesh.positions.size(), mesh.triangles);
  std::vector<char> rim(mesh.positions.size(), 0);
  for (std::size_t e = 0; e < c.edges.size(); ++e)
    if (c.on_rim(e))
      rim[c.edges[e][0]] = rim[c.edges[e][1]] = 1;
  std::mt19937_64 random(7);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    if (!rim[v]) {
      const double dx = uniform(), dy = uniform();
      mesh.positions[v] += shift * length * Vector3(dx, dy, 0);
    }
}

} // namespace

Mesh icosphere(int level) {
  Mesh m;
  const double g = std::numbers::phi;
  for (const double s : {1.0, -1.0})
    for (const double t : {g, -g}) {
      m.positions.emplace_back(0, s, t);
      m.positions.emplace_back(s, t, 0);
      m.positions.emplace_back(t, 0, s);
    }
  for (Vector3& x : m.positions)
    x.normalize();
  // The faces are the triples at mutual distance of one edge.
  const double edge = 1.05146222423827;
  const auto near = [&](std::uint32_t a, std::uint32_t b) {
    return std::abs((m.positions[a] - m.positions[b]).norm() - edge) < 1e-6;
  };
  for (std::uint32_t a = 0; a < 12; ++a)
    for (std::uint32_t b = a + 1; b < 12; ++b)
      for (std::uint32_t c = b + 1; c < 12; ++c)
        if (near(a, b) && near(b, c) && near(a, c)) {
          const bool out = m.positions[a].dot(m.positions[b].cross(m.positions[c])) > 0;
          m.triangles.push_back(out ? Corners{a, b, c} : Corners{a, c, b});
        }
  for (int l = 0; l < level; ++l) {
    std::map<Edge, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [it, fresh] =
          middles.try_emplace(Edge{std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(m.positions.size()));
      if (fresh)
        m.positions.push_back((m.positions[a] + m.positions[b]).normalized());
      return it->second;
    };
    std::vector<Corners> finer;
    for (const Corners& t : m.triangles) {
      const auto a = middle(t[1], t[2]), b = middle(t[2], t[0]), c = middle(t[0], t[1]);
      finer.insert(finer.end(), {{t[0], c, b}, {t[1], a, c}, {t[2], b, a}, {a, b, c}});
    }
    m.triangles = std::move(finer);
  }
  return m;
}

Mesh disk(double radius, int rings, double shift) {
  Mesh m;
  m.positions.push_back(Vector3::Zero());
  for (int k = 1; k <= rings; ++k)
    for (int i = 0; i < 6 * k; ++i) {
      const double r = radius * k / rings, angle = std::numbers::pi * i / (3 * k);
      m.positions.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
    }
  const auto at = [](int k, int i) {
    return k == 0 ? 0U : static_cast<std::uint32_t>(1 + 3 * k * (k - 1) + (i % (6 * k)));
  };
  for (int k = 1; k <= rings; ++k)
    for (int s = 0; s < 6; ++s)
      for (int j = 0; j < k; ++j) {
        m.triangles.push_back({at(k - 1, s * (k - 1) + j), at(k, s * k + j), at(k, s * k + j + 1)});
        if (j + 1 < k)
          m.triangles.push_back({at(k - 1, s * (k - 1) + j), at(k, s * k + j + 1), at(k - 1, s * (k - 1) + j + 1)});
      }
  jitter(m, radius / rings, shift);
  return m;
}

Mesh rectangle(double lx, double ly, int nx, int ny, double shift) {
  Mesh m;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i)
      m.positions.emplace_back(lx * i / nx, ly * j / ny, 0);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (nx + 1) + i), b = a + 1;
      const auto c = a + static_cast<std::uint32_t>(nx) + 1, d = c + 1;
      if ((i + j) % 2 == 0)
        m.triangles.insert(m.triangles.end(), {{a, b, d}, {a, d, c}});
      else
        m.triangles.insert(m.triangles.end(), {{a, b, c}, {b, d, c}});
    }
  jitter(m, std::min(lx / nx, ly / ny), shift);
  return m;
}

State at_rest(const Mesh& mesh, double thickness) {
  State s;
  s.mesh = std::make_shared<const Connectivity>(connect(mesh.positions.size(), mesh.triangles));
  s.positions = mesh.positions;
  s.velocities.assign(mesh.positions.size(), Vector3::Zero());
  for (const Corners& t : mesh.triangles)
    s.volumes.push_back(thickness *
                        TriangleArea(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]).area);
  return s;
}

} // namespace sheet::test
