// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/size_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include <Eigen/Eigenvalues>

#include "libsheet/base/error.h"

namespace sheet::remesh {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double jump_tolerance = 0.2;    // τ: of strain rate and of thickness, from triangle to triangle
constexpr double edges_in_a_wave = 8;     // of a buckle
constexpr double growth_over_rate = 5;    // of a buckle, over the rate at which the sheet deforms
constexpr double thicknesses_an_edge = 2; // a shell model says nothing about what is shorter
constexpr double grading = 0.4;           // growth of length over distance

void check_length(const char* option, double value) {
  if (!(value > 0 && std::isfinite(value)))
    fail(ExitCode::usage, "{}: {} is not a positive length", option, value);
}

struct Bounds {
  double low, high;
};
Bounds bounds_of(const SizeOptions& o) {
  const double spread = o.chord_error ? 4 : 1;
  return {o.min_edge.value_or(o.edge_length / spread), o.max_edge.value_or(o.edge_length * spread)};
}

// What the triangles do.
struct State {
  std::vector<TriangleShape> shape;
  std::vector<double> thickness;
  std::vector<Matrix3> strain_rate; // in the triangle's plane [1/s]
  double rate_scale = 0;            // what is a large rate in this sheet [1/s]
};

// Surface gradient of the velocity: of a linear function, Σ u_i (n × e_i)ᵀ / (2 A), e_i opposite corner i.
Matrix3 velocity_gradient(const EditableSheet& sheet, std::uint32_t t, const TriangleShape& shape) {
  Matrix3 gradient = Matrix3::Zero();
  const Corners& c = sheet.mesh().corners(t);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 opposite = sheet.at(c[(i + 2) % 3]) - sheet.at(c[(i + 1) % 3]);
    gradient += sheet.velocity(c[i]) * shape.normal.cross(opposite).transpose() / (2 * shape.area);
  }
  return gradient;
}

Matrix3 strain_rate_of(const Matrix3& gradient, const TriangleShape& shape) {
  const Matrix3 plane = Matrix3::Identity() - shape.normal * shape.normal.transpose();
  const Matrix3 in_plane = plane * gradient;
  return 0.5 * (in_plane + in_plane.transpose());
}

// Root mean square over the sheet of the velocity gradient G, less the rotation Ω of the whole that makes it least,
// which is that of the mean antisymmetric part where the sheet lies all around, so that a turning frame changes nothing
// that matters: |G - Ω P|², P the projection onto the triangle's plane.
double rate_scale(const std::vector<Matrix3>& gradients, const std::vector<TriangleShape>& shapes) {
  Matrix3 left = Matrix3::Zero();
  Vector3 right = Vector3::Zero();
  double area = 0;
  const auto plane = [](const TriangleShape& s) {
    return Matrix3(Matrix3::Identity() - s.normal * s.normal.transpose());
  };
  // Ω P = Σ ω_i L_i P with (L_i)_jk = -ε_ijk
  const auto turn = [](int i) { return skew(Vector3::Unit(i)); };
  for (std::size_t t = 0; t < shapes.size(); ++t) {
    area += shapes[t].area;
    for (int i = 0; i < 3; ++i) {
      right[i] += shapes[t].area * (turn(i) * plane(shapes[t])).cwiseProduct(gradients[t]).sum();
      for (int k = 0; k < 3; ++k)
        left(i, k) += shapes[t].area * (turn(i) * plane(shapes[t])).cwiseProduct(turn(k) * plane(shapes[t])).sum();
    }
  }
  const Vector3 spin = left.ldlt().solve(right);
  double sum = 0;
  for (std::size_t t = 0; t < shapes.size(); ++t)
    sum += shapes[t].area * (gradients[t] - skew(spin) * plane(shapes[t])).squaredNorm();
  return area > 0 ? std::sqrt(sum / area) : 0;
}

State state_of(const EditableSheet& sheet) {
  State state;
  std::vector<Matrix3> gradients;
  for (std::uint32_t t = 0; t < sheet.mesh().triangle_slots(); ++t) {
    const TriangleShape& shape = state.shape.emplace_back(sheet.shape(t));
    const bool flat = !(shape.area > 0);
    gradients.push_back(flat ? Matrix3::Zero() : velocity_gradient(sheet, t, shape));
    state.thickness.push_back(flat ? 0 : sheet.volume(t) / shape.area);
    state.strain_rate.push_back(flat ? Matrix3::Zero() : strain_rate_of(gradients.back(), shape));
  }
  state.rate_scale = rate_scale(gradients, state.shape);
  return state;
}

