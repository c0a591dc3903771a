// SPDX-License-Identifier: MIT
// VTK's XML unstructured grid (.vtu): the cells that are surfaces; several pieces become one mesh.
#include <cmath>

#include "formats/cpp/mesh_assembler.h"
#include "formats/cpp/text_scan.h"
#include "formats/cpp/vtu_data.h"
#include "formats/cpp/xml_scan.h"

namespace sheet::formats {

namespace {

constexpr const char* how_to_convert = "save it uncompressed: in ParaView 'Compressor Type: None', or in Python "
                                       "meshio.write(name, mesh, compression=None)";

struct Piece {
  std::uint64_t points = 0, cells = 0;
  std::size_t start = 0;
  std::optional<VtuDeclaration> coordinates, connectivity, offsets, types;
  std::array<std::optional<VtuDeclaration>, 2> thickness, velocity; // of points, of cells
};

enum class Section { none, points, cells, point_data, cell_data };

std::optional<NumberType> vtu_number_type(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, NumberType>, 10> names = {{{"Int8", NumberType::i8},
                                                                              {"UInt8", NumberType::u8},
                                                                              {"Int16", NumberType::i16},
                                                                              {"UInt16", NumberType::u16},
                                                                              {"Int32", NumberType::i32},
                                                                              {"UInt32", NumberType::u32},
                                                                              {"Int64", NumberType::i64},
                                                                              {"UInt64", NumberType::u64},
                                                                              {"Float32", NumberType::f32},
                                                                              {"Float64", NumberType::f64}}};
  for (const auto& [text, type] : names)
    if (text == name)
      return type;
  return std::nullopt;
}

class Reader {
public:
  Reader(std::string_view bytes, const std::string& name) : file_(name), xml_(bytes, name), mesh_(name, "cell") {
    data_.file = name;
    data_.budget = 2 * bytes.size();
  }

  MeshImport read() {
    read_tags();
    if (pieces_.empty())
      mesh_fail(file_, "", "the file has no <Piece>; it was cut short or is empty");
    for (std::size_t place = 0; place < 2; ++place) { // an array counts only if all pieces with cells have it
      const auto all = [&](auto member) {
        for (const Piece& piece : pieces_)
          if (!(piece.*member)[place] && piece.cells > 0)
            return false;
        return true;
      };
      with_thickness_[place] = all(&Piece::thickness);
      with_velocity_[place] = all(&Piece::velocity);
    }
    for (const Piece& piece : pieces_)
      if (piece.cells > 0)
        read_piece(piece);
    if (other_cells_ > 0)
      mesh_.note(std::to_string(other_cells_) + " cells that are points or lines passed over");
    std::vector<MeshArray> arrays;
    for (std::size_t place = 0; place < 2; ++place) {
      const MeshPlace where = place == 0 ? MeshPlace::point : MeshPlace::cell;
      if (with_thickness_[place])
        arrays.push_back({"thickness", where, 1, std::move(thickness_[place])});
      if (with_velocity_[place])
        arrays.push_back({"velocity", where, 3, std::move(velocity_[place])});
    }
    return std::move(mesh_).finish(std::move(arrays));
  }

private:
  [[noreturn]] void fail(std::size_t at, const std::string& problem) const {
    mesh_fail(file_, "byte " + std::to_string(at), problem);
  }

  std::uint64_t count(const XmlTag& tag, std::string_view key, std::string_view otherwise) const {
    const std::string_view text = tag.attribute(key, otherwise);
    const std::optional<std::int64_t> value = parse_integer(text);
    if (!value || *value < 0)
      fail(tag.start, "attribute " + quoted(key) + " is not a count: " + quoted(text));
    return static_cast<std::uint64_t>(*value);
  }

  void read_tags() {
    XmlTag tag;
    bool is_vtu = false;
    Section section = Section::none;
    while (xml_.next(tag)) {
      if (tag.name == "VTKFile" && !tag.closing) {
        read_root(tag);
        is_vtu = true;
      } else if (!is_vtu) {
        fail(tag.start,
             "the file starts with tag " + quoted(tag.name) + ", not with <VTKFile type=\"UnstructuredGrid\">");
      } else if (tag.name == "Piece" && !tag.closing) {
        pieces_.emplace_back();
        pieces_.back().start = tag.start;
        pieces_.back().points = count(tag, "NumberOfPoints", "");
        pieces_.back().cells = count(tag, "NumberOfCells", "");
        section = Section::none;
      } else if (tag.name == "AppendedData" && !tag.closing) {
        if (read_appended(tag))
          return; // what follows raw data is not XML
      } else if (tag.name == "DataArray" && !tag.closing) {
        read_declaration(tag, section);
      } else {
        section = section_of(tag, section);
      }
    }
    if (!is_vtu)
      mesh_fail(file_, "", "no <VTKFile> found; is it a VTU file?");
  }

