// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-export: frames as mesh files for other programs.
#include <filesystem>

#include "formats/cpp/mesh_export.h"
#include "formats/cpp/stream_reader.h"
#include "libsheet/base/files.h"
#include "libsheet/base/log.h"
#include "libsheet/base/numbered_name.h"
#include "libsheet/base/tool.h"
#include "libsheet/base/whole_file.h"
#include "libsheet/shape/export.h"

namespace {

using sheet::formats::MeshFormat;

void write_file(const std::string& path, const std::string& bytes) {
  sheet::write_whole_file(path, [&](sheet::OutputFile& file) { file.write(bytes); });
}

struct Options {
  std::string input = "-", output;
  std::size_t format = 0; // by the name's ending, then as in the declaration
  bool solidify = false;
};

MeshFormat format_of(const Options& o) {
  constexpr std::array formats{MeshFormat::vtu, MeshFormat::ply, MeshFormat::obj, MeshFormat::off, MeshFormat::stl};
  if (o.format > 0)
    return formats[o.format - 1];
  const auto format = sheet::formats::mesh_format_of(o.output);
  if (!format)
    sheet::fail(sheet::ExitCode::usage, "-o {}: the name must end in .vtu, .ply, .obj, .off or .stl, or give --format",
                o.output);
  return *format;
}

void export_frames(const Options& o) {
  if (o.output.empty())
    sheet::fail(sheet::ExitCode::usage, "give -o FILE, such as -o out/frame_%04d.vtu");
  const MeshFormat format = format_of(o);
  const sheet::NumberedName name(o.output);
  const sheet::InputFile in(o.input);
  sheet::formats::StreamReader reader(in.descriptor(), in.name());
  sheet::formats::Frame frame;
  std::vector<sheet::formats::PvdEntry> collection;
  sheet::make_folder_of(name.of(0));
  while (reader.read(frame)) {
    const std::uint64_t index = reader.frames() - 1;
    if (index > 0 && !name.has_number())
      sheet::fail(sheet::ExitCode::usage,
                  "{} has several frames and -o names one file: number them, as in frame_%04d.vtu, or pick one with "
                  "sheet-select",
                  in.name());
    const std::string path = name.of(index);
    write_file(path, encode_mesh(o.solidify ? sheet::to_solid_mesh(frame) : sheet::to_foreign_mesh(frame), format));
    collection.push_back({frame.time, std::filesystem::path(path).filename().string()});
  }
  if (reader.frames() == 0)
    sheet::log::warning("{} has no frames: nothing is written", in.name());
  else if (name.has_number() && format == MeshFormat::vtu)
    write_file(name.collection(".pvd"), sheet::formats::encode_pvd(collection));
}

} // namespace

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-export", "write frames as mesh files for other programs",
      "Writes VTU (ParaView), PLY, OBJ, OFF or STL files. VTU and PLY carry the thickness, per triangle "
      "(volume divided by area) and per vertex (the mean around it, weighted by area), and every array of "
      "numbers at vertices and triangles; an array that is called thickness itself becomes thickness.array, integers "
      "beyond 2^53 become two arrays NAME.low32 and NAME.high32. VTU files say their time. Debian's meshio cannot read "
      "a PLY file with properties of faces: give it VTU.\n"
      "Numbered VTU files get a collection beside them, frame.pvd for frame_%04d.vtu, which holds the times.");
  Options o;
  tool.argument("INPUT", o.input, "stream to read; - for standard input");
  tool.option(
      "-o,--output", o.output, "FILE",
      "file to write; %d or %04d in its name stands for the frame's number in the stream; - for standard output. "
      "Its folder is made if it is missing");
  tool.choice("--format", o.format, {"auto", "vtu", "ply", "obj", "off", "stl"},
              "format of the files; auto goes by the ending of their name");
  tool.flag(
      "--solidify", o.solidify,
      "write the closed outer surface of the liquid, half the thickness to either side, instead of the mid-surface");
  tool.example("sheet-export run.sheet -o out/frame_%04d.vtu && paraview out/frame.pvd", "a film for ParaView");
  tool.example("sheet-select --last run.sheet | sheet-export --solidify -o end.stl", "the end, to print in plastic");
  return tool.run(argc, argv, [&] { export_frames(o); });
}
