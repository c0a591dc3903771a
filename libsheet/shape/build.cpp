// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/build.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "libsheet/base/error.h"
#include "libsheet/base/log.h"
#include "libsheet/base/overloaded.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/scene/sheet_edges.h"
#include "libsheet/scene/write.h"
#include "libsheet/shape/enclosed.h"
#include "libsheet/shape/mesh_file.h"
#include "libsheet/shape/mesh_measure.h"
#include "libsheet/shape/perturb.h"
#include "libsheet/shape/place.h"
#include "libsheet/shape/random.h"
#include "libsheet/shape/regions.h"
#include "libsheet/shape/shapes.h"
#include "libsheet/shape/thickness_profile.h"
#include "libsheet/shape/waves.h"
#include "libsheet/sheet/append.h"
#include "libsheet/sheet/enclosures.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

using Eigen::Vector3d;

MeshOptions mesh_options(const scene::SheetTable& table) {
  MeshOptions options;
  options.pattern = table.pattern == scene::Pattern::structured    ? Pattern::structured
                    : table.pattern == scene::Pattern::equilateral ? Pattern::equilateral
                                                                   : Pattern::irregular;
  options.edge_length = table.edge_length.value_or(0);
  options.seed = static_cast<std::uint64_t>(table.seed);
  if (table.segments)
    options.segments = {static_cast<std::uint32_t>((*table.segments)[0]),
                        static_cast<std::uint32_t>((*table.segments)[1])};
  return options;
}

TriangleMesh load_scaled(const scene::SheetMesh& file, const std::vector<std::string>& arrays, Notes notes) {
  LoadedMesh loaded = load_mesh(file.file, arrays);
  if (notes == Notes::told)
    for (const std::string& note : loaded.notes)
      log::warning("{}", note);
  for (Vector3d& x : loaded.mesh.positions)
    x *= file.scale;
  return std::move(loaded.mesh);
}

// The arrays of a sheet's file that the scene names: those that go along, then those of its regions.
std::vector<std::string> arrays_of(const Scene& scene, const scene::SheetTable& table) {
  std::vector<std::string> names = table.arrays;
  const auto add = [&](const std::string& sheet, const auto& region) {
    const auto* array = std::get_if<scene::ArrayRegion>(&region);
    if (array && &sheet_named(scene, sheet) == &table && std::ranges::find(names, array->array) == names.end())
      names.push_back(array->array);
  };
  const auto* temperature = table.temperature ? std::get_if<scene::TemperatureData>(&*table.temperature) : nullptr;
  if (temperature != nullptr && std::ranges::find(names, temperature->data) == names.end())
    names.push_back(temperature->data);
  for (const scene::Hold& hold : scene.holds)
    add(hold.sheet, hold.region);
  for (const scene::Inflow& inflow : scene.inflows)
    add(inflow.sheet, inflow.region);
  return names;
}

// In the shape's local frame (shapes.h).
TriangleMesh local_mesh(const Scene& scene, const scene::SheetTable& table, Notes notes) {
  const MeshOptions options = mesh_options(table);
  return std::visit(Overloaded{
                        [&](const scene::Rectangle& r) { return make_rectangle(r.size_first, r.size_second, options); },
                        [&](const scene::Disk& d) { return make_disk(d.radius, options); },
                        [&](const scene::Annulus& a) { return make_annulus(a.inner_radius, a.outer_radius, options); },
                        [&](const scene::Sphere& s) { return make_sphere(s.radius, options); },
                        [&](const scene::Cap& c) { return make_cap(c.radius, c.angle, options, c.opening); },
                        [&](const scene::Tube& t) { return make_tube(t.radius, t.height, options); },
                        [&](const scene::SheetMesh& m) { return load_scaled(m, arrays_of(scene, table), notes); },
                    },
                    table.shape);
}

Plane plane_of(scene::Plane plane) {
  return plane == scene::Plane::xy ? Plane::xy : plane == scene::Plane::xz ? Plane::xz : Plane::yz;
}

