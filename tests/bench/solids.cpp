// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets against solids: what gets through, what distances cost.
//   bench_solids tunnelling [MESH]    a sheet thrown at solids at 1, 10, 100 m/s with steps of 1/24 s
//   bench_solids fields MESH...       OpenVDB's distances against exact ones, over voxel size; time and memory
//   bench_solids cost [MESH]          a step's time where nothing, something, everything touches
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>

#include <unistd.h>

#include "libsheet/base/error.h"
#include "libsheet/collide/distance_field.h"
#include "libsheet/collide/solid_check.h"
#include "libsheet/collide/solid_contact.h"
#include "libsheet/collide/triangle_tree.h"
#include "tests/support/falling_sheet.h"

using namespace sheet;
using namespace sheet::collide;

namespace {

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

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
  const std::string file = "/tmp/needle-" + std::to_string(getpid()) + ".obj";
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

void tunnelling(const std::string& mesh) {
  std::printf("sheet 0.6 m x 0.6 m, thickness h = 5 mm, edge 15 mm, 1 cm above the solid, one step of 1/24 s\n");
  std::printf("%-28s %8s %12s %12s %9s %7s %8s %10s %9s\n", "solid", "speed", "least/h", "penetr./h", "touching",
              "pushed", "carried", "unresolved", "time [ms]");
  for (const Named& target : targets(mesh))
    for (const double speed : {1.0, 10.0, 100.0}) {
      test::FallingSheet sheet(0.6, 40, 5e-3, target.top + 0.01, {0, -speed, 0}, 1.0 / 24);
      const double begin = seconds();
      const SolidReport report = resolve_solids(sheet.path, target.solids);
      const double time = seconds() - begin;
      const double least = test::least_distance(sheet.path, target.solids, 0, 5e-4, 5) / 5e-3;
      std::printf("%-28s %8.0f %12.4f %12.4f %9zu %7zu %8zu %10zu %9.2f\n", target.name, speed, least,
                  std::max(0.0, -least), report.touching, report.pushed, report.carried, report.unresolved, 1e3 * time);
    }
}

} // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    if (words.empty())
      fail(ExitCode::usage, "bench_solids: say what: tunnelling, fields or cost");
    if (words[0] == "tunnelling")
      tunnelling(words.size() > 1 ? words[1] : "");
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
