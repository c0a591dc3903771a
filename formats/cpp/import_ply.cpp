// SPDX-License-Identifier: MIT
// Stanford PLY: a text header that declares elements and their properties, then the elements as text or as numbers in
// either byte order. Read: element vertex (x, y, z, thickness, velocity_x.. or vx..) and element face (the list
// vertex_indices or vertex_index, thickness, velocity), and the arrays that are asked for; other elements and
// properties are passed over.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "formats/cpp/byte_scan.h"
#include "formats/cpp/mesh_assembler.h"
#include "formats/cpp/text_scan.h"

namespace sheet::formats {

namespace {

struct Property {
  std::string name;
  NumberType type = NumberType::f32;
  std::optional<NumberType> list_count; // set for lists
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::uint64_t line = 0; // of its declaration
  std::vector<Property> properties;
};

enum class Encoding { ascii, little, big };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
};

std::optional<NumberType> ply_number_type(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, NumberType>, 16> names = {{
      {"char", NumberType::i8},
      {"int8", NumberType::i8},
      {"uchar", NumberType::u8},
      {"uint8", NumberType::u8},
      {"short", NumberType::i16},
      {"int16", NumberType::i16},
      {"ushort", NumberType::u16},
      {"uint16", NumberType::u16},
      {"int", NumberType::i32},
      {"int32", NumberType::i32},
      {"uint", NumberType::u32},
      {"uint32", NumberType::u32},
      {"float", NumberType::f32},
      {"float32", NumberType::f32},
      {"double", NumberType::f64},
      {"float64", NumberType::f64},
  }};
  for (const auto& [text, type] : names)
    if (text == name)
      return type;
  return std::nullopt;
}

NumberType read_type(TextScan& text, bool integer) {
  const std::string_view word = text.word();
  const std::optional<NumberType> type = ply_number_type(word);
  if (!type || (integer && is_real(*type)))
    text.fail("unknown number type " + quoted(word) + (integer ? " for the length of a list" : ""));
  return *type;
}

Header read_header(TextScan& text, const std::string& file) {
  if (!text.next_line() || text.word() != "ply")
    mesh_fail(file, "line 1", "a PLY file starts with 'ply'");
  Header header;
  bool has_format = false;
  while (text.next_filled_line()) {
    const std::string_view keyword = text.word();
    if (keyword == "format") {
      const std::string_view encoding = text.word();
      if (encoding == "ascii")
        header.encoding = Encoding::ascii;
      else if (encoding == "binary_little_endian")
        header.encoding = Encoding::little;
      else if (encoding == "binary_big_endian")
        header.encoding = Encoding::big;
      else
        text.fail("unknown format " + quoted(encoding) + "; known: ascii, binary_little_endian, binary_big_endian");
      has_format = true;
    } else if (keyword == "element") {
      Element element;
      element.name = text.word();
      const std::int64_t count = text.integer("the number of elements");
      if (count < 0)
        text.fail("the number of elements is negative");
      element.count = static_cast<std::uint64_t>(count);
      element.line = text.line();
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty())
        text.fail("a property before the first element");
      Property property;
      const std::string_view word = text.word();
      if (word == "list") {
        property.list_count = read_type(text, true);
        property.type = read_type(text, false);
      } else if (const std::optional<NumberType> type = ply_number_type(word)) {
        property.type = *type;
      } else {
        text.fail("unknown number type " + quoted(word));
      }
      property.name = text.word();
      if (property.name.empty())
        text.fail("a property without a name");
      header.elements.back().properties.push_back(std::move(property));
    } else if (keyword == "end_header") {
      if (!has_format)
        text.fail("the header has no 'format' line");
      text.next_line(); // step over the line end; what follows may be binary
      return header;
    } else if (keyword != "comment" && keyword != "obj_info") {
      text.fail("unknown header line " + quoted(keyword));
    }
  }
  text.fail("the header has no 'end_header' line; the file was cut short");
}

// Numbers of the body, whichever way they are written.
class Body {
public:
  Body(std::string_view bytes, TextScan& text, Encoding encoding, const std::string& file)
      : bytes_(bytes), text_(text), ascii_(encoding == Encoding::ascii),
        order_(encoding == Encoding::big ? ByteOrder::big : ByteOrder::little), at_(text.offset()), file_(file) {}

  [[nodiscard]] std::uint64_t bytes_left() const { return ascii_ ? text_.bytes_left() : bytes_.size() - at_; }
  [[nodiscard]] std::uint64_t bytes_of(NumberType type) const { return ascii_ ? 2 : size_of(type); } // at least
  [[nodiscard]] std::uint64_t place() const { return ascii_ ? text_.line() : at_; }

