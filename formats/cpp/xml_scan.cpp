// SPDX-License-Identifier: MIT
#include "formats/cpp/xml_scan.h"

#include "formats/cpp/text_scan.h"

namespace sheet::formats {

namespace {

bool is_white_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool is_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == ':' || c == '.';
}

} // namespace

std::string_view XmlTag::attribute(std::string_view key, std::string_view otherwise) const {
  for (const auto& [name_here, value] : attributes)
    if (name_here == key)
      return value;
  return otherwise;
}

void XmlScan::fail(std::size_t at, const std::string& problem) const {
  mesh_fail(file_, "byte " + std::to_string(at), problem);
}

void XmlScan::skip_blanks() {
  while (at_ < text_.size() && is_white_space(text_[at_]))
    ++at_;
}

std::string_view XmlScan::read_name() {
  const std::size_t start = at_;
  while (at_ < text_.size() && is_name(text_[at_]))
    ++at_;
  return text_.substr(start, at_ - start);
}

std::string_view XmlScan::text_here() const { return text_.substr(at_, text_.find('<', at_) - at_); }

bool XmlScan::next(XmlTag& tag) {
  for (;;) {
    at_ = text_.find('<', at_);
    if (at_ == text_.npos) {
      at_ = text_.size();
      return false;
    }
    const std::string_view here = text_.substr(at_);
    std::string_view end;
    if (here.starts_with("<!--"))
      end = "-->";
    else if (here.starts_with("<?"))
      end = "?>";
    else if (here.starts_with("<!"))
      end = ">";
    else
      break;
    const std::size_t stop = text_.find(end, at_ + 2);
    if (stop == text_.npos)
      fail(at_, "a comment or declaration that does not end");
    at_ = stop + end.size();
  }
  tag = XmlTag{};
  tag.start = at_++;
  if (at_ < text_.size() && text_[at_] == '/') {
    tag.closing = true;
    ++at_;
  }
  tag.name = read_name();
  if (tag.name.empty())
    fail(tag.start, "'<' is not followed by the name of a tag");
  read_attributes(tag);
  return true;
}

void XmlScan::read_attributes(XmlTag& tag) {
  for (;;) {
    skip_blanks();
    const std::string_view here = text_.substr(at_);
    if (here.starts_with(">")) {
      ++at_;
      return;
    }
    if (here.starts_with("/>")) {
      tag.self_closed = true;
      at_ += 2;
      return;
    }
    const std::string_view name = read_name();
    skip_blanks();
    if (name.empty() || at_ >= text_.size() || text_[at_] != '=')
      fail(tag.start, "tag " + quoted(tag.name) + " does not end properly; the file was cut short or is no XML");
    ++at_;
    skip_blanks();
    const char quote = at_ < text_.size() ? text_[at_] : ' ';
    const std::size_t stop = quote == '"' || quote == '\'' ? text_.find(quote, at_ + 1) : text_.npos;
    if (stop == text_.npos)
      fail(at_, "the value of attribute " + quoted(name) + " is not in quotes");
    tag.attributes.emplace_back(name, text_.substr(at_ + 1, stop - at_ - 1));
    at_ = stop + 1;
  }
}

} // namespace sheet::formats