// The sheet stands in its plane around the origin, not yet rotated: perturbations and named borders are meant so.
void perturb_positions(TriangleMesh& mesh, const scene::SheetTable& table) {
  for (const scene::Perturbation& p : table.perturbations) {
    if (p.of_thickness)
      continue;
    if (const auto* wave = std::get_if<scene::Wave>(&p.form)) {
      displace_along_normals(mesh, wave_field(p, *wave, table));
      continue;
    }
    Random random(static_cast<std::uint64_t>(std::get<scene::Noise>(p.form).seed));
    const std::vector<Vector3d> normals = vertex_normals(mesh);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      mesh.positions[v] += random.uniform(-p.amplitude, p.amplitude) * normals[v];
  }
}

// One thickness a triangle [m].
std::vector<double> thicknesses(const TriangleMesh& mesh, const scene::SheetTable& table) {
  std::vector<double> h(mesh.triangles.size());
  if (const auto* uniform = std::get_if<double>(&table.thickness)) {
    std::fill(h.begin(), h.end(), *uniform);
  } else if (const auto* profile = std::get_if<scene::ThicknessProfile>(&table.thickness)) {
    std::ranges::transform(mesh.triangles, h.begin(), [&](const Corners& c) {
      return thickness_at((mesh.positions[c[0]] + mesh.positions[c[1]] + mesh.positions[c[2]]) / 3, *profile,
                          table.plane);
    });
  } else {
    const auto& data = std::get<scene::ThicknessData>(table.thickness);
    const std::vector<double>& values = data.per_face ? mesh.triangle_thickness : mesh.vertex_thickness;
    if (data.data != "thickness")
      fail(ExitCode::bad_input,
           "sheet.thickness: of a mesh file the array \"thickness\" alone is read, not \"{}\": name it so there, and "
           "as data here",
           data.data);
    if (values.empty())
      fail(ExitCode::bad_input,
           "sheet.thickness: the mesh file has no array \"thickness\" per {} (it is read from PLY and VTU files)",
           data.per_face ? "face" : "vertex");
    for (std::size_t t = 0; t < h.size(); ++t) {
      const auto& c = mesh.triangles[t];
      h[t] = data.scale * (data.per_face ? values[t] : (values[c[0]] + values[c[1]] + values[c[2]]) / 3);
    }
  }
  for (const scene::Perturbation& p : table.perturbations) {
    if (!p.of_thickness)
      continue;
    if (const auto* wave = std::get_if<scene::Wave>(&p.form)) {
      const HeightField field = wave_field(p, *wave, table);
      for (std::size_t t = 0; t < h.size(); ++t) {
        const auto& c = mesh.triangles[t];
        h[t] += field((mesh.positions[c[0]] + mesh.positions[c[1]] + mesh.positions[c[2]]) / 3);
      }
    } else {
      Random random(static_cast<std::uint64_t>(std::get<scene::Noise>(p.form).seed));
      for (double& thickness : h)
        thickness += random.uniform(-p.amplitude, p.amplitude);
    }
  }
  for (std::size_t t = 0; t < h.size(); ++t)
    if (!(h[t] > 0))
      fail(ExitCode::bad_input, "sheet.thickness: triangle {} gets {} m, it must be positive", t, h[t]);
  return h;
}

std::string_view name_of(scene::Border border) {
  constexpr std::array<std::string_view, 9> names{"rim",   "inner_rim", "outer_rim", "x_min", "x_max",
                                                  "y_min", "y_max",     "z_min",     "z_max"};
  return names[static_cast<std::size_t>(border)];
}

// Vertices where an array of the file is above a half.
VertexSet in_array(const TriangleMesh& mesh, const scene::ArrayRegion& region) {
  const auto array = std::ranges::find(mesh.arrays, region.array, &formats::MeshArray::name);
  if (array == mesh.arrays.end() || array->place != formats::MeshPlace::point || array->components != 1)
    fail(ExitCode::bad_input, "region: the array \"{}\" of the mesh file must have one number at each vertex",
         region.array);
  VertexSet vertices;
  for (std::uint32_t v = 0; v < array->values.size(); ++v)
    if (array->values[v] > 0.5)
      vertices.push_back(v);
  return vertices;
}

