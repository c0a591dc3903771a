// SPDX-License-Identifier: GPL-3.0-or-later
// make_grid N: writes a stream of one frame, a flat grid of N x N vertices with velocities and start positions.
#include <cstdlib>
#include <vector>

#include <unistd.h>

#include "formats/cpp/stream_writer.h"
#include "libsheet/sheet/sheet.h"

int main(int argc, char** argv) {
  using namespace sheet::formats;
  const auto n = static_cast<std::uint32_t>(argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 2);
  std::vector<Eigen::Vector3d> x;
  std::vector<sheet::Corners> t;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j)
      x.emplace_back(0.1 * i, 0, 0.1 * j);
  for (std::uint32_t i = 0; i + 1 < n; ++i)
    for (std::uint32_t j = 0; j + 1 < n; ++j) {
      const std::uint32_t a = i * n + j;
      t.push_back({a, a + 1, a + n});
      t.push_back({a + 1, a + n + 1, a + n});
    }
  Frame frame = sheet::make_frame(x, t, std::vector<double>(t.size(), 1e-6));
  for (Eigen::Vector3d& v : sheet::velocities(frame))
    v = {0, -1, 0};
  Array start = make_array("start_position", Place::vertex, Type::float64, 3, "m", Transfer::drop, x.size());
  if (!x.empty())
    std::memcpy(start.data.data(), x.data(), start.data.size());
  frame.put(std::move(start));
  StreamWriter writer(STDOUT_FILENO, "standard output");
  writer.write(frame);
  writer.end();
}
