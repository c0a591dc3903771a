// SPDX-License-Identifier: MIT
#include "formats/cpp/stream_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>

#include <fmt/core.h>

#include "formats/cpp/stream_layout.h"

namespace sheet::formats {

namespace {

constexpr std::array<std::string_view, 4> place_names{"vertex", "triangle", "edge", "frame"};
constexpr std::array<std::string_view, 10> type_names{"",      "int8",   "uint8",   "int32",   "uint32",
                                                      "int64", "uint64", "float32", "float64", "text"};
constexpr std::array<std::size_t, 10> type_sizes{0, 1, 1, 4, 4, 8, 8, 4, 8, 1};
constexpr std::array<std::string_view, 6> transfer_names{"drop", "copy", "interpolate", "conserve", "common", "mean"};

// The table's value, or its type's empty one for a number outside of it.
template <class Table, class Enum> typename Table::value_type lookup(const Table& table, Enum index) {
  const auto i = static_cast<std::size_t>(index);
  return i < table.size() ? table[i] : typename Table::value_type{};
}

bool is_floating(Type type) { return type == Type::float32 || type == Type::float64; }

bool good_unit(std::string_view unit) {
  const auto good = [](char c) { return c > ' ' && c < 0x7f; };
  return !unit.empty() && unit.size() < sizeof(layout::ArrayEntry::unit) && std::all_of(unit.begin(), unit.end(), good);
}

// The length of the well-formed UTF-8 sequence at `p`, of which `left` bytes are there; 0 if it is none.
std::size_t utf8_length(const unsigned char* p, std::size_t left) {
  if (p[0] < 0x80)
    return 1;
  const std::size_t length = p[0] < 0xc2 ? 0 : p[0] < 0xe0 ? 2 : p[0] < 0xf0 ? 3 : p[0] < 0xf5 ? 4 : 0;
  if (length == 0 || length > left)
    return 0;
  // The second byte excludes overlong forms, surrogates and what is above U+10FFFF.
  const unsigned char low = p[0] == 0xe0 ? 0xa0 : p[0] == 0xf0 ? 0x90 : 0x80;
  const unsigned char high = p[0] == 0xed ? 0x9f : p[0] == 0xf4 ? 0x8f : 0xbf;
  if (p[1] < low || p[1] > high)
    return 0;
  return std::all_of(p + 2, p + length, [](unsigned char c) { return (c & 0xc0) == 0x80; }) ? length : 0;
}

std::string find_text_error(std::string_view text) {
  if (const std::size_t at = text.find('\0'); at != text.npos)
    return fmt::format("its byte {} is zero, text has none", at);
  const auto* p = reinterpret_cast<const unsigned char*>(text.data());
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(p + i, text.size() - i);
    if (length == 0)
      return fmt::format("its byte {} is not UTF-8", i);
    i += length;
  }
  return {};
}

} // namespace

std::size_t size_of(Type type) noexcept { return lookup(type_sizes, type); }
std::string_view name_of(Place place) noexcept { return lookup(place_names, place); }
std::string_view name_of(Type type) noexcept { return lookup(type_names, type); }
std::string_view name_of(Transfer transfer) noexcept { return lookup(transfer_names, transfer); }

bool is_array_name(std::string_view name) {
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.' || c == ':' || c == '-';
  };
  return !name.empty() && name.size() < sizeof(layout::ArrayEntry::name) && std::all_of(name.begin(), name.end(), good);
}

Array* Frame::find(std::string_view name) noexcept {
  const auto it = std::find_if(arrays.begin(), arrays.end(), [&](const Array& a) { return a.name == name; });
  return it == arrays.end() ? nullptr : &*it;
}

const Array* Frame::find(std::string_view name) const noexcept { return const_cast<Frame*>(this)->find(name); }

std::uint64_t Frame::rows_at(Place place) const noexcept {
  switch (place) {
  case Place::vertex:
    return vertices;
  case Place::triangle:
    return triangles;
  case Place::edge:
    return edges;
  case Place::frame:
    break;
  }
  return 0;
}

Array& Frame::put(Array array) {
  if (Array* old = find(array.name))
    return *old = std::move(array);
  return arrays.emplace_back(std::move(array));
}