  static Section section_of(const XmlTag& tag, Section now) {
    constexpr std::array<std::pair<std::string_view, Section>, 4> names = {{{"Points", Section::points},
                                                                            {"Cells", Section::cells},
                                                                            {"PointData", Section::point_data},
                                                                            {"CellData", Section::cell_data}}};
    for (const auto& [name, section] : names)
      if (name == tag.name)
        return tag.closing || tag.self_closed ? Section::none : section;
    return now;
  }

  void read_root(const XmlTag& tag) {
    if (const std::string_view type = tag.attribute("type"); type != "UnstructuredGrid")
      fail(tag.start, "VTK file of type " + quoted(type) + "; only UnstructuredGrid is read");
    if (const std::string_view compressor = tag.attribute("compressor"); !compressor.empty())
      fail(tag.start, "the data are compressed (" + quoted(compressor) + "); " + how_to_convert);
    const std::string_view order = tag.attribute("byte_order", "LittleEndian");
    if (order != "LittleEndian" && order != "BigEndian")
      fail(tag.start, "unknown byte order " + quoted(order));
    data_.order = order == "BigEndian" ? ByteOrder::big : ByteOrder::little;
    const std::string_view header = tag.attribute("header_type", "UInt32");
    if (header != "UInt32" && header != "UInt64")
      fail(tag.start, "unknown header_type " + quoted(header));
    data_.length_bytes = header == "UInt64" ? 8 : 4;
  }

  // True if the data are raw.
  bool read_appended(const XmlTag& tag) {
    const std::string_view encoding = tag.attribute("encoding", "raw");
    if (encoding != "raw" && encoding != "base64")
      fail(tag.start, "unknown encoding of appended data " + quoted(encoding));
    data_.appended_is_base64 = encoding == "base64";
    const std::string_view rest = data_.appended_is_base64 ? xml_.text_here() : xml_.rest();
    const std::size_t underscore = rest.find_first_not_of(" \t\r\n");
    if (underscore == rest.npos || rest[underscore] != '_')
      fail(tag.start, "appended data must start with an underscore");
    data_.appended = rest.substr(underscore + 1);
    return !data_.appended_is_base64;
  }

  void read_declaration(const XmlTag& tag, Section section) {
    if (section == Section::none || pieces_.empty())
      return;
    const std::string_view name = tag.attribute("Name");
    Piece& piece = pieces_.back();
    std::optional<VtuDeclaration>* target = nullptr;
    if (section == Section::points)
      target = &piece.coordinates;
    else if (section == Section::cells)
      target = name == "connectivity" ? &piece.connectivity
               : name == "offsets"    ? &piece.offsets
               : name == "types"      ? &piece.types
                                      : nullptr;
    else if (name == "thickness")
      target = &piece.thickness[section == Section::cell_data ? 1 : 0];
    else if (name == "velocity")
      target = &piece.velocity[section == Section::cell_data ? 1 : 0];
    if (!target)
      return;
    VtuDeclaration array;
    array.name = name.empty() ? "Points" : name;
    array.start = tag.start;
    const std::optional<NumberType> type = vtu_number_type(tag.attribute("type"));
    if (!type)
      fail(tag.start, "array " + quoted(array.name) + " has the unknown type " + quoted(tag.attribute("type")));
    array.type = *type;
    array.components = count(tag, "NumberOfComponents", "1");
    const std::string_view format = tag.attribute("format", "ascii");
    if (format == "appended") {
      array.encoding = VtuEncoding::appended;
      array.offset = count(tag, "offset", "");
    } else if (format == "ascii" || format == "binary") {
      array.encoding = format == "ascii" ? VtuEncoding::ascii : VtuEncoding::base64;
      if (!tag.self_closed)
        array.inline_text = xml_.text_here();
    } else {
      fail(tag.start, "array " + quoted(array.name) + " has the unknown format " + quoted(format));
    }
    *target = std::move(array);
  }

  void expect_size(const VtuDeclaration& array, std::uint64_t tuples, std::uint64_t components,
                   std::size_t values) const {
    if (array.components != components || values % components != 0 || values / components != tuples)
      fail(array.start, "array " + quoted(array.name) + " has " + std::to_string(values) + " values in tuples of " +
                            std::to_string(array.components) + "; expected " + std::to_string(tuples) + " tuples of " +
                            std::to_string(components));
  }

  void append_array(const Piece& piece, const std::optional<VtuDeclaration>& array, bool of_cells,
                    std::uint64_t components, const std::vector<std::uint64_t>& copies, std::vector<double>& values) {
    const std::uint64_t tuples = of_cells ? piece.cells : piece.points;
    const std::vector<double> read = data_.reals(*array);
    expect_size(*array, tuples, components, read.size());
    for (std::uint64_t i = 0; i < tuples; ++i) // a strip is several faces, a line is none
      for (std::uint64_t copy = 0; copy < (of_cells ? copies[i] : 1); ++copy)
        values.insert(values.end(), read.begin() + static_cast<std::ptrdiff_t>(i * components),
                      read.begin() + static_cast<std::ptrdiff_t>((i + 1) * components));
  }

