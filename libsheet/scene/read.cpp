// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/read.h"

#include <algorithm>
#include <limits>

#include "libsheet/base/files.h"
#include "libsheet/scene/tables.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::scene {
namespace {

// [[hold]]s have a bit of 64 each in the array "hold" of a frame.
constexpr std::size_t most_holds = 64, most_sheets = 1000;

bool has_sheet_named(std::span<const SheetTable> sheets, const std::string& name) {
  return std::ranges::any_of(sheets, [&](const SheetTable& sheet) { return sheet.name == name; });
}

// A liquid of a scene, and the table that tells it.
struct ToldLiquid {
  const Liquid& liquid;
  const Node& table;
  std::string_view where; // that table's name, for messages
  [[nodiscard]] Place place_of(std::string_view key) const {
    const Node* value = table.find(key);
    return value ? value->place : table.place;
  }
};

// Of a scene of which every sheet has a liquid.
std::vector<ToldLiquid> told_liquids(const Scene& scene, const Node& document) {
  std::vector<ToldLiquid> told;
  if (const Node* own = document.find("material"))
    told.push_back({scene.material, *own, "[material]"});
  const Node& tables = *document.find("sheet");
  for (std::size_t i = 0; i < scene.sheets.size(); ++i)
    if (const auto& material = scene.sheets[i].material) {
      const Node& table = tables.type == Node::Type::list ? tables.items[i] : tables;
      told.push_back({*material, *table.find("material"), "[sheet.material]"});
    }
  return told;
}

// What is said of temperatures where there are none, and what [heat] needs. `place_of`: of a key in a table.
template <class PlaceOf>
void check_heat(const Scene& scene, std::span<const ToldLiquid> liquids, PlaceOf place_of, Problems& problems) {
  if (scene.heat) {
    for (const ToldLiquid& told : liquids)
      if (!(told.liquid.density > 0))
        problems.add(told.place_of("density"),
                     fmt::format("missing key \"density\" in {}: [heat] needs it", told.where));
    return;
  }
  const auto needs_at = [&](const Place& place, std::string_view key) {
    problems.add(place, fmt::format("{}: needs a table [heat], without which nothing has a temperature", key));
  };
  const auto needs = [&](std::string_view table, std::string_view key) { needs_at(place_of(table, key), key); };
  for (const ToldLiquid& told : liquids)
    if (!told.liquid.temperature_law.constant())
      needs_at(told.place_of("viscosity_law"), "viscosity_law");
    else if (told.liquid.surface_tension_slope != 0)
      needs_at(told.place_of("surface_tension_slope"), "surface_tension_slope");
  if (std::ranges::any_of(scene.sheets, [](const SheetTable& sheet) { return sheet.temperature.has_value(); }))
    needs("sheet", "temperature");
  if (std::ranges::any_of(scene.inflows, [](const Inflow& inflow) { return inflow.temperature.has_value(); }))
    needs("inflow", "temperature");
  if (std::ranges::any_of(scene.solids, [](const Solid& solid) { return solid.temperature.has_value(); }))
    needs("solid", "temperature");
}

// What a liquid needs in this scene, and what several have in common.
void check_liquids(const Scene& scene, std::span<const ToldLiquid> liquids, Problems& problems) {
  const ToldLiquid& first = liquids.front();
  for (const ToldLiquid& told : liquids) {
    const auto needs_density = [&](std::string_view why) {
      problems.add(told.place_of("density"), fmt::format("missing key \"density\" in {}: {}", told.where, why));
    };
    const bool dense = told.table.find("density") != nullptr; // what is wrong with it was told
    if (!dense && scene.model.inertia)
      needs_density("inertia needs it (or switch it off: inertia = false in [model])");
    else if (!dense && scene.environment.gravity)
      needs_density("gravity needs it");
    else if (!dense && scene.environment.air && scene.tear && scene.tear->drops)
      needs_density("drops in air need it");
    else if (dense != (first.table.find("density") != nullptr))
      problems.add(told.place_of("density"), "density: one of the scene's liquids has one, and another one does not");
    if (told.liquid.viscosity == 0 && !scene.model.inertia)
      problems.add(told.place_of("viscosity"), "viscosity: 0 needs inertia: nothing else would resist the forces");
    if ((told.liquid.viscosity == 0) != (first.liquid.viscosity == 0))
      problems.add(told.place_of("viscosity"),
                   "viscosity: one of the scene's liquids has one, and another one has not: "
                   "give the latter a small one");
  }
}

// What only several tables together can say.
void check_together(const Scene& scene, const Node& document, Problems& problems) {
  const auto place = [&](std::string_view table, std::string_view key) {
    const Node* found = document.find(table);
    if (found && found->type == Node::Type::table)
      if (const Node* value = found->find(key))
        return value->place;
    return found ? found->place : document.place;
  };
  const auto has = [&](std::string_view table, std::string_view key) {
    const Node* found = document.find(table);
    return found && found->find(key);
  };
  const std::vector<ToldLiquid> liquids = told_liquids(scene, document);
  const bool tense =
      std::ranges::any_of(liquids, [](const ToldLiquid& told) { return told.liquid.surface_tension > 0; });
  const auto& [sheets, material, environment, model, holds, solids, inflows, outflows, tear, merge, contact, heat] =
      scene;
  check_liquids(scene, liquids, problems);
  if (model.faces && !tense)
    problems.add(place("model", "faces"), "faces: needs surface_tension in [material], which acts on them");
  if (environment.bath && !environment.gravity && (!has("environment", "gravity") || !problems.any()))
    problems.add(place("environment", "bath"), "bath: needs gravity, which says where up is");
  if (merge && !(contact && contact->self))
    problems.add(place("merge", "after"), "[merge] needs [contact] with self = true: nothing touches without it");
  if (merge && !merge->after && !tense)
    problems.add(place("merge", "after"), "missing key \"after\" in [merge]: without surface tension nothing says how "
                                          "long layers take to become one; for example after = \"0.3 s\"");
  if (const std::string& name = environment.pressure_sheet; !name.empty() && !has_sheet_named(sheets, name))
    problems.add(place("environment", "pressure"), fmt::format("pressure: there is no [[sheet]] \"{}\"", name));
  const bool flat = std::ranges::all_of(sheets, [](const SheetTable& sheet) { return sheet.shape.index() <= 2; });
  const auto* gas = environment.pressure ? std::get_if<GasPressure>(&*environment.pressure) : nullptr;
  const bool without_volume =
      environment.pressure &&
      (std::holds_alternative<ConstantPressure>(*environment.pressure) || (gas && gas->more_volume > 0));
  if (environment.pressure && flat && !without_volume)
    problems.add(place("environment", "pressure"),
                 "pressure: this law needs a shape that encloses a volume, or a mesh");
  check_heat(scene, liquids, place, problems);
  std::size_t rows = 0;
  const auto count = [&](const Motion& motion) {
    if (const auto* keyed = std::get_if<Keyframed>(&motion))
      rows += keyed->frames->times().size();
  };
  for (const Hold& hold : holds)
    count(hold.motion);
  for (const Solid& solid : solids)
    count(solid.motion);
  if (rows > most_keyframes)
    problems.add(document.place, fmt::format("its motions have {} rows; a scene, which every frame carries, takes {}: "
                                             "take every n-th; what stands between is found by interpolation",
                                             rows, most_keyframes));
}

// The tables [[key]], at most so many.
std::vector<TableReader> tables_of(const Node* node, std::string_view key, std::size_t most, Problems& problems) {
  std::vector<TableReader> tables;
  if (!node)
    return tables;
  if (node->type != Node::Type::list) {
    problems.add(node->place, fmt::format("{0}: expected tables [[{0}]], got {1}", key, describe(node->type)));
    return tables;
  }
  if (node->items.size() > most)
    problems.add(node->items[most].place,
                 fmt::format("{0}: {1} tables [[{0}]]; a scene may have {2}", key, node->items.size(), most));
  for (const Node& item : node->items) {
    if (item.type == Node::Type::table)
      tables.emplace_back(item, fmt::format("[[{}]]", key), *scene_keys().find(key)->below, problems);
    else
      problems.add(item.place,
                   fmt::format("{0}: expected tables [[{0}]], got {1} in the list", key, describe(item.type)));
  }
  return tables;
}

// Names are told apart, and one sheet is there from the start. Without tables: one that has every border.
std::vector<SheetTable> read_sheets(std::span<TableReader> tables, const Environment& environment, const Files& files) {
  std::vector<SheetTable> sheets;
  for (TableReader& table : tables) {
    SheetTable sheet = read_sheet(table, environment, files);
    const auto same = [&](const SheetTable& other) { return !sheet.name.empty() && other.name == sheet.name; };
    if (std::ranges::any_of(sheets, same))
      table.wrong("name", "another [[sheet]] has this name");
    if (sheets.empty() && sheet.enters)
      table.wrong("enters", "the first sheet is there from the start");
    sheets.push_back(std::move(sheet));
  }
  if (sheets.empty())
    sheets.emplace_back().shape = SheetMesh{"", 1};
  return sheets;
}

Scene read_document(const Node& document, Problems& problems, const Files& files) {
  static const Node nothing{};
  TableReader top(document, "the scene", scene_keys(), problems);
  const auto required = [&](std::string_view key) {
    const auto table = top.table(key);
    if (!table && top.absent(key))
      problems.add({}, fmt::format("missing table [{}]", key));
    return table;
  };
  const auto named = [&](std::string_view key, const Node& node) {
    return TableReader(node, fmt::format("[{}]", key), *scene_keys().find(key)->below, problems);
  };
  const auto optional = [&](std::string_view key) -> std::optional<TableReader> {
    const Node* node = top.table(key) ? document.find(key) : nullptr;
    if (!node)
      return {};
    return named(key, *node);
  };
  const auto list = [&](std::string_view key, std::size_t most) {
    return tables_of(top.take(key), key, most, problems);
  };
  const auto one_or_several = [&](std::string_view key, std::size_t most) -> std::vector<TableReader> {
    const Node* node = top.take(key);
    if (node != nullptr && node->type == Node::Type::list)
      return list(key, most);
    const auto table = optional(key);
    return table ? std::vector<TableReader>{*table} : std::vector<TableReader>{};
  };

  Scene scene;
  std::vector<TableReader> sheets = one_or_several("sheet", most_sheets);
  if (const Node* sheet = document.find("sheet"); !sheet)
    problems.add({}, "missing table [sheet]");
  else if (sheet->type == Node::Type::list && sheet->items.empty())
    problems.add(sheet->place, "sheet: an empty list; there must be a [sheet], or at least one [[sheet]]");
  const bool own = std::ranges::all_of(sheets, [](const TableReader& sheet) { return !sheet.absent("material"); });
  const bool has_sheet = !sheets.empty(), sheets_tell = has_sheet && own && top.absent("material");
  const bool has_material = sheets_tell || required("material").has_value();
  if (has_material && !sheets_tell)
    scene.material = read_material(named("material", *document.find("material")), files);
  if (auto table = optional("environment"))
    scene.environment = read_environment(*table);
  if (auto table = optional("model"))
    scene.model = read_model(*table);
  scene.sheets = read_sheets(sheets, scene.environment, files);
  if (sheets_tell && scene.sheets.front().material)
    scene.material = *scene.sheets.front().material;
  for (TableReader& table : list("hold", most_holds))
    scene.holds.push_back(read_hold(table, scene.sheets, scene.model, files));
  for (TableReader& table : list("solid", std::numeric_limits<std::size_t>::max()))
    scene.solids.push_back(read_solid(table, scene.environment, files));
  for (TableReader& table : one_or_several("inflow", most_inlets))
    scene.inflows.push_back(read_inflow(table, scene.sheets));
  for (TableReader& table : list("outflow", std::numeric_limits<std::size_t>::max()))
    scene.outflows.push_back(read_outflow(table));
  if (auto table = optional("tear"))
    scene.tear = read_tear(*table, scene.sheets);
  if (auto table = optional("merge"))
    scene.merge = read_merge(*table);
  if (auto table = optional("contact"))
    scene.contact = read_contact(*table);
  if (auto table = optional("heat"))
    scene.heat = read_heat(*table);
  top.finish();
  if (has_sheet && has_material)
    check_together(scene, document, problems);
  return scene;
}

Scene parse(std::string_view text, const std::string& name, std::span<const std::string> sets, const Files& files) {
  Node document = parse_toml(text, name);
  for (std::size_t i = 0; i < sets.size(); ++i)
    apply_set(document, sets[i], static_cast<int>(i));
  Problems problems(name, sets);
  Scene scene = read_document(document, problems, files);
  problems.throw_if_any();
  return scene;
}

} // namespace

Scene parse_scene(std::string_view text, std::string_view name, std::span<const std::string> sets,
                  const std::filesystem::path& base_folder) {
  return parse(text, std::string(name), sets, Files{base_folder, false});
}

Scene read_scene(const std::filesystem::path& path, std::span<const std::string> sets) {
  const std::string text = read_utf8_file(path.string());
  std::filesystem::path folder = path.parent_path();
  if (folder.is_absolute())
    folder = folder.lexically_proximate(std::filesystem::current_path());
  return parse(text, path.string(), sets, Files{folder, true});
}

} // namespace sheet::scene
