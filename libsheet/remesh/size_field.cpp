// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/size_field.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <queue>

#include <Eigen/Eigenvalues>

#include "libsheet/base/error.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/remesh/buckling.h"
#include "libsheet/remesh/flow_error.h"
#include "libsheet/remesh/necks.h"
#include "libsheet/remesh/operations.h"
#include "libsheet/remesh/strip_width.h"

namespace sheet::remesh {

namespace {

using std::numbers::pi;
constexpr double jump_tolerance = 0.2; // τ: of thickness, from triangle to triangle
constexpr double even_enough = 1.5;    // of the flow's mean over the sheet's size: gradients below make no difference
constexpr double edges_in_a_wave = 8;  // of a buckle
constexpr double thicknesses_an_edge = 1;            // a shell model says nothing about what is shorter
constexpr double thicknesses_an_edge_on_walls = 0.5; // likewise of a layer on one
constexpr double grading = 0.4;                      // growth of length over distance
constexpr double widths_an_edge = 2; // of a strip: up to split_above times that, no angle need be below 19 degrees
constexpr double widths_an_edge_of_threads = 1.5; // which are as wide as π/4 of their thickness
constexpr double thicknesses_an_edge_of_threads = 0.5;
constexpr double least_wedge_of_threads = pi / 9; // a thread ends in no wedge, but tension shortens it
constexpr double widths_long = 6;                 // a thread, at least
constexpr double finest_in_strips = 1.0 / 16;     // of edge_length
constexpr double carries_enough = 0.01;           // of what triangles carry in the mean, one of a neck

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

// Largest principal curvature at each vertex [1/m]: of Σ ½ θ |e| ē ēᵀ / A over its edges, A a third of its triangles,
// averaged once over the neighbours, for the tensor of one vertex of an irregular mesh is noise to a factor of 2.
std::vector<double> curvatures(const EditableSheet& sheet, const std::vector<TriangleRates>& rates) {
  const Mesh& mesh = sheet.mesh();
  const std::size_t count = mesh.vertex_slots();
  std::vector<Matrix3> tensor(count, Matrix3::Zero());
  const std::vector<double> area =
      vertex_shares(count, mesh.triangles(), [&](std::uint32_t t) { return rates[t].shape.area; });
  for (std::uint32_t side = 0; side < 3 * mesh.triangle_slots(); ++side) {
    const std::uint32_t twin = mesh.twin(side), t = Mesh::triangle_of(side);
    if (twin == no_index || twin < side)
      continue;
    const Vector3 edge = sheet.at(mesh.to(side)) - sheet.at(mesh.from(side));
    const double length = edge.norm();
    const Vector3 &one = rates[t].shape.normal, &two = rates[Mesh::triangle_of(twin)].shape.normal;
    if (!(length > 0) || one.isZero() || two.isZero())
      continue;
    const double angle = std::atan2(one.cross(two).dot(edge) / length, one.dot(two));
    const Matrix3 part = 0.5 * angle / length * edge * edge.transpose();
    tensor[mesh.from(side)] += part;
    tensor[mesh.to(side)] += part;
  }
  std::vector<double> curvature(count, 0);
  for (std::uint32_t v = 0; v < count; ++v) {
    if (mesh.side_at(v) == no_index)
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

// Of the rim as a curve in space [1/m]; 0 at corners, which stay, and inside.
double rim_curvature(const EditableSheet& sheet, std::uint32_t v) {
  if (!sheet.mesh().on_rim(v) || is_corner(sheet, v))
    return 0;
  const auto [before, after] = rim_neighbours(sheet.mesh(), v);
  const Vector3 in = sheet.at(v) - sheet.at(before), out = sheet.at(after) - sheet.at(v);
  const double length = 0.5 * (in.norm() + out.norm());
  return length > 0 ? std::atan2(in.cross(out).norm(), in.dot(out)) / length : 0;
}

// The lengths that make the least error with as many triangles as edges of `even` everywhere: l ∝ g^-½, for Σ l² g² A
// is least at a given Σ A / l² where l⁴ g² is the same everywhere (flow_error.h).
void share_out(const EditableSheet& sheet, const std::vector<TriangleRates>& rates, const FlowError& error, double even,
               const Bounds& bounds, std::vector<double>& size) {
  const std::vector<double> around =
      vertex_shares(size.size(), sheet.mesh().triangles(), [&](std::uint32_t t) { return rates[t].shape.area; });
  double area = 0;
  for (const TriangleRates& r : rates)
    for (int corner = 0; corner < 3; ++corner)
      area += r.shape.area / 3;
  const double least = even_enough * error.mean / std::sqrt(area);
  if (!(least > 0)) {
    for (double& length : size)
      length = std::min(length, even);
    return;
  }
  const auto length = [&](std::size_t v, double factor) {
    return std::clamp(factor / std::sqrt(std::max(error.gradient[v], least)), bounds.low, bounds.high);
  };
  double low = bounds.low * std::sqrt(least), high = low;
  for (const double g : error.gradient)
    high = std::max(high, bounds.high * std::sqrt(std::max(g, least)));
  for (int i = 0; i < 40; ++i) {
    const double middle = std::sqrt(low * high);
    double count = 0;
    for (std::size_t v = 0; v < size.size(); ++v)
      count += around[v] / std::pow(length(v, middle), 2);
    (count > area / (even * even) ? low : high) = middle;
  }
  for (std::size_t v = 0; v < size.size(); ++v)
    size[v] = std::min(size[v], length(v, high));
}

// At each vertex the length that the jumps of thickness to the neighbours of its triangles ask for, divided by the part
// of a face that lies on no layer.
void limit_by_thickness(const EditableSheet& sheet, const std::vector<TriangleRates>& rates,
                        const std::vector<double>& inner_faces, std::vector<double>& size) {
  const Mesh& mesh = sheet.mesh();
  const auto open = [&](std::uint32_t v) { return inner_faces.empty() ? 1 : std::max(0.0, 1 - inner_faces[v]); };
  for (std::uint32_t side = 0; side < 3 * mesh.triangle_slots(); ++side) {
    const std::uint32_t twin = mesh.twin(side);
    if (twin == no_index || twin < side)
      continue;
    const std::uint32_t one = Mesh::triangle_of(side), two = Mesh::triangle_of(twin);
    const double length = (sheet.at(mesh.to(side)) - sheet.at(mesh.from(side))).norm();
    const double value = std::max(rates[one].thickness, rates[two].thickness);
    const double jump = std::abs(rates[one].thickness - rates[two].thickness);
    if (jump > jump_tolerance * value)
      for (const std::uint32_t t : {one, two})
        for (const std::uint32_t v : mesh.corners(t))
          if (const double share = open(v); share > 0)
            size[v] = std::min(size[v], length * jump_tolerance * value / (share * jump));
  }
}

// Waves about to buckle get `edges_in_a_wave` at least, and their share as if they already took as much power as all
// else does now: g = k times the mean.
void look_ahead(const EditableSheet& sheet, const Scene& scene, const std::vector<TriangleRates>& rates,
                FlowError& error, std::vector<double>& size) {
  const std::vector<double> wavenumber = buckling_wavenumbers(scene, rates);
  for (std::uint32_t t = 0; t < rates.size(); ++t)
    if (const double k = wavenumber[t]; k > 0)
      for (const std::uint32_t v : sheet.mesh().corners(t)) {
        size[v] = std::min(size[v], 2 * pi / (edges_in_a_wave * k));
        error.gradient[v] = std::max(error.gradient[v], k * error.mean);
      }
}

// Of each vertex the mean of its triangles, by their areas [m].
std::vector<double> thickness_at_vertices(const EditableSheet& sheet) {
  return thickness_around(sheet.mesh().vertex_slots(), sheet.mesh().triangles(), sheet.triangle_volumes(),
                          [&](std::uint32_t t) { return sheet.shape(t).area; });
}

// Of the triangles [m³].
double mean_volume(const EditableSheet& sheet) {
  double volume = 0;
  std::size_t triangles = 0;
  for (std::uint32_t t = 0; t < sheet.mesh().triangle_slots(); ++t)
    if (sheet.mesh().has_triangle(t)) {
      volume += sheet.volume(t);
      ++triangles;
    }
  return triangles > 0 ? volume / static_cast<double>(triangles) : 0;
}

// Vertices of long strands that are as thick as they are wide, or thicker.
std::vector<bool> round_threads(const EditableSheet& sheet, const std::vector<double>& width,
                                const std::vector<double>& thickness) {
  const Mesh& mesh = sheet.mesh();
  std::vector<bool> round(width.size(), false);
  for (std::uint32_t v = 0; v < width.size(); ++v)
    round[v] = width[v] < thickness[v];
  DisjointSets strands(width.size());
  std::vector<double> widest(width.size(), 0), area(width.size(), 0);
  const auto whole = [&](std::uint32_t t) {
    return std::ranges::all_of(mesh.corners(t), [&](std::uint32_t v) { return round[v]; });
  };
  for (std::uint32_t t = 0; t < mesh.triangle_slots(); ++t)
    if (mesh.has_triangle(t) && whole(t))
      for (const std::uint32_t v : mesh.corners(t))
        strands.join(mesh.corners(t)[0], v);
  for (std::uint32_t t = 0; t < mesh.triangle_slots(); ++t)
    if (mesh.has_triangle(t) && whole(t)) {
      const auto strand = strands.find(mesh.corners(t)[0]);
      area[strand] += sheet.shape(t).area;
      for (const std::uint32_t v : mesh.corners(t))
        widest[strand] = std::max(widest[strand], width[v]);
    }
  for (std::uint32_t v = 0; v < width.size(); ++v) {
    const auto strand = strands.find(v);
    round[v] = round[v] && area[strand] > widths_long * widest[strand] * widest[strand];
  }
  return round;
}

// size[v] <= size[w] + grading |x_v - x_w| along edges, by shortest paths [Dijkstra 1959].
void grade(const EditableSheet& sheet, std::vector<double>& size) {
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::uint32_t v = 0; v < size.size(); ++v)
    queue.push({size[v], v});
  while (!queue.empty()) {
    const double length = queue.top().first;
    const std::uint32_t v = queue.top().second;
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
  if (options.chord_error)
    adapt(sheet, scene, options);
  multiply(sheet, options.scale);
  if (!options.chord_error)
    coarsen_deep_layers(sheet);
  note_thick(sheet, options.chord_error ? bounds_of(options).high : uniform_);
  fit_strips(sheet, options, scene != nullptr && scene->model.faces);
}

double SizeOptions::shortest_in_strips() const { return min_edge.value_or(finest_in_strips * edge_length); }

void SizeField::multiply(const EditableSheet& sheet, const std::vector<double>& scale) {
  if (scale.empty())
    return;
  if (size_.empty())
    size_.assign(sheet.mesh().vertex_slots(), uniform_);
  for (std::size_t v = 0; v < scale.size(); ++v)
    size_[v] *= scale[v];
}

void SizeField::coarsen_deep_layers(const EditableSheet& sheet) {
  const std::vector<double> thickness = thickness_at_vertices(sheet);
  std::vector<double> coarse(thickness.size());
  bool any = false;
  for (std::uint32_t v = 0; v < coarse.size(); ++v) {
    const double least = sheet.wall(v) == no_index ? 0 : thicknesses_an_edge_on_walls * thickness[v];
    any = any || least > at(v);
    coarse[v] = std::max(at(v), least);
  }
  if (!any)
    return;
  grade(sheet, coarse);
  size_ = std::move(coarse);
}

void SizeField::note_thick(const EditableSheet& sheet, double longest) {
  std::vector<double> thick = thickness_at_vertices(sheet);
  for (std::uint32_t v = 0; v < thick.size(); ++v)
    if (!sheet.free(v))
      thick[v] = 0;
  if (std::ranges::any_of(thick, [&](double h) { return h > longest; }))
    thick_ = std::move(thick);
}

void SizeField::fit_strips(const EditableSheet& sheet, const SizeOptions& options, bool round) {
  const double widths = round ? widths_an_edge_of_threads : widths_an_edge;
  const double thicknesses = round ? thicknesses_an_edge_of_threads : thicknesses_an_edge;
  const double floor = options.shortest_in_strips();
  const std::vector<double> strip = strip_widths(sheet, round ? least_wedge_of_threads : 0),
                            neck = neck_widths(sheet, options.edge_length / widths_an_edge),
                            thickness = thickness_at_vertices(sheet);
  const std::vector<bool> threads =
      round && !options.chord_error ? round_threads(sheet, strip, thickness) : std::vector<bool>(strip.size(), false);
  const double enough = carries_enough * mean_volume(sheet);
  std::vector<double> fitted(strip.size());
  bool any = false;
  for (std::uint32_t v = 0; v < fitted.size(); ++v) {
    const double least = std::max(thicknesses * thickness[v], floor);
    const double in_strip = std::max(widths * strip[v], least);
    const double in_neck = std::max({widths * neck[v], least, 2 * enough / (neck[v] * thickness[v])});
    const double own = std::min(in_strip, in_neck);
    fitted[v] = threads[v] ? own : std::min(at(v), own);
    any = any || fitted[v] != at(v);
    if (round && !thick_.empty() && fitted[v] < at(v))
      thick_[v] *= thicknesses;
  }
  if (!any)
    return;
  grade(sheet, fitted);
  size_ = std::move(fitted);
}

void SizeField::adapt(const EditableSheet& sheet, const Scene* scene, const SizeOptions& options) {
  const Bounds bounds = bounds_of(options);
  const std::vector<TriangleRates> rates = triangle_rates(sheet);
  const std::vector<double> curvature = curvatures(sheet, rates);
  size_.assign(sheet.mesh().vertex_slots(), bounds.high);
  for (std::uint32_t v = 0; v < size_.size(); ++v)
    if (const double k = std::max(curvature[v], rim_curvature(sheet, v)); k > 0)
      size_[v] = std::min(size_[v], std::sqrt(8 * *options.chord_error / k));
  FlowError error = flow_error(sheet, rates, scene == nullptr || scene->model.bending);
  if (scene != nullptr)
    look_ahead(sheet, *scene, rates, error, size_);
  share_out(sheet, rates, error, options.edge_length, bounds, size_);
  limit_by_thickness(sheet, rates, options.inner_faces, size_);
  for (std::uint32_t t = 0; t < sheet.mesh().triangle_slots(); ++t)
    for (const std::uint32_t v : sheet.mesh().corners(t))
      size_[v] = std::max(size_[v], std::min(thicknesses_an_edge * rates[t].thickness, bounds.high));
  for (std::size_t v = 0; v < options.inner_faces.size(); ++v)
    if (const double buried = options.inner_faces[v] - 1; buried > 0)
      size_[v] += buried * std::max(0.0, options.edge_length - size_[v]);
  for (double& size : size_)
    size = std::clamp(size, bounds.low, bounds.high);
  grade(sheet, size_);
}

double SizeField::shortest() const { return size_.empty() ? uniform_ : *std::min_element(size_.begin(), size_.end()); }

void SizeField::set_between(std::uint32_t v, std::uint32_t a, std::uint32_t b) {
  for (std::vector<double>* values : {&size_, &thick_}) {
    if (values->empty())
      continue;
    const double between = 0.5 * ((*values)[a] + (*values)[b]);
    if (v >= values->size())
      values->resize(v + 1);
    (*values)[v] = between;
  }
}

} // namespace sheet::remesh
