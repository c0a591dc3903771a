// SPDX-License-Identifier: GPL-3.0-or-later
// How deep the sheet of a stream lies in the solids of its scene, by exact distances (of meshes too), over whole
// triangles.
//   bench_penetration RUN.sheet     CSV, a line a frame: time [s]; triangles nearer than their thickness h to a solid;
//                                   the least distance d of a mid-surface from a solid, over h (below 0: the sheet is
//                                   pierced); the mean of d/h over those triangles; the greatest depth h/2 - d [m] to
//                                   which a sheet's side lies in a solid
#include <algorithm>
#include <cstdio>
#include <limits>
#include <optional>

#include <fmt/core.h>

#include "formats/cpp/stream_reader.h"
#include "libsheet/base/error.h"
#include "libsheet/base/files.h"
#include "libsheet/scene/frame_scene.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

namespace {

using namespace sheet;
using namespace sheet::solid;

struct Depth {
  std::size_t near = 0;
  double least = std::numeric_limits<double>::infinity(), sum = 0, deepest = 0;
};

Depth measure(const formats::Frame& frame, const Solids& solids) {
  Depth result;
  const auto x = positions(frame);
  const auto corners = triangles(frame);
  const auto volume = volumes(frame);
  for (std::size_t solid = 0; solid < solids.size(); ++solid) {
    const Eigen::Isometry3d into = solids.pose(solid, frame.time).inverse();
    const SolidDistance& shape = solids.shape(solid);
    for (std::size_t t = 0; t < corners.size(); ++t) {
      const Triangle3 triangle = {into * x[corners[t][0]], into * x[corners[t][1]], into * x[corners[t][2]]};
      const double area = 0.5 * (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).norm();
      const double thickness = volume[t] / area;
      const Vector3 middle = (triangle[0] + triangle[1] + triangle[2]) / 3;
      double radius = 0;
      for (const Vector3& corner : triangle)
        radius = std::max(radius, (corner - middle).norm());
      if (shape.distance(middle, 2 * (radius + thickness)) > radius + thickness)
        continue;
      const double distance = shape.deepest(triangle, 1e-2 * thickness).near.distance;
      if (distance > thickness)
        continue;
      ++result.near;
      result.sum += distance / thickness;
      result.least = std::min(result.least, distance / thickness);
      result.deepest = std::max(result.deepest, thickness / 2 - distance);
    }
  }
  return result;
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "bench_penetration: give one stream\n");
    return 2;
  }
  try {
    const InputFile file(argv[1]);
    formats::StreamReader reader(file.descriptor(), file.name());
    formats::Frame frame;
    FrameScene scenes;
    std::optional<Solids> solids;
    fmt::print("time,near,least_over_h,mean_over_h,depth\n");
    while (reader.read(frame)) {
      const Scene& scene = scenes.of(frame);
      if (scenes.changed())
        solids.emplace(scene);
      const Depth depth = measure(frame, *solids);
      if (depth.near == 0)
        fmt::print("{:.6g},0,,,\n", frame.time);
      else
        fmt::print("{:.6g},{},{:.4f},{:.4f},{:.3g}\n", frame.time, depth.near, depth.least,
                   depth.sum / static_cast<double>(depth.near), depth.deepest);
      std::fflush(stdout);
    }
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(error.code());
  } catch (const formats::StreamError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 4;
  }
  return 0;
}
