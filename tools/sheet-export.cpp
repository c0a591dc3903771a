// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-export: frames as mesh files for other programs.
#include "libsheet/base/tool.h"
#include "libsheet/shape/export_files.h"

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-export", "write frames as mesh files for other programs",
      "Writes VTU (ParaView), PLY, OBJ, OFF, STL or glTF (.glb) files. VTU and PLY carry the thickness, per triangle "
      "(volume divided by area) and per vertex (the mean around it, weighted by area), and every array of "
      "numbers at vertices and triangles; an array that is called thickness itself becomes thickness.array, integers "
      "beyond 2^53 become two arrays NAME.low32 and NAME.high32. VTU files say their time. Debian's meshio cannot read "
      "a PLY file with properties of faces: give it VTU.\n"
      "glTF has single precision, up as +y, the thickness at vertices as _THICKNESS and as u of the texture "
      "coordinates [m], and the time in the scene's extras.\n"
      "Numbered VTU files get a collection beside them, frame.pvd for frame_%04d.vtu, which holds the times.");
  using sheet::ExportFormat;
  sheet::ExportOptions o;
  tool.argument("INPUT", o.input, "stream to read; - for standard input");
  tool.option(
      "-o,--output", o.output, "FILE",
      "file to write; %d or %04d in its name stands for the frame's number in the stream; - for standard output. "
      "Its folder is made if it is missing");
  tool.choice("--format", o.format,
              {{"auto", std::nullopt},
               {"vtu", ExportFormat::vtu},
               {"ply", ExportFormat::ply},
               {"obj", ExportFormat::obj},
               {"off", ExportFormat::off},
               {"stl", ExportFormat::stl},
               {"glb", ExportFormat::glb}},
              "format of the files; auto goes by the ending of their name");
  tool.flag(
      "--solidify", o.solidify,
      "write the closed outer surface of the liquid, half the thickness to either side, instead of the mid-surface");
  tool.example("sheet-export run.sheet -o out/frame_%04d.vtu && paraview out/frame.pvd", "a film for ParaView");
  tool.example("sheet-export run.sheet -o out/frame_%04d.glb", "models for browsers");
  tool.example("sheet-select --last run.sheet | sheet-export --solidify -o end.stl", "the end, to print in plastic");
  return tool.run(argc, argv, [&] { sheet::export_frames(o); });
}
