// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/explain.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "libsheet/base/overloaded.h"
#include "libsheet/material/driven_rate.h"
#include "libsheet/scene/brief.h"
#include "libsheet/scene/explain_heat.h"
#include "libsheet/scene/explain_law.h"
#include "libsheet/scene/layer_scales.h"
#include "libsheet/scene/level_planes.h"
#include "libsheet/scene/scales.h"

namespace sheet::scene {
namespace {

std::vector<Scale> scale_list(const Scene& scene, const Scales& scales) {
  std::vector<Scale> list;
  const auto add = [&](std::string_view symbol, std::string_view name, double value, std::string_view unit,
                       std::string source) {
    if (std::isfinite(value) && value > 0)
      list.push_back({symbol, name, value, unit, std::move(source)});
  };
  const double L = scales.length.value_or(0), h = scales.thickness.value_or(0), g = scales.gravity;
  const double rho = scene.material.density, gamma = scene.material.surface_tension;
  // In which a stress strains it by 1: mu over the stress, mu at that rate. What yields is not strained below.
  const auto time_under = [&](double stress, double borne) {
    return 1 / stretching_rate(scene.material, stress, borne);
  };
  add("L", "length", L, "m", "the shape's shortest side, radius or width");
  add("h", "thickness", h, "m", "the sheet's, at the start");
  add("V", "speed", scales.speed, "m/s", "the fastest drive: " + scales.speed_source);
  add("t_V", "time of the flow", L / scales.speed, "s", "L / V");
  std::ranges::move(scales_of_law(scene, scales), std::back_inserter(list));
  if (rho > 0)
    add("t_g", "time in which gravity stretches it", time_under(rho * g * L, std::numbers::sqrt3), "s",
        "mu / (rho g L)");
  add("t_f", "time of free fall", std::sqrt(L / g), "s", "sqrt(L / g)");
  add("t_c", "time in which surface tension contracts it", time_under(gamma / h, 1), "s", "mu h / gamma");
  if (const auto layer = layer_scales_of(scene, scales)) {
    add("U", "speed of a layer along the steepest solid", layer->speed, "m/s",
        std::string(scene.material.law.newtonian() ? "rho h (h + 3 b) (g_t + g h / L) / (3 mu)"
                                                   : "from its weight rho h (g_t + g h / L) and the law") +
            "; steps are kept below half an edge over it");
    add("t_U", "time in which it spreads by its length", layer->time, "s", "L / U");
    add("l_c", "capillary length", layer->capillary_length, "m", "sqrt(gamma / (rho g))");
  }
  add("t_p", "time in which pressure stretches it", time_under(scales.pressure * L / h, 2), "s", "mu h / (p L)");
  if (const auto& bath = scene.environment.bath) {
    const double excess = 4 * scales.viscosity * h * scales.speed / L - 2 * gamma;
    add("lambda", "wavelength of the fastest wrinkles on the bath",
        2 * std::numbers::pi * std::sqrt(excess / (2 * bath->density * g)), "m",
        "2 pi sqrt((P - 2 gamma) / (2 rho_bath g)), P = 4 mu h V / L, if it is compressed so fast");
  }
  return list;
}

std::vector<DimensionlessNumber> numbers_of(const Scene& scene, const Scales& scales) {
  std::vector<DimensionlessNumber> list;
  const auto add = [&](std::string_view name, std::string_view formula, double value, auto meaning) {
    if (std::isfinite(value) && value > 0)
      list.push_back({name, formula, value, std::string(meaning(value))});
  };
  if (!scales.length)
    return list;
  const double L = *scales.length, V = scales.speed, g = scales.gravity;
  const double mu = scales.viscosity, rho = scene.material.density, gamma = scene.material.surface_tension;
  if (scales.thickness) {
    const double slenderness = *scales.thickness / L;
    add("thickness to length", "h / L", slenderness, [](double x) {
      return x > 0.2    ? "Not a thin sheet: its equations are doubtful here."
             : x > 0.02 ? "A thick sheet: bending matters."
                        : "Thin: it folds and wrinkles far more easily than it stretches.";
    });
    add("bending to stretching", "(h / L)²", slenderness * slenderness,
        [](double x) { return fmt::format("Bending by a length L dissipates {} of what stretching does.", brief(x)); });
    add("buckling", "(12 / pi²) (L / h)²", 12 / (std::numbers::pi * std::numbers::pi * slenderness * slenderness),
        [](double x) {
          return x > 1 ? fmt::format("Under compression it buckles {} times as fast as it thickens.", brief(x))
                       : std::string("Under compression it thickens rather than buckles.");
        });
  }
  add("Reynolds", "rho V L / mu", rho * V * L / mu, [](double x) {
    return x < 0.01 ? "Creeping flow: viscosity stops everything at once, inertia hardly matters."
           : x < 10 ? "Viscosity and inertia both matter."
                    : "Inertia rules: it falls and flies before viscosity is felt.";
  });
  if (const auto layer = layer_scales_of(scene, scales))
    add("Reynolds of the layer", "U h² / (nu L)", layer->reynolds, [](double x) {
      return x < 1 ? "The drag of the wall is felt at once." : "Inertia delays the drag of the wall.";
    });
  // A sheet carries its load by its thickness, so its tension is judged by the numbers times h / L.
  const double part = scales.thickness ? *scales.thickness / L : 1;
  const auto against_tension = [](double x, std::string_view force) {
    return x < 0.1  ? fmt::format("In the sheet surface tension rules over {}.", force)
           : x < 10 ? fmt::format("In the sheet surface tension and {} are alike.", force)
                    : fmt::format("In the sheet {} rules over surface tension.", force);
  };
  add("capillary", "mu V / gamma", mu * V / gamma, [&](double x) {
    return against_tension(x * part, "viscous stress") + fmt::format(" (mu V h / (gamma L) = {})", brief(x * part));
  });
  add("Bond", "rho g L² / gamma", rho * g * L * L / gamma, [&](double x) {
    return against_tension(x * part, "weight") + fmt::format(" (rho g L h / gamma = {})", brief(x * part));
  });
  if (const auto& bath = scene.environment.bath) {
    add("Bond of the bath", "rho_bath g L² / gamma", bath->density * g * L * L / gamma, [](double x) {
      return x < 1 ? "Surface tension keeps the bath's surface flat." : "The bath's weight rules over surface tension.";
    });
    add("density to the bath's", "rho / rho_bath", rho / bath->density,
        [](double x) { return x > 1 ? "The sheet is heavier than the bath and sinks." : "The sheet floats."; });
  }
  std::ranges::move(numbers_of_law(scene, scales), std::back_inserter(list));
  return list;
}

// The longest edge that a shape's table asks for, diagonals aside [m]; a mesh's is not known.
std::optional<double> longest_edge(const SheetTable& sheet) {
  if (sheet.edge_length || !sheet.segments)
    return sheet.edge_length;
  const auto longer = [&segments = *sheet.segments](double circumference, double length) {
    return std::optional(std::max(circumference / segments[0], length / segments[1]));
  };
  constexpr double pi = std::numbers::pi;
  return std::visit(Overloaded{[&](const Cap& c) {
                                 const double widest = c.radius * std::sin(std::min(c.angle, pi / 2));
                                 return longer(2 * pi * widest, c.radius * (c.angle - c.opening));
                               },
                               [&](const Tube& t) { return longer(2 * pi * t.radius, t.height); },
                               [](const auto&) { return std::optional<double>(); }},
                    sheet.shape);
}

// What is curved, drawn together by tension and not blown up may buckle, in waves no shorter than some root(R h). Arcs
// longer than half of that give way before the sheet does.
std::optional<std::string> warning_of_buckling(const Scene& scene, const SheetTable& sheet, const Scales& scales) {
  const auto edge = longest_edge(sheet);
  const bool viscous = scene.material.viscous() && scene.material.surface_tension > 0;
  if (!edge || !scales.thickness || !viscous || !scene.model.bending || scales.curvature <= 0 || scales.pressure > 0)
    return {};
  const double enough = 0.5 * std::sqrt(*scales.thickness / scales.curvature);
  if (*edge <= enough)
    return {};
  return fmt::format(
      "edges of {} m are above sqrt(h / curvature) / 2 = {} m: if the sheet buckles, the mesh decides how",
      brief(*edge), brief(enough));
}

// Of a sheet that is thicker than long [m]; else "".
std::string hint_of_thickness(const SheetTable& sheet, double thickness, double length) {
  if (!(thickness > length))
    return "";
  if (std::holds_alternative<ThicknessData>(sheet.thickness))
    return fmt::format("; its data make it {} m thick: if they are in millimetres, scale = 0.001 in its thickness",
                       brief(thickness));
  return fmt::format("; it is {0} m thick: write \"{0} mm\" if you mean that; numbers without unit are metres",
                     brief(thickness));
}

// What jumps does so within one time step, which ends there: how hard it pulls goes by the step's length.
std::optional<std::string> warning_of_jumps(const Motion& motion, std::string_view thing) {
  const auto* keyed = std::get_if<Keyframed>(&motion);
  if (keyed == nullptr || keyed->frames->interpolation() != Interpolation::step)
    return {};
  return fmt::format("{} jumps at its rows (interpolation = \"step\"): what it carries along, or hits, follows within "
                     "one time step, and its forces go by the length of that step; \"linear\" moves it",
                     thing);
}

// How fast rows lead at a time, "" where that is slow for them.
std::string pace_at(const Keyframes& frames, double t) {
  constexpr double slow = 0.05; // of the fastest
  const auto [velocity, turning] = frames.rates(t);
  const auto all = frames.bounds(frames.times().front(), frames.times().back());
  const bool moves = velocity.norm() > slow * all.speed, turns = turning.norm() > slow * all.turning;
  return fmt::format("{}{}{}", moves ? brief(velocity.norm()) + " m/s" : "", moves && turns ? " and " : "",
                     turns ? brief(turning.norm()) + " rad/s" : "");
}

// Smooth rows keep their pace to the first and the last one, and at rest is the thing beyond.
std::optional<std::string> warning_of_abrupt_ends(const Motion& motion, std::string_view thing) {
  const auto* keyed = std::get_if<Keyframed>(&motion);
  if (keyed == nullptr || keyed->frames->interpolation() != Interpolation::smooth)
    return {};
  const std::vector<double>& times = keyed->frames->times();
  const double last = times.back();
  const std::string start = times.front() < 0 ? "" : pace_at(*keyed->frames, times.front()),
                    end = pace_at(*keyed->frames, std::nextafter(last, times.front()));
  if (start.empty() && end.empty())
    return {};
  return fmt::format(
      "{} {}{}{}, at once: smooth rows keep their pace up to both ends, and beyond it rests; another row "
      "like the first one before it (times may be below 0), and one like the last one after it, let it "
      "start and stop gently",
      thing, start.empty() ? "" : fmt::format("sets off at {} at {} s", start, brief(times.front())),
      start.empty() || end.empty() ? "" : " and ",
      end.empty() ? "" : fmt::format("stops from {} at {} s", end, brief(last)));
}

// "sheet NAME", or its number from 0; "" where there is no other.
std::string name_of_sheet(const Scene& scene, std::size_t number) {
  const std::string& name = scene.sheets[number].name;
  return scene.sheets.size() == 1 ? ""
         : name.empty()           ? fmt::format("sheet {}", number)
                                  : fmt::format("sheet \"{}\"", name);
}

// By something, at some time.
bool is_carried(const Scene& scene, const SheetTable& sheet) {
  const auto on_it = [&](const auto& thing) { return thing.sheet.empty() || thing.sheet == sheet.name; };
  return scene.environment.bath || std::ranges::any_of(scene.holds, on_it) || std::ranges::any_of(scene.inflows, on_it);
}

// Whether it never falls: what carries it does so from the start on, and for ever.
bool is_always_carried(const Scene& scene, const SheetTable& sheet, double above_bath) {
  const auto stays = [&](const auto& thing) {
    return !thing.until && (thing.sheet.empty() || thing.sheet == sheet.name);
  };
  return (scene.environment.bath && above_bath == 0) || std::ranges::any_of(scene.holds, stays) ||
         std::ranges::any_of(scene.inflows, stays);
}

// Whether solids may, or other sheets that are carried.
bool may_be_caught(const Scene& scene) {
  const auto carried = [&](const SheetTable& sheet) { return is_carried(scene, sheet); };
  return !scene.solids.empty() || (scene.contact && scene.contact->self && std::ranges::any_of(scene.sheets, carried));
}

std::vector<std::string> warnings_of_edges(const Scene& scene, const SheetTable& sheet, const Scales& scales) {
  std::vector<std::string> warnings;
  if (const auto edge = sheet.edge_length; edge && scales.thickness) {
    const double h = *scales.thickness, locking = std::sqrt(h / scales.curvature);
    if (scene.model.bending && scales.curvature > 0 && *edge > locking)
      warnings.push_back(fmt::format(
          "edge_length {} m is above sqrt(h / curvature) = {} m: flat triangles resist bending too much there",
          brief(*edge), brief(locking)));
    if (*edge < h)
      warnings.push_back(fmt::format("edge_length {} m is below the thickness {} m: a sheet has no detail that fine",
                                     brief(*edge), brief(h)));
  }
  if (const auto buckling = warning_of_buckling(scene, sheet, scales))
    warnings.push_back(*buckling);
  return warnings;
}

std::vector<std::string> warnings_of_sheet(const Scene& scene, const SheetTable& sheet, const Scales& scales) {
  std::vector<std::string> warnings;
  const auto warn = [&](std::string text) { warnings.push_back(std::move(text)); };
  const bool carried = is_carried(scene, sheet), always = is_always_carried(scene, sheet, scales.above_bath);
  for (const auto& number : numbers_of(scene, scales)) {
    if (number.name != "Reynolds")
      continue;
    if (scene.model.inertia && number.value < 1e-4 && (always || !scene.environment.gravity))
      warn(fmt::format("inertia is on, but the Reynolds number is {}: inertia = false gives the same motion",
                       brief(number.value)));
    if (!scene.model.inertia && number.value > 1)
      warn(fmt::format("inertia is off, but the Reynolds number is {}: the real sheet would move differently",
                       brief(number.value)));
  }
  if (const auto layer = layer_scales_of(scene, scales); layer && layer->reynolds > 1)
    warn(fmt::format("the Reynolds number of the layer on a solid is {}: drag that acts at once is wrong by its order",
                     brief(layer->reynolds)));
  for (std::string& warning : warnings_of_edges(scene, sheet, scales))
    warn(std::move(warning));
  if (const auto rest = warning_of_rest_rate(scene, scales))
    warn(*rest);
  if (const auto biot = warning_of_biot(scene, scales))
    warn(*biot);
  if (scales.length && scales.thickness && *scales.thickness > 0.2 * *scales.length)
    warn(fmt::format("the sheet is thicker than a fifth of its length: the equations of thin sheets are doubtful{}",
                     hint_of_thickness(sheet, *scales.thickness, *scales.length)));
  constexpr double large = 20;    // [m]
  constexpr double of_rock = 1e8; // ice and rock are that large [Pa s]
  if (scales.length && *scales.length > large && std::max(scales.viscosity, scene.material.viscosity) < of_rock)
    warn(fmt::format(
        "the sheet is {} m long: {}", brief(*scales.length),
        std::holds_alternative<SheetMesh>(sheet.shape)
            ? "if its mesh is in millimetres, give [sheet] scale = 0.001"
            : fmt::format("write \"{} mm\" if you mean that; numbers without unit are metres", brief(*scales.length))));
  if (scene.environment.gravity && !scene.model.inertia && !carried && scene.solids.empty())
    warn("creeping flow under gravity without hold, bath or inflow: nothing resists the fall, there is no solution");
  else if (scene.environment.gravity && !scene.model.inertia && !always && scene.solids.empty())
    warn("creeping flow under gravity of a sheet that falls, onto the bath, or as its holds and inlets let it go: "
         "nothing resists the fall, there is no solution then; model.inertia = true lets it fall");
  else if (scene.environment.gravity && !carried && !may_be_caught(scene))
    warn("nothing holds or catches the sheet: it falls for ever");
  return warnings;
}

// Of what is turned more than once round.
std::optional<std::string> warning_of_angle(const std::optional<Rotation>& rotation, std::string_view what) {
  constexpr double rounding = 1e-9;
  if (!rotation || !(std::abs(rotation->angle) > 2 * std::numbers::pi * (1 + rounding)))
    return std::nullopt;
  return fmt::format("{} is turned by {} rad, {} times round: a plain number is in radians; degrees are written \"{} "
                     "deg\"",
                     what, brief(rotation->angle), brief(std::abs(rotation->angle) / (2 * std::numbers::pi)),
                     brief(rotation->angle));
}

bool tense(const Scene& scene) {
  return std::ranges::any_of(liquids_of(scene), [](const Liquid& liquid) { return liquid.surface_tension > 0; });
}

// Of one of a kind, by its number from 0 and what it is called.
using WarningOf = std::function<std::optional<std::string>(std::size_t number, std::string_view thing)>;

// Of each of a kind, told once of all of whom the same is said.
std::vector<std::string> warnings_of_each(std::string_view kind, std::size_t count, const WarningOf& warning_of) {
  std::vector<std::pair<std::string, std::vector<std::size_t>>> alike; // what is said, but of whom; of whom
  for (std::size_t i = 0; i < count; ++i)
    if (const auto words = warning_of(i, "")) {
      const auto same = std::ranges::find(alike, *words, &decltype(alike)::value_type::first);
      (same == alike.end() ? alike.emplace_back(*words, std::vector<std::size_t>()) : *same).second.push_back(i);
    }
  std::vector<std::string> warnings;
  for (const auto& [words, numbers] : alike) {
    const std::string more = numbers.size() > 1 ? fmt::format(" (and {} more alike)", numbers.size() - 1) : "";
    warnings.push_back(*warning_of(numbers.front(), fmt::format("{} {}{}", kind, numbers.front(), more)));
  }
  return warnings;
}

std::optional<std::string> warning_of_turning(const Scene& scene, std::size_t i, std::string_view thing) {
  return warning_of_angle(scene.solids[i].rotation, thing);
}

std::optional<std::string> warning_of_level(const Scene& scene, std::size_t i, std::string_view thing) {
  const auto level = level_plane_in_doubt(scene, i);
  return level ? std::optional(fmt::format("{} (plane): {}", thing, *level)) : std::nullopt;
}

std::optional<std::string> warning_of_contact_angle(const Scene& scene, std::size_t i, std::string_view thing) {
  if (!scene.solids[i].contact_angle || tense(scene))
    return std::nullopt;
  return fmt::format("contact_angle of {} does nothing: there is no surface_tension in [material]", thing);
}

constexpr double coldest_likely = 200; // that a liquid starts at [K]

std::vector<std::string> warnings_of(const Scene& scene, std::span<const Scales> scales) {
  std::vector<std::string> warnings;
  const auto warn = [&](std::string text) { warnings.push_back(std::move(text)); };
  for (std::size_t i = 0; i < scene.sheets.size(); ++i) {
    const std::string name = name_of_sheet(scene, i);
    for (const std::string& warning :
         warnings_of_sheet(with_material_of(scene, scene.sheets[i]), scene.sheets[i], scales[i]))
      warn(name.empty() ? warning : name + ": " + warning);
    if (const auto angle = warning_of_angle(scene.sheets[i].rotation, name.empty() ? "the sheet" : name))
      warn(*angle);
  }
  const auto warn_of_each = [&](std::string_view kind, std::size_t count, const WarningOf& warning_of) {
    std::ranges::copy(warnings_of_each(kind, count, warning_of), std::back_inserter(warnings));
  };
  for (const auto warning_of : {warning_of_jumps, warning_of_abrupt_ends}) {
    warn_of_each("hold", scene.holds.size(),
                 [&](std::size_t i, std::string_view thing) { return warning_of(scene.holds[i].motion, thing); });
    warn_of_each("solid", scene.solids.size(),
                 [&](std::size_t i, std::string_view thing) { return warning_of(scene.solids[i].motion, thing); });
  }
  for (const auto warning_of : {warning_of_turning, warning_of_level, warning_of_contact_angle})
    warn_of_each("solid", scene.solids.size(),
                 [&](std::size_t i, std::string_view thing) { return warning_of(scene, i, thing); });
  if (std::ranges::all_of(scales, [](const Scales& s) { return s.speed == 0; }) && !scene.environment.pressure &&
      !scene.environment.gravity)
    warn("nothing drives the sheet: it stays as it is");
  if (scene.heat && scene.heat->temperature < coldest_likely)
    warn(fmt::format("heat.temperature is {:g} K, {:.4g} degC: a plain number is in K", scene.heat->temperature,
                     scene.heat->temperature - 273.15));
  return warnings;
}

// Where films are so thin, or so fast, that air would hold them back, it says so.
std::string what_air_lacks(const Scene& scene, const Scales& scales) {
  constexpr double much = 0.1, density = 1.2; // of the weight; of air [kg/m³]
  if (scene.environment.air)
    return fmt::format("air has no mass, and no flow of its own that a film would flap in{}",
                       scene.solids.empty() ? "" : ", and does not drive what touches a solid");
  const double V = scales.speed, h = scales.thickness.value_or(0);
  const double weight = scene.material.density * h * scales.gravity;
  const double part = Air().drag_coefficient * density * V * V / 2 / weight;
  if (!std::isfinite(part) || part < much)
    return "air has neither drag nor mass";
  return fmt::format("air has neither drag nor mass: on what moves across itself at {} m/s its drag would be {} of the "
                     "weight (air = {{density = \"1.2 kg/m^3\"}} in [environment])",
                     brief(V), brief(part));
}

// What a user may take for modelled, and is not.
std::vector<std::string> left_out_of(const Scene& scene, const Scales& scales) {
  std::vector<std::string> left_out;
  if (std::ranges::any_of(scene.solids, [](const Solid& s) { return s.contact == SolidContact::stick; }))
    left_out.push_back("what sticks to a solid does not spread on it");
  const auto has_an_underside = [&](const Solid& s) {
    constexpr double looks_down = 0.2; // cosine
    const auto* plane = std::get_if<HalfSpace>(&s.shape);
    const Vector3d& gravity = *scene.environment.gravity;
    return s.contact != SolidContact::stick &&
           (plane == nullptr || plane->normal.normalized().dot(gravity) > looks_down * gravity.norm());
  };
  if (scene.environment.gravity && !(scene.contact && scene.contact->adhesion) &&
      std::ranges::any_of(scene.solids, has_an_underside))
    left_out.push_back("what comes to hang below a solid never drips off ([contact] adhesion)");
  if (scene.merge)
    left_out.push_back("layers become one where one lies wholly on another; tight folds stay two");
  else if (scene.contact && scene.contact->self)
    left_out.push_back("layers that touch never become one liquid ([merge])");
  if (const auto& bath = scene.environment.bath) {
    const std::string_view tension = tense(scene) ? ", no surface tension of its own, which would pull on rims," : "";
    left_out.push_back(
        fmt::format("the bath has no waves{} and {}", tension, bath->drag > 0 ? "stays at rest" : "no viscosity"));
    if (!bath->spreads)
      left_out.push_back("what floats does not spread by its own weight, and is drawn together at free rims (bath = "
                         "{..., spreads = true})");
  }
  if (const auto& pressure = scene.environment.pressure; pressure && std::holds_alternative<GasPressure>(*pressure))
    left_out.push_back(
        "enclosed gas has one pressure everywhere, and leaves through holes without a jet that pushes anything");
  else if (pressure && depends_on_volume(*pressure))
    left_out.push_back("enclosed gas is not compressed");
  if (scene.tear && scene.tear->below)
    left_out.push_back("tearing goes by thickness alone");
  if (scene.tear && scene.tear->inclusions)
    left_out.push_back("a hole opens at once, whatever pulls; inclusions do not move in the liquid");
  if (scene.tear && scene.tear->drops)
    left_out.push_back("drops are balls that meet the sheet and solids, not each other; on solids they do not spread");
  left_out.push_back(what_air_lacks(scene, scales));
  return left_out;
}

} // namespace

Explanation explain(const Scene& with_heat, std::span<const Measured> measured, std::vector<ModelledPart> parts) {
  const Scene scene = as_it_starts(with_heat);
  const std::vector<Scales> scales = scales_of_sheets(scene, measured);
  Explanation result;
  result.parts = std::move(parts);
  result.judged = name_of_sheet(scene, 0);
  const Scene first = with_material_of(scene, scene.sheets.front());
  const Scene first_with_heat = with_material_of(with_heat, scene.sheets.front());
  result.scales = scale_list(first, scales.front());
  result.numbers = numbers_of(first, scales.front());
  std::ranges::copy(heat_scales(first_with_heat, scales.front()), std::back_inserter(result.scales));
  std::ranges::copy(heat_numbers(first_with_heat, scales.front()), std::back_inserter(result.numbers));
  result.warnings = warnings_of(scene, scales);
  if (const auto thinning = warning_of_thinning(first_with_heat))
    result.warnings.push_back(*thinning);
  result.left_out = left_out_of(scene, scales.front());
  return result;
}

std::string to_text(const Explanation& explanation) {
  std::string modelled = "Modelled\n", not_modelled;
  for (const ModelledPart& part : explanation.parts)
    (part.modelled ? modelled : not_modelled) += fmt::format("  {:<16}{}\n", part.name, part.why);
  std::string text = modelled;
  if (!not_modelled.empty())
    text += "\nNot modelled, and at no cost\n" + not_modelled;
  const std::string of = explanation.judged.empty() ? "" : " of " + explanation.judged;
  if (!explanation.scales.empty())
    text += "\nScales" + of + "\n";
  for (const Scale& scale : explanation.scales)
    text += fmt::format("  {:<7}{:>10} {:<4} {}: {}\n", scale.symbol, brief(scale.value), scale.unit, scale.name,
                        scale.source);
  if (!explanation.numbers.empty())
    text += "\nDimensionless numbers" + of + "\n";
  for (const auto& number : explanation.numbers)
    text += fmt::format("  {} = {} = {}\n      {}\n", number.name, number.formula, brief(number.value), number.meaning);
  if (!explanation.warnings.empty())
    text += "\nWarnings\n";
  for (const std::string& warning : explanation.warnings)
    text += fmt::format("  {}\n", warning);
  text += fmt::format("\nLeft out: {}\n", fmt::join(explanation.left_out, "; "));
  return text;
}

} // namespace sheet::scene