  double real(NumberType type) {
    if (ascii_)
      return text_.to_real(text_.word_across_lines(), "a value");
    need(size_of(type));
    return load_real(type, take(size_of(type)), order_);
  }
  std::int64_t integer(NumberType type) {
    if (ascii_) {
      const std::string_view word = text_.word_across_lines();
      const std::optional<std::int64_t> value = parse_integer(word);
      if (!value)
        fail(word.empty() ? "the file ends too early; it was cut short" : "not a whole number: " + quoted(word));
      return *value;
    }
    need(size_of(type));
    return load_integer(type, take(size_of(type)), order_);
  }
  void skip(NumberType type, std::uint64_t n) {
    if (n > bytes_left() / bytes_of(type) + (ascii_ ? 1 : 0))
      fail("a list of " + std::to_string(n) + " numbers is longer than the file");
    if (ascii_)
      for (std::uint64_t i = 0; i < n; ++i)
        real(type);
    else
      at_ += n * size_of(type);
  }
  [[noreturn]] void fail(const std::string& problem) const {
    mesh_fail(file_, (ascii_ ? "line " : "byte ") + std::to_string(place()), problem);
  }

private:
  void need(std::size_t n) const {
    if (bytes_.size() - at_ < n)
      fail("the file ends too early; it was cut short");
  }
  const char* take(std::size_t n) {
    at_ += n;
    return bytes_.data() + at_ - n;
  }

  std::string_view bytes_;
  TextScan& text_;
  bool ascii_;
  ByteOrder order_;
  std::size_t at_;
  std::string file_;
};

std::uint64_t read_list_length(Body& body, const Property& property) {
  const std::int64_t n = body.integer(*property.list_count);
  if (n < 0 || static_cast<std::uint64_t>(n) > body.bytes_left() / body.bytes_of(property.type) + 1)
    body.fail("a list of " + std::to_string(n) + " numbers is impossible or longer than the file");
  return static_cast<std::uint64_t>(n);
}

// Fails if the file cannot hold the element's rows.
void check_count(const Element& element, const Body& body, const std::string& file) {
  std::uint64_t row = 0;
  for (const Property& property : element.properties)
    row += body.bytes_of(property.list_count ? *property.list_count : property.type);
  if (row > 0 && element.count > (body.bytes_left() + 1) / row)
    mesh_fail(file, "line " + std::to_string(element.line),
              "the file claims " + std::to_string(element.count) + " times element " + quoted(element.name) +
                  " but is too short for them");
}

// Where a scalar property's values go: an array and a component, or nowhere.
struct Target {
  MeshArray* array = nullptr;
  int component = 0;
};

// The names of the properties of an array that somebody asks for, one a component; empty if the element has none.
std::vector<std::string> properties_of(const std::string& array, const Element& element) {
  const auto has = [&](const std::string& name) {
    return std::any_of(element.properties.begin(), element.properties.end(),
                       [&](const Property& p) { return p.name == name && !p.list_count; });
  };
  std::vector<std::vector<std::string>> known = {{array}, {array + "_x", array + "_y", array + "_z"}};
  if (array == "uv")
    known.insert(known.end(), {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}});
  for (std::vector<std::string>& names : known)
    if (std::all_of(names.begin(), names.end(), has))
      return std::move(names);
  std::vector<std::string> numbered;
  while (has(array + "_" + std::to_string(numbered.size())))
    numbered.push_back(array + "_" + std::to_string(numbered.size()));
  return numbered;
}

struct Wanted {
  MeshArray thickness{"thickness", MeshPlace::point, 1, {}};
  MeshArray velocity{"velocity", MeshPlace::point, 3, {}};
  std::vector<MeshArray> others;
  std::vector<std::vector<std::string>> other_names; // their properties

  Wanted(MeshPlace place, const Element& element, WantedArrays names) {
    thickness.place = velocity.place = place;
    for (const std::string& name : names)
      if (std::vector<std::string> properties = properties_of(name, element); !properties.empty()) {
        MeshArray array{name, place, static_cast<int>(properties.size()), {}};
        array.values.resize(properties.size() * element.count);
        array.whole = true; // unless a property is not
        others.push_back(std::move(array));
        other_names.push_back(std::move(properties));
      }
  }

  Target target(const Property& property) {
    if (property.list_count)
      return {};
    for (std::size_t i = 0; i < others.size(); ++i)
      for (std::size_t k = 0; k < other_names[i].size(); ++k)
        if (other_names[i][k] == property.name) {
          others[i].whole = others[i].whole && !is_real(property.type);
          return {&others[i], static_cast<int>(k)};
        }
    if (property.name == "thickness")
      return {&thickness, 0};
    for (int d = 0; d < 3; ++d) {
      const char axis = static_cast<char>('x' + d);
      if (property.name == std::string("velocity_") + axis || property.name == std::string("v") + axis)
        return {&velocity, d};
    }
    return {};
  }

  // The targets of all properties; makes room for the values. A velocity needs its three components, once each.
  std::vector<Target> prepare(const Element& element, const std::string& file) {
    std::vector<Target> targets;
    std::array<int, 3> seen{};
    int thickness_seen = 0;
    for (const Property& property : element.properties) {
      targets.push_back(target(property));
      if (targets.back().array == &velocity)
        ++seen[targets.back().component];
      thickness_seen += targets.back().array == &thickness ? 1 : 0;
    }
    const bool any = seen[0] + seen[1] + seen[2] > 0;
    if (thickness_seen > 1 || (any && seen != std::array<int, 3>{1, 1, 1}))
      mesh_fail(file, "line " + std::to_string(element.line),
                "element " + quoted(element.name) +
                    " must declare thickness at most once and velocity_x, velocity_y, "
                    "velocity_z all together, once each");
    if (thickness_seen > 0)
      thickness.values.resize(element.count);
    if (any)
      velocity.values.resize(3 * element.count);
    return targets;
  }

