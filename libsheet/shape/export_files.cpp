// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/export_files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>
#include <vector>

#include "formats/cpp/mesh_export.h"
#include "formats/cpp/stream_reader.h"
#include "libsheet/base/error.h"
#include "libsheet/base/files.h"
#include "libsheet/base/frame_files.h"
#include "libsheet/base/log.h"
#include "libsheet/base/whole_file.h"
#include "libsheet/scene/frame_scene.h"
#include "libsheet/shape/export.h"
#include "libsheet/shape/gltf.h"
#include "libsheet/shape/seam_texture.h"
#include "libsheet/sheet/drop_shells.h"
#include "libsheet/sheet/drops.h"

namespace sheet {

namespace {

void write_file(const std::string& path, const std::string& bytes) {
  write_whole_file(path, [&](OutputFile& file) { file.write(bytes); });
}

ExportFormat format_by_name(const std::string& name) {
  std::string lower = name;
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
  const std::vector<std::pair<const char*, ExportFormat>> endings = {
      {".vtu", ExportFormat::vtu}, {".ply", ExportFormat::ply}, {".obj", ExportFormat::obj},
      {".off", ExportFormat::off}, {".stl", ExportFormat::stl}, {".glb", ExportFormat::glb},
      {".vdb", ExportFormat::vdb}};
  for (const auto& [ending, format] : endings)
    if (lower.ends_with(ending))
      return format;
  fail(ExitCode::usage, "-o {}: the name must end in .vtu, .ply, .obj, .off, .stl, .glb or .vdb, or give --format",
       name);
}

// scene: null if there is none, or it does not matter.
std::string encode(formats::ForeignMesh mesh, ExportFormat format, const Scene* scene, SeamTextures& textures) {
  if (scene != nullptr)
    textures.add(*scene, mesh);
  switch (format) {
  case ExportFormat::vtu:
    return encode_vtu(mesh);
  case ExportFormat::ply:
    return encode_ply(mesh);
  case ExportFormat::obj:
    if (mesh.texture() || mesh.corner_texture()) // a textured surface is to be drawn smooth
      add_normals(mesh);
    else
      std::erase_if(mesh.arrays, [](const formats::MeshArray& array) { return array.name == "normal"; });
    return encode_obj(mesh);
  case ExportFormat::off:
    return encode_off(mesh);
  case ExportFormat::stl:
    return encode_stl(mesh);
  case ExportFormat::glb:
  case ExportFormat::vdb: // no mesh
    break;
  }
  const std::optional<Eigen::Vector3d> upwards = scene != nullptr ? up(scene->environment) : std::nullopt;
  return encode_gltf(mesh, upwards.value_or(Eigen::Vector3d::UnitY()));
}

// Whether what is written depends on the scene: by what is up, or by texture coordinates with seams.
bool needs_scene(ExportFormat format, const formats::Frame& frame) {
  const auto is_rest = [](const formats::Array& array) {
    return array.name == "rest" || array.name.ends_with(".rest");
  };
  return format == ExportFormat::glb ||
         (format != ExportFormat::stl && format != ExportFormat::off && std::ranges::any_of(frame.arrays, is_rest));
}

// What contradicts itself.
void check(const ExportOptions& o, ExportFormat format) {
  if (o.unite && o.solidify)
    fail(ExitCode::usage, "--union and --solidify are two surfaces: give one of them (--union makes one body of layers "
                          "that touch)");
  if (o.unite)
    return;
  for (const auto& [name, given] :
       {std::pair("--voxel", o.body.voxel.has_value()), std::pair("--close", o.body.close.has_value()),
        std::pair("--keep-voids", o.body.keep_voids)})
    if (given)
      fail(ExitCode::usage, "{} says how to unite layers: give --union with it", name);
  if (format == ExportFormat::vdb)
    fail(ExitCode::usage, "{}: a level set (.vdb) is made of a closed surface: give --union with it", o.output);
}

// Tells, with -v, what was done, and always what is not as it was asked for.
void tell(const std::string& path, const solid::SlabUnion& body, const solid::UnionOptions& options) {
  if (!body.volume_reached)
    log::warning(
        "{}: the surface does not hold the liquid's volume: layers lie in each other too deep, or are too thin "
        "for voxels of {:.3g} m; the union of the layers holds {:.1f} % of it",
        path, options.voxel, 100 * body.union_volume / options.volume);
  const auto& s = body.seconds;
  log::detail(
      "{}: {} voxels of {:.3g} m; closing {:.3g} m; the union holds {:.2f} % of the volume; shifted by {:.3g} m; "
      "{} voids filled, {:.3g} m^3 of air; {} points; seconds: field {:.2f}, closing {:.2f}, volume "
      "{:.2f}, mesh {:.2f}, origins {:.2f}, level set {:.2f}",
      path, body.voxels, options.voxel, options.close, 100 * body.union_volume / options.volume, body.shift, body.voids,
      body.air, body.surface.points.size(), s.field, s.closing, s.volume, s.mesh, s.origins, s.level_set);
}

// Frames as bodies of one piece.
class Uniting {
public:
  Uniting(const ExportOptions& o, ExportFormat format) : settings_(o.body), format_(format) {
    settings_.level_set = format == ExportFormat::vdb;
  }

