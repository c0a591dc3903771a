// SPDX-License-Identifier: MIT
// One frame of a sheet stream in memory: a header and named arrays. Specification: formats/sheet.md.
// Quantities are SI; triangles are counter-clockwise seen from their positive side.
#pragma once
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "formats/cpp/bytes.h"

namespace sheet::formats {

inline constexpr std::uint16_t version_major = 1;
inline constexpr std::uint16_t version_minor = 0;

// The numbers are those of the file.
enum class Place : std::uint8_t { vertex = 0, triangle = 1, edge = 2, frame = 3 };
enum class Type : std::uint8_t {
  int8 = 1,
  uint8 = 2,
  int32 = 3,
  uint32 = 4,
  int64 = 5,
  uint64 = 6,
  float32 = 7,
  float64 = 8,
  text = 9, // UTF-8, place frame only, one row a byte
};
// What becomes of an array's rows when an edit of the mesh replaces parents by children.
enum class Transfer : std::uint8_t {
  drop = 0,        // the array is removed
  copy = 1,        // from the parent with the largest weight
  interpolate = 2, // weighted mean of the parents (floating point only)
  conserve = 3,    // the sum over all rows stays (floating point only)
  common = 4,      // the bits that all parents have (integers only)
  mean = 5,        // mean by volume: the sum of value x volume stays (floating point, of triangles only)
};

[[nodiscard]] std::size_t size_of(Type type) noexcept;
[[nodiscard]] std::string_view name_of(Place place) noexcept;
[[nodiscard]] std::string_view name_of(Type type) noexcept;
[[nodiscard]] std::string_view name_of(Transfer transfer) noexcept;

template <class T> [[nodiscard]] constexpr Type type_of();
template <> constexpr Type type_of<std::int8_t>() { return Type::int8; }
template <> constexpr Type type_of<std::uint8_t>() { return Type::uint8; }
template <> constexpr Type type_of<std::int32_t>() { return Type::int32; }
template <> constexpr Type type_of<std::uint32_t>() { return Type::uint32; }
template <> constexpr Type type_of<std::int64_t>() { return Type::int64; }
template <> constexpr Type type_of<std::uint64_t>() { return Type::uint64; }
template <> constexpr Type type_of<float>() { return Type::float32; }
template <> constexpr Type type_of<double>() { return Type::float64; }

struct Array {
  std::string name;       // [a-z0-9_.:-]{1,47}
  std::string unit = "1"; // SI unit as text, "1" where there is none, at most 23 characters
  Place place = Place::vertex;
  Type type = Type::float64;
  Transfer transfer = Transfer::drop;
  bool critical = false; // a reader that does not know this name must refuse the frame
  std::uint32_t components = 1;
  std::uint64_t rows = 0;
  Bytes data; // rows * components values of `type`, little endian, row by row

  // The values; T must be the array's type, or a struct of `components` such values. Precondition, checked.
  template <class T> [[nodiscard]] std::span<T> values() { return {cast<T>(), data.size() / sizeof(T)}; }
  template <class T> [[nodiscard]] std::span<const T> values() const {
    return {const_cast<Array*>(this)->cast<T>(), data.size() / sizeof(T)};
  }
  [[nodiscard]] std::string_view text() const { return {reinterpret_cast<const char*>(data.data()), data.size()}; }
  bool operator==(const Array&) const = default;

private:
  template <class T> T* cast() {
    if (sizeof(T) != size_of(type) && sizeof(T) != size_of(type) * components)
      throw std::logic_error("array \"" + name + "\" read as a type of another size");
    return reinterpret_cast<T*>(data.data());
  }
};

struct Frame {
  double time = 0;             // [s], finite
  std::uint64_t step = 0;      // steps taken so far
  std::uint64_t vertices = 0;  // rows of a vertex array
  std::uint64_t triangles = 0; // rows of a triangle array
  std::uint64_t edges = 0;     // rows of an edge array; 0 in a frame without one
  std::vector<Array> arrays;   // in the order of the stream; names are unique

  [[nodiscard]] Array* find(std::string_view name) noexcept;
  [[nodiscard]] const Array* find(std::string_view name) const noexcept;
  // Rows that an array at this place has; place frame is free, hence 0.
  [[nodiscard]] std::uint64_t rows_at(Place place) const noexcept;
  // Replaces an array of that name in its place in the order, else appends.
  Array& put(Array array);
  // Adds or replaces a text array of place frame, transfer copy.
  Array& put_text(std::string_view name, std::string_view text);
  void erase(std::string_view name);
  bool operator==(const Frame&) const = default;
};

// A new array, its rows zero.
[[nodiscard]] Array make_array(std::string_view name, Place place, Type type, std::uint32_t components,
                               std::string_view unit, Transfer transfer, std::uint64_t rows, bool critical = false);

// A standard array (formats/sheet.md, section 5), its rows zero. Components: for those only whose number the format
// leaves open. The name must be a standard one.
[[nodiscard]] Array make_standard_array(std::string_view name, std::uint64_t rows, std::uint32_t components = 1);

// Whether an array may have this name, and whether it is that of a standard one.
[[nodiscard]] bool is_array_name(std::string_view name);
[[nodiscard]] bool is_standard_array(std::string_view name);

// What a reader or writer throws: `kind` decides the exit code of a tool.
class StreamError : public std::runtime_error {
public:
  enum class Kind {
    corrupt, // cut short or damaged: the bytes are not a sheet stream
    value,   // well-formed, but says something impossible (an index out of range, a NaN position)
    io,      // the operating system could not read or write
    closed,  // nobody reads the other end of the pipe any more
  };
  StreamError(Kind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  [[nodiscard]] Kind kind() const noexcept { return kind_; }

private:
  Kind kind_;
};

// Each says what is wrong with the form of a frame; empty if nothing is.
[[nodiscard]] std::string find_header_error(const Frame& frame);                    // time, counts
[[nodiscard]] std::string find_entry_error(const Array& array, const Frame& frame); // all of an array but its data
[[nodiscard]] std::string find_table_error(const Frame& frame);                     // all entries, names unique, edges
[[nodiscard]] std::string find_data_error(const Array& array);                      // size; text is UTF-8 without NUL
[[nodiscard]] std::string find_form_error(const Frame& frame);                      // all of these

// Says which standard array breaks its rule (section 5 of formats/sheet.md: shapes, indices in range, finite positions,
// positive volumes, number of edges), with row; empty if none does. Cost: one pass; arrays at place edge: a sort.
[[nodiscard]] std::string find_value_error(const Frame& frame);

// The same for one array; empty for arrays that are not standard.
[[nodiscard]] std::string find_array_error(const Frame& frame, const Array& array);

// Says which critical array this version does not know; empty if there is none.
[[nodiscard]] std::string find_critical_error(const Frame& frame);

} // namespace sheet::formats
