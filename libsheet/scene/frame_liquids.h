// SPDX-License-Identifier: GPL-3.0-or-later
// Which liquid each triangle of a frame is of: the array "liquid" has its number in scene::liquids_of. Scenes of one
// liquid have no such array.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet::scene {

// A scene's liquids, and numbers of a frame's triangles. Good as long as the frame keeps its triangles.
class FrameLiquids {
public:
  // Throws Error (bad_input) where there are several and the frame does not say which, or names one that is none.
  FrameLiquids(const Scene& scene, const formats::Frame& frame);

  [[nodiscard]] const std::vector<Liquid>& all() const { return all_; }
  [[nodiscard]] bool several() const { return all_.size() > 1; }
  [[nodiscard]] std::span<const std::uint32_t> numbers() const { return numbers_; } // empty: all are 0
  [[nodiscard]] std::uint32_t number(std::size_t triangle) const { return numbers_.empty() ? 0 : numbers_[triangle]; }
  [[nodiscard]] const Liquid& of(std::size_t triangle) const { return all_[number(triangle)]; }
  [[nodiscard]] double density(std::size_t triangle) const { return of(triangle).density; } // [kg/m³]
  // Of one liquid 1: by what sums over triangles are weighed that are then multiplied by the first one's density.
  [[nodiscard]] double relative_density(std::size_t triangle) const {
    return several() ? density(triangle) / all_[0].density : 1;
  }
  // Of each vertex, of one of its triangles: layers of two liquids share none. Empty: all are 0.
  [[nodiscard]] std::vector<std::uint32_t> numbers_at_vertices(const formats::Frame& frame) const;

private:
  std::vector<Liquid> all_;
  std::span<const std::uint32_t> numbers_;
};

// Whether the frame says which triangle is of which, or all are of one. Stages that do not keep the array make frames
// that do not.
[[nodiscard]] bool tells_liquids(const Scene& scene, const formats::Frame& frame);

// What to do about that.
inline constexpr const char* keep_liquid = "the array \"liquid\" tells: sheet-init makes it, and stages must keep it";

// Adds the array, of a part that is wholly of the numbered liquid.
void put_liquid(std::size_t number, formats::Frame& frame);

} // namespace sheet::scene

namespace sheet {
using scene::FrameLiquids;
} // namespace sheet