// Likewise, of the mesh's border.
VertexSet inlet_in_array(const TriangleMesh& mesh, const scene::ArrayRegion& region) {
  VertexSet vertices = in_array(mesh, region);
  if (vertices.empty())
    fail(ExitCode::bad_input, "inflow.region: the array \"{}\" is nowhere above 0.5, so nothing can flow in",
         region.array);
  const VertexSet border = rim(mesh);
  for (const std::uint32_t v : vertices)
    if (!std::ranges::binary_search(border, v))
      fail(ExitCode::bad_input,
           "inflow.region: the array \"{}\" is above 0.5 at vertex {}, which is not on the border of the sheet, where "
           "alone liquid can enter",
           region.array, v);
  return vertices;
}

// What goes along: real numbers change with the mesh, whole ones are those of the nearest.
void put_arrays(const TriangleMesh& mesh, const scene::SheetTable& table, formats::Frame& frame) {
  for (const std::string& name : table.arrays) {
    const formats::MeshArray& from = *std::ranges::find(mesh.arrays, name, &formats::MeshArray::name);
    const bool at_vertices = from.place == formats::MeshPlace::point;
    formats::Array& to = frame.put(formats::make_array(
        name, at_vertices ? formats::Place::vertex : formats::Place::triangle,
        from.whole ? formats::Type::int64 : formats::Type::float64, static_cast<std::uint32_t>(from.components), "1",
        from.whole ? formats::Transfer::copy : formats::Transfer::interpolate,
        at_vertices ? mesh.positions.size() : mesh.triangles.size()));
    if (from.whole)
      std::ranges::transform(from.values, to.values<std::int64_t>().begin(),
                             [](double x) { return static_cast<std::int64_t>(x); });
    else
      std::ranges::copy(from.values, to.values<double>().begin());
  }
}

// What the scene, or an array of the file, says [K].
void put_temperature(const TriangleMesh& mesh, const Scene& scene, const scene::SheetTable& table,
                     formats::Frame& frame) {
  std::vector<double> temperature(mesh.triangles.size(), scene.heat->temperature);
  const auto* data = table.temperature ? std::get_if<scene::TemperatureData>(&*table.temperature) : nullptr;
  if (table.temperature && data == nullptr)
    std::ranges::fill(temperature, std::get<double>(*table.temperature));
  if (data != nullptr) {
    const formats::MeshArray& from = *std::ranges::find(mesh.arrays, data->data, &formats::MeshArray::name);
    if (from.components != 1)
      fail(ExitCode::bad_input, "sheet.temperature: the array \"{}\" must have one number a vertex or face",
           data->data);
    for (std::size_t t = 0; t < temperature.size(); ++t) {
      const auto& c = mesh.triangles[t];
      temperature[t] = from.place == formats::MeshPlace::point
                           ? (from.values[c[0]] + from.values[c[1]] + from.values[c[2]]) / 3
                           : from.values[t];
      if (!(temperature[t] > 0) || !std::isfinite(temperature[t]))
        fail(ExitCode::bad_input, "sheet.temperature: triangle {} gets {} K, it must be above 0 (the array is in K)", t,
             temperature[t]);
    }
  }
  put_temperatures(temperature, frame);
}

// The borders where liquid enters.
std::vector<std::uint64_t> inlets_of(const TriangleMesh& mesh, const Scene& scene, const scene::SheetTable& table) {
  std::vector<std::uint64_t> bits(mesh.positions.size());
  for (std::size_t i = 0; i < scene.inflows.size(); ++i)
    if (&sheet_named(scene, scene.inflows[i].sheet) == &table)
      for (const std::uint32_t v :
           std::visit(Overloaded{
                          [&](scene::Border border) { return named_region(mesh, name_of(border)); },
                          [&](const scene::ArrayRegion& region) { return inlet_in_array(mesh, region); },
                      },
                      scene.inflows[i].region))
        bits[v] |= (in_inlet | at_inlet_border) << (bits_of_an_inlet * i);
  return bits;
}