  void read_piece(const Piece& piece) {
    if (!piece.coordinates || !piece.connectivity || !piece.offsets || !piece.types)
      fail(piece.start, "the piece lacks its Points or the cell arrays connectivity, offsets and types");
    const std::int64_t first_point = static_cast<std::int64_t>(mesh_.points.size());
    const std::vector<double> x = data_.reals(*piece.coordinates);
    expect_size(*piece.coordinates, piece.points, 3, x.size());
    for (std::size_t i = 0; i < x.size(); i += 3) {
      if (!std::isfinite(x[i]) || !std::isfinite(x[i + 1]) || !std::isfinite(x[i + 2]))
        fail(piece.coordinates->start, "point " + std::to_string(i / 3) + " has a coordinate that is not finite");
      mesh_.points.push_back({x[i], x[i + 1], x[i + 2]});
    }
    const std::vector<std::uint64_t> copies = read_cells(piece, first_point);
    for (std::size_t place = 0; place < 2; ++place) {
      if (with_thickness_[place])
        append_array(piece, piece.thickness[place], place == 1, 1, copies, thickness_[place]);
      if (with_velocity_[place])
        append_array(piece, piece.velocity[place], place == 1, 3, copies, velocity_[place]);
    }
  }

  // Adds the cells' faces; returns how many each cell gave.
  std::vector<std::uint64_t> read_cells(const Piece& piece, std::int64_t first_point) {
    std::vector<std::int64_t> corners = data_.integers(*piece.connectivity);
    const std::vector<std::int64_t> ends = data_.integers(*piece.offsets);
    const std::vector<std::int64_t> types = data_.integers(*piece.types);
    expect_size(*piece.offsets, piece.cells, 1, ends.size());
    expect_size(*piece.types, piece.cells, 1, types.size());
    for (std::int64_t& corner : corners) {
      if (corner < 0 || static_cast<std::uint64_t>(corner) >= piece.points)
        fail(piece.connectivity->start, "vertex index " + std::to_string(corner) + " is out of range: the piece has " +
                                            std::to_string(piece.points) + " points, counted from 0");
      corner += first_point;
    }
    std::vector<std::uint64_t> copies(piece.cells);
    std::int64_t start = 0;
    for (std::uint64_t i = 0; i < piece.cells; ++i) {
      if (ends[i] < start || static_cast<std::uint64_t>(ends[i]) > corners.size())
        fail(piece.offsets->start, "offset of cell " + std::to_string(i) + " is out of order or out of range");
      const std::size_t faces_before = mesh_.face_count();
      add_cell(types[i], std::span(corners).subspan(start, ends[i] - start), i, piece.types->start);
      copies[i] = mesh_.face_count() - faces_before;
      start = ends[i];
    }
    return copies;
  }

  void add_cell(std::int64_t type, std::span<std::int64_t> corners, std::uint64_t cell, std::size_t start) {
    constexpr std::int64_t vertex = 1, poly_vertex = 2, line = 3, poly_line = 4, triangle = 5, strip = 6, polygon = 7,
                           pixel = 8, quad = 9;
    switch (type) {
    case vertex:
    case poly_vertex:
    case line:
    case poly_line:
      ++other_cells_;
      return;
    case triangle:
    case pixel:
    case quad:
      if (corners.size() != (type == triangle ? 3U : 4U))
        fail(start, "cell " + std::to_string(cell) + " of type " + std::to_string(type) + " has " +
                        std::to_string(corners.size()) + " corners");
      if (type == pixel)
        std::swap(corners[2], corners[3]);
      break;
    case polygon:
      break;
    case strip:
      for (std::size_t k = 0; k + 2 < corners.size(); ++k) // every second triangle is turned round
        mesh_.add_face(k % 2 == 0 ? std::array{corners[k], corners[k + 1], corners[k + 2]}
                                  : std::array{corners[k + 1], corners[k], corners[k + 2]},
                       cell);
      return;
    default:
      fail(start, "cell " + std::to_string(cell) + " has the VTK type " + std::to_string(type) +
                      ", which is no flat surface; in ParaView apply 'Extract Surface' and 'Triangulate' first");
    }
    mesh_.add_face(corners, cell);
  }

  std::string file_;
  XmlScan xml_;
  MeshAssembler mesh_;
  VtuData data_;
  std::vector<Piece> pieces_;
  std::array<bool, 2> with_thickness_{}, with_velocity_{};
  std::array<std::vector<double>, 2> thickness_, velocity_;
  std::size_t other_cells_ = 0;
};

} // namespace

MeshImport import_vtu(std::string_view bytes, const std::string& name) { return Reader(bytes, name).read(); }

} // namespace sheet::formats
