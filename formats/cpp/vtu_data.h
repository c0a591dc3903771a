// SPDX-License-Identifier: MIT
// The numbers of one DataArray of a VTK XML file: ASCII, inline base64 or appended (raw or base64), not compressed.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/cpp/byte_scan.h"

namespace sheet::formats {

enum class VtuEncoding { ascii, base64, appended };

// A DataArray as declared; its numbers are fetched later, because appended data come last in the file.
struct VtuDeclaration {
  std::string name;
  NumberType type = NumberType::f64;
  std::uint64_t components = 1;
  VtuEncoding encoding = VtuEncoding::ascii;
  std::string_view inline_text;
  std::uint64_t offset = 0; // into the appended data
  std::size_t start = 0;    // byte of the tag in the file, for messages
};

class VtuData {
public:
  std::string file;
  ByteOrder order = ByteOrder::little;
  std::size_t length_bytes = 4;             // of the byte count before binary data
  std::optional<std::string_view> appended; // from behind the underscore
  bool appended_is_base64 = false;
  std::uint64_t budget = 0; // bytes of binary data that may still be decoded: arrays may not share data without end

  [[nodiscard]] std::vector<double> reals(const VtuDeclaration& array);
  [[nodiscard]] std::vector<std::int64_t> integers(const VtuDeclaration& array);

private:
  std::string_view binary(const VtuDeclaration& array, std::string& decoded);
  template <class T, class Load, class Parse>
  std::vector<T> numbers(const VtuDeclaration& array, Load load, Parse parse);
};

} // namespace sheet::formats
