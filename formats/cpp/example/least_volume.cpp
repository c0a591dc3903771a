// SPDX-License-Identifier: MIT
// Prints time [s] and least volume of a triangle [m^3] of every frame: least_volume < run.sheet
#include <algorithm>
#include <cstdio>

#include "formats/cpp/stream_reader.h"

int main() {
  try {
    sheet::formats::StreamReader reader(0, "standard input");
    for (sheet::formats::Frame frame; reader.read(frame);) {
      const auto volumes = frame.find("volume")->values<double>();
      std::printf("%g %g\n", frame.time, std::ranges::min(volumes));
    }
  } catch (const sheet::formats::StreamError& error) {
    std::fprintf(stderr, "least_volume: %s\n", error.what());
    return 1;
  }
}
