// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/view/liquid_looks.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "libsheet/render/display.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::view {

std::vector<std::string> names_of_liquids(const Scene& scene) {
  std::vector<std::string> names(liquids_of(scene).size());
  for (const scene::SheetTable& sheet : scene.sheets)
    if (std::string& name = names[liquid_of(scene, sheet)]; !sheet.name.empty())
      name += (name.empty() ? "" : ", ") + sheet.name;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i].empty())
      names[i] = fmt::format("liquid {}", i + 1);
  return names;
}

std::vector<double> liquid_thickness(const formats::Frame& frame, std::span<const std::uint32_t> numbers,
                                     std::size_t liquids) {
  std::vector<double> area(liquids, 0), volume(liquids, 0);
  const auto x = positions(frame);
  for (std::size_t t = 0; t < frame.triangles; ++t) {
    const Corners& c = triangles(frame)[t];
    const std::size_t liquid = numbers.empty() ? 0 : numbers[t];
    area[liquid] += 0.5 * (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm();
    volume[liquid] += volumes(frame)[t];
  }
  for (std::size_t i = 0; i < liquids; ++i)
    volume[i] = area[i] > 0 ? volume[i] / area[i] : 0;
  return volume;
}

DisplayedColour colour_on_white(const render::Liquid& liquid, double h) {
  constexpr float white = 0.8F;
  const render::Slab slab(liquid);
  const render::Straight straight = slab.straight(1, static_cast<float>(h));
  const render::Diffuse diffuse = slab.diffuse(static_cast<float>(h));
  const render::Colour thrown = straight.coupled * diffuse.reflected,
                       passed = straight.transmitted + straight.coupled * diffuse.transmitted;
  const render::Colour all = thrown + passed.square() * white / (1 - white * (straight.reflected + thrown));
  DisplayedColour colour;
  for (std::size_t c = 0; c < colour.size(); ++c)
    colour[c] = render::encode_srgb(std::clamp(all[static_cast<Eigen::Index>(c)], 0.0F, 1.0F));
  return colour;
}

} // namespace sheet::view