  void move_to(std::vector<MeshArray>& arrays) {
    for (MeshArray* array : {&thickness, &velocity})
      if (!array->values.empty())
        arrays.push_back(std::move(*array));
    std::move(others.begin(), others.end(), std::back_inserter(arrays));
  }
};

void store(const Target& target, std::uint64_t row, double value) {
  if (target.array)
    target.array->values[row * target.array->components + target.component] = value;
}

void read_vertices(const Element& element, Body& body, const std::string& file, WantedArrays names, MeshAssembler& mesh,
                   std::vector<MeshArray>& arrays) {
  std::vector<int> axis; // of each property, -1 for none
  std::array<int, 3> seen{};
  for (const Property& property : element.properties) {
    const bool coordinate =
        !property.list_count && property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z';
    axis.push_back(coordinate ? property.name[0] - 'x' : -1);
    if (coordinate)
      ++seen[axis.back()];
  }
  if (seen != std::array<int, 3>{1, 1, 1})
    mesh_fail(file, "line " + std::to_string(element.line),
              "element 'vertex' needs the properties x, y and z, once each");
  Wanted wanted(MeshPlace::point, element, names);
  const std::vector<Target> targets = wanted.prepare(element, file);
  mesh.points.resize(element.count);
  for (std::uint64_t row = 0; row < element.count; ++row)
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const Property& property = element.properties[i];
      if (property.list_count) {
        body.skip(property.type, read_list_length(body, property));
        continue;
      }
      const std::uint64_t place = body.place();
      const double value = body.real(property.type);
      if (axis[i] >= 0) {
        if (!std::isfinite(value))
          mesh_fail(file, "byte " + std::to_string(place), "a coordinate is not finite");
        mesh.points[row][axis[i]] = value;
      }
      store(targets[i], row, value);
    }
  wanted.move_to(arrays);
}

void read_faces(const Element& element, Body& body, const std::string& file, WantedArrays names, MeshAssembler& mesh,
                std::vector<MeshArray>& arrays) {
  const auto is_corner_list = [](const Property& p) {
    return p.list_count && (p.name == "vertex_indices" || p.name == "vertex_index") && !is_real(p.type);
  };
  int lists = 0;
  for (const Property& property : element.properties)
    lists += is_corner_list(property) ? 1 : 0;
  if (lists != 1)
    mesh_fail(file, "line " + std::to_string(element.line),
              "element 'face' needs one list of whole numbers called vertex_indices or vertex_index");
  Wanted wanted(MeshPlace::cell, element, names);
  const std::vector<Target> targets = wanted.prepare(element, file);
  std::vector<std::int64_t> corners;
  for (std::uint64_t row = 0; row < element.count; ++row)
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const Property& property = element.properties[i];
      if (!property.list_count) {
        store(targets[i], row, body.real(property.type));
        continue;
      }
      const std::uint64_t n = read_list_length(body, property);
      if (!is_corner_list(property)) {
        body.skip(property.type, n);
        continue;
      }
      corners.clear();
      for (std::uint64_t k = 0; k < n; ++k)
        corners.push_back(body.integer(property.type));
      mesh.add_face(corners, row);
    }
  wanted.move_to(arrays);
}

void skip_element(const Element& element, Body& body) {
  if (element.properties.empty())
    return;
  for (std::uint64_t row = 0; row < element.count; ++row)
    for (const Property& property : element.properties)
      body.skip(property.type, property.list_count ? read_list_length(body, property) : 1);
}

} // namespace

MeshImport import_ply(std::string_view bytes, const std::string& name, WantedArrays names) {
  TextScan text(bytes, name, 0);
  const Header header = read_header(text, name);
  Body body(bytes, text, header.encoding, name);
  MeshAssembler mesh(name, "face");
  std::vector<MeshArray> arrays;
  bool has_vertices = false, has_faces = false;
  for (const Element& element : header.elements) {
    check_count(element, body, name);
    const std::string line = "line " + std::to_string(element.line);
    if (element.name == "vertex") {
      if (has_vertices)
        mesh_fail(name, line, "a second element 'vertex'");
      has_vertices = true;
      read_vertices(element, body, name, names, mesh, arrays);
    } else if (element.name == "face") {
      if (!has_vertices || has_faces)
        mesh_fail(name, line, "element 'face' must come once, after element 'vertex'");
      has_faces = true;
      read_faces(element, body, name, names, mesh, arrays);
    } else {
      if (element.name == "tristrips" && element.count > 0)
        mesh_fail(name, line, "triangle strips are not supported; save the mesh with faces");
      mesh.note("element " + quoted(element.name) + " passed over");
      skip_element(element, body);
    }
  }
  return std::move(mesh).finish(std::move(arrays));
}

} // namespace sheet::formats
