// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/export_files.h"

#include <filesystem>
#include <vector>

#include "formats/cpp/stream_reader.h"
#include "libsheet/base/error.h"
#include "libsheet/base/files.h"
#include "libsheet/base/log.h"
#include "libsheet/base/numbered_name.h"
#include "libsheet/base/whole_file.h"
#include "libsheet/shape/export.h"

namespace sheet {

namespace {

void write_file(const std::string& path, const std::string& bytes) {
  write_whole_file(path, [&](OutputFile& file) { file.write(bytes); });
}

formats::MeshFormat format_by_name(const std::string& name) {
  const auto format = formats::mesh_format_of(name);
  if (!format)
    fail(ExitCode::usage, "-o {}: the name must end in .vtu, .ply, .obj, .off or .stl, or give --format", name);
  return *format;
}

} // namespace

void export_frames(const ExportOptions& o) {
  if (o.output.empty())
    fail(ExitCode::usage, "give -o FILE, such as -o out/frame_%04d.vtu");
  const formats::MeshFormat format = o.format ? *o.format : format_by_name(o.output);
  const NumberedName name(o.output);
  const InputFile in(o.input);
  formats::StreamReader reader(in.descriptor(), in.name());
  formats::Frame frame;
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
    write_file(path, encode_mesh(o.solidify ? to_solid_mesh(frame) : to_foreign_mesh(frame), format));
    collection.push_back({frame.time, std::filesystem::path(path).filename().string()});
  }
  if (reader.frames() == 0)
    log::warning("{} has no frames: nothing is written", in.name());
  else if (name.has_number() && format == formats::MeshFormat::vtu)
    write_file(name.collection(".pvd"), formats::encode_pvd(collection));
}

} // namespace sheet
