// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-export: frames as mesh files for other programs.
#include <cmath>
#include <optional>
#include <string>

#include "libsheet/base/error.h"
#include "libsheet/base/tool.h"
#include "libsheet/base/units.h"
#include "libsheet/shape/export_files.h"

namespace {

// A length above zero, or not below it.
void length_option(sheet::Tool& tool, const char* name, std::optional<double>& value, bool zero, const char* text) {
  tool.custom(
      name, "LENGTH", text,
      [&value, zero](const std::string& s) {
        const double length = sheet::parse_quantity(s, sheet::quantity::length);
        if (!(std::isfinite(length) && (length > 0 || (zero && length == 0))))
          sheet::fail(sheet::ExitCode::usage, "\"{}\": a length {}, such as 0.3mm, is wanted", s,
                      zero ? "of 0 or more" : "above 0");
        value = length;
      },
      [&value] { return value ? sheet::shortest(*value) : std::string(); });
}

} // namespace

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-export", "write frames as mesh files for other programs",
      "Writes VTU (ParaView), PLY, OBJ, OFF, STL or glTF (.glb) files, or level sets (.vdb). VTU and PLY carry the "
      "thickness, per triangle "
      "(volume divided by area) and per vertex (the mean around it, weighted by area), and every array of "
      "numbers at vertices and triangles; an array that is called thickness itself becomes thickness.array, integers "
      "beyond 2^53 become two arrays NAME.low32 and NAME.high32. VTU files say their time. Debian's meshio cannot read "
      "a PLY file with properties of faces: give it VTU.\n"
      "An array of two components at vertices called uv, or NAME.uv, is the texture coordinates: OBJ files then have "
      "vt, "
      "and vn for smooth light, glTF has them first. Those with seams are found in the mesh file of the scene, "
      "as NAME.corner_uv of its faces, where the frame has NAME.rest.\n"
      "glTF has single precision, up as +y, the thickness at vertices as _THICKNESS and as u of texture "
      "coordinates [m] (the second ones of a sheet with uv), and the time in the scene's extras.\n"
      "Of --union, .vdb has a level set in metres, named surface, which Houdini and other programs with OpenVDB read; "
      "meshes have the arrays of the sheet's nearest point, sums such as the volume left out. What is thinner than a "
      "voxel gets holes. Solids are not cut out. For a film give both --voxel and --close: what is chosen for each "
      "frame changes with it.\n"
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
               {"glb", ExportFormat::glb},
               {"vdb", ExportFormat::vdb}},
              "format of the files; auto goes by the ending of their name");
  tool.flag(
      "--solidify", o.solidify,
      "write the closed outer surface of the liquid, half the thickness to either side, instead of the mid-surface");
  tool.flag(
      "--union", o.unite,
      "write the outer surface of all layers as one closed body that holds the liquid's volume: layers that touch "
      "become one, however they cross, and gaps between them are closed");
  length_option(tool, "--voxel", o.body.voxel, false,
                "of --union: size of the voxels that the surface is found on; if not given a quarter of the thickness "
                "that 5 % of the sheet are thinner than, or more, so that there are no more than 5e7 voxels");
  length_option(
      tool, "--close", o.body.close, true,
      "of --union: gaps narrower than twice this are closed, 0 for none; if not given a quarter of the median "
      "thickness");
  tool.flag("--keep-voids", o.body.keep_voids, "of --union: also the surfaces of air that is enclosed by liquid");
  tool.example("sheet-export run.sheet -o out/frame_%04d.vtu && paraview out/frame.pvd", "a film for ParaView");
  tool.example("sheet-export run.sheet -o out/frame_%04d.glb", "models for browsers");
  tool.example("sheet-select --last run.sheet | sheet-export --solidify -o end.stl", "the end, to print in plastic");
  tool.example("sheet-export --union run.sheet -o out/frame_%04d.ply", "one body a frame, for renderers");
  return tool.run(argc, argv, [&] { sheet::export_frames(o); });
}