// Where the inlets are.
void put_inlets(const TriangleMesh& mesh, std::span<const std::uint64_t> inlets, formats::Frame& frame) {
  std::ranges::copy(inlets, put_masks(frame, "inlet").begin());
  formats::Array& origins = frame.put(formats::make_standard_array("inlet_origin", frame.vertices));
  std::copy(mesh.positions.begin(), mesh.positions.end(), origins.values<Vector3d>().begin());
}

// Bits of all holds of a sheet whose region is a named border (borders of the undisturbed shape), or all others.
void add_holds(const TriangleMesh& mesh, const Scene& scene, const scene::SheetTable& sheet, bool borders,
               std::vector<std::uint64_t>& bits) {
  const std::vector<scene::Hold>& table = scene.holds;
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (std::holds_alternative<scene::Border>(table[i].region) != borders ||
        (!table[i].sheet.empty() && table[i].sheet != sheet.name))
      continue;
    const VertexSet held =
        std::visit(Overloaded{
                       [&](scene::Border b) { return named_region(mesh, name_of(b)); },
                       [&](const scene::BoxRegion& b) { return in_box(mesh, b.low, b.high); },
                       [&](const scene::SphereRegion& s) { return in_sphere(mesh, s.center, s.radius); },
                       [&](const scene::ArrayRegion& a) { return in_array(mesh, a); },
                   },
                   table[i].region);
    for (const std::uint32_t v : held)
      bits[v] |= std::uint64_t{1} << i;
  }
}

// How far it is from a part of space [m]; nothing of other regions.
std::optional<double> distance_to(const scene::Region& region, const Vector3d& x) {
  if (const auto* box = std::get_if<scene::BoxRegion>(&region))
    return (x - x.cwiseMax(box->low).cwiseMin(box->high)).norm();
  if (const auto* sphere = std::get_if<scene::SphereRegion>(&region))
    return std::max(0.0, (x - sphere->center).norm() - sphere->radius);
  return {};
}

// What is said of a hold that holds nothing: where the nearest vertex is of the sheets that it may hold.
std::string nearest_to(const Scene& scene, const scene::Hold& hold) {
  double nearest = std::numeric_limits<double>::infinity();
  Vector3d place = Vector3d::Zero();
  for (std::size_t i = 0; i < scene.sheets.size(); ++i) {
    if (!hold.sheet.empty() && hold.sheet != scene.sheets[i].name)
      continue;
    const formats::Frame sheet = build_sheet(scene, i, Notes::silent);
    for (const Vector3d& x : positions(sheet))
      if (const auto distance = distance_to(hold.region, x); distance && *distance < nearest) {
        nearest = *distance;
        place = x;
      }
  }
  return std::isfinite(nearest) ? fmt::format(": the nearest one, at ({:.4g}, {:.4g}, {:.4g}) m, is {:.2g} m outside",
                                              place[0], place[1], place[2], nearest)
                                : "";
}

// None where the sheet rests.
void put_velocities(const TriangleMesh& mesh, const scene::SheetTable& table, formats::Frame& frame) {
  const bool turns = table.angular_velocity != Vector3d::Zero(), opens = table.radial_velocity != 0;
  if (mesh.velocities.empty() && table.velocity == Vector3d::Zero() && !turns && !opens)
    return;
  const scene::SheetAxis axis = scene::axis_of(table);
  const std::span<Vector3d> v = velocities(frame);
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vector3d& x = mesh.positions[i];
    v[i] = table.velocity + table.angular_velocity.cross(x - table.center) +
           (mesh.velocities.empty() ? Vector3d::Zero() : mesh.velocities[i]);
    if (opens)
      v[i] += table.radial_velocity * axis.outward(x);
  }
}

