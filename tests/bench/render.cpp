// SPDX-License-Identifier: GPL-3.0-or-later
// Seconds for a picture of 1280 x 720 against Embree's bare ray casting in the same run, by number of triangles and
// material. Processor time of the whole process, so that other load on the machine matters little; the least of some
// repetitions. An idle machine takes 1 / cores of it. render [samples [repetitions]]
//   bare: nearest hits of the camera's rays, one a pixel and sample, nothing else done
//   wild: the same number of rays between random points of the surfaces' box, which no cache helps
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include <tbb/parallel_for.h>

#include "libsheet/render/draw.h"
#include "libsheet/render/path_tracer.h"
#include "tests/unit/render/scenes.h"

using namespace sheet;
using namespace sheet::render;

namespace {

double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// The least of some runs, in seconds.
template <class F> double measure(int repetitions, F&& f) {
  double least = 1e30;
  for (int k = 0; k < repetitions; ++k) {
    const double start = processor_seconds();
    f();
    least = std::min(least, processor_seconds() - start);
  }
  return least;
}

template <class MakeRay> double cast(const World& world, const DrawOptions& o, int repetitions, MakeRay&& make_ray) {
  return measure(repetitions, [&] {
    tbb::parallel_for(0, o.height, [&](int y) {
      float sum = 0;
      for (int x = 0; x < o.width; ++x)
        for (int s = 0; s < o.samples; ++s)
          sum += world.bare_distance(make_ray(x, y, s));
      volatile float kept = sum;
      static_cast<void>(kept);
    });
  });
}

} // namespace

int main(int argc, char** argv) {
  DrawOptions o;
  o.samples = argc > 1 ? std::atoi(argv[1]) : 8;
  const int repetitions = argc > 2 ? std::atoi(argv[2]) : 3;
  std::printf("triangles,material,samples,seconds,build,Mrays,bare_seconds,wild_seconds,picture/bare,"
              "ray/bare_ray,ray/wild_ray\n");
  for (const int n : {50, 158}) {
    const formats::Frame frame = test::trough(n, 0.005);
    const Box box = test::box_of(frame);
    const std::vector<Plane> ground = {{ground_id, Vector3(0, -0.6, 0), Vector3::UnitY()}};
    const Surface surface = make_surface(middle_of(frame), 1e-4);
    const World world(surface, {}, {}, ground, box);
    const double build = measure(repetitions, [&] { const World again(surface, {}, {}, ground, box); });
    const Camera camera = test::frame_box(box, {}, Vector3::UnitY(), 16.0 / 9, 0.06);
    const Vec eye = world.to_world(camera.eye());
    const double bare = cast(world, o, repetitions, [&](int x, int y, int s) {
      return Ray{eye, camera.direction((x + (s + 0.5) / o.samples) / o.width, (y + 0.5) / o.height)};
    });
    const double wild = cast(world, o, repetitions, [&](int x, int y, int s) {
      Sampler sampler(static_cast<std::uint32_t>(y * o.width + x), static_cast<std::uint32_t>(s));
      const Point2 a = sampler.point(), b = sampler.point(), c = sampler.point();
      const Vec from = Vec(a.x, a.y, b.x) - Vec::Constant(0.5F), to = Vec(b.y, c.x, c.y) - Vec::Constant(0.5F);
      return Ray{from, (to - from).normalized()};
    });
    const Lighting lighting = Lighting::studio(-camera.axis(), Vec::UnitY());
    for (const std::size_t liquid : {0, 2}) {
      const PathTracer tracer(world, lighting, {preset(liquid)}, {});
      Picture picture;
      const double seconds = measure(repetitions, [&] {
        picture = draw(
            world, camera,
            [&](const Ray& ray, Sampler& sampler, std::uint64_t& rays) {
              return tracer.radiance(ray, sampler, rays).sum();
            },
            o, nullptr);
      });
      const double camera_rays = static_cast<double>(o.width) * o.height * o.samples;
      const double ray = seconds / static_cast<double>(picture.rays);
      std::printf("%d,%s,%d,%.2f,%.3f,%.1f,%.2f,%.2f,%.1f,%.1f,%.1f\n", 2 * n * n, liquid_names()[liquid].c_str(),
                  o.samples, seconds, build, 1e-6 * static_cast<double>(picture.rays), bare, wild, seconds / bare,
                  ray / (bare / camera_rays), ray / (wild / camera_rays));
      std::fflush(stdout);
    }
  }
}