  std::string operator()(const formats::Frame& frame, const std::string& path, const Scene* scene,
                         SeamTextures& textures) {
    const ChosenUnion chosen = choose_union(frame, settings_);
    if (!told_ && chosen.options.voxel > chosen.wanted_voxel) {
      log::warning(
          "{}: voxels of {:.3g} m rather than {:.3g} m, a quarter of the thinnest 5 %, so that they are no more "
          "than {:.0e}; --voxel LENGTH chooses",
          path, chosen.options.voxel, chosen.wanted_voxel, most_voxels);
      told_ = true;
    }
    solid::SlabUnion body = unite_layers(frame, chosen.options);
    tell(path, body, chosen.options);
    return settings_.level_set ? std::move(body.level_set) : encode(union_mesh(frame, body), format_, scene, textures);
  }

private:
  UnionSettings settings_;
  ExportFormat format_;
  bool told_ = false;
};

} // namespace

void export_frames(const ExportOptions& o) {
  if (o.output.empty())
    fail(ExitCode::usage, "give -o FILE, such as -o out/frame_%04d.vtu");
  const ExportFormat format = o.format ? *o.format : format_by_name(o.output);
  check(o, format);
  Uniting united(o, format);
  FrameFiles files(o.output, "sheet-select");
  const InputFile in(o.input);
  formats::StreamReader reader(in.descriptor(), in.name());
  formats::Frame frame;
  FrameScene scenes;
  SeamTextures textures;
  std::vector<formats::PvdEntry> collection;
  const auto finish = [&] {
    files.finish();
    if (!collection.empty() && files.names().has_number() && format == ExportFormat::vtu)
      write_file(files.names().collection(".pvd"), formats::encode_pvd(collection));
  };
  try {
    while (reader.read(frame)) {
      const std::string path = files.next(reader.frames() - 1);
      const Scene* const scene = needs_scene(format, frame) ? scenes.find(frame) : nullptr;
      if (knows_drops(frame))
        frame = with_drop_shells(frame);
      files.write(o.unite
                      ? united(frame, path, scene, textures)
                      : encode(o.solidify ? to_solid_mesh(frame) : to_foreign_mesh(frame), format, scene, textures));
      collection.push_back({frame.time, std::filesystem::path(path).filename().string()});
    }
  } catch (const formats::StreamError&) { // of a run that has failed: what is whole is exported
    finish();
    throw;
  }
  if (reader.frames() == 0)
    log::warning("{} has no frames: nothing is written", in.name());
  finish();
}

} // namespace sheet