void put_sheet_number(std::size_t number, formats::Frame& frame) {
  formats::Array array = formats::make_standard_array("sheet", frame.triangles);
  std::ranges::fill(array.values<std::uint32_t>(), static_cast<std::uint32_t>(number));
  frame.put(std::move(array));
}

} // namespace

formats::Frame build_sheet(const Scene& scene, std::size_t number, Notes notes) {
  const scene::SheetTable& table = scene.sheets[number];
  TriangleMesh mesh = local_mesh(scene, table, notes);
  if (!std::holds_alternative<scene::SheetMesh>(table.shape)) // a file's coordinates are taken as they are
    place_mesh(mesh, {plane_of(table.plane), Eigen::Matrix3d::Identity(), Vector3d::Zero()});
  std::vector<std::uint64_t> holds(mesh.positions.size());
  add_holds(mesh, scene, table, true, holds);
  const std::vector<std::uint64_t> inlets = inlets_of(mesh, scene, table);
  const std::vector<double> h = thicknesses(mesh, table);
  perturb_positions(mesh, table);
  place_mesh(mesh, {Plane::xy, scene::matrix(table.rotation), table.center});
  add_holds(mesh, scene, table, false, holds);

  std::vector<double> volumes(h.size());
  for (std::size_t t = 0; t < h.size(); ++t) {
    const auto& c = mesh.triangles[t];
    const Vector3d& x = mesh.positions[c[0]];
    const double area = 0.5 * (mesh.positions[c[1]] - x).cross(mesh.positions[c[2]] - x).norm();
    volumes[t] = h[t] * area;
    if (!(volumes[t] > 0))
      fail(ExitCode::bad_input, "triangle {} of the sheet has no area: repair the mesh first", t);
  }
  formats::Frame frame = make_frame(mesh.positions, mesh.triangles, volumes);
  put_velocities(mesh, table, frame);
  if (!scene.holds.empty())
    std::copy(holds.begin(), holds.end(), put_masks(frame, "hold").begin());
  if (!scene.inflows.empty())
    put_inlets(mesh, inlets, frame);
  number_enclosures(scene, table, frame);
  put_arrays(mesh, table, frame);
  if (scene.heat)
    put_temperature(mesh, scene, table, frame);
  if (scene::liquids_of(scene).size() > 1)
    scene::put_liquid(scene::liquid_of(scene, table), frame);
  if (scene.sheets.size() > 1)
    put_sheet_number(number, frame);
  scene::put_sheet_edge(scene, table, frame);
  return frame;
}

void append_sheet(const formats::Frame& sheet, formats::Frame& frame) {
  const std::uint32_t last = last_enclosure(frame);
  const std::size_t old = frame.triangles;
  append(sheet, frame);
  if (last == 0)
    return;
  const auto all = enclosures(frame);
  std::vector<std::uint32_t> numbers(all.begin(), all.end());
  for (std::size_t t = old; t < numbers.size(); ++t)
    numbers[t] += numbers[t] != 0 ? last : 0;
  put_enclosures(numbers, frame);
}

formats::Frame build_frame(const Scene& scene) {
  formats::Frame frame = build_sheet(scene, 0);
  std::uint64_t held = 0; // bits of any vertex
  const auto note_holds = [&](const formats::Frame& sheet) {
    for (const std::uint64_t bits : sheet::holds(sheet))
      held |= bits;
  };
  note_holds(frame);
  for (std::size_t i = 1; i < scene.sheets.size(); ++i) {
    const formats::Frame sheet = build_sheet(scene, i);
    note_holds(sheet);
    if (!scene.sheets[i].enters)
      append_sheet(sheet, frame);
  }
  for (std::size_t i = 0; i < scene.holds.size(); ++i)
    if ((held >> i & 1) == 0 && !scene.holds[i].roll)
      fail(ExitCode::bad_input, "[[hold]] number {} (from 0): no vertex lies in its region{}", i,
           nearest_to(scene, scene.holds[i]));
  frame.put_text("scene", to_toml(scene));
  return frame;
}

} // namespace sheet
