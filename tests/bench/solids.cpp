// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets against solids: what gets through, what distances cost. One thread; times are processor times.
//   bench_solids tunnelling [MESH [THICKNESS]]
//                                     a sheet thrown at solids at 1, 10, 100 m/s with steps of 1/24 s
//   bench_solids fields MESH...       OpenVDB's distances against exact ones, over voxel size; time and memory
//   bench_solids meshes MESH...       a sheet and each mesh, 0.4 m in size: at rest, moving, spinning
//   bench_solids cost [MESH]          a step's time where nothing, something, everything touches
//   bench_solids searches             evaluations and times of searches where contact is near
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include <time.h>
#include <unistd.h>

#include "libsheet/base/error.h"
#include "libsheet/base/parallel.h"
#include "libsheet/collide/solid_contact.h"
#include "libsheet/solid/check.h"
#include "libsheet/solid/distance_field.h"
#include "libsheet/solid/triangle_tree.h"
#include "tests/support/falling_sheet.h"
#include "tests/support/slow_searches.h"

using namespace sheet;
using namespace sheet::collide;
using namespace sheet::solid;

namespace {

// Processor time: tells the same on a busy machine.
double seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Named {
  const char* name;
  Solids solids;
  double top; // its highest point
};

Solids one(scene::SolidShape shape, const Vector3& center, std::optional<scene::Rotation> rotation = std::nullopt) {
  Scene scene;
  scene.solids.resize(1);
  scene.solids[0].shape = std::move(shape);
  scene.solids[0].center = center;
  scene.solids[0].rotation = rotation;
  return Solids(scene);
}

void write_obj(const std::string& file, const SolidSurface& surface) {
  std::ofstream out(file);
  out.precision(17);
  for (const Vector3& x : surface.points)
    out << "v " << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
  for (const Corners& c : surface.triangles)
    out << "f " << c[0] + 1 << ' ' << c[1] + 1 << ' ' << c[2] + 1 << '\n';
}

std::vector<Named> targets(const std::string& mesh) {
  std::vector<Named> result;
  result.push_back({"sphere, radius 0.1", one(scene::Sphere{0.1}, {0, 0, 0}), 0.1});
  const scene::Rotation lying{Vector3::UnitX(), std::numbers::pi / 2};
  result.push_back({"rod, radius 1 mm", one(scene::Capsule{1e-3, 0.8}, {0, 0, 0}, lying), 1e-3});
  result.push_back({"rod, radius 10 um", one(scene::Capsule{1e-5, 0.8}, {0, 0, 0}, lying), 1e-5});
  result.push_back({"upright pin, radius 0.2 mm", one(scene::Capsule{2e-4, 0.3}, {2e-3, 0, 1e-3}), 0.15 + 2e-4});
  const scene::Rotation corner{Vector3(1, 0, -1).normalized(), std::acos(1 / std::sqrt(3.0))};
  result.push_back(
      {"box on its corner", one(scene::SolidBox{{0.1, 0.1, 0.1}}, {0, 0, 0}, corner), 0.05 * std::sqrt(3.0)});
  const std::string file =
      (std::filesystem::temp_directory_path() / ("needle-" + std::to_string(getpid()) + ".obj")).string();
  write_obj(file, test::needle(2e-3, 0.2, 8));
  result.push_back({"needle, a mesh", one(scene::SolidMesh{file, 1, {}}, {3e-3, 0, 2e-3}), 0.2});
  std::remove(file.c_str());
  if (!mesh.empty()) {
    Solids solids = one(scene::SolidMesh{mesh, 0.4, {}}, {0, 0, 0});
    const double top = solids.shape(0).bounds().max().y();
    result.push_back({"mesh", std::move(solids), top});
  }
  return result;
}

void tunnelling(const std::string& mesh, double thickness) {
  std::printf("sheet 0.6 m x 0.6 m, thickness h = %g mm, edge 15 mm, 1 cm above the solid, one step of 1/24 s\n",
              1e3 * thickness);
  std::printf("%-28s %8s %12s %12s %9s %7s %8s %10s %9s\n", "solid", "speed", "least/h", "penetr./h", "touching",
              "pushed", "carried", "unresolved", "time [ms]");
  for (const Named& target : targets(mesh))
    for (const double speed : {1.0, 10.0, 100.0}) {
      test::FallingSheet sheet(0.6, 40, thickness, target.top + 0.01, {0, -speed, 0}, 1.0 / 24);
      const double begin = seconds();
      const SolidReport report = resolve_solids(sheet.path, target.solids);
      const double time = seconds() - begin;
      const double least =
          test::least_distance(sheet.path, target.solids, 0, std::max(thickness / 50, 5e-5), 5) / thickness;
      std::printf("%-28s %8.0f %12.4f %12.4f %9zu %7zu %8zu %10zu %9.2f\n", target.name, speed, least,
                  std::max(0.0, -least), report.touching, report.pushed, report.carried, report.unresolved, 1e3 * time);
    }
}

SolidSurface load(const std::string& mesh, double size) {
  SolidSurface surface = read_surface({mesh, 1, {}});
  Box3 box;
  for (const Vector3& x : surface.points)
    box.extend(x);
  for (Vector3& x : surface.points)
    x = (x - box.center()) * (size / box.sizes().maxCoeff());
  return surface;
}

template <class F> double nanoseconds_each(const std::vector<Vector3>& points, const F& query) {
  double sum = 0;
  const double begin = seconds();
  for (const Vector3& x : points)
    sum += query(x);
  const double time = seconds() - begin;
  if (sum == 0.123) // so that the queries are not optimised away
    std::puts("");
  return 1e9 * time / static_cast<double>(points.size());
}

void fields(const std::vector<std::string>& meshes) {
  std::printf("longest side 1 m; 100,000 points within 4 voxels of the surface; the tree is exact\n");
  std::printf("%-34s %6s %9s %9s %10s %10s %10s %9s %9s %9s\n", "mesh", "1/vox", "rms/vox", "max/vox", "voxels", "MB",
              "build [s]", "parse [s]", "field ns", "tree ns");
  for (const std::string& mesh : meshes)
    for (const double resolution : {32.0, 64.0, 128.0, 256.0}) {
      const double voxel = 1 / resolution;
      const SolidSurface surface = load(mesh, 1);
      double begin = seconds();
      const DistanceField field(surface, voxel, 6);
      const double build = seconds() - begin;
      const std::string bytes = field.print();
      begin = seconds();
      const DistanceField again = DistanceField::parse(bytes);
      const double parse = seconds() - begin;
      const TriangleTree tree(surface);
      std::mt19937 random(7);
      std::uniform_real_distribution<double> unit(-1, 1);
      std::vector<Vector3> points;
      while (points.size() < 100000) {
        const Vector3 x = surface.points[random() % surface.points.size()];
        const double a = unit(random), b = unit(random), c = unit(random);
        points.push_back(x + 2.3 * voxel * Vector3(a, b, c));
      }
      double worst = 0, squares = 0;
      for (const Vector3& x : points) {
        const double error = std::abs(again.at(x) - tree.nearest(x, 10)->distance);
        worst = std::max(worst, error);
        squares += error * error;
      }
      const double in_field = nanoseconds_each(points, [&](const Vector3& x) { return field.at(x); });
      const double in_tree = nanoseconds_each(points, [&](const Vector3& x) { return tree.nearest(x, 10)->distance; });
      std::printf("%-34s %6.0f %9.4f %9.4f %10zu %10.2f %10.3f %9.3f %9.0f %9.0f\n", mesh.c_str(), resolution,
                  std::sqrt(squares / static_cast<double>(points.size())) / voxel, worst / voxel, field.voxels(),
                  1e-6 * static_cast<double>(field.bytes()), build, parse, in_field, in_tree);
    }
}

void meshes(const std::vector<std::string>& files) {
  std::printf("sheet 0.6 m x 0.6 m, h = 5 mm, edge 15 mm; one step of 1/24 s\n");
  std::printf("%-34s %9s %10s %12s %9s %7s %8s %10s %9s\n", "mesh", "triangles", "motion", "least/h", "touching",
              "pushed", "carried", "unresolved", "time [ms]");
  for (const std::string& file : files) {
    const SolidSurface original = read_surface({file, 1, {}});
    Box3 box;
    for (const Vector3& x : original.points)
      box.extend(x);
    double begin = seconds();
    check_surface(original, file);
    const double check = seconds() - begin;
    const double scale = 0.4 / box.sizes().maxCoeff();
    for (const std::string motion : {"at rest", "rising", "spinning"}) {
      Scene scene;
      scene.solids.resize(1);
      scene.solids[0].shape = scene::SolidMesh{file, scale, {}};
      double speed = 10;
      if (motion == "rising") {
        scene.solids[0].motion = scene::Translating{{{{0, {0, 10, 0}}}}};
        speed = 0;
      } else if (motion == "spinning") {
        scene.solids[0].motion = scene::Rotating{{0, 1, 0}, scale * box.center(), {{{0, 20}}}};
        speed = 2;
      }
      const Solids solids(scene);
      test::FallingSheet sheet(0.6, 40, 5e-3, scale * box.max().y() + 0.01, {0, -speed, 0}, 1.0 / 24);
      begin = seconds();
      const SolidReport report = resolve_solids(sheet.path, solids);
      const double time = seconds() - begin;
      // Its end is what is measured: on the way there, what rides on a spinning solid does not go straight.
      sheet.path.start = sheet.path.end;
      sheet.path.start_time = sheet.path.end_time - 1e-12;
      const double least = test::least_distance(sheet.path, solids, 0, 1e-4, 1);
      std::printf("%-34s %9zu %10s %12.4f %9zu %7zu %8zu %10zu %9.2f\n", file.c_str(), original.triangles.size(),
                  motion.c_str(), least / 5e-3, report.touching, report.pushed, report.carried, report.unresolved,
                  1e3 * time);
    }
    std::printf("%-34s checked in %.2f s\n", file.c_str(), check);
  }
}

// Steps of 2 ms at 1 m/s onto a solid 0.4 m in size, a sheet of 15,129 vertices.
void cost(const std::string& mesh) {
  std::vector<Named> list;
  list.push_back({"no solid", Solids(Scene{}), 0.2});
  list.push_back({"sphere", one(scene::Sphere{0.2}, {0, 0, 0}), 0.2});
  list.push_back({"ground", one(scene::HalfSpace{{0, 1, 0}}, {0, 0.2, 0}), 0.2});
  if (!mesh.empty()) {
    Solids solids = one(scene::SolidMesh{mesh, 0.4, {}}, {0, 0, 0});
    const double top = solids.shape(0).bounds().max().y();
    list.push_back({"mesh", std::move(solids), top});
  }
  std::printf("%-10s %12s %12s %12s %12s %14s\n", "solid", "first [ms]", "step 20", "step 60", "step 100",
              "touching then");
  for (const Named& named : list) {
    test::FallingSheet sheet(0.6, 122, 5e-3, named.top + 0.004, {0, -1, 0}, 2e-3);
    std::printf("%-10s", named.name);
    SolidReport report;
    for (int step = 0; step <= 100; ++step) {
      const double begin = seconds();
      report = resolve_solids(sheet.path, named.solids);
      const double time = seconds() - begin;
      if (step == 0 || step == 20 || step == 60 || step == 100)
        std::printf(" %12.3f", 1e3 * time);
      sheet.go_on();
    }
    std::printf(" %14zu\n", report.touching);
  }
}

void searches() {
  std::printf("%-36s %8s %12s %12s\n", "triangle", "gap [m]", "evaluations", "time [ms]");
  for (const double gap : {1e-4, 1e-6, 1e-8, 1e-10})
    for (const auto& [name, moving] : test::slow_searches(gap)) {
      const test::CountedBox box;
      const double begin = seconds();
      (void)box.first_hit(moving, 0.9 * gap, 0.05 * gap);
      (void)box.separation(moving.start, gap, 1e-4 * gap);
      (void)box.separation(moving.end, gap, 1e-4 * gap);
      (void)box.deepest(moving.end, 0.05 * gap);
      std::printf("%-36s %8.0e %12ld %12.3f\n", name.c_str(), gap, box.count(), 1e3 * (seconds() - begin));
    }
}

} // namespace

int main(int argc, char** argv) {
  const ThreadLimit limit(1);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    if (words.empty())
      fail(ExitCode::usage, "bench_solids: say what: tunnelling, fields, meshes, cost or searches");
    if (words[0] == "tunnelling")
      tunnelling(words.size() > 1 ? words[1] : "", words.size() > 2 ? std::stod(words[2]) : 5e-3);
    else if (words[0] == "fields")
      fields({words.begin() + 1, words.end()});
    else if (words[0] == "meshes")
      meshes({words.begin() + 1, words.end()});
    else if (words[0] == "cost")
      cost(words.size() > 1 ? words[1] : "");
    else if (words[0] == "searches")
      searches();
    else
      fail(ExitCode::usage, "bench_solids: {} is unknown; say tunnelling, fields, meshes, cost or searches", words[0]);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
