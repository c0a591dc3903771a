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
#include "libsheet/base/log.h"
#include "libsheet/base/numbered_name.h"
#include "libsheet/base/whole_file.h"
#include "libsheet/scene/frame_scene.h"
#include "libsheet/shape/export.h"
#include "libsheet/shape/gltf.h"

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
      {".off", ExportFormat::off}, {".stl", ExportFormat::stl}, {".glb", ExportFormat::glb}};
  for (const auto& [ending, format] : endings)
    if (lower.ends_with(ending))
      return format;
  fail(ExitCode::usage, "-o {}: the name must end in .vtu, .ply, .obj, .off, .stl or .glb, or give --format", name);
}

std::string encode(const formats::ForeignMesh& mesh, ExportFormat format, const Scene* scene) {
  switch (format) {
  case ExportFormat::vtu:
    return encode_vtu(mesh);
  case ExportFormat::ply:
    return encode_ply(mesh);
  case ExportFormat::obj:
    return encode_obj(mesh);
  case ExportFormat::off:
    return encode_off(mesh);
  case ExportFormat::stl:
    return encode_stl(mesh);
  case ExportFormat::glb:
    break;
  }
  const std::optional<Eigen::Vector3d> upwards = scene != nullptr ? up(scene->environment) : std::nullopt;
  return encode_gltf(mesh, upwards.value_or(Eigen::Vector3d::UnitY()));
}

} // namespace

void export_frames(const ExportOptions& o) {
  if (o.output.empty())
    fail(ExitCode::usage, "give -o FILE, such as -o out/frame_%04d.vtu");
  const ExportFormat format = o.format ? *o.format : format_by_name(o.output);
  const NumberedName name(o.output);
  const InputFile in(o.input);
  formats::StreamReader reader(in.descriptor(), in.name());
  formats::Frame frame;
  FrameScene scenes;
  std::vector<formats::PvdEntry> collection;
  make_folder_of(name.of(0));
  while (reader.read(frame)) {
    const std::uint64_t index = reader.frames() - 1;
    if (index > 0 && !name.has_number())
      fail(ExitCode::usage,
           "{} has several frames and -o names one file: number them, as in frame_%04d.vtu, or pick one with "
           "sheet-select",
           in.name());
    const std::string path = name.of(index);
    const Scene* const scene = format == ExportFormat::glb ? scenes.find(frame) : nullptr;
    write_file(path, encode(o.solidify ? to_solid_mesh(frame) : to_foreign_mesh(frame), format, scene));
    collection.push_back({frame.time, std::filesystem::path(path).filename().string()});
  }
  if (reader.frames() == 0)
    log::warning("{} has no frames: nothing is written", in.name());
  else if (name.has_number() && format == ExportFormat::vtu)
    write_file(name.collection(".pvd"), formats::encode_pvd(collection));
}

} // namespace sheet
