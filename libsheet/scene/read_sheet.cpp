// SPDX-License-Identifier: GPL-3.0-or-later
// [sheet]
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/tables.h"
#include "libsheet/scene/words.h"

namespace sheet::scene {
namespace {

constexpr double most_triangles = 1e9;

Rectangle read_rectangle(TableReader& table) {
  constexpr std::string_view example = "[\"1 m\", \"0.5 m\"]";
  const Node* size = table.take("size");
  if (!size) {
    table.missing("size", example);
    return {NAN, NAN};
  }
  if (size->type != Node::Type::list || size->items.size() != 2) {
    table.wrong("size", fmt::format("expected two lengths such as {}", example));
    return {NAN, NAN};
  }
  const auto side = [&](std::size_t i) {
    return table.quantity(size->items[i], "size", Bound::positive).value_or(NAN);
  };
  const double first = side(0);
  return {first, side(1)};
}

Annulus read_annulus(TableReader& table) {
  const Annulus annulus{table.required("inner_radius"), table.required("outer_radius")};
  if (annulus.inner_radius >= annulus.outer_radius) {
    table.wrong("inner_radius", fmt::format("must be less than outer_radius, but {} m is not less than {} m",
                                            shortest(annulus.inner_radius), shortest(annulus.outer_radius)));
    return {annulus.inner_radius, NAN};
  }
  return annulus;
}

Cap read_cap(TableReader& table) {
  const Cap cap{table.required("radius"), table.required("angle", Bound::any),
                table.quantity_or("opening", 0, Bound::not_negative)};
  const auto degrees = [](double angle) { return shortest(angle * 180 / std::numbers::pi); };
  if (cap.angle <= 0 || cap.angle > std::numbers::pi)
    table.wrong("angle", fmt::format("must be above 0 and at most 180 deg, got {} deg (a number is in radians)",
                                     degrees(cap.angle)));
  else if (cap.opening >= cap.angle)
    table.wrong("opening", fmt::format("must be less than the cap's angle, but {} deg is not less than {} deg",
                                       degrees(cap.opening), degrees(cap.angle)));
  else
    return cap;
  return {cap.radius, NAN, 0};
}

SheetShape read_shape(TableReader& table, const Files& files) {
  constexpr std::array<std::string_view, 7> keys{
      "size",           "radius",     "inner_radius, outer_radius", "radius", "radius, angle, opening",
      "radius, height", "file, scale"};
  if (table.absent("shape"))
    table.missing("shape", "\"disk\"");
  const auto kind = table.choice("shape");
  if (!kind) {
    // What depends on the shape cannot be judged; a mesh is the shape with the fewest rules.
    for (const auto key : {"size", "radius", "inner_radius", "outer_radius", "angle", "opening", "height", "file",
                           "scale", "edge_length", "segments", "pattern", "seed"})
      table.take(key);
    return SheetMesh{"", 1};
  }
  SheetShape shape;
  switch (*kind) {
  case 0:
    shape = read_rectangle(table);
    break;
  case 1:
    shape = Disk{table.required("radius")};
    break;
  case 2:
    shape = read_annulus(table);
    break;
  case 3:
    shape = Sphere{table.required("radius")};
    break;
  case 4:
    shape = read_cap(table);
    break;
  case 5: {
    const double radius = table.required("radius");
    shape = Tube{radius, table.required("height")};
    break;
  }
  default: {
    std::string file = read_file(table, files);
    shape = SheetMesh{std::move(file), table.quantity_or("scale", 1, Bound::positive)};
    table.has_no_meaning({"edge_length", "segments", "pattern", "seed"}, "a mesh is taken as it is");
  }
  }
  table.has_no_meaning(
      {"size", "radius", "inner_radius", "outer_radius", "angle", "opening", "height", "file", "scale"},
      fmt::format("shape \"{}\" takes {}", words::sheet_shapes[*kind], keys[*kind]));
  return shape;
}

std::optional<std::array<int, 2>> read_segments(TableReader& table, bool round) {
  const Node* value = table.take("segments");
  if (!value)
    return {};
  constexpr std::int64_t most = 1'000'000;
  const auto good = [&](std::size_t i, std::int64_t least) {
    const Node& item = value->items[i];
    return item.type == Node::Type::integer && item.integer >= least && item.integer <= most;
  };
  const int least = round ? 3 : 1;
  if (value->type != Node::Type::list || value->items.size() != 2 || !good(0, least) || !good(1, 1)) {
    table.wrong("segments", fmt::format("expected two integers such as [30, 20], from {} to {}{}", least, most,
                                        round ? " around and from 1 along" : ""));
    return {};
  }
  return std::array{static_cast<int>(value->items[0].integer), static_cast<int>(value->items[1].integer)};
}

void read_mesh_size(TableReader& table, SheetTable& sheet) {
  if (std::holds_alternative<SheetMesh>(sheet.shape))
    return;
  sheet.edge_length = table.quantity("edge_length", Bound::positive);
  sheet.segments = read_segments(table, !std::holds_alternative<Rectangle>(sheet.shape));
  const auto pattern = table.choice("pattern");
  const bool counted = !table.absent("segments");
  if (!counted && table.absent("edge_length"))
    table.missing("edge_length", "\"20 mm\"");
  if (counted && !table.absent("edge_length"))
    table.wrong("segments", "give either edge_length or segments, not both");
  sheet.pattern = pattern ? static_cast<Pattern>(*pattern) : counted ? Pattern::structured : Pattern::irregular;
  if (counted && pattern && sheet.pattern != Pattern::structured)
    table.wrong("pattern", "segments need the pattern \"structured\"");
  if (sheet.pattern == Pattern::irregular)
    sheet.seed = table.seed("seed").value_or(0);
  else
    table.has_no_meaning({"seed"}, "only the pattern \"irregular\" has one");

  const auto size = size_of(sheet.shape);
  if (!sheet.edge_length || !size)
    return;
  const double edge = *sheet.edge_length;
  if (edge > size->smallest)
    table.wrong("edge_length",
                fmt::format("{} m is too large for the shape; at most {} m", shortest(edge), shortest(size->smallest)));
  else if (const double triangles = size->area / (edge * edge) * 4 / std::sqrt(3.0);
           !(triangles <= most_triangles) && !std::isnan(size->area))
    table.wrong("edge_length", fmt::format("{} m makes about {:.1e} triangles; at most {:.0e} are possible",
                                           shortest(edge), triangles, most_triangles));
}

bool is_flat(const SheetShape& shape) { return shape.index() <= 2; }

ThicknessProfile read_profile(TableReader& source, const SheetTable& sheet) {
  ThicknessProfile profile{SheetDirection::radial, {}};
  std::string_view key = "radial";
  if (source.absent("radial")) {
    key = "rows";
    const auto along = source.choice("along");
    if (is_flat(sheet.shape) && along == static_cast<std::size_t>(axes_of(sheet.plane).normal))
      source.wrong("along", "is the normal of the sheet's plane, along which a flat sheet has no extent");
    profile.over = static_cast<SheetDirection>(along.value_or(0));
    if (source.absent("rows"))
      source.missing("rows", "[[0, \"1.9 mm\"], [\"20 mm\", \"1.2 mm\"]]");
  } else {
    source.has_no_meaning({"along", "rows"}, "the rows are those of radial");
  }
  profile.rows = read_place_rows(source, key, "the thickness", "[\"20 mm\", \"1.2 mm\"]", Bound::positive);
  return profile;
}

void read_thickness(TableReader& table, SheetTable& sheet) {
  const bool mesh = std::holds_alternative<SheetMesh>(sheet.shape);
  const Node* value = table.take("thickness");
  if (!value || value->type != Node::Type::table) {
    sheet.thickness = table.required("thickness");
    return;
  }
  auto source = *table.table("thickness");
  if (!source.absent("radial") || !source.absent("along")) {
    source.has_no_meaning({"data", "place", "scale"}, "the thickness is given by rows");
    sheet.thickness = read_profile(source, sheet);
    source.finish();
    return;
  }
  if (!mesh)
    table.wrong("thickness", "only shape \"mesh\" has data to take it from; expected a length such as \"2.5 mm\", or "
                             "{radial = [[0, \"1.9 mm\"], [\"20 mm\", \"1.2 mm\"]]}");
  ThicknessData data{};
  if (source.absent("data"))
    source.missing("data", "\"thickness\"");
  data.data = source.text("data").value_or("");
  data.per_face = source.choice("place").value_or(0) == 1;
  data.scale = source.quantity_or("scale", 1, Bound::positive);
  source.finish();
  sheet.thickness = std::move(data);
}

void read_temperature(TableReader& table, SheetTable& sheet) {
  const Node* value = table.take("temperature");
  if (!value || value->type != Node::Type::table) {
    if (const auto uniform = table.quantity("temperature", Bound::positive))
      sheet.temperature = *uniform;
    return;
  }
  auto source = *table.table("temperature");
  if (!std::holds_alternative<SheetMesh>(sheet.shape))
    table.wrong("temperature", "only shape \"mesh\" has data to take it from; expected one such as \"900 degC\"");
  if (source.absent("data"))
    source.missing("data", "\"temperature\"");
  TemperatureData data{source.text("data").value_or("")};
  source.finish();
  sheet.temperature = std::move(data);
}

// Whether a user's array may have this name: frames can have it, and nobody else does. The programs' own begin with one
// of these words.
bool is_free_name(std::string_view name) {
  constexpr std::array<std::string_view, 10> taken{"emit.",   "gas.",  "heat.", "merge.",    "outflow.",
                                                   "remesh.", "step.", "tear.", "enclosure", "thickness"};
  return formats::is_array_name(name) && !formats::is_standard_array(name) &&
         std::ranges::none_of(taken, [&](std::string_view word) { return name.starts_with(word); });
}

// Names of arrays that go along.
void read_arrays(TableReader& table, SheetTable& sheet) {
  const Node* value = table.take("arrays");
  if (!value)
    return;
  constexpr std::string_view expected = "expected names such as [\"uv\", \"material\"]";
  if (!std::holds_alternative<SheetMesh>(sheet.shape))
    return table.wrong("arrays", "only a sheet of shape \"mesh\" has some, from its PLY file");
  if (value->type != Node::Type::list)
    return table.wrong("arrays", std::string(expected));
  for (const Node& item : value->items) {
    if (item.type != Node::Type::text)
      return table.wrong("arrays", std::string(expected));
    if (!is_free_name(item.text))
      table.wrong("arrays",
                  fmt::format("\"{}\" cannot be the name of an array that goes along: it has at most 47 of the "
                              "characters a to z, 0 to 9, _ . : -, and is none that Sheet has itself",
                              item.text));
    else if (std::ranges::find(sheet.arrays, item.text) != sheet.arrays.end())
      table.wrong("arrays", fmt::format("\"{}\" stands there twice", item.text));
    else
      sheet.arrays.push_back(item.text);
  }
}

Perturbation read_perturbation(TableReader table, const SheetTable& sheet) {
  Perturbation result{};
  result.of_thickness = table.choice("of").value_or(0) == 1;
  result.amplitude = table.required("amplitude");
  const double* uniform = std::get_if<double>(&sheet.thickness);
  if (result.of_thickness && uniform && result.amplitude >= *uniform)
    table.wrong("amplitude", fmt::format("must be less than the sheet's thickness, but {} m is not less than {} m",
                                         shortest(result.amplitude), shortest(*uniform)));
  const auto seed = table.seed("seed");
  const auto wavelength = table.quantity("wavelength", Bound::positive);
  if (table.absent("seed") == table.absent("wavelength"))
    table.problems().add(table.place(),
                         fmt::format("{}: give either a wavelength or a seed (for noise)", table.where()));
  if (!table.absent("seed")) {
    result.form = Noise{seed.value_or(0)};
    table.has_no_meaning({"direction", "phase"}, "noise has none");
  } else {
    const PlaneAxes axes = axes_of(sheet.plane);
    const auto direction = table.choice("direction");
    if (is_flat(sheet.shape) && direction == static_cast<std::size_t>(axes.normal))
      table.wrong("direction", "is the normal of the sheet's plane, along which a flat sheet has no extent");
    result.form = Wave{wavelength.value_or(1), table.quantity_or("phase", 0),
                       static_cast<SheetDirection>(direction.value_or(static_cast<std::size_t>(axes.first)))};
  }
  table.finish();
  return result;
}

void read_perturbations(TableReader& table, SheetTable& sheet) {
  const Node* value = table.take("perturbation");
  if (!value)
    return;
  if (value->type == Node::Type::list) {
    for (const Node& item : value->items) {
      if (item.type == Node::Type::table)
        sheet.perturbations.push_back(
            read_perturbation({item, "perturbation", *table.declared("perturbation").below, table.problems()}, sheet));
      else
        table.problems().add(item.place, fmt::format("perturbation: expected tables, got {}", describe(item.type)));
    }
  } else if (auto one = table.table("perturbation")) {
    sheet.perturbations.push_back(read_perturbation(*one, sheet));
  }
}

// Horizontal: the coordinate plane that is most nearly perpendicular to gravity; y is up without gravity.
Plane horizontal(const Environment& environment) {
  if (!environment.gravity)
    return Plane::xz;
  int axis = 1;
  for (const int other : {0, 2})
    if (std::abs((*environment.gravity)[other]) > std::abs((*environment.gravity)[axis]))
      axis = other;
  return axis == 0 ? Plane::yz : axis == 1 ? Plane::xz : Plane::xy;
}

} // namespace

SheetTable read_sheet(TableReader table, const Environment& environment, const Files& files) {
  SheetTable sheet;
  sheet.name = table.text("name").value_or("");
  sheet.shape = read_shape(table, files);
  read_mesh_size(table, sheet);
  const auto plane = table.choice("plane");
  sheet.plane = plane ? static_cast<Plane>(*plane) : horizontal(environment);
  read_thickness(table, sheet);
  read_temperature(table, sheet);
  read_arrays(table, sheet);
  read_perturbations(table, sheet);
  sheet.center = table.vector("center").value_or(Vector3d::Zero());
  sheet.rotation = read_rotation(table);
  sheet.velocity = table.vector("velocity").value_or(Vector3d::Zero());
  sheet.angular_velocity = table.vector("angular_velocity").value_or(Vector3d::Zero());
  sheet.radial_velocity = table.quantity_or("radial_velocity", 0);
  sheet.enters = table.quantity("enters", Bound::positive);
  if (const Node* material = table.take("material"); material && table.table("material"))
    sheet.material =
        read_material({*material, "[sheet.material]", *table.declared("material").below, table.problems()}, files);
  if (sheet.enters && std::holds_alternative<SheetMesh>(sheet.shape)) // its file would have to travel with the stream
    table.wrong("enters", "a sheet from a mesh file is there from the start; a shape can enter");
  table.finish();
  return sheet;
}

} // namespace sheet::scene
