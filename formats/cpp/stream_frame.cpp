// SPDX-License-Identifier: MIT
#include "formats/cpp/stream_frame.h"

#include <algorithm>
#include <array>
#include <unordered_set>

#include <fmt/core.h>

#include "formats/cpp/stream_layout.h"

namespace sheet::formats {

namespace {

constexpr std::array<std::string_view, 4> place_names{"vertex", "triangle", "edge", "frame"};
constexpr std::array<std::string_view, 10> type_names{"",       "int8",   "uint8",   "int32",   "uint32",
                                                      "int64", "uint64", "float32", "float64", "text"};
constexpr std::array<std::size_t, 10> type_sizes{0, 1, 1, 4, 4, 8, 8, 4, 8, 1};
constexpr std::array<std::string_view, 5> transfer_names{"drop", "copy", "interpolate", "conserve", "common"};

// The table's value, or its type's empty one for a number outside of it.
template <class Table, class Enum> typename Table::value_type lookup(const Table& table, Enum index) {
  const auto i = static_cast<std::size_t>(index);
  return i < table.size() ? table[i] : typename Table::value_type{};
}

bool is_floating(Type type) { return type == Type::float32 || type == Type::float64; }

bool good_name(std::string_view name) {
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.' || c == ':' || c == '-';
  };
  return !name.empty() && name.size() < sizeof(layout::ArrayEntry::name) && std::all_of(name.begin(), name.end(), good);
}

bool good_unit(std::string_view unit) {
  const auto good = [](char c) { return c > ' ' && c < 0x7f; };
  return !unit.empty() && unit.size() < sizeof(layout::ArrayEntry::unit) && std::all_of(unit.begin(), unit.end(), good);
}

std::string find_form_error(const Array& a, const Frame& frame) {
  if (!good_name(a.name))
    return "its name is not 1 to 47 characters of [a-z0-9_.:-]";
  if (!good_unit(a.unit))
    return "its unit is not 1 to 23 printable characters without blanks (\"1\" for none)";
  if (a.components == 0)
    return "it has no components";
  if (a.type == Type::text && (a.place != Place::frame || a.components != 1))
    return "text belongs to the frame, with one component";
  if (a.transfer == Transfer::common && (is_floating(a.type) || a.type == Type::text))
    return "transfer \"common\" is for integers";
  if ((a.transfer == Transfer::interpolate || a.transfer == Transfer::conserve) && !is_floating(a.type))
    return fmt::format("transfer \"{}\" is for floating point", name_of(a.transfer));
  if (a.place != Place::frame && a.rows != frame.rows_at(a.place))
    return fmt::format("it has {} rows, the frame has {} at place {}", a.rows, frame.rows_at(a.place),
                       name_of(a.place));
  const unsigned __int128 bytes = static_cast<unsigned __int128>(a.rows) * a.components * size_of(a.type);
  if (bytes != a.data.size())
    return fmt::format("it has {} bytes, its rows and components need another number", a.data.size());
  return {};
}

} // namespace

std::size_t size_of(Type type) noexcept { return lookup(type_sizes, type); }
std::string_view name_of(Place place) noexcept { return lookup(place_names, place); }
std::string_view name_of(Type type) noexcept { return lookup(type_names, type); }
std::string_view name_of(Transfer transfer) noexcept { return lookup(transfer_names, transfer); }

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
  return array;
}

std::string find_form_error(const Frame& frame) {
  if (frame.arrays.size() > layout::max_arrays)
    return fmt::format("{} arrays are more than the {} that a frame may have", frame.arrays.size(),
                       layout::max_arrays);
  for (const std::uint64_t rows : {frame.vertices, frame.triangles, frame.edges})
    if (rows > layout::max_rows)
      return fmt::format("{} vertices, triangles or edges are more than 2^32", rows);
  std::unordered_set<std::string_view> names;
  for (const Array& a : frame.arrays) {
    if (const std::string error = find_form_error(a, frame); !error.empty())
      return fmt::format("array \"{}\": {}", a.name, error);
    if (!names.insert(a.name).second)
      return fmt::format("array \"{}\" appears twice", a.name);
  }
  return {};
}

} // namespace sheet::formats
