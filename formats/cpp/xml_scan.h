// SPDX-License-Identifier: MIT
// The small part of XML that VTK's files use: tags with attributes, and the text after a tag. No entities, no CDATA.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sheet::formats {

struct XmlTag {
  std::string_view name;
  std::vector<std::pair<std::string_view, std::string_view>> attributes;
  bool closing = false;     // </name>
  bool self_closed = false; // <name/>
  std::size_t start = 0;    // byte of '<'

  // The attribute's value, or the given one if it is absent.
  [[nodiscard]] std::string_view attribute(std::string_view key, std::string_view otherwise = {}) const;
};

class XmlScan {
public:
  XmlScan(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  // Goes to the next tag, passing over text, comments and <? ?>; false at the end.
  bool next(XmlTag& tag);
  // The text between the last tag and the next '<'.
  [[nodiscard]] std::string_view text_here() const;
  // Everything after the last tag.
  [[nodiscard]] std::string_view rest() const { return text_.substr(at_); }
  [[nodiscard]] std::size_t offset() const { return at_; }

private:
  [[noreturn]] void fail(std::size_t at, const std::string& problem) const;
  void read_attributes(XmlTag& tag);
  void skip_blanks();
  std::string_view read_name();

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
};

} // namespace sheet::formats
