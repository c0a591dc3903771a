// SPDX-License-Identifier: GPL-3.0-or-later
// What several tables have in common: motions, rotations, files, borders.
#include <algorithm>

#include "libsheet/base/file_roles.h"
#include "libsheet/scene/tables.h"
#include "libsheet/scene/words.h"

namespace sheet::scene {

Motion read_motion(TableReader& parent, const Vector3d& center, const Files& files) {
  auto table = parent.table("motion");
  if (!table)
    return Fixed{};
  const auto kind = table->choice("kind");
  if (table->absent("kind"))
    table->missing("kind", "\"rotating\"");
  Motion motion = Fixed{};
  if (kind == 1) {
    if (table->absent("velocity"))
      table->missing("velocity", "[0, 0, \"0.4 m/s\"]");
    motion = Translating{table->timed_velocity("velocity").value_or(Timed<Vector3d>{})};
  } else if (kind == 2) {
    if (table->absent("rate"))
      table->missing("rate", "\"0.3 rad/s\"");
    if (table->absent("axis"))
      table->missing("axis", "[0, 1, 0]");
    motion = Rotating{table->direction_or("axis", Vector3d::UnitY()), table->vector("center").value_or(center),
                      table->timed_number("rate").value_or(Timed<double>{}),
                      table->timed_velocity("velocity").value_or(Timed<Vector3d>{})};
  } else if (kind == 3) {
    if (auto frames = read_keyframes(*table, center, files))
      motion = Keyframed{std::move(frames)};
  }
  constexpr std::array<std::string_view, 4> takes{"nothing else", "velocity", "axis, center, rate, velocity",
                                                  "file, or times with places, rotations or both; interpolation"};
  const auto because = kind ? fmt::format("a {} motion takes {}", words::motions[*kind], takes[*kind])
                            : "the motion's kind is not known";
  table->has_no_meaning({"velocity", "rate", "axis", "center", "file", "times", "places", "rotations", "interpolation"},
                        because);
  table->finish();
  return motion;
}

Motion read_motion_or_velocity(TableReader& parent, const Vector3d& center, const Files& files) {
  const Motion motion = read_motion(parent, center, files);
  const auto velocity = parent.timed_velocity("velocity");
  const auto angular = parent.vector("angular_velocity");
  const bool led = !parent.absent("motion"), moves = !parent.absent("velocity");
  if (led && moves)
    parent.wrong("velocity", "it is short for a motion, which is there too: give one of them");
  if (led && !parent.absent("angular_velocity"))
    parent.wrong("angular_velocity", "it is short for a motion, which is there too: give one of them");
  if (led)
    return motion;
  if (angular && !angular->isZero(0))
    return Rotating{*angular, center, {{{0, angular->stableNorm()}}}, velocity.value_or(Timed<Vector3d>{})};
  if (velocity)
    return Translating{*velocity};
  return Fixed{};
}

WhichSheet read_which_sheet(TableReader& table, std::span<const SheetTable> sheets, bool any) {
  const auto name = table.text("sheet");
  if (!name) {
    if (sheets.size() > 1 && !any)
      table.missing("sheet", fmt::format("\"{}\", as there are several", sheets.front().name));
    return {"", sheets.front()};
  }
  const auto found = std::ranges::find(sheets, *name, [](const SheetTable& sheet) { return sheet.name; });
  if (found != sheets.end() && !name->empty())
    return {*name, *found};
  std::string names;
  for (const SheetTable& sheet : sheets)
    if (!sheet.name.empty())
      names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", sheet.name);
  table.wrong("sheet", names.empty() ? "no [[sheet]] has a name"
                                     : fmt::format("there is no [[sheet]] \"{}\"; there is {}", *name, names));
  return {"", sheets.front()};
}

std::optional<Rotation> read_rotation(TableReader& parent) {
  auto table = parent.table("rotation");
  if (!table)
    return {};
  if (table->absent("axis"))
    table->missing("axis", "[0, 1, 0]");
  Rotation rotation;
  rotation.axis = table->direction_or("axis", Vector3d::UnitY());
  rotation.angle = table->required("angle", Bound::any);
  table->finish();
  return rotation;
}

namespace {

constexpr std::size_t most_place_rows = 1000; // every frame of a run carries them

// In which planes the sheet would have that border, as a tube whose axis is not the one that was meant; "" if in none.
std::string planes_with(SheetTable sheet, Border border) {
  const std::string_view own = words::planes[static_cast<std::size_t>(sheet.plane)];
  std::string planes;
  for (std::size_t i = 0; i < words::planes.size(); ++i) {
    sheet.plane = static_cast<Plane>(i);
    const auto there = borders_of(sheet);
    if (std::find(there.begin(), there.end(), border) != there.end())
      planes += fmt::format("{}\"{}\"", planes.empty() ? "" : " or ", words::planes[i]);
  }
  return planes.empty() ? "" : fmt::format(", as its plane is \"{}\"; with plane = {} it has that", own, planes);
}

} // namespace

PlaceRows read_place_rows(TableReader& table, std::string_view key, std::string_view what, std::string_view example,
                          Bound bound) {
  PlaceRows rows;
  const Node* list = table.take(key);
  if (list == nullptr)
    return rows;
  if (list->type != Node::Type::list || list->items.size() < 2 || list->items.size() > most_place_rows) {
    table.wrong(key, fmt::format("expected 2 to {} rows of a place and {} there", most_place_rows, what));
    return rows;
  }
  for (const Node& row : list->items) {
    if (row.type != Node::Type::list || row.items.size() != 2) {
      table.problems().add(row.place, fmt::format("{}: {}: expected rows of a place and {} there, such as {}",
                                                  table.where(), key, what, example));
      break;
    }
    const auto place = table.number(row.items[0], key, quantity::length, Bound::any);
    const auto value = table.quantity(row.items[1], key, bound);
    if (!place || !value)
      break;
    if (!rows.empty() && !(*place > rows.back()[0])) {
      table.problems().add(row.place, fmt::format("{}: {}: places must increase from each row to the next, but {} m "
                                                  "follows {} m",
                                                  table.where(), key, shortest(*place), shortest(rows.back()[0])));
      break;
    }
    rows.push_back({*place, *value});
  }
  return rows;
}

std::string read_file(TableReader& table, const Files& files, std::string_view key) {
  const std::span<const std::string_view> extensions = table.declared(key).words;
  if (table.absent(key))
    table.missing(key, fmt::format("\"bunny{}\"", extensions.front()));
  const auto name = table.text(key);
  if (!name)
    return {};
  const std::filesystem::path path = (files.folder / *name).lexically_normal();
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) {
    std::string list;
    for (const auto known : extensions)
      list += fmt::format("{}{}", list.empty() ? "" : ", ", known);
    table.wrong(key, fmt::format("\"{}\" is of no known kind; known: {}", *name, list));
  } else if (files.must_exist) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status))
      table.wrong(key, fmt::format("there is no \"{}\"", path.string()));
    else if (!std::filesystem::is_regular_file(status))
      table.wrong(key, fmt::format("\"{}\" is not a file", path.string()));
    else
      claim_file(path.string(), FileRole::input);
  }
  return path.string();
}

std::optional<Border> read_border(TableReader& table, std::string_view key, const SheetTable& sheet) {
  const auto index = table.choice(key);
  if (!index)
    return {};
  const auto border = static_cast<Border>(*index);
  const auto existing = borders_of(sheet);
  if (std::find(existing.begin(), existing.end(), border) == existing.end()) {
    std::string list;
    for (const Border one : existing)
      list += fmt::format("{}{}", list.empty() ? "" : ", ", words::borders[static_cast<std::size_t>(one)]);
    table.wrong(key, fmt::format("this sheet has no \"{}\"; it has {}{}", words::borders[*index],
                                 list.empty() ? "no border" : list, planes_with(sheet, border)));
  }
  return border;
}

} // namespace sheet::scene
