// SPDX-License-Identifier: MIT
#include "formats/cpp/vtu_data.h"

#include <utility>

#include "formats/cpp/base64.h"
#include "formats/cpp/text_scan.h"

namespace sheet::formats {

// The bytes of the array's numbers; `decoded` keeps them if they had to be decoded.
std::string_view VtuData::binary(const VtuDeclaration& array, std::string& decoded) {
  const auto fail = [&](const std::string& problem) {
    mesh_fail(file, "byte " + std::to_string(array.start), "array " + quoted(array.name) + ": " + problem);
  };
  std::string_view source = array.inline_text;
  if (array.encoding == VtuEncoding::appended) {
    if (!appended)
      fail("its data are said to be appended, but the file has no appended data; it was cut short");
    if (array.offset > appended->size())
      fail("its offset " + std::to_string(array.offset) + " lies behind the appended data");
    source = appended->substr(array.offset);
  }
  const bool base64 = array.encoding == VtuEncoding::base64 || appended_is_base64;
  if (base64) {
    const std::optional<std::string> head = decode_base64(source, length_bytes);
    if (!head)
      fail("its data are not base64");
    decoded = *head;
  }
  const std::string_view head = base64 ? std::string_view(decoded) : source;
  if (head.size() < length_bytes)
    fail("its data are cut short");
  const std::uint64_t length = length_bytes == 8 ? load_number<std::uint64_t>(head.data(), order)
                                                 : load_number<std::uint32_t>(head.data(), order);
  if (length > source.size() || length > budget)
    fail("claims " + std::to_string(length) + " bytes, more than the file has");
  budget -= length;
  if (base64) {
    std::optional<std::string> all = decode_base64(source, length_bytes + length);
    if (!all)
      fail("its data are not base64");
    decoded = std::move(*all);
    source = decoded;
  }
  if (source.size() < length_bytes + length)
    fail("its data are cut short");
  source = source.substr(length_bytes, length);
  if (source.size() % size_of(array.type) != 0)
    fail("its length of " + std::to_string(length) + " bytes is no whole number of values");
  return source;
}

template <class T, class Load, class Parse>
std::vector<T> VtuData::numbers(const VtuDeclaration& array, Load load, Parse parse) {
  std::vector<T> values;
  if (array.encoding == VtuEncoding::ascii) {
    TextScan text(array.inline_text, file, 0);
    for (std::string_view word = text.word_across_lines(); !word.empty(); word = text.word_across_lines()) {
      const auto value = parse(word);
      if (!value)
        mesh_fail(file, "byte " + std::to_string(word.data() - array.inline_text.data() + array.start),
                  "array " + quoted(array.name) + ": wrong number " + quoted(word));
      values.push_back(*value);
    }
    return values;
  }
  std::string decoded;
  const std::string_view bytes = binary(array, decoded);
  const std::size_t size = size_of(array.type);
  values.reserve(bytes.size() / size);
  for (std::size_t i = 0; i < bytes.size(); i += size)
    values.push_back(load(array.type, bytes.data() + i, order));
  return values;
}

std::vector<double> VtuData::reals(const VtuDeclaration& array) {
  return numbers<double>(array, load_real, parse_real);
}

std::vector<std::int64_t> VtuData::integers(const VtuDeclaration& array) {
  if (is_real(array.type))
    mesh_fail(file, "byte " + std::to_string(array.start), "array " + quoted(array.name) + " must hold whole numbers");
  return numbers<std::int64_t>(array, load_integer, parse_integer);
}

} // namespace sheet::formats
