// SPDX-License-Identifier: GPL-3.0-or-later
// [[hold]], [[solid]], [inflow], [tear], [merge], [contact]
#include <algorithm>
#include <filesystem>
#include <numbers>

#include "libsheet/base/named_files.h"
#include "libsheet/scene/tables.h"
#include "libsheet/scene/words.h"

namespace sheet::scene {
namespace {

constexpr std::string_view region_example =
    "\"rim\", {box = [[0, 0, 0], [1, 1, 1]]}, {sphere = {center = [0, 0, 0], radius = 1}} or {array = \"pinned\"}";

// {array = "NAME"}, which a sheet from a mesh file may have.
ArrayRegion read_array_region(TableReader& parent, TableReader& table, const SheetTable& sheet) {
  if (!std::holds_alternative<SheetMesh>(sheet.shape))
    parent.wrong("region", "only a sheet of shape \"mesh\" has arrays, from its PLY file");
  ArrayRegion region{table.text("array").value_or("")};
  if (region.array.empty() && !table.absent("array"))
    table.wrong("array", "expected the name of a property of the PLY file");
  return region;
}

std::optional<Region> read_box_region(TableReader& parent) {
  const Node* box = parent.take("box");
  if (box->type != Node::Type::list || box->items.size() != 2) {
    parent.wrong("box", "expected two corners such as [[0, 0, 0], [1, 1, 1]]");
    return {};
  }
  const auto low = parent.vector(box->items[0], "box");
  const auto high = parent.vector(box->items[1], "box");
  if (!low || !high)
    return {};
  if ((low->array() > high->array()).any())
    parent.wrong("box", "the first corner must not exceed the second in any coordinate");
  return BoxRegion{*low, *high};
}

std::optional<Region> read_region(TableReader& hold, const SheetTable& sheet) {
  const Node* value = hold.take("region");
  if (!value) {
    hold.missing("region", "\"rim\"");
    return {};
  }
  if (value->type == Node::Type::text) {
    if (const auto border = read_border(hold, "region", sheet))
      return *border;
    return {};
  }
  if (value->type != Node::Type::table) {
    hold.wrong("region", fmt::format("expected {}, got {}", region_example, describe(value->type)));
    return {};
  }
  auto table = *hold.table("region");
  std::optional<Region> result;
  if (table.absent("box") + table.absent("sphere") + table.absent("array") != 2)
    hold.wrong("region", fmt::format("expected {}", region_example));
  if (!table.absent("array"))
    result = read_array_region(hold, table, sheet);
  if (!table.absent("box"))
    result = read_box_region(table);
  if (auto sphere = table.table("sphere")) {
    if (sphere->absent("center"))
      sphere->missing("center", "[0, 0, 0]");
    const Vector3d center = sphere->vector("center").value_or(Vector3d::Zero());
    result = SphereRegion{center, sphere->required("radius")};
    sphere->finish();
  }
  table.finish();
  return result;
}

Axes read_axes(TableReader& table) {
  const auto text = table.text("axes");
  if (!text)
    return all_axes;
  Axes axes = 0;
  for (const char c : *text) {
    const std::size_t axis = c == 'x' ? 0 : c == 'y' ? 1 : c == 'z' ? 2 : 3;
    if (axis == 3 || has_axis(axes, axis)) {
      table.wrong("axes", "expected some of the letters x, y, z, such as \"y\" or \"xz\"");
      return all_axes;
    }
    axes |= axis_bit(axis);
  }
  return axes;
}

struct KnownSolid {
  SolidShape shape;
  std::string_view keys;
};

// Of the file; sheet-init finds it out, so that stages can tell whether they read the same one.
std::string read_checksum(TableReader& table, const std::string& file, const Files& files) {
  const std::string told = table.text("checksum").value_or("");
  if (!files.must_exist || !std::filesystem::is_regular_file(file))
    return told;
  const std::string found = checksum_of_file(file);
  if (!told.empty() && told != found)
    table.wrong("checksum", fmt::format("\"{}\" has {}: another file, or take the key away", file, found));
  return found;
}

KnownSolid read_solid_shape(TableReader& table, std::size_t kind, const Environment& environment, const Files& files) {
  switch (kind) {
  case 0:
    return {Sphere{table.required("radius")}, "radius"};
  case 1: {
    if (table.absent("size"))
      table.missing("size", "[0.2, 0.1, 0.2]");
    const auto size = table.vector("size");
    if (size && (size->array() <= 0).any())
      table.wrong("size", "every edge must be positive");
    return {SolidBox{size.value_or(Vector3d::Ones())}, "size, rotation"};
  }
  case 2: {
    const double radius = table.required("radius");
    return {Capsule{radius, table.required("length")}, "radius, length, rotation"};
  }
  case 3: {
    const double radius = table.required("radius");
    return {Cylinder{radius, table.required("height")}, "radius, height, rotation"};
  }
  case 4:
    return {HalfSpace{table.direction_or("normal", up(environment).value_or(Vector3d::UnitY()))}, "normal"};
  default: {
    std::string file = read_file(table, files);
    const double scale = table.quantity_or("scale", 1, Bound::positive);
    const auto voxel_size = table.quantity("voxel_size", Bound::positive);
    std::string checksum = read_checksum(table, file, files);
    return {SolidMesh{std::move(file), scale, voxel_size, std::move(checksum)},
            "file, scale, voxel_size, checksum, rotation"};
  }
  }
}

// How liquid that touches the solid meets it.
void read_contact_with(TableReader& table, Solid& solid) {
  const std::size_t contact = table.choice("contact").value_or(0);
  solid.contact = static_cast<SolidContact>(contact);
  const auto needs = [&](std::string_view what) {
    return fmt::format("contact is \"{}\"; liquid must {} along it", words::solid_contacts[contact], what);
  };
  if (solid.contact == SolidContact::flow) {
    solid.slip_length = table.quantity_or("slip_length", 0, Bound::not_negative);
    solid.receding = table.boolean("receding").value_or(false);
  } else {
    table.has_no_meaning({"slip_length", "receding"}, needs("\"flow\""));
  }
  if (solid.contact != SolidContact::stick) {
    solid.contact_angle = table.quantity("contact_angle", Bound::not_negative);
    if (solid.contact_angle > std::numbers::pi)
      table.wrong("contact_angle", "expected an angle from 0 to 180 deg");
  } else {
    table.has_no_meaning({"contact_angle"}, needs("\"flow\" or \"slip\""));
  }
}

// A solid that does not say where it is at time 0 is where the rows of its motion have it.
void put_at_keyframes(const TableReader& table, Solid& solid) {
  const auto* keyed = std::get_if<Keyframed>(&solid.motion);
  if (keyed == nullptr)
    return;
  const Eigen::Isometry3d start = keyed->frames->pose(0);
  if (table.absent("center") && !keyed->frames->places().empty())
    solid.center = start.translation();
  const bool turnable = !std::holds_alternative<Sphere>(solid.shape) && !std::holds_alternative<HalfSpace>(solid.shape);
  const Eigen::AngleAxisd turn(start.linear());
  if (turnable && table.absent("rotation") && turn.angle() != 0)
    solid.rotation = Rotation{turn.axis(), turn.angle()};
}

} // namespace

Hold read_hold(TableReader table, std::span<const SheetTable> sheets, const Model& model, const Files& files) {
  Hold hold;
  const Node* region = table.take("region");
  const bool in_space = region != nullptr && region->type == Node::Type::table && region->find("array") == nullptr;
  const auto [name, sheet] = read_which_sheet(table, sheets, in_space);
  hold.sheet = name;
  hold.region = read_region(table, sheet).value_or(Border::rim);
  hold.clamped = table.choice("kind").value_or(0) == 1;
  hold.axes = read_axes(table);
  hold.motion = read_motion(table, sheet.center, files);
  hold.until = table.quantity("until", Bound::positive);
  hold.roll = table.boolean("roll").value_or(false);
  if (hold.roll && (std::holds_alternative<Border>(hold.region) || std::holds_alternative<ArrayRegion>(hold.region)))
    table.wrong("roll",
                "a roll takes what enters a part of space: region = {box = [[0, 0, 0], [1, 1, 1]]}, or a sphere");
  if (hold.roll && std::holds_alternative<Fixed>(hold.motion))
    table.wrong("roll", "a roll carries what it holds: it needs a motion, such as {kind = \"translating\", velocity = "
                        "[1, 0, 0]}");
  if (hold.clamped && !model.bending)
    table.wrong("kind", "a clamped hold needs bending, which [model] switches off; use \"pinned\"");
  if (hold.clamped && hold.axes != all_axes)
    table.wrong("axes", "a clamped hold holds all axes; use kind = \"pinned\"");
  if (turns(hold.motion) && hold.axes != all_axes)
    table.wrong("axes", "a hold that turns holds all axes");
  table.finish();
  return hold;
}

Solid read_solid(TableReader table, const Environment& environment, const Files& files) {
  Solid solid;
  if (table.absent("shape"))
    table.missing("shape", "\"sphere\"");
  const auto kind = table.choice("shape");
  solid.center = table.vector("center").value_or(Vector3d::Zero());
  std::string because = "the shape is not known";
  if (kind) {
    KnownSolid known = read_solid_shape(table, *kind, environment, files);
    solid.shape = std::move(known.shape);
    because = fmt::format("shape \"{}\" takes {}", words::solid_shapes[*kind], known.keys);
    if (*kind != 0 && *kind != 4)
      solid.rotation = read_rotation(table);
    table.has_no_meaning({"radius", "size", "length", "height", "normal", "file", "scale", "voxel_size", "rotation"},
                         because);
  } else {
    for (const auto key :
         {"radius", "size", "length", "height", "normal", "file", "scale", "voxel_size", "checksum", "rotation"})
      table.take(key); // judged when the shape is known
  }
  solid.motion = read_motion_or_velocity(table, solid.center, files);
  put_at_keyframes(table, solid);
  solid.surface_velocity = table.vector("surface_velocity").value_or(Vector3d::Zero());
  read_contact_with(table, solid);
  solid.temperature = table.timed_number("temperature", Bound::positive);
  solid.contact_conductance = table.quantity_or("contact_conductance", 0, Bound::not_negative);
  if (solid.temperature && table.absent("contact_conductance"))
    table.missing("contact_conductance", "\"500 W/(m^2*K)\"");
  else if (solid.contact_conductance > 0 && table.absent("temperature"))
    table.missing("temperature", "\"20 degC\"");
  table.finish();
  return solid;
}

namespace {

std::variant<Border, ArrayRegion> read_inlet_region(TableReader& inflow, const SheetTable& sheet) {
  const Node* value = inflow.take("region");
  if (value && value->type == Node::Type::table) {
    auto table = *inflow.table("region");
    if (table.absent("array"))
      table.missing("array", "\"inlet\"");
    ArrayRegion region = read_array_region(inflow, table, sheet);
    table.finish();
    return region;
  }
  const auto border = read_border(inflow, "region", sheet);
  if (border == Border::rim && borders_of(sheet).size() > 2)
    inflow.wrong("region", "liquid enters at one side or ring only; \"rim\" is all of the border");
  return border.value_or(Border::rim);
}

} // namespace

Inflow read_inflow(TableReader table, std::span<const SheetTable> sheets) {
  Inflow inflow;
  const auto [name, sheet] = read_which_sheet(table, sheets, false);
  inflow.sheet = name;
  if (table.absent("region"))
    table.missing("region", "\"y_max\"");
  inflow.region = read_inlet_region(table, sheet);
  if (table.absent("velocity") && table.absent("radial_velocity"))
    table.missing("velocity", "[0, \"-0.1 m/s\", 0]");
  inflow.velocity = table.timed_velocity("velocity").value_or(Timed<Vector3d>{});
  inflow.radial_velocity = table.timed_number("radial_velocity").value_or(Timed<double>{});
  const auto thickness = table.quantity("thickness", Bound::positive);
  const double* uniform = std::get_if<double>(&sheet.thickness);
  if (table.absent("thickness") && !uniform)
    table.missing("thickness", "\"2.5 mm\"");
  inflow.thickness = thickness.value_or(uniform ? *uniform : 0);
  inflow.temperature = table.timed_number("temperature", Bound::positive);
  inflow.until = table.quantity("until", Bound::positive);
  table.has_no_meaning({"motion"}, "an inlet stands; let the solids move past it the other way ([[solid]] velocity or "
                                   "motion), which is the same as seen from it");
  const auto& common = inflow.velocity.entries;
  const auto& radial = inflow.radial_velocity.entries;
  const bool some_radial = std::ranges::any_of(radial, [](const auto& entry) { return entry.value != 0; });
  if (common.size() == 1 && common[0].value.isZero(0) && !some_radial)
    table.wrong("velocity", "with no velocity nothing flows in");
  else if (common.empty() && !radial.empty() && !some_radial)
    table.wrong("radial_velocity", "with no velocity nothing flows in");
  table.finish();
  return inflow;
}

Outflow read_outflow(TableReader table) {
  Outflow outflow;
  for (const std::string_view key : {"point", "normal"})
    if (table.absent(key))
      table.missing(key, key == "point" ? "[\"1 m\", 0, 0]" : "[1, 0, 0]");
  outflow.point = table.vector("point").value_or(Vector3d::Zero());
  outflow.normal = table.direction_or("normal", Vector3d::UnitX());
  table.finish();
  return outflow;
}

Tear read_tear(TableReader table, std::span<const SheetTable> sheets) {
  Tear tear;
  if (table.absent("below") && table.absent("sites") && table.absent("snap") && table.absent("drops"))
    table.missing("below", "\"0.8 mm\", or sites, or snap");
  tear.below = table.quantity("below", Bound::positive);
  for (const SheetTable& sheet : sheets)
    if (const double* uniform = std::get_if<double>(&sheet.thickness);
        uniform && tear.below && *tear.below >= *uniform) {
      table.wrong("below", fmt::format("the whole sheet would tear at once: {} m is not less than its thickness {} m",
                                       shortest(*tear.below), shortest(*uniform)));
      break;
    }
  if (table.absent("below"))
    table.has_no_meaning({"crumbs"}, "only what tears below a thickness comes off in crumbs");
  tear.drop_crumbs = table.choice("crumbs").value_or(0) == 1;
  if (const std::optional<double> sites = table.quantity("sites", Bound::positive); table.absent("sites")) {
    table.has_no_meaning({"at_thickness", "exponent", "seed"}, "there are no sites");
  } else {
    Inclusions& inclusions = tear.inclusions.emplace();
    inclusions.number = sites.value_or(0);
    inclusions.at_thickness = table.required("at_thickness", Bound::positive, "\"0.6 mm\"");
    inclusions.exponent = table.required("exponent", Bound::positive, "6");
    inclusions.seed = table.seed("seed").value_or(inclusions.seed);
  }
  tear.snap = table.quantity("snap", Bound::positive);
  tear.drops = table.boolean("drops").value_or(false);
  table.finish();
  return tear;
}

Merge read_merge(TableReader table) {
  Merge merge;
  merge.after = table.quantity("after", Bound::not_negative);
  merge.on_solids = table.choice("on").value_or(0) == 1;
  table.finish();
  return merge;
}

Contact read_contact(TableReader table) {
  Contact contact;
  contact.self = table.boolean("self").value_or(true);
  contact.stiffness = table.quantity("stiffness", Bound::positive);
  contact.adhesion = table.quantity("adhesion", Bound::not_negative);
  contact.distance = table.quantity("distance", Bound::positive);
  table.finish();
  return contact;
}

} // namespace sheet::scene
