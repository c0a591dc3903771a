// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/open_rims.h"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "libsheet/geometry/connectivity.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"
#include "libsheet/solve/gas_holes.h"

namespace sheet {

std::string open_rim_warning(const Scene& scene, const formats::Frame& first) {
  constexpr const char* sealed = "gas.sealed"; // what first_frame has closed (gas_holes.h)
  if (!encloses_gas(scene) || std::get<scene::GasPressure>(*scene.environment.pressure).leak > 0 ||
      first.find(sealed) == nullptr)
    return "";
  formats::Frame open = first;
  open.erase(sealed);
  const Connectivity mesh = connect(open.vertices, triangles(open));
  const solid::Solids solids(scene);
  std::vector<double> clearances = rim_clearances(scene, open, mesh, &solids).with_bath;
  const auto encloses = masks(first, sealed);
  for (std::size_t v = 0; v < clearances.size(); ++v)
    clearances[v] = encloses[v] != 0 ? clearances[v] : 0;
  const GasHoles holes = gas_holes(mesh, positions(std::as_const(open)), clearances, {});
  if (!(holes.area > 0))
    return "";
  const Vector3 place = (holes.place.array().abs() > 1e-9 * holes.place.norm()).select(holes.place, 0.0);
  return fmt::format("the sheet, which encloses gas, starts with an open rim, about ({:.3g}, {:.3g}, {:.3g}) m: that "
                     "counts as closed, as by a lid without weight, and no gas leaves there. leak in pressure lets it "
                     "out; a [[hold]] at the rim says that it is closed",
                     place.x(), place.y(), place.z());
}

} // namespace sheet
