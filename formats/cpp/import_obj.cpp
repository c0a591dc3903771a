// SPDX-License-Identifier: MIT
// Wavefront OBJ: lines "v x y z" and "f a b c ..." with a = index, index/texture, index//normal or all three; indices
// count from 1, negative ones backwards from the latest vertex. Everything else does not concern a sheet.
#include <set>

#include "formats/cpp/mesh_assembler.h"
#include "formats/cpp/text_scan.h"

namespace sheet::formats {

namespace {

struct FaceList { // faces may name vertices that come later in the file, so they wait here
  std::vector<std::int64_t> corners;
  std::vector<std::size_t> ends;
  std::vector<std::uint64_t> lines;
};

void read_face(TextScan& text, std::size_t points_so_far, FaceList& faces) {
  for (std::string_view word = text.word(); !word.empty(); word = text.word()) {
    const std::string_view vertex = word.substr(0, word.find('/'));
    const std::optional<std::int64_t> index = parse_integer(vertex);
    if (!index || *index == 0)
      text.fail("vertex index " + quoted(word) + " is not a whole number from 1 up or from -1 down");
    if (*index < 0 && static_cast<std::uint64_t>(-(*index + 1)) >= points_so_far)
      text.fail("vertex index " + quoted(word) + " reaches back before the first vertex");
    faces.corners.push_back(*index > 0 ? *index - 1 : static_cast<std::int64_t>(points_so_far) + *index);
  }
  faces.ends.push_back(faces.corners.size());
  faces.lines.push_back(text.line());
}

} // namespace

MeshImport import_obj(std::string_view bytes, const std::string& name) {
  static const std::set<std::string_view> harmless = {"vn", "vt",     "vp",     "g",  "o",
                                                      "s",  "usemtl", "mtllib", "mg", "usemap"};
  TextScan text(bytes, name, '#', TextScan::Continuation::backslash);
  MeshAssembler mesh(name, "line");
  FaceList faces;
  std::size_t passed_over = 0;
  std::string first_passed_over;
  while (text.next_filled_line()) {
    const std::string_view keyword = text.word();
    if (keyword == "v") {
      std::array<double, 3> point{};
      for (double& x : point)
        x = text.real("a coordinate");
      mesh.points.push_back(point);
    } else if (keyword == "f" || keyword == "fo") {
      read_face(text, mesh.points.size(), faces);
    } else if (keyword.find('\0') != keyword.npos) {
      text.fail("binary data; OBJ is a text format");
    } else if (!harmless.contains(keyword) && passed_over++ == 0) {
      first_passed_over = quoted(keyword) + " in line " + std::to_string(text.line());
    }
  }
  if (passed_over > 0)
    mesh.note(std::to_string(passed_over) +
              " lines that are no vertices and no faces passed over (first: " + first_passed_over + ")");
  std::size_t start = 0;
  for (std::size_t f = 0; f < faces.ends.size(); ++f) {
    mesh.add_face(std::span(faces.corners).subspan(start, faces.ends[f] - start), faces.lines[f], 1);
    start = faces.ends[f];
  }
  return std::move(mesh).finish({});
}

} // namespace sheet::formats
