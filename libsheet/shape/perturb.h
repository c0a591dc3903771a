// SPDX-License-Identifier: GPL-3.0-or-later
// Small deviations of a shape or of its thickness from the ideal: waves and noise, seeds of instabilities.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>

#include "libsheet/shape/triangle_mesh.h"

namespace sheet {

// A length [m] at every place [m].
using HeightField = std::function<double(const Eigen::Vector3d&)>;

// amplitude sin(2 pi s / wavelength), s = distance from `origin` along `direction` (any length above zero).
[[nodiscard]] HeightField plane_wave(double amplitude, double wavelength, const Eigen::Vector3d& direction,
                                     const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

// amplitude sin(2 pi s / wavelength), s = distance from the axis through `center` minus `start`.
[[nodiscard]] HeightField radial_wave(double amplitude, double wavelength, const Eigen::Vector3d& axis,
                                      const Eigen::Vector3d& center = Eigen::Vector3d::Zero(), double start = 0.0);

// Random waves of all directions with wavelengths from wavelength / 1.25 to wavelength * 1.25: mean 0, root mean square
// amplitude / sqrt(2), as a plane wave has. With `normal`, all directions are perpendicular to it: for flat sheets,
// on which slanted waves would seem longer. The same seed gives the same field.
[[nodiscard]] HeightField band_noise(double amplitude, double wavelength, std::uint64_t seed,
                                     const std::optional<Eigen::Vector3d>& normal = std::nullopt);

// Moves each vertex along its normal by the field's value.
void displace_along_normals(TriangleMesh& mesh, const HeightField& field);

// Sets the thickness at the vertices: mean [m], plus the field's value if there is one. Throws Error (bad_input) where
// that is not positive.
void set_thickness(TriangleMesh& mesh, double mean, const HeightField& field = nullptr);

} // namespace sheet
