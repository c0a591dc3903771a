// SPDX-License-Identifier: GPL-3.0-or-later
// How much liquid a picture shows, over what the stream has: bench_drawn_volume RUN.sheet, of each frame. CSV: time
// [s]; what the surface of the layers encloses over the stream's volume, with the beads of rims; the same of one body,
// whose surfaces are round where layers touch. What layers have in common counts twice in either.
#include <cstdio>

#include <fmt/core.h>

#include "formats/cpp/stream_reader.h"
#include "libsheet/base/error.h"
#include "libsheet/base/files.h"
#include "libsheet/render/body.h"
#include "libsheet/sheet/sheet.h"

namespace {

using namespace sheet;
using namespace sheet::render;

double enclosed(const Surface& s) {
  double sum = 0;
  for (const Corners& t : s.triangles)
    sum += s.positions[t[0]].dot(s.positions[t[1]].cross(s.positions[t[2]])) / 6;
  return sum;
}

void print(const formats::Frame& frame) {
  double volume = 0;
  for (const double part : volumes(frame))
    volume += part;
  Box box;
  for (const Vector3& x : positions(frame))
    box.add(x);
  const Surface layers = make_surface(middle_of(frame), 1e-4 * box.diagonal());
  const double body = enclosed(world_of_bodies(layers, {}, {}, {}, box)->surface());
  fmt::print("{},{:.5f},{:.5f}\n", frame.time, enclosed(layers) / volume, body / volume);
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "bench_drawn_volume: give one stream\n");
    return 2;
  }
  try {
    const InputFile file(argv[1]);
    formats::StreamReader reader(file.descriptor(), file.name());
    formats::Frame frame;
    fmt::print("time,layers,body\n");
    while (reader.read(frame))
      print(frame);
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(error.code());
  } catch (const formats::StreamError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 4;
  }
  return 0;
}
