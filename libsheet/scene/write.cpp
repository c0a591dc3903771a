// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/write.h"

#include "libsheet/base/overloaded.h"
#include "libsheet/base/units.h"
#include "libsheet/scene/document.h"
#include "libsheet/scene/words.h"

namespace sheet::scene {
namespace {

// -0 and 0 are equal, so they read the same.
std::string number(double value) { return shortest(value == 0 ? 0 : value); }
constexpr auto array_region = [](const ArrayRegion& region) {
  return fmt::format("{{array = {}}}", toml_text(region.array));
};
std::string list(const Vector3d& v) { return fmt::format("[{}, {}, {}]", number(v[0]), number(v[1]), number(v[2])); }
std::string_view flag(bool value) { return value ? "true" : "false"; }
template <class Words> std::string word(const Words& words, std::size_t index) { return toml_text(words[index]); }
template <class Words, class Enum>
requires std::is_enum_v<Enum> std::string word(const Words& words, Enum value) {
  return word(words, static_cast<std::size_t>(value));
}

// Lines "key = value" of a table.
class Writer {
public:
  void open(std::string_view header) { text_ += fmt::format("{}{}\n", text_.empty() ? "" : "\n", header); }
  void line(std::string_view key, std::string_view value) { text_ += fmt::format("{} = {}\n", key, value); }
  void line(std::string_view key, double value) { line(key, number(value)); }
  void line(std::string_view key, const std::optional<double>& value) {
    if (value)
      line(key, *value);
  }
  void line_unless_zero(std::string_view key, const Vector3d& value) {
    if (!value.isZero(0))
      line(key, list(value));
  }
  [[nodiscard]] std::string text() && { return std::move(text_); }

private:
  std::string text_;
};

void write_rotation(Writer& out, const std::optional<Rotation>& rotation) {
  if (rotation)
    out.line("rotation", fmt::format("{{axis = {}, angle = {}}}", list(rotation->axis), number(rotation->angle)));
}

template <class T, class Constant, class Row> std::string timed(const Timed<T>& table, Constant constant, Row row) {
  if (table.entries.size() == 1 && table.entries[0].time == 0)
    return constant(table.entries[0].value);
  std::string rows;
  for (const auto& [time, value] : table.entries)
    rows += fmt::format("{}[{}, {}]", rows.empty() ? "" : ", ", number(time), row(value));
  return "[" + rows + "]";
}

std::string timed(const Timed<double>& rate) { return timed(rate, number, number); }
std::string timed(const Timed<Vector3d>& velocity) {
  return timed(velocity, list,
               [](const Vector3d& v) { return fmt::format("{}, {}, {}", number(v[0]), number(v[1]), number(v[2])); });
}

template <class T, class Item> std::string items(const std::vector<T>& values, Item item) {
  std::string text;
  for (const T& value : values)
    text += fmt::format("{}{}", text.empty() ? "" : ", ", item(value));
  return "[" + text + "]";
}

std::string place_rows(const PlaceRows& rows) {
  return items(rows, [](const auto& row) { return fmt::format("[{}, {}]", number(row[0]), number(row[1])); });
}

std::string keyframes(const Keyframes& frames) {
  std::string text = "{kind = \"keyframed\", times = " + items(frames.times(), number);
  if (!frames.places().empty())
    text += ", places = " + items(frames.places(), list);
  if (!frames.rotations().empty())
    text += ", rotations = " + items(frames.rotations(), [](const Eigen::Quaterniond& q) {
              return fmt::format("[{}, {}, {}, {}]", number(q.w()), number(q.x()), number(q.y()), number(q.z()));
            });
  if (frames.places().empty())
    text += ", center = " + list(frames.center());
  if (frames.interpolation() != Interpolation::smooth)
    text += ", interpolation = " + word(words::interpolations, frames.interpolation());
  return text + "}";
}

void write_motion(Writer& out, const Motion& motion) {
  std::visit(
      Overloaded{[](const Fixed&) {},
                 [&](const Translating& m) {
                   out.line("motion", fmt::format("{{kind = \"translating\", velocity = {}}}", timed(m.velocity)));
                 },
                 [&](const Rotating& m) {
                   const std::string moves = m.velocity.entries.empty() ? "" : ", velocity = " + timed(m.velocity);
                   out.line("motion", fmt::format("{{kind = \"rotating\", axis = {}, center = {}, rate = {}{}}}",
                                                  list(m.axis), list(m.center), timed(m.rate), moves));
                 },
                 [&](const Keyframed& m) { out.line("motion", keyframes(*m.frames)); }},
      motion);
}

void write_perturbations(Writer& out, const SheetTable& sheet) {
  if (sheet.perturbations.empty())
    return;
  std::string tables;
  for (const Perturbation& p : sheet.perturbations) {
    tables += fmt::format("{}{{of = {}, amplitude = {}, ", tables.empty() ? "" : ", ",
                          word(words::perturbed, p.of_thickness ? 1UL : 0UL), number(p.amplitude));
    std::visit(Overloaded{[&](const Wave& wave) {
                            tables +=
                                fmt::format("wavelength = {}, direction = {}, phase = {}}}", number(wave.wavelength),
                                            word(words::directions, wave.direction), number(wave.phase));
                          },
                          [&](const Noise& noise) { tables += fmt::format("seed = {}}}", noise.seed); }},
               p.form);
  }
  out.line("perturbation", "[" + tables + "]");
}

void write_measures(Writer& out, const SheetShape& shape) {
  std::visit(Overloaded{[&](const Rectangle& s) {
                          out.line("size", fmt::format("[{}, {}]", number(s.size_first), number(s.size_second)));
                        },
                        [&](const Disk& s) { out.line("radius", s.radius); },
                        [&](const Annulus& s) {
                          out.line("inner_radius", s.inner_radius);
                          out.line("outer_radius", s.outer_radius);
                        },
                        [&](const Sphere& s) { out.line("radius", s.radius); },
                        [&](const Cap& s) {
                          out.line("radius", s.radius);
                          out.line("angle", s.angle);
                          out.line("opening", s.opening);
                        },
                        [&](const Tube& s) {
                          out.line("radius", s.radius);
                          out.line("height", s.height);
                        },
                        [&](const SheetMesh& s) {
                          out.line("file", toml_text(s.file));
                          out.line("scale", s.scale);
                        }},
             shape);
}

void write_thickness(Writer& out, const SheetTable& sheet) {
  std::visit(
      Overloaded{[&](double uniform) { out.line("thickness", uniform); },
                 [&](const ThicknessData& t) {
                   out.line("thickness", fmt::format("{{data = {}, place = {}, scale = {}}}", toml_text(t.data),
                                                     word(words::places, t.per_face ? 1UL : 0UL), number(t.scale)));
                 },
                 [&](const ThicknessProfile& t) {
                   const std::string rows = place_rows(t.rows);
                   out.line("thickness",
                            t.over == SheetDirection::radial
                                ? fmt::format("{{radial = {}}}", rows)
                                : fmt::format("{{along = {}, rows = {}}}", word(words::directions, t.over), rows));
                 }},
      sheet.thickness);
}

void write_sheet(Writer& out, const SheetTable& sheet, std::string_view header) {
  out.open(header);
  if (!sheet.name.empty())
    out.line("name", toml_text(sheet.name));
  out.line("shape", word(words::sheet_shapes, sheet.shape.index()));
  write_measures(out, sheet.shape);
  out.line("edge_length", sheet.edge_length);
  if (sheet.segments)
    out.line("segments", fmt::format("[{}, {}]", (*sheet.segments)[0], (*sheet.segments)[1]));
  if (!std::holds_alternative<SheetMesh>(sheet.shape)) {
    out.line("pattern", word(words::patterns, sheet.pattern));
    if (sheet.pattern == Pattern::irregular)
      out.line("seed", fmt::format("{}", sheet.seed));
  }
  write_thickness(out, sheet);
  if (sheet.temperature)
    std::visit(Overloaded{[&](double uniform) { out.line("temperature", uniform); },
                          [&](const TemperatureData& t) {
                            out.line("temperature", fmt::format("{{data = {}}}", toml_text(t.data)));
                          }},
               *sheet.temperature);
  if (!sheet.arrays.empty())
    out.line("arrays", items(sheet.arrays, toml_text));
  write_perturbations(out, sheet);
  out.line("plane", word(words::planes, sheet.plane));
  out.line_unless_zero("center", sheet.center);
  write_rotation(out, sheet.rotation);
  out.line_unless_zero("velocity", sheet.velocity);
  out.line_unless_zero("angular_velocity", sheet.angular_velocity);
  if (sheet.radial_velocity != 0)
    out.line("radial_velocity", sheet.radial_velocity);
  out.line("enters", sheet.enters);
}

void write_environment(Writer& out, const Environment& environment) {
  if (environment == Environment{})
    return;
  out.open("[environment]");
  if (environment.gravity)
    out.line("gravity", list(*environment.gravity));
  if (environment.pressure) {
    std::string values = std::visit(
        Overloaded{[](const ConstantPressure& p) { return fmt::format("value = {}", number(p.value)); },
                   [](const InverseSquarePressure& p) {
                     return fmt::format("value = {}, reference_radius = {}", number(p.value),
                                        number(p.reference_radius));
                   },
                   [](const DrainingPressure& p) { return fmt::format("conductance = {}", number(p.conductance)); },
                   [](const GasPressure& p) {
                     return fmt::format("{} = {}, ambient = {}, exponent = {}, leak = {}, more_volume = {}",
                                        p.amount ? "amount" : "value", number(p.amount.value_or(p.value)),
                                        number(p.ambient), number(p.exponent), number(p.leak), number(p.more_volume));
                   }},
        *environment.pressure);
    out.line("pressure",
             fmt::format("{{law = {}, {}{}}}", word(words::pressures, environment.pressure->index()), values,
                         environment.pressure_sheet.empty()
                             ? ""
                             : fmt::format(", sheet = {}", toml_text(environment.pressure_sheet))));
  }
  if (environment.bath)
    out.line("bath",
             fmt::format("{{density = {}, level = {}, clings = {}, spreads = {}{}}}", number(environment.bath->density),
                         number(environment.bath->level), environment.bath->clings, environment.bath->spreads,
                         environment.bath->drag > 0 ? ", drag = " + number(environment.bath->drag) : ""));
  if (const auto& air = environment.air)
    out.line("air", fmt::format("{{density = {}, drag_coefficient = {}, friction_coefficient = {}{}}}",
                                number(air->density), number(air->drag_coefficient), number(air->friction_coefficient),
                                air->wind.entries.empty() ? "" : ", wind = " + timed(air->wind)));
}

void write_hold(Writer& out, const Hold& hold) {
  out.open("[[hold]]");
  if (!hold.sheet.empty())
    out.line("sheet", toml_text(hold.sheet));
  out.line("region", std::visit(Overloaded{[](Border border) { return word(words::borders, border); },
                                           [](const BoxRegion& box) {
                                             return fmt::format("{{box = [{}, {}]}}", list(box.low), list(box.high));
                                           },
                                           [](const SphereRegion& sphere) {
                                             return fmt::format("{{sphere = {{center = {}, radius = {}}}}}",
                                                                list(sphere.center), number(sphere.radius));
                                           },
                                           array_region},
                                hold.region));
  out.line("kind", word(words::holds, hold.clamped ? 1UL : 0UL));
  if (hold.axes != all_axes) {
    std::string axes;
    for (std::size_t i = 0; i < 3; ++i)
      if (has_axis(hold.axes, i))
        axes += "xyz"[i];
    out.line("axes", toml_text(axes));
  }
  write_motion(out, hold.motion);
  out.line("until", hold.until);
  if (hold.roll)
    out.line("roll", flag(true));
}

void write_solid(Writer& out, const Solid& solid) {
  out.open("[[solid]]");
  out.line("shape", word(words::solid_shapes, solid.shape.index()));
  std::visit(Overloaded{[&](const Sphere& s) { out.line("radius", s.radius); },
                        [&](const SolidBox& s) { out.line("size", list(s.size)); },
                        [&](const Capsule& s) {
                          out.line("radius", s.radius);
                          out.line("length", s.length);
                        },
                        [&](const Cylinder& s) {
                          out.line("radius", s.radius);
                          out.line("height", s.height);
                        },
                        [&](const HalfSpace& s) { out.line("normal", list(s.normal)); },
                        [&](const SolidMesh& s) {
                          out.line("file", toml_text(s.file));
                          out.line("scale", s.scale);
                          out.line("voxel_size", s.voxel_size);
                          if (!s.checksum.empty())
                            out.line("checksum", toml_text(s.checksum));
                        }},
             solid.shape);
  if (std::holds_alternative<Keyframed>(solid.motion)) // else it is where the rows say
    out.line("center", list(solid.center));
  else
    out.line_unless_zero("center", solid.center);
  write_rotation(out, solid.rotation);
  write_motion(out, solid.motion);
  out.line_unless_zero("surface_velocity", solid.surface_velocity);
  if (solid.contact != SolidContact::stick)
    out.line("contact", word(words::solid_contacts, static_cast<std::size_t>(solid.contact)));
  if (solid.slip_length > 0)
    out.line("slip_length", solid.slip_length);
  out.line("contact_angle", solid.contact_angle);
  if (solid.receding)
    out.line("receding", flag(true));
  if (solid.temperature) {
    out.line("temperature", timed(*solid.temperature));
    out.line("contact_conductance", solid.contact_conductance);
  }
}

// As read_flow_law.cpp reads it.
void write_flow_law(Writer& out, const Liquid& liquid) {
  const FlowLaw &law = liquid.law, newtonian;
  const bool plateaus = law.kind == FlowLawKind::carreau || law.kind == FlowLawKind::cross;
  if (!law.newtonian())
    out.line("law", word(words::flow_laws, static_cast<std::size_t>(law.kind)));
  const bool by_temperature = law.newtonian() && has_viscosity(liquid.temperature_law);
  if (law.kind != FlowLawKind::table && !by_temperature)
    out.line(plateaus ? "zero_viscosity" : "viscosity", liquid.viscosity);
  const auto unless_newtonian = [&](std::string_view key, double FlowLaw::*member) {
    if (law.*member != newtonian.*member)
      out.line(key, law.*member);
  };
  unless_newtonian("yield_stress", &FlowLaw::yield_stress);
  if (plateaus || law.kind == FlowLawKind::power || law.kind == FlowLawKind::herschel_bulkley)
    out.line("flow_index", law.flow_index);
  unless_newtonian("reference_rate", &FlowLaw::reference_rate);
  unless_newtonian("infinite_viscosity", &FlowLaw::infinite_viscosity);
  unless_newtonian("time_constant", &FlowLaw::time_constant);
  unless_newtonian("transition", &FlowLaw::transition);
  if (!law.rates.empty()) {
    out.line("rates", items(law.rates, number));
    out.line("viscosities", items(law.viscosities, number));
  }
  out.line("rest_rate", law.rest_rate);
}

// As read_temperature_law.cpp reads it.
void write_temperature_law(Writer& out, const Liquid& liquid) {
  const TemperatureLaw& law = liquid.temperature_law;
  if (!law.constant())
    out.line("viscosity_law", word(words::temperature_laws, law.kind));
  if (liquid.thermal())
    out.line("reference_temperature", law.reference_temperature);
  const auto unless_zero = [&](std::string_view key, double value) {
    if (value != 0)
      out.line(key, value);
  };
  unless_zero("activation_energy", law.activation_energy);
  unless_zero("temperature_coefficient", law.temperature_coefficient);
  out.line("vft_a", law.vft_a);
  unless_zero("vft_b", law.vft_b);
  unless_zero("vft_temperature", law.vft_temperature);
  unless_zero("wlf_c1", law.wlf_c1);
  unless_zero("wlf_c2", law.wlf_c2);
  if (!law.temperatures.empty()) {
    out.line("temperatures", items(law.temperatures, number));
    out.line("temperature_viscosities", items(law.viscosities, number));
  }
  unless_zero("surface_tension_slope", liquid.surface_tension_slope);
}

void write_material(Writer& out, const Liquid& liquid, std::string_view header) {
  out.open(header);
  write_flow_law(out, liquid);
  write_temperature_law(out, liquid);
  if (liquid.density > 0)
    out.line("density", liquid.density);
  if (liquid.surface_tension > 0)
    out.line("surface_tension", liquid.surface_tension);
}

std::string varying(const Varying& value) {
  return std::visit(Overloaded{[](const Timed<double>& rows) { return timed(rows); },
                               [](const AlongAxis& along) {
                                 return fmt::format("{{along = {}, rows = {}}}",
                                                    word(words::axes, static_cast<std::size_t>(along.axis)),
                                                    place_rows(along.rows));
                               }},
                    value.over);
}

std::string face(const HeatedFace& face) {
  return fmt::format("{{ambient = {}, transfer = {}, emissivity = {}, radiant = {}}}", varying(face.ambient),
                     varying(face.transfer), number(face.emissivity), varying(face.radiant));
}

void write_heat(Writer& out, const Heat& heat) {
  out.open("[heat]");
  out.line("specific_heat", heat.specific_heat);
  if (heat.conductivity > 0)
    out.line("conductivity", heat.conductivity);
  out.line("temperature", heat.temperature);
  if (heat.profile)
    out.line("profile", fmt::format("{}", *heat.profile));
  if (heat.upper.exchanges())
    out.line("upper", face(heat.upper));
  if (heat.lower.exchanges())
    out.line("lower", face(heat.lower));
  if (heat.viscous_heating)
    out.line("viscous_heating", flag(true));
}

void write_inflow(Writer& out, const Inflow& inflow, std::string_view header) {
  out.open(header);
  if (!inflow.sheet.empty())
    out.line("sheet", toml_text(inflow.sheet));
  out.line("region", std::visit(Overloaded{[](Border border) { return word(words::borders, border); }, array_region},
                                inflow.region));
  if (!inflow.velocity.entries.empty())
    out.line("velocity", timed(inflow.velocity));
  if (!inflow.radial_velocity.entries.empty())
    out.line("radial_velocity", timed(inflow.radial_velocity));
  out.line("thickness", inflow.thickness);
  if (inflow.temperature)
    out.line("temperature", timed(*inflow.temperature));
  out.line("until", inflow.until);
}

void write_tear(Writer& out, const Tear& tear) {
  out.open("[tear]");
  out.line("below", tear.below);
  if (tear.below)
    out.line("crumbs", word(words::crumbs, tear.drop_crumbs ? 1UL : 0UL));
  if (const auto& inclusions = tear.inclusions) {
    out.line("sites", inclusions->number);
    out.line("at_thickness", inclusions->at_thickness);
    out.line("exponent", inclusions->exponent);
    out.line("seed", fmt::format("{}", inclusions->seed));
  }
  out.line("snap", tear.snap);
  if (tear.drops)
    out.line("drops", flag(true));
}

} // namespace

std::string to_toml(const Scene& scene) {
  Writer out;
  const bool several = scene.sheets.size() > 1;
  for (const SheetTable& sheet : scene.sheets) {
    write_sheet(out, sheet, several ? "[[sheet]]" : "[sheet]");
    if (sheet.material)
      write_material(out, *sheet.material, "[sheet.material]");
  }
  write_material(out, scene.material, "[material]");
  write_environment(out, scene.environment);
  out.open("[model]");
  out.line("inertia", flag(scene.model.inertia));
  out.line("bending", flag(scene.model.bending));
  if (scene.model.forces)
    out.line("forces", flag(true));
  if (scene.model.faces)
    out.line("faces", flag(true));
  for (const Hold& hold : scene.holds)
    write_hold(out, hold);
  for (const Solid& solid : scene.solids)
    write_solid(out, solid);
  for (const Inflow& inflow : scene.inflows)
    write_inflow(out, inflow, scene.inflows.size() > 1 ? "[[inflow]]" : "[inflow]");
  for (const Outflow& outflow : scene.outflows) {
    out.open("[[outflow]]");
    out.line("point", list(outflow.point));
    out.line("normal", list(outflow.normal));
  }
  if (scene.tear)
    write_tear(out, *scene.tear);
  if (const auto& merge = scene.merge) {
    out.open("[merge]");
    out.line("after", merge->after);
    out.line("on", word(words::merges, merge->on_solids ? 1UL : 0UL));
  }
  if (const auto& contact = scene.contact) {
    out.open("[contact]");
    out.line("self", flag(contact->self));
    out.line("stiffness", contact->stiffness);
    out.line("adhesion", contact->adhesion);
    out.line("distance", contact->distance);
  }
  if (scene.heat)
    write_heat(out, *scene.heat);
  return std::move(out).text();
}

} // namespace sheet::scene