// Largest principal curvature at each vertex [1/m]: of Σ ½ θ |e| ē ēᵀ / A over its edges, A a third of its triangles,
// averaged once over the neighbours, for the tensor of one vertex of an irregular mesh is noise to a factor of 2.
std::vector<double> curvatures(const EditableSheet& sheet, const State& state) {
  const Mesh& mesh = sheet.mesh();
  const std::size_t count = mesh.vertex_slots();
  std::vector<Matrix3> tensor(count, Matrix3::Zero());
  std::vector<double> area(count, 0);
  for (std::uint32_t side = 0; side < 3 * mesh.triangle_slots(); ++side) {
    const std::uint32_t twin = mesh.twin(side), t = Mesh::triangle_of(side);
    area[mesh.from(side)] += state.shape[t].area / 3;
    if (twin == none || twin < side)
      continue;
    const Vector3 edge = sheet.at(mesh.to(side)) - sheet.at(mesh.from(side));
    const double length = edge.norm();
    const Vector3 &one = state.shape[t].normal, &two = state.shape[Mesh::triangle_of(twin)].normal;
    if (!(length > 0) || one.isZero() || two.isZero())
      continue;
    const double angle = std::atan2(one.cross(two).dot(edge) / length, one.dot(two));
    const Matrix3 part = 0.5 * angle / length * edge * edge.transpose();
    tensor[mesh.from(side)] += part;
    tensor[mesh.to(side)] += part;
  }
  std::vector<double> curvature(count, 0);
  for (std::uint32_t v = 0; v < count; ++v) {
    if (mesh.side_at(v) == none)
      continue;
    Matrix3 sum = tensor[v];
    double around = area[v];
    mesh.for_neighbours(v, [&](std::uint32_t w) {
      sum += tensor[w];
      around += area[w];
    });
    if (!(around > 0))
      continue;
    Eigen::SelfAdjointEigenSolver<Matrix3> solver;
    solver.computeDirect(sum / around, Eigen::EigenvaluesOnly);
    curvature[v] = solver.eigenvalues().cwiseAbs().maxCoeff();
  }
  return curvature;
}

double least_eigenvalue(const Matrix3& m) {
  Eigen::SelfAdjointEigenSolver<Matrix3> solver;
  solver.computeDirect(m, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0];
}

// Length of the wave that compression at this rate makes grow fastest [m]; infinite where none grows much faster than
// the sheet deforms (`rate_scale`), as it must to get anywhere.
double buckling_wavelength(const Scene& scene, double strain_rate, double h, double rate_scale) {
  const double infinite = std::numeric_limits<double>::infinity();
  const scene::Material& m = scene.material;
  const double load = -4 * m.viscosity * h * strain_rate - 2 * m.surface_tension;
  const double modulus = m.viscosity * h * h * h / 3;
  if (!(load > 0 && modulus > 0 && scene.model.bending))
    return infinite;
  double wavenumber = 0;
  const auto consider = [&](double k, double growth) {
    if (growth > growth_over_rate * rate_scale)
      wavenumber = std::max(wavenumber, k);
  };
  const auto& gravity = scene.environment.gravity;
  if (scene.environment.bath && gravity) {
    const double weight = scene.environment.bath->density * gravity->norm();
    consider(std::sqrt(2 * weight / load), load * load / (4 * modulus * weight));
  }
  if (scene.model.inertia) {
    const double k = std::pow(m.density * h * load / (2 * modulus * modulus), 1.0 / 6);
    consider(k, load / (2 * modulus * k * k));
  }
  return wavenumber > 0 ? 2 * pi / wavenumber : infinite;
}

