// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/flow_error.h"

#include <array>
#include <cmath>

namespace sheet::remesh {

namespace {

Matrix3 plane_of(const TriangleShape& shape) { return Matrix3::Identity() - shape.normal * shape.normal.transpose(); }

// n × e_i / (2 A), e_i opposite corner i: a linear function's gradient is Σ f_i of these.
std::array<Vector3, 3> shape_gradients(const EditableSheet& sheet, const Corners& c, const TriangleShape& shape) {
  std::array<Vector3, 3> result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = shape.normal.cross(sheet.at(c[(i + 2) % 3]) - sheet.at(c[(i + 1) % 3])) / (2 * shape.area);
  return result;
}

Matrix3 symmetric_in(const Matrix3& plane, const Matrix3& m) { return plane * (0.5 * (m + m.transpose())) * plane; }

// Normals at vertices and their rates: of Σ A n over the triangles around, and what that changes by.
struct Normals {
  std::vector<Vector3> normal, rate;
};
Normals normals_of(const EditableSheet& sheet, const std::vector<TriangleRates>& rates) {
  Normals result;
  const std::size_t count = sheet.mesh().vertex_slots();
  result.normal.assign(count, Vector3::Zero());
  result.rate.assign(count, Vector3::Zero());
  for (std::uint32_t t = 0; t < rates.size(); ++t) {
    if (!(rates[t].thickness > 0))
      continue;
    const Corners& c = sheet.mesh().corners(t);
    const Vector3 u = sheet.at(c[1]) - sheet.at(c[0]), v = sheet.at(c[2]) - sheet.at(c[0]);
    const Vector3 du = sheet.velocity(c[1]) - sheet.velocity(c[0]), dv = sheet.velocity(c[2]) - sheet.velocity(c[0]);
    const Vector3 area = u.cross(v), change = du.cross(v) + u.cross(dv);
    for (const std::uint32_t corner : c) {
      result.normal[corner] += area;
      result.rate[corner] += change;
    }
  }
  for (std::size_t v = 0; v < count; ++v) {
    const double length = result.normal[v].norm();
    if (!(length > 0))
      continue;
    const Vector3 n = result.normal[v] / length;
    result.normal[v] = n;
    result.rate[v] = (result.rate[v] - n.dot(result.rate[v]) * n) / length;
  }
  return result;
}

// A tensor at each vertex, the mean over the triangles around that have one.
class VertexTensors {
public:
  explicit VertexTensors(std::size_t count) : sum_(count, Matrix3::Zero()), area_(count, 0) {}
  void add(const Corners& c, double area, const Matrix3& value) {
    for (const std::uint32_t v : c) {
      sum_[v] += area * value;
      area_[v] += area;
    }
  }
  [[nodiscard]] bool has(const Corners& c) const { return area_[c[0]] > 0 && area_[c[1]] > 0 && area_[c[2]] > 0; }
  // |∇T|² in a triangle, the vertices' tensors laid into its plane.
  [[nodiscard]] double squared_gradient(const Corners& c, const Matrix3& plane,
                                        const std::array<Vector3, 3>& gradients) const {
    const auto at = [&](std::size_t i) -> Matrix3 { return plane * (sum_[c[i]] / area_[c[i]]) * plane; };
    const Matrix3 first = at(0), one = at(1) - first, two = at(2) - first;
    return one.squaredNorm() * gradients[1].squaredNorm() + two.squaredNorm() * gradients[2].squaredNorm() +
           2 * one.cwiseProduct(two).sum() * gradients[1].dot(gradients[2]);
  }

private:
  std::vector<Matrix3> sum_;
  std::vector<double> area_;
};

// Vertices without a value get the mean of their neighbours', ring by ring.
void spread(const Mesh& mesh, std::vector<double>& value, std::vector<bool>& known) {
  for (bool more = true; more;) {
    std::vector<std::pair<std::uint32_t, double>> found;
    for (std::uint32_t v = 0; v < value.size(); ++v) {
      if (known[v] || mesh.side_at(v) == no_index)
        continue;
      double sum = 0, count = 0;
      mesh.for_neighbours(v, [&](std::uint32_t w) {
        if (known[w]) {
          sum += value[w];
          ++count;
        }
      });
      if (count > 0)
        found.emplace_back(v, sum / count);
    }
    for (const auto& [v, mean] : found) {
      value[v] = mean;
      known[v] = true;
    }
    more = !found.empty();
  }
}

} // namespace

std::vector<TriangleRates> triangle_rates(const EditableSheet& sheet) {
  const Mesh& mesh = sheet.mesh();
  std::vector<TriangleRates> rates(mesh.triangle_slots());
  for (std::uint32_t t = 0; t < rates.size(); ++t)
    if (mesh.has_triangle(t) && sheet.shape(t).area > 0) {
      rates[t].shape = sheet.shape(t);
      rates[t].thickness = sheet.volume(t) / sheet.shape(t).area;
      rates[t].temperature = sheet.temperature(t);
      rates[t].liquid = sheet.liquid(t);
    }
  const Normals normals = normals_of(sheet, rates);
  for (std::uint32_t t = 0; t < rates.size(); ++t) {
    TriangleRates& r = rates[t];
    if (!(r.thickness > 0))
      continue;
    const Corners& c = mesh.corners(t);
    const std::array<Vector3, 3> gradients = shape_gradients(sheet, c, r.shape);
    Matrix3 normal = Matrix3::Zero(), rate = Matrix3::Zero();
    r.bends = true;
    for (std::size_t i = 0; i < 3; ++i) {
      r.velocity += sheet.velocity(c[i]) * gradients[i].transpose();
      normal += normals.normal[c[i]] * gradients[i].transpose();
      rate += normals.rate[c[i]] * gradients[i].transpose();
      r.bends = r.bends && !mesh.on_rim(c[i]);
    }
    const Matrix3 plane = plane_of(r.shape);
    r.stretching = symmetric_in(plane, r.velocity);
    if (!r.bends)
      continue;
    // b(u, v) = -∇n(u)·v for vectors that move with the sheet: db/dt = -∇(dn/dt)(u)·v - ∇n(u)·∇ẋ(v).
    r.bending = symmetric_in(plane, -rate.transpose() - normal.transpose() * r.velocity);
  }
  return rates;
}

FlowError flow_error(const EditableSheet& sheet, const std::vector<TriangleRates>& rates, bool bending) {
  const Mesh& mesh = sheet.mesh();
  const std::size_t count = mesh.vertex_slots();
  VertexTensors stretching(count), bent(count);
  FlowError result;
  double area = 0;
  for (std::uint32_t t = 0; t < rates.size(); ++t) {
    const TriangleRates& r = rates[t];
    if (!(r.thickness > 0))
      continue;
    const double a = r.shape.area, h = r.thickness, h3 = bending && r.bends ? h * h * h / 12 : 0;
    stretching.add(mesh.corners(t), a, r.stretching);
    if (r.bends)
      bent.add(mesh.corners(t), a, r.bending);
    result.mean += a * (h * r.stretching.squaredNorm() + h3 * r.bending.squaredNorm());
    area += a;
  }
  result.mean = area > 0 ? std::sqrt(result.mean / area) : 0;
  result.gradient.assign(count, 0);
  std::vector<double> weight(count, 0);
  for (std::uint32_t t = 0; t < rates.size(); ++t) {
    const TriangleRates& r = rates[t];
    if (!(r.thickness > 0) || !r.bends || !bent.has(mesh.corners(t)))
      continue;
    const double h = r.thickness;
    const Matrix3 plane = plane_of(r.shape);
    const std::array<Vector3, 3> gradients = shape_gradients(sheet, mesh.corners(t), r.shape);
    double squared = h * stretching.squared_gradient(mesh.corners(t), plane, gradients);
    if (bending)
      squared += h * h * h / 12 * bent.squared_gradient(mesh.corners(t), plane, gradients);
    for (const std::uint32_t v : mesh.corners(t)) {
      result.gradient[v] += r.shape.area * squared;
      weight[v] += r.shape.area;
    }
  }
  // Once more over the neighbours, for second differences of an irregular mesh are noise to a factor of 2.
  std::vector<double> sum = result.gradient, around = weight;
  std::vector<bool> known(count);
  for (std::uint32_t v = 0; v < count; ++v) {
    if (mesh.side_at(v) == no_index)
      continue;
    mesh.for_neighbours(v, [&](std::uint32_t w) {
      sum[v] += result.gradient[w];
      around[v] += weight[w];
    });
    known[v] = weight[v] > 0;
  }
  for (std::uint32_t v = 0; v < count; ++v)
    result.gradient[v] = known[v] ? std::sqrt(sum[v] / around[v]) : 0;
  spread(mesh, result.gradient, known);
  return result;
}

} // namespace sheet::remesh