Array& Frame::put_text(std::string_view name, std::string_view text) {
  Array array = make_array(name, Place::frame, Type::text, 1, "1", Transfer::copy, text.size());
  if (!text.empty())
    std::memcpy(array.data.data(), text.data(), text.size());
  return put(std::move(array));
}

void Frame::erase(std::string_view name) {
  std::erase_if(arrays, [&](const Array& a) { return a.name == name; });
}

Array make_array(std::string_view name, Place place, Type type, std::uint32_t components, std::string_view unit,
                 Transfer transfer, std::uint64_t rows, bool critical) {
  Array array;
  array.name = name;
  array.unit = unit;
  array.place = place;
  array.type = type;
  array.transfer = transfer;
  array.critical = critical;
  array.components = components;
  array.rows = rows;
  array.data.resize(rows * components * size_of(type));
  std::fill_n(array.data.data(), array.data.size(), std::byte{0});
  return array;
}

std::string find_header_error(const Frame& frame) {
  if (frame.arrays.size() > layout::max_arrays)
    return fmt::format("{} arrays are more than the {} that a frame may have", frame.arrays.size(), layout::max_arrays);
  for (const std::uint64_t rows : {frame.vertices, frame.triangles, frame.edges})
    if (rows > layout::max_rows)
      return fmt::format("{} vertices, triangles or edges are more than 2^32", rows);
  if (!std::isfinite(frame.time))
    return "the time is not finite";
  return {};
}

std::string find_entry_error(const Array& a, const Frame& frame) {
  if (!is_array_name(a.name))
    return "its name is not 1 to 47 characters of [a-z0-9_.:-]";
  if (!good_unit(a.unit))
    return "its unit is not 1 to 23 printable characters without blanks (\"1\" for none)";
  if (a.components == 0)
    return "it has no components";
  if (a.type == Type::text && (a.place != Place::frame || a.components != 1))
    return "text belongs to the frame, with one component";
  if (a.transfer == Transfer::common && (is_floating(a.type) || a.type == Type::text))
    return "transfer \"common\" is for integers";
  if ((a.transfer == Transfer::interpolate || a.transfer == Transfer::conserve || a.transfer == Transfer::mean) &&
      !is_floating(a.type))
    return fmt::format("transfer \"{}\" is for floating point", name_of(a.transfer));
  if (a.transfer == Transfer::mean && a.place != Place::triangle)
    return "transfer \"mean\" is for triangles, which have a volume";
  if (a.place != Place::frame && a.rows != frame.rows_at(a.place))
    return fmt::format("it has {} rows, the frame has {} at place {}", a.rows, frame.rows_at(a.place),
                       name_of(a.place));
  return {};
}

std::string find_table_error(const Frame& frame) {
  std::unordered_set<std::string_view> names;
  for (const Array& a : frame.arrays) {
    if (const std::string error = find_entry_error(a, frame); !error.empty())
      return fmt::format("array \"{}\": {}", a.name, error);
    if (!names.insert(a.name).second)
      return fmt::format("array \"{}\" appears twice", a.name);
  }
  if (frame.edges != 0 &&
      std::none_of(frame.arrays.begin(), frame.arrays.end(), [](const Array& a) { return a.place == Place::edge; }))
    return fmt::format("the frame counts {} edges but has no array at place edge", frame.edges);
  return {};
}

std::string find_data_error(const Array& a) {
  const unsigned __int128 bytes = static_cast<unsigned __int128>(a.rows) * a.components * size_of(a.type);
  if (bytes != a.data.size())
    return fmt::format("it has {} bytes, its rows and components need another number", a.data.size());
  return a.type == Type::text ? find_text_error(a.text()) : std::string();
}

std::string find_form_error(const Frame& frame) {
  if (std::string error = find_header_error(frame); !error.empty())
    return error;
  if (std::string error = find_table_error(frame); !error.empty())
    return error;
  for (const Array& a : frame.arrays)
    if (const std::string error = find_data_error(a); !error.empty())
      return fmt::format("array \"{}\": {}", a.name, error);
  return {};
}

} // namespace sheet::formats
