// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/keys.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "libsheet/scene/words.h"

namespace sheet::scene {
namespace {

using Form = Key::Form;

constexpr Key number_key(std::string_view name, const Quantity& quantity, std::string_view help) {
  return {name, Form::quantity, help, &quantity};
}
constexpr Key list_key(std::string_view name, const Quantity& quantity, std::string_view dimensions,
                       std::string_view help) {
  return {name, Form::list, help, &quantity, dimensions};
}
constexpr Key timed_key(std::string_view name, const Quantity& quantity, std::string_view dimensions,
                        std::string_view help) {
  return {name, Form::timed, help, &quantity, dimensions};
}
constexpr Key word_key(std::string_view name, std::span<const std::string_view> words, std::string_view help,
                       const KeyTable* below = nullptr) {
  return {name, Form::word, help, nullptr, "", words, below};
}
constexpr Key file_key(std::span<const std::string_view> endings, std::string_view help,
                       std::string_view name = "file") {
  return {name, Form::file, help, nullptr, "", endings};
}
constexpr Key text_key(std::string_view name, std::string_view help) { return {name, Form::text, help}; }
constexpr Key texts_key(std::string_view name, std::string_view help) {
  return {name, Form::text, help, nullptr, "[]"};
}
constexpr Key boolean_key(std::string_view name, std::string_view help) { return {name, Form::boolean, help}; }
constexpr Key integer_key(std::string_view name, std::string_view dimensions, std::string_view help) {
  return {name, Form::integer, help, nullptr, dimensions};
}
constexpr Key table_key(std::string_view name, const KeyTable& below, std::string_view help = "") {
  return {name, Form::table, help, nullptr, "", {}, &below};
}

// ---- parts that several tables have

constexpr std::array rotation_keys{
    list_key("axis", quantity::number, "[3]", "axis of the turn, of any length"),
    number_key("angle", quantity::angle, "by which it is turned about the axis, right-handed")};
constexpr KeyTable rotation_table{"rotation", rotation_keys};

constexpr std::array<std::string_view, 1> row_files{".csv"};
constexpr std::array motion_keys{
    word_key("kind", words::motions, "how it moves"),
    timed_key("velocity", quantity::velocity, "[3]",
              "of a translating motion, or of a rotating one's axis; rows are [time, x, y, z]"),
    list_key("axis", quantity::number, "[3]", "about which a rotating one turns"),
    list_key("center", quantity::length, "[3]",
             "through which the axis goes at time 0 (default: the thing's own center)"),
    timed_key("rate", quantity::turning_rate, "", "at which it turns; rows are [time, rate]"),
    file_key(row_files, "rows of a keyframed motion: columns time, x, y, z, qw, qx, qy, qz"),
    list_key("times", quantity::time, "[]", "of the rows of a keyframed motion"),
    list_key("places", quantity::length, "[][3]", "of the rows"),
    list_key("rotations", quantity::number, "[][4]", "of the rows: unit quaternions [w, x, y, z]"),
    word_key("interpolation", words::interpolations, "between the rows")};
constexpr KeyTable motion_table{"motion", motion_keys};

// ---- [material]

constexpr std::array material_keys{
    number_key("viscosity", quantity::viscosity, "resists stretching and bending; also \"800 P\" or \"2 cP\""),
    number_key("density", quantity::density, "or \"1.3 g/cm^3\"; needed for inertia and gravity"),
    number_key("surface_tension", quantity::surface_tension, "of each of the two surfaces (absent or 0: no such term)"),
    word_key("law", words::flow_laws, "how viscosity depends on the rate of strain (default: newtonian, not at all)"),
    number_key("flow_index", quantity::number, "n: stress grows as the rate to this power; below 1 it thins"),
    number_key("yield_stress", quantity::pressure, "below which nothing flows"),
    number_key("reference_rate", quantity::strain_rate, "at which power law and table have `viscosity` (default 1/s)"),
    number_key("zero_viscosity", quantity::viscosity, "of carreau and cross, at low rates, in place of viscosity"),
    number_key("infinite_viscosity", quantity::viscosity, "of the same, at high rates (default 0)"),
    number_key("time_constant", quantity::time, "of the same: from its inverse on it thins"),
    number_key("transition", quantity::number, "of carreau: how sharply it begins to thin (default 2)"),
    list_key("rates", quantity::strain_rate, "[]", "of a table, ascending"),
    list_key("viscosities", quantity::viscosity, "[]", "of a table, at its rates"),
    file_key(row_files, "of a table, in place of the two: columns rate and viscosity"),
    number_key("rest_rate", quantity::strain_rate,
               "below which it is Newtonian (default: 1e-5 of the rate at which it yields, or of reference_rate)"),
    word_key("viscosity_law", words::temperature_laws, "how viscosity depends on temperature (default: not at all)"),
    number_key("reference_temperature", quantity::temperature, "at which it has its viscosity and surface tension"),
    number_key("activation_energy", quantity::molar_energy, "E of arrhenius: ln(mu) rises by (E/R) (1/T - 1/T_r)"),
    number_key("temperature_coefficient", quantity::per_kelvin, "b of exponential: ln(mu) falls by b (T - T_r)"),
    number_key("vft_a", quantity::number, "A of log10(mu) = A + B/(T - T_0), mu in Pa s, in place of viscosity"),
    number_key("vft_b", quantity::temperature, "B of the same, in K"),
    number_key("vft_temperature", quantity::temperature, "T_0 of the same"),
    number_key("wlf_c1", quantity::number, "C1 of log10(mu) = log10(mu_r) - C1 (T - T_r)/(C2 + T - T_r)"),
    number_key("wlf_c2", quantity::temperature, "C2 of the same, in K"),
    list_key("temperatures", quantity::temperature, "[]", "of a table, ascending, in place of viscosity"),
    list_key("temperature_viscosities", quantity::viscosity, "[]", "of the same, at its temperatures"),
    file_key(row_files, "of the same, in place of the two: columns temperature and viscosity", "temperature_file"),
    number_key("surface_tension_slope", quantity::tension_slope, "by how much it changes with temperature")};
constexpr KeyTable material_table{"material", material_keys};

// ---- [sheet]

constexpr std::array thickness_keys{
    text_key("data", "name of the mesh's array that has the thickness"),
    word_key("place", words::places, "where the array has its values"),
    number_key("scale", quantity::number, "metres per unit of the array (default 1)"),
    list_key("radial", quantity::length, "[][2]", "or rows of distance from the sheet's axis and thickness there"),
    word_key("along", words::axes, "or rows over a coordinate from its center"),
    list_key("rows", quantity::length, "[][2]", "of that coordinate, increasing, and thickness there")};
constexpr KeyTable thickness_table{"thickness", thickness_keys};
constexpr std::array temperature_keys{text_key("data", "name of the PLY file's array that has it, in K")};
constexpr KeyTable temperature_table{"temperature", temperature_keys};

constexpr std::array perturbation_keys{
    word_key("of", words::perturbed, "what deviates: the position along the normal, or the thickness"),
    number_key("amplitude", quantity::length, "greatest deviation"),
    integer_key("seed", "", "of noise at each vertex"),
    number_key("wavelength", quantity::length, "of a wave"),
    word_key("direction", words::directions, "along which the wave runs; radial: outwards"),
    number_key("phase", quantity::angle, "of the wave at the center (default 0)")};
constexpr KeyTable perturbation_table{"perturbation", perturbation_keys};

constexpr std::array<std::string_view, 6> sheet_files{".obj", ".off", ".ply", ".stl", ".vtu", ".sheet"};
constexpr std::array sheet_keys{
    text_key("name", "by which holds, inflows and pressure speak of one of several sheets"),
    word_key("shape", words::sheet_shapes, "its shape at the start"),
    list_key("size", quantity::length, "[2]", "along the plane's first and second letter"),
    number_key("radius", quantity::length, "of a disk, sphere, cap or tube"),
    number_key("inner_radius", quantity::length, "of an annulus"),
    number_key("outer_radius", quantity::length, "of an annulus"),
    number_key("angle", quantity::angle, "of a cap, from its pole (90 deg: a hemisphere)"),
    number_key("opening", quantity::angle, "angle of a hole around a cap's pole (default 0)"),
    number_key("height", quantity::length, "of a tube"),
    file_key(sheet_files,
             "mesh, or a stream for its last frame, taken as it is; names start in the folder of the scene"),
    number_key("scale", quantity::number, "metres per unit of the mesh file (default 1)"),
    number_key("edge_length", quantity::length, "of the triangles to begin with"),
    integer_key("segments", "[2]", "along both sides, or around and along: a structured pattern"),
    word_key("pattern", words::patterns, "of the triangles"),
    integer_key("seed", "", "of the irregular pattern"),
    Key{"thickness", Form::quantity, "at the start", &quantity::length, "", {}, &thickness_table},
    Key{"temperature",
        Form::quantity,
        "at the start (default: that of [heat])",
        &quantity::temperature,
        "",
        {},
        &temperature_table},
    texts_key("arrays", "of a PLY file, that go along: real numbers change with the mesh, whole ones stay"),
    table_key("perturbation", perturbation_table),
    word_key("plane", words::planes, "of flat shapes; caps and tubes stand on it (default: horizontal)"),
    list_key("center", quantity::length, "[3]", "where its middle is (a cap's: that of its sphere)"),
    table_key("rotation", rotation_table),
    list_key("velocity", quantity::velocity, "[3]", "at the start"),
    list_key("angular_velocity", quantity::turning_rate, "[3]", "at the start, about its center, along the axis"),
    number_key("radial_velocity", quantity::velocity, "at the start, away from its axis"),
    number_key("enters", quantity::time, "when it comes in; not the first sheet"),
    table_key("material", material_table, "its own liquid, wholly in place of that of [material]")};
constexpr KeyTable sheet_table{"sheet", sheet_keys};

// ---- [environment], [model]

constexpr std::array pressure_keys{
    word_key("law", words::pressures, "what it depends on"),
    text_key("sheet", "the only sheet on which it acts (default: all)"),
    number_key("value", quantity::pressure, "inside less outside; of gas: at the start"),
    number_key("reference_radius", quantity::length, "where an inverse_square pressure has its value"),
    number_key("conductance", quantity::conductance, "volume that leaves a second for each pascal"),
    number_key("amount", quantity::volume, "volume that the gas would fill outside"),
    number_key("ambient", quantity::pressure, "pressure outside (default 101325 Pa)"),
    number_key("exponent", quantity::number,
               "polytropic; 1: constant temperature (default), 1.4: air without time to cool"),
    number_key("leak", quantity::conductance, "of a hole through which gas leaves (default 0)"),
    number_key("more_volume", quantity::volume, "of vessels and pipes that the gas fills, too (default 0)")};
constexpr KeyTable pressure_table{"pressure", pressure_keys};

constexpr std::array bath_keys{
    number_key("density", quantity::density, "of the heavy liquid below the sheet"),
    number_key("level", quantity::length, "height of its surface against gravity (default 0)"),
    boolean_key("clings", "the sheet cannot leave it (default false)"),
    boolean_key("spreads", "the sheet spreads on it by its own weight (default true, unless it clings)"),
    number_key("drag", quantity::drag, "on what slides on it, over its speed (default 0)")};
constexpr KeyTable bath_table{"bath", bath_keys};

constexpr std::array air_keys{
    number_key("density", quantity::density, "of the air; 1.2 kg/m^3 at 20 degC"),
    number_key("drag_coefficient", quantity::number, "of what moves across the sheet (default 1.2, a plate's)"),
    number_key("friction_coefficient", quantity::number, "of what moves along it, both faces (default 0.01)"),
    timed_key("wind", quantity::velocity, "[3]", "everywhere (default 0); rows are [time, x, y, z]")};
constexpr KeyTable air_table{"air", air_keys};

constexpr std::array environment_keys{list_key("gravity", quantity::acceleration, "[3]", "acceleration (absent: none)"),
                                      table_key("pressure", pressure_table), table_key("bath", bath_table),
                                      table_key("air", air_table)};
constexpr KeyTable environment_table{"environment", environment_keys};

constexpr std::array model_keys{
    boolean_key("inertia", "false: creeping flow, when viscosity stops everything at once"),
    boolean_key("bending", "false: a membrane"),
    boolean_key("forces", "those of holds and solids on the sheet are written, for sheet-info"),
    boolean_key("faces", "tension makes rims round and levels faces (default: it acts on the middle surface)")};
constexpr KeyTable model_table{"model", model_keys};

// ---- [[hold]], [[solid]], [[inflow]], [[outflow]], [tear], [merge], [contact]

constexpr std::array ball_keys{list_key("center", quantity::length, "[3]", "of the ball"),
                               number_key("radius", quantity::length, "of the ball")};
constexpr KeyTable ball_table{"sphere", ball_keys};
constexpr std::array region_keys{
    list_key("box", quantity::length, "[2][3]", "lowest and highest corner of what is held at the start"),
    table_key("sphere", ball_table),
    text_key("array", "of the sheet's PLY file: what is held is where it is above 0.5 at vertices")};
constexpr KeyTable region_table{"region", region_keys};
constexpr std::array inlet_region_keys{
    text_key("array", "of the sheet's PLY file: the border where it is above 0.5 at vertices")};
constexpr KeyTable inlet_region_table{"region", inlet_region_keys};

constexpr std::array hold_keys{
    text_key("sheet", "whose vertices are held (default: of all)"),
    word_key("region", words::borders,
             "what is held: a border as the sheet lies before its rotation, a box, a sphere, an array", &region_table),
    word_key("kind", words::holds, "the position, or the slope too"),
    text_key("axes", "letters of the coordinates that are held (default xyz)"),
    table_key("motion", motion_table),
    number_key("until", quantity::time, "when it is let go (default: never)"),
    boolean_key("roll", "the region stays; what enters is held and carried, what leaves is let go")};
constexpr KeyTable hold_table{"hold", hold_keys};

constexpr std::array<std::string_view, 5> solid_files{".obj", ".off", ".ply", ".stl", ".vdb"};
constexpr std::array solid_keys{
    word_key("shape", words::solid_shapes, "its shape; capsules and cylinders stand along y"),
    number_key("radius", quantity::length, "of a sphere, capsule or cylinder"),
    list_key("size", quantity::length, "[3]", "of a box"),
    number_key("length", quantity::length, "of a capsule, between the centers of its ends"),
    number_key("height", quantity::length, "of a cylinder"),
    list_key("normal", quantity::number, "[3]", "of a plane, out of the solid (default: against gravity)"),
    file_key(solid_files, "mesh or distance field; names start in the folder of the scene"),
    number_key("scale", quantity::number, "metres per unit of the file (default 1)"),
    number_key("voxel_size", quantity::length, "of a mesh's distance field (default: the program chooses)"),
    text_key("checksum", "of the file, in the scenes of frames"),
    list_key("center", quantity::length, "[3]", "where its middle is (a mesh: where the file's origin goes)"),
    table_key("rotation", rotation_table),
    table_key("motion", motion_table),
    timed_key("velocity", quantity::velocity, "[3]", "short for a motion that translates, or of its axis"),
    list_key("angular_velocity", quantity::turning_rate, "[3]",
             "short for one that rotates about the center, which may move"),
    list_key("surface_velocity", quantity::velocity, "[3]", "of a belt: its surface moves, its shape stays"),
    word_key("contact", words::solid_contacts, "what liquid does that touches it"),
    number_key("slip_length", quantity::length, "eases the drag on what flows (default 0)"),
    number_key("contact_angle", quantity::angle,
               "of the rim, with surface tension (absent: the wetted face pulls as a free one)"),
    boolean_key("receding", "rims may retreat, else they leave a film (default false)"),
    timed_key("temperature", quantity::temperature, "", "of its surface; rows are [time, temperature]"),
    number_key("contact_conductance", quantity::heat_transfer, "by which it cools or heats what touches it")};
constexpr KeyTable solid_table{"solid", solid_keys};

constexpr std::array inflow_keys{
    text_key("sheet", "whose border (default: of the only one)"),
    word_key("region", words::borders, "border at which liquid enters", &inlet_region_table),
    timed_key("velocity", quantity::velocity, "[3]", "of what enters; rows are [time, x, y, z]"),
    timed_key("radial_velocity", quantity::velocity, "",
              "of what enters, besides, away from the sheet's axis; rows are [time, velocity]"),
    number_key("thickness", quantity::length, "of what enters (default: that of the sheet)"),
    timed_key("temperature", quantity::temperature, "", "of what enters (default: that of [heat])"),
    number_key("until", quantity::time, "when it stops (default: never)")};
constexpr KeyTable inflow_table{"inflow", inflow_keys};

constexpr std::array outflow_keys{list_key("point", quantity::length, "[3]", "of the plane beyond which liquid leaves"),
                                  list_key("normal", quantity::number, "[3]", "to the side where it leaves")};
constexpr KeyTable outflow_table{"outflow", outflow_keys};

constexpr std::array tear_keys{number_key("below", quantity::length, "thickness below which the sheet tears"),
                               word_key("crumbs", words::crumbs, "what becomes of small pieces that come off"),
                               number_key("sites", quantity::number_density,
                                          "inclusions that pierce a sheet as thick as at_thickness, and open holes"),
                               number_key("at_thickness", quantity::length, "of the sheet that these pierce"),
                               number_key("exponent", quantity::number,
                                          "m: a sheet of thickness h is pierced by sites (at_thickness/h)^m of them"),
                               integer_key("seed", "", "of where and when holes open (default 1)"),
                               number_key("snap", quantity::length, "width of strands that part"),
                               boolean_key("drops", "small pieces that come off fly on as drops")};
constexpr KeyTable tear_table{"tear", tear_keys};

constexpr std::array merge_keys{
    number_key("after", quantity::time, "how long it has touched (default, with tension: mu h/gamma)"),
    word_key("on", words::merges, "what may take it up: any layer, or one that lies on a solid")};
constexpr KeyTable merge_table{"merge", merge_keys};

constexpr std::array contact_keys{
    boolean_key("self", "of the sheet with itself (default true)"),
    number_key("stiffness", quantity::stiffness, "of the springs of one contact (default: the program chooses)"),
    number_key("adhesion", quantity::pressure, "tension at which touching surfaces part again (absent: never)"),
    number_key("distance", quantity::length, "between the middles of touching layers (default: their mean thickness)")};
constexpr KeyTable contact_table{"contact", contact_keys};

constexpr Key along_key = word_key("along", words::axes, "coordinate of the world over which it changes");
constexpr std::array temperatures_along{along_key, list_key("rows", quantity::temperature, "[][2]",
                                                            "of that coordinate, increasing, and temperature there")};
constexpr std::array transfers_along{along_key, list_key("rows", quantity::heat_transfer, "[][2]",
                                                         "of that coordinate, increasing, and its value there")};
constexpr KeyTable ambient_table{"ambient", temperatures_along}, radiant_table{"radiant", temperatures_along},
    transfer_table{"transfer", transfers_along};
// Constant, over time, or over a place.
constexpr Key varying_key(const Quantity& quantity, const KeyTable& along, std::string_view help) {
  return {along.name, Form::timed, help, &quantity, "", {}, &along};
}
constexpr std::array face_keys{
    varying_key(quantity::temperature, ambient_table,
                "of the air, or what else is there; rows are [time, temperature]"),
    varying_key(quantity::heat_transfer, transfer_table, "heat lost a second and kelvin above it (default 0)"),
    number_key("emissivity", quantity::number, "part of a black body's radiation, 0 to 1 (default 0)"),
    varying_key(quantity::temperature, radiant_table, "of what the face sees (default: ambient)")};
constexpr KeyTable upper_table{"upper", face_keys}, lower_table{"lower", face_keys};

constexpr std::array heat_keys{
    number_key("specific_heat", quantity::specific_heat, "of the liquid"),
    number_key("conductivity", quantity::conductivity, "by which heat spreads along the sheet (default 0)"),
    number_key("temperature", quantity::temperature, "at the start, and of what enters"),
    face_keys[0],
    face_keys[1],
    face_keys[2],
    face_keys[3],
    integer_key("profile", "", "modes of temperature across the thickness, 1 to 8 (default: a parabola by the losses)"),
    table_key("upper", upper_table),
    table_key("lower", lower_table),
    boolean_key("viscous_heating", "what viscosity dissipates becomes heat (default false)")};
constexpr KeyTable heat_table{"heat", heat_keys};

constexpr std::array all_tables{table_key("sheet", sheet_table),
                                table_key("material", material_table),
                                table_key("environment", environment_table),
                                table_key("model", model_table),
                                table_key("hold", hold_table),
                                table_key("solid", solid_table),
                                table_key("inflow", inflow_table),
                                table_key("outflow", outflow_table),
                                table_key("tear", tear_table),
                                table_key("merge", merge_table),
                                table_key("contact", contact_table),
                                table_key("heat", heat_table)};
constexpr KeyTable scene_table{"the scene", all_tables};

// Always in a list; [sheet], [inflow] and a perturbation stand alone as a rule.
bool is_numbered(std::string_view table) { return table == "hold" || table == "solid" || table == "outflow"; }

void list_below(const KeyTable& table, const std::string& path, std::vector<ListedKey>& listed) {
  for (const Key& key : table.keys) {
    const std::string here = path + std::string(key.name);
    if (key.form != Form::table)
      listed.push_back({here, key});
    if (key.below)
      list_below(*key.below, here + (is_numbered(key.name) ? ".N." : "."), listed);
  }
}

void collect_files(const Node& node, const KeyTable& table, const std::string& path, std::vector<NamedFile>& named) {
  if (node.type == Node::Type::list)
    for (std::size_t i = 0; i < node.items.size(); ++i)
      collect_files(node.items[i], table, fmt::format("{}{}.", path, i), named);
  for (const Key& key : table.keys) {
    const Node* value = node.find(key.name);
    if (value && key.form == Form::file && value->type == Node::Type::text)
      named.push_back({value->text, path + std::string(key.name)});
    if (value && key.below)
      collect_files(*value, *key.below, path + std::string(key.name) + ".", named);
  }
}

} // namespace

const Key* KeyTable::find(std::string_view key) const {
  const auto found = std::ranges::find(keys, key, &Key::name);
  return found == keys.end() ? nullptr : &*found;
}

const KeyTable& scene_keys() { return scene_table; }

std::vector<std::string> tables_with(std::string_view key) {
  std::vector<std::string> tables;
  for (const Key& table : scene_table.keys)
    if (table.below->find(key) != nullptr)
      tables.push_back(is_numbered(table.name) ? fmt::format("[[{}]]", table.name) : fmt::format("[{}]", table.name));
  return tables;
}

std::vector<ListedKey> listed_keys() {
  std::vector<ListedKey> listed;
  list_below(scene_table, "", listed);
  return listed;
}

std::vector<std::string> begun_settings() {
  std::vector<std::string> begun;
  for (const ListedKey& listed : listed_keys()) {
    std::string path = listed.path;
    if (const std::size_t numbered = path.find(".N."); numbered != std::string::npos)
      path[numbered + 1] = '0';
    begun.push_back(path + "=");
  }
  return begun;
}

std::string kind_of(const Key& key) {
  const auto plain = [&] {
    return key.quantity == &quantity::number ? "number" : key.quantity->name.substr(key.quantity->name.find(' ') + 1);
  };
  const auto kind = [&]() -> std::string {
    switch (key.form) {
    case Form::quantity:
    case Form::list:
      return fmt::format("{}{}", plain(), key.dimensions);
    case Form::timed:
      return fmt::format("{}{} or rows", plain(), key.dimensions);
    case Form::text:
      return fmt::format("text{}", key.dimensions);
    case Form::word:
      return fmt::format("{}", fmt::join(key.words, "|"));
    case Form::file:
      return fmt::format("file ({})", fmt::join(key.words, " "));
    case Form::boolean:
      return "boolean";
    case Form::integer:
      return fmt::format("integer{}", key.dimensions);
    case Form::table:
      break;
    }
    return "table";
  };
  return kind() + (key.below && key.form != Form::table ? " or table" : "");
}

std::string_view unit_of(const Key& key) {
  return key.quantity && key.quantity->unit != "1" ? key.quantity->unit : std::string_view();
}

std::vector<NamedFile> files_named_in(const Node& document) {
  std::vector<NamedFile> named;
  collect_files(document, scene_table, "", named);
  return named;
}

} // namespace sheet::scene
