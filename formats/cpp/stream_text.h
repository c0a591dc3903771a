// SPDX-License-Identifier: MIT
// The canonical text form of a sheet stream: lossless both ways. Specification: formats/sheet.md, section 6.
// binary to text: while (reader.read(frame)) printer.print(frame, reader.ends());  printer.end(reader.ends());
// text to binary: while ((item = parser.read(frame)) != nothing) item == end ? writer.end() : writer.write(frame);
#pragma once
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"

namespace sheet::formats {

class TextPrinter {
public:
  // `name` appears in messages. The descriptor stays the caller's.
  TextPrinter(int descriptor, std::string name);

  // Prints `end` until there are as many as `ends` (StreamReader::ends(): so joined streams stay apart), then the
  // frame. All of it has been written on return. Throws StreamError: value (bad form), io, closed.
  void print(const Frame& frame, std::uint64_t ends = 0);
  // Prints `end` until there are as many as `ends`.
  void end(std::uint64_t ends = 1);

private:
  void put_ends(std::uint64_t ends);
  void put_array(const Array& array);
  void put_text(std::string_view text);
  void put(std::string_view text);
  template <class T> void put_number(T number);
  template <class T> void put_rows(const Array& array);
  void flush();

  int descriptor_;
  std::string name_;
  bool terminal_; // text that would command it is made visible
  std::vector<char> buffer_;
  std::size_t used_ = 0;
  std::uint64_t ends_ = 0;
  bool started_ = false;
};

class TextParser {
public:
  enum class Item { frame, end, nothing };

  // `name` appears in messages. The descriptor stays the caller's.
  TextParser(int descriptor, std::string name);

  // Reads the next frame into `frame`, or the next `end`; nothing at the end of the input, which must stand behind
  // `end`. A frame's form has been checked (find_form_error), its values have not (find_value_error). Throws
  // StreamError: corrupt (no `end`), value (says something else than section 6 allows), io; the message is
  // "NAME:LINE:COLUMN: what is wrong and what is expected".
  [[nodiscard]] Item read(Frame& frame);

private:
  [[noreturn]] void fail(std::string_view word, const std::string& what) const;
  [[noreturn]] void cut_short(const std::string& what) const;
  bool read_line();
  bool next_line();
  std::string_view next_word();
  void expect_line_end(std::string_view what);
  template <class T> T expect_number();
  template <class T> T expect_setting(std::string_view key);
  void read_version();
  void read_frame(Frame& frame);
  Array read_entry(const Frame& frame);
  void read_data(Array& array);
  void read_text(Array& array);
  template <class T> void read_rows(Array& array);

  int descriptor_;
  std::string name_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, filled_ = 0; // of buffer_: behind the current line, behind the last byte read
  std::string_view line_, rest_;       // the current line without its newline, what has not been parsed of it
  std::uint64_t number_ = 0;           // of the line, from 1
  bool again_ = false;                 // the current line is the next one once more
  bool started_ = false;               // the line sheet-text has been read
  bool ended_ = false;                 // the last item was `end`
  bool returns_ = false;               // lines end with CR LF, as some programs write them: so did the first
};

} // namespace sheet::formats
