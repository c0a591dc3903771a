// SPDX-License-Identifier: GPL-3.0-or-later
// Signed distances on the voxels near a closed surface: an OpenVDB level set. OpenVDB is loaded when the first is made
// (vdb/level_sets.h).
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "libsheet/solid/distance.h"
#include "libsheet/solid/mesh.h"

namespace sheet::solid {

class LevelSet;

class DistanceField {
public:
  // Distances of the surface at the corners of voxels [m], as far as `band` voxels from it on both sides; the same bits
  // for any number of threads. The surface must be closed.
  DistanceField(const SolidSurface& surface, double voxel_size, double band);
  ~DistanceField();
  DistanceField(DistanceField&&) noexcept;
  DistanceField& operator=(DistanceField&&) noexcept;

  // Interpolated linearly between the corners of the voxel at x; outside the band its half width, with the sign.
  [[nodiscard]] double at(const Vector3& x) const;

  // |at(x)| exceeds the true distance from the surface by no more than this: the corners of a voxel are at most its
  // diagonal's half from the mean, distances change no faster than 1, and their corners are exact [m].
  [[nodiscard]] double slack() const;

  [[nodiscard]] double voxel_size() const;
  [[nodiscard]] std::size_t bytes() const;  // of memory
  [[nodiscard]] std::size_t voxels() const; // that carry a distance of their own

  // The field as bytes and back (OpenVDB's own format). `parse` throws std::exception on anything else.
  [[nodiscard]] std::string print() const;
  [[nodiscard]] static DistanceField parse(const std::string& bytes);

private:
  explicit DistanceField(std::unique_ptr<const LevelSet> values);
  std::unique_ptr<const LevelSet> values_;
};

// Of what makes the fields, which other versions might do otherwise.
[[nodiscard]] std::uint64_t level_set_version();

// The zero level of the first level set in a .vdb file, as triangles. Throws Error (io, bad_input) naming the file.
[[nodiscard]] SolidSurface read_level_set(const std::string& file);

} // namespace sheet::solid
