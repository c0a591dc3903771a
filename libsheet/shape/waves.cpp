// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/waves.h"

#include "libsheet/geometry/types.h"

namespace sheet {

using Eigen::Vector3d;

HeightField wave_field(const scene::Perturbation& perturbation, const scene::Wave& wave,
                       const scene::SheetTable& table) {
  const double shift = -wave.phase / two_pi * wave.wavelength;
  if (wave.direction == scene::SheetDirection::radial) {
    const auto* annulus = std::get_if<scene::Annulus>(&table.shape);
    const Vector3d axis = Vector3d::Unit(scene::axes_of(table.plane).normal);
    const double start = annulus == nullptr ? 0 : annulus->inner_radius;
    return radial_wave(perturbation.amplitude, wave.wavelength, axis, Vector3d::Zero(), start + shift);
  }
  const Vector3d direction = Vector3d::Unit(static_cast<int>(wave.direction));
  return plane_wave(perturbation.amplitude, wave.wavelength, direction, shift * direction);
}

} // namespace sheet
