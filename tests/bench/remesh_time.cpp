// SPDX-License-Identifier: GPL-3.0-or-later
// Processor time of remeshing [ms], medians of `repeats` on the same frames, against CGAL's isotropic_remeshing (which
// conserves nothing), in one run.   bench_remesh_time [LARGEST number of triangles, default 100000] [REPEATS, default
// 5]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/core.h>

#include "libsheet/shape/shapes.h"
#include "tests/support/remesh/flows.h"

namespace {

using namespace sheet;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

CgalMesh cgal_mesh(const formats::Frame& frame) {
  CgalMesh mesh;
  for (const Vector3& x : positions(frame))
    mesh.add_vertex({x[0], x[1], x[2]});
  for (const Corners& t : triangles(frame))
    mesh.add_face(CgalMesh::Vertex_index(t[0]), CgalMesh::Vertex_index(t[1]), CgalMesh::Vertex_index(t[2]));
  return mesh;
}

template <class Work> double median_ms(int repeats, Work work) {
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i)
    times.push_back(work());
  std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
  return times[static_cast<std::size_t>(repeats / 2)];
}

// Both run on one thread, and a processor's time depends little on what else the machine does.
double since(std::clock_t start) { return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC; }

struct Timed {
  double ms;
  std::uint64_t edits;
};
Timed ours(const formats::Frame& frame, double edge_length, bool smooth, bool safe, int repeats) {
  remesh::Options options;
  options.size.edge_length = edge_length;
  options.smooth = smooth;
  options.intersections = safe;
  std::uint64_t edits = 0;
  const double ms = median_ms(repeats, [&] {
    formats::Frame copy = frame;
    const std::clock_t start = std::clock();
    edits = remesh::remesh(copy, nullptr, options).edits();
    return since(start);
  });
  return {ms, edits};
}

double cgal(const formats::Frame& frame, double edge_length, int repeats) {
  return median_ms(repeats, [&] {
    CgalMesh mesh = cgal_mesh(frame);
    const std::clock_t start = std::clock();
    CGAL::Polygon_mesh_processing::isotropic_remeshing(
        faces(mesh), edge_length, mesh, CGAL::Polygon_mesh_processing::parameters::number_of_iterations(1));
    return since(start);
  });
}

// A wavy square of about this many triangles: a remeshed one, then stretched as one time step would.
formats::Frame stretched(std::size_t wanted, double edge_length, double by) {
  const double side = std::sqrt(static_cast<double>(wanted) * std::sqrt(3.0) / 4) * edge_length;
  MeshOptions edges;
  edges.edge_length = edge_length;
  TriangleMesh mesh = make_rectangle(side, side, edges);
  for (Vector3& x : mesh.positions)
    x[2] = 2 * edge_length * std::sin(0.3 * x[0] / edge_length);
  formats::Frame frame = test::frame_of(mesh, 0.01 * edge_length);
  remesh::Options options;
  options.size.edge_length = edge_length;
  options.smooth = true;
  for (int i = 0; i < 3; ++i)
    static_cast<void>(remesh::remesh(frame, nullptr, options));
  for (Vector3& u : velocities(frame))
    u = {1, 0, 0};
  for (Vector3& x : positions(frame))
    x = {x[0] * by, x[1] / by, x[2]};
  return frame;
}

} // namespace

int main(int argc, char** argv) {
  const std::size_t largest = argc > 1 ? static_cast<std::size_t>(std::atol(argv[1])) : 100000;
  const int repeats = argc > 2 ? std::atoi(argv[2]) : 5;
  fmt::print("mesh,triangles,edits_all,ours_plain,ours_safe,ours_all,cgal,all_over_cgal,all_per_1000_triangles\n");
  const auto row = [&](const char* name, const formats::Frame& frame) {
    const Timed plain = ours(frame, 0.01, false, false, repeats), safe = ours(frame, 0.01, false, true, repeats),
                all = ours(frame, 0.01, true, true, repeats);
    const double other = cgal(frame, 0.01, repeats);
    fmt::print("{},{},{},{:.2f},{:.2f},{:.2f},{:.2f},{:.3f},{:.3f}\n", name, frame.triangles, all.edits, plain.ms,
               safe.ms, all.ms, other, all.ms / other, all.ms / (static_cast<double>(frame.triangles) / 1000));
    std::fflush(stdout);
  };
  for (std::size_t n = 1000; n <= largest; n *= 10) {
    row("needs nothing", stretched(n, 0.01, 1));
    row("stretched by 2 %", stretched(n, 0.01, 1.02));
    row("stretched by 20 %", stretched(n, 0.01, 1.2));
  }
}
