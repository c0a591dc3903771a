// SPDX-License-Identifier: MIT
// Geomview OFF: "OFF", the counts of vertices, faces and edges, then a line a vertex (x y z and whatever follows), then
// a line a face (number of corners, indices from 0, and whatever follows).
#include "formats/cpp/mesh_assembler.h"
#include "formats/cpp/text_scan.h"

namespace sheet::formats {

namespace {

// Takes the keyword with the letters before it that tell of normals, colours and texture coordinates.
void read_keyword(TextScan& text) {
  const std::string_view keyword = text.word();
  if (keyword.size() < 3 || keyword.size() > 8 || keyword.substr(keyword.size() - 3) != "OFF")
    text.fail("an OFF file starts with OFF, not with " + quoted(keyword));
  const std::string_view prefix = keyword.substr(0, keyword.size() - 3);
  if (prefix.find_first_not_of("STCN") != prefix.npos)
    text.fail(quoted(keyword) + " means points that are not three-dimensional; save the mesh as plain OFF");
}

std::uint64_t read_count(TextScan& text, std::string_view word, const char* what, std::size_t bytes_each) {
  const std::optional<std::int64_t> count = parse_integer(word);
  if (!count || *count < 0)
    text.fail(std::string("the number of ") + what + " is " + (word.empty() ? "missing" : "wrong: " + quoted(word)));
  if (static_cast<std::uint64_t>(*count) > (text.bytes_left() + 1) / bytes_each)
    text.fail("the file claims " + std::to_string(*count) + " " + what + " but is too short for them");
  return static_cast<std::uint64_t>(*count);
}

} // namespace

MeshImport import_off(std::string_view bytes, const std::string& name) {
  TextScan text(bytes, name, '#');
  if (!text.next_filled_line())
    mesh_fail(name, "", "the file is empty");
  read_keyword(text);
  std::string_view word = text.word();
  if (word == "BINARY")
    text.fail("binary OFF is not supported; save the mesh as ASCII OFF or PLY");
  if (word.empty() && text.next_filled_line())
    word = text.word();
  const std::uint64_t point_count = read_count(text, word, "vertices", 6); // "0 0 0\n" is the shortest
  const std::uint64_t face_count = read_count(text, text.word(), "faces", 2);

  MeshAssembler mesh(name, "line");
  mesh.points.resize(point_count);
  for (std::uint64_t i = 0; i < point_count; ++i) {
    if (!text.next_filled_line())
      text.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(point_count) + " vertices");
    for (double& x : mesh.points[i])
      x = text.real("a coordinate");
  }
  std::vector<std::int64_t> corners;
  for (std::uint64_t i = 0; i < face_count; ++i) {
    if (!text.next_filled_line())
      text.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(face_count) + " faces");
    const std::int64_t n = text.integer("the number of corners");
    if (n < 0)
      text.fail("the number of corners is negative");
    corners.clear();
    for (std::int64_t k = 0; k < n; ++k)
      corners.push_back(text.integer("a vertex index"));
    mesh.add_face(corners, text.line());
  }
  if (text.next_filled_line())
    mesh.note("line " + std::to_string(text.line()) + " and what follows the last face passed over");
  return std::move(mesh).finish({});
}

} // namespace sheet::formats