// At each vertex the length that the jumps to the neighbours of its triangles and buckling ask for.
void limit_by_flow(const EditableSheet& sheet, const Scene* scene, const State& state, std::vector<double>& size) {
  const Mesh& mesh = sheet.mesh();
  const auto limit = [&](std::uint32_t t, double length) {
    for (const std::uint32_t v : mesh.corners(t))
      size[v] = std::min(size[v], length);
  };
  for (std::uint32_t side = 0; side < 3 * mesh.triangle_slots(); ++side) {
    const std::uint32_t twin = mesh.twin(side);
    if (twin == none || twin < side)
      continue;
    const std::uint32_t one = Mesh::triangle_of(side), two = Mesh::triangle_of(twin);
    const double length = (sheet.at(mesh.to(side)) - sheet.at(mesh.from(side))).norm();
    const auto limit_both = [&](double value, double jump) {
      if (jump > jump_tolerance * value && value > 0) {
        limit(one, length * jump_tolerance * value / jump);
        limit(two, length * jump_tolerance * value / jump);
      }
    };
    limit_both(state.rate_scale, (state.strain_rate[one] - state.strain_rate[two]).norm());
    limit_both(std::max(state.thickness[one], state.thickness[two]),
               std::abs(state.thickness[one] - state.thickness[two]));
  }
  if (scene != nullptr)
    for (std::uint32_t t = 0; t < mesh.triangle_slots(); ++t)
      limit(t,
            buckling_wavelength(*scene, least_eigenvalue(state.strain_rate[t]), state.thickness[t], state.rate_scale) /
                edges_in_a_wave);
}

// size[v] <= size[w] + grading |x_v - x_w| along edges, by shortest paths [Dijkstra 1959].
void grade(const EditableSheet& sheet, std::vector<double>& size) {
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::uint32_t v = 0; v < size.size(); ++v)
    queue.push({size[v], v});
  while (!queue.empty()) {
    const auto [length, v] = queue.top();
    queue.pop();
    if (length > size[v])
      continue;
    sheet.mesh().for_neighbours(v, [&](std::uint32_t w) {
      const double allowed = length + grading * (sheet.at(v) - sheet.at(w)).norm();
      if (allowed < size[w]) {
        size[w] = allowed;
        queue.push({allowed, w});
      }
    });
  }
}

} // namespace

void SizeOptions::check() const {
  check_length("--edge-length", edge_length);
  if (chord_error)
    check_length("--adaptive", *chord_error);
  if (min_edge)
    check_length("--min-edge", *min_edge);
  if (max_edge)
    check_length("--max-edge", *max_edge);
  const Bounds bounds = bounds_of(*this);
  if (chord_error && bounds.high < 2 * bounds.low)
    fail(ExitCode::usage,
         "--max-edge: {} is less than twice the shortest edge, {}: between them there is no room for splitting and "
         "collapsing",
         bounds.high, bounds.low);
  if (!chord_error && (min_edge || max_edge))
    fail(ExitCode::usage,
         "--min-edge and --max-edge bound the lengths of --adaptive: without it all edges get --edge-length");
}

SizeField::SizeField(const EditableSheet& sheet, const Scene* scene, const SizeOptions& options)
    : uniform_(options.edge_length) {
  if (!options.chord_error)
    return;
  const Bounds bounds = bounds_of(options);
  const State state = state_of(sheet);
  const std::vector<double> curvature = curvatures(sheet, state);
  size_.assign(sheet.mesh().vertex_slots(), bounds.high);
  for (std::uint32_t v = 0; v < size_.size(); ++v)
    if (curvature[v] > 0)
      size_[v] = std::min(size_[v], std::sqrt(8 * *options.chord_error / curvature[v]));
  limit_by_flow(sheet, scene, state, size_);
  for (std::uint32_t t = 0; t < sheet.mesh().triangle_slots(); ++t)
    for (const std::uint32_t v : sheet.mesh().corners(t))
      size_[v] = std::max(size_[v], std::min(thicknesses_an_edge * state.thickness[t], bounds.high));
  for (double& size : size_)
    size = std::clamp(size, bounds.low, bounds.high);
  grade(sheet, size_);
}

double SizeField::shortest() const { return size_.empty() ? uniform_ : *std::min_element(size_.begin(), size_.end()); }

void SizeField::set_between(std::uint32_t v, std::uint32_t a, std::uint32_t b) {
  if (size_.empty())
    return;
  const double between = along(a, b);
  if (v >= size_.size())
    size_.resize(v + 1);
  size_[v] = between;
}

} // namespace sheet::remesh
