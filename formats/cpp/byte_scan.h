// SPDX-License-Identifier: MIT
// Numbers of binary files in either byte order, never past the end.
#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace sheet::formats {

enum class ByteOrder { little, big };

// The number at the start of `bytes`, which the caller knows to be long enough.
template <class T> [[nodiscard]] T load_number(const char* bytes, ByteOrder order) {
  char raw[sizeof(T)];
  std::memcpy(raw, bytes, sizeof(T));
  if ((order == ByteOrder::big) != (std::endian::native == std::endian::big))
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) {
      const char swap = raw[i];
      raw[i] = raw[sizeof(T) - 1 - i];
      raw[sizeof(T) - 1 - i] = swap;
    }
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return value;
}

// The number types that PLY and VTU name.
enum class NumberType { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

[[nodiscard]] constexpr std::size_t size_of(NumberType type) {
  switch (type) {
  case NumberType::i8:
  case NumberType::u8:
    return 1;
  case NumberType::i16:
  case NumberType::u16:
    return 2;
  case NumberType::i32:
  case NumberType::u32:
  case NumberType::f32:
    return 4;
  case NumberType::i64:
  case NumberType::u64:
  case NumberType::f64:
    return 8;
  }
  return 8;
}

[[nodiscard]] constexpr bool is_real(NumberType type) { return type == NumberType::f32 || type == NumberType::f64; }

// Calls f with the number of that type at `bytes` and returns its result.
template <class F> auto visit_number(NumberType type, const char* bytes, ByteOrder order, F&& f) {
  switch (type) {
  case NumberType::i8:
    return f(load_number<std::int8_t>(bytes, order));
  case NumberType::u8:
    return f(load_number<std::uint8_t>(bytes, order));
  case NumberType::i16:
    return f(load_number<std::int16_t>(bytes, order));
  case NumberType::u16:
    return f(load_number<std::uint16_t>(bytes, order));
  case NumberType::i32:
    return f(load_number<std::int32_t>(bytes, order));
  case NumberType::u32:
    return f(load_number<std::uint32_t>(bytes, order));
  case NumberType::i64:
    return f(load_number<std::int64_t>(bytes, order));
  case NumberType::u64:
    return f(load_number<std::uint64_t>(bytes, order));
  case NumberType::f32:
    return f(load_number<float>(bytes, order));
  case NumberType::f64:
    break;
  }
  return f(load_number<double>(bytes, order));
}

[[nodiscard]] inline double load_real(NumberType type, const char* bytes, ByteOrder order) {
  return visit_number(type, bytes, order, [](auto value) { return static_cast<double>(value); });
}

// Integers above the range of int64 become -1, which no index or count may be; type must not be a real one.
[[nodiscard]] inline std::int64_t load_integer(NumberType type, const char* bytes, ByteOrder order) {
  return visit_number(type, bytes, order, [](auto value) -> std::int64_t {
    if constexpr (std::is_floating_point_v<decltype(value)>)
      return -1;
    else if constexpr (std::is_same_v<decltype(value), std::uint64_t>)
      return value > static_cast<std::uint64_t>(INT64_MAX) ? -1 : static_cast<std::int64_t>(value);
    else
      return value;
  });
}

} // namespace sheet::formats
