// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/row_perturbation.h"

#include "libsheet/shape/random.h"
#include "libsheet/shape/waves.h"

namespace sheet::flow {

namespace {

std::uint64_t mixed(std::uint64_t seed, std::uint64_t number) { return Random(seed + number).next(); }

} // namespace

RowPerturbation::RowPerturbation(const Scene& scene, std::size_t number, const formats::Frame& frame) {
  const scene::Inflow& inflow = scene.inflows[number];
  const scene::SheetTable& table = sheet_named(scene, inflow.sheet);
  for (const scene::Perturbation& p : table.perturbations) {
    if (p.of_thickness)
      continue;
    if (const auto* wave = std::get_if<scene::Wave>(&p.form))
      waves_.push_back(wave_field(p, *wave, table));
    else
      noises_.push_back(
          {p.amplitude,
           mixed(mixed(static_cast<std::uint64_t>(std::get<scene::Noise>(p.form).seed), number), frame.step)});
  }
  center_ = table.center;
  velocity_ = scene::inlet_velocity(scene, inflow);
  from_ = table.enters.value_or(0);
  until_ = frame.time;
  to_plane_ = scene::matrix(table.rotation).transpose();
}

double RowPerturbation::at(const Eigen::Vector3d& origin, const Eigen::Vector3d& lowest, double part, std::size_t row,
                           std::size_t i) const {
  // What stands at the inlet now would have been `come` behind it at the start. The inlet itself stays as it was then.
  const Eigen::Vector3d come = velocity_.way(from_, until_, origin);
  const auto at_start = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return to_plane_ * (x - center_); };
  double way = 0;
  for (const HeightField& wave : waves_)
    way += wave(at_start(origin + part * (lowest - origin) - come)) - (1 - part) * wave(at_start(origin)) -
           part * wave(at_start(lowest - come));
  for (const NoiseOf& noise : noises_)
    way += Random(mixed(mixed(noise.seed, row), i)).uniform(-noise.amplitude, noise.amplitude);
  return way;
}

} // namespace sheet::flow
