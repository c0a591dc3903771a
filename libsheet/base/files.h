// SPDX-License-Identifier: GPL-3.0-or-later
// Files or pipes alike: "-" is standard input or output. Opening and closing are checked; errors name the file.
#pragma once
#include <string>
#include <string_view>

namespace sheet {

// A file descriptor that is open for reading. Throws Error: usage (standard input is a terminal; this program writes
// the same file), io (cannot open).
class InputFile {
public:
  explicit InputFile(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
  // For messages: the path, or "standard input".
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

private:
  std::string name_;
  int descriptor_ = -1;
};

// A file descriptor that is open for writing. Throws Error: usage (binary data to a terminal; this program reads the
// same file), io (cannot open; another program writes it). Until start() an earlier content stays, and it stays for
// good if start() is never called: so a mistake costs no result. Call close() when all is written: only then is it
// known to be on its way.
class OutputFile {
public:
  enum class Content { binary, text };
  OutputFile(const std::string& path, Content content);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  // Whoever calls this before start() loses nothing: what the file has then, if it is a regular one and not empty,
  // stays beside it under its name with "~" behind it, in the place of what had that name. Throws Error: usage (this
  // program reads the file of that name), io at start().
  void keep_earlier();
  // There is something to write: empties the file. Does nothing when called again.
  void start();
  // Starts, if need be; close() does, too.
  void write(std::string_view text);
  void close();

private:
  [[nodiscard]] bool has_content() const;
  void put_aside();

  std::string path_, name_, earlier_; // earlier_: the name under which what is there is kept; "": it is not
  int descriptor_ = -1;
  bool started_ = false, created_ = false;
};

// The whole content of a file. Throws Error (io), also above `limit` bytes.
[[nodiscard]] std::string read_text_file(const std::string& path, std::size_t limit = std::size_t{1} << 30);

// The same of a text, without the byte order mark that some programs put before UTF-8. Throws Error also (bad_input) if
// it is UTF-16 or compressed.
[[nodiscard]] std::string read_utf8_file(const std::string& path, std::size_t limit = std::size_t{1} << 30);

// Grows a pipe's buffer to 1 MiB where the system allows it, so that a frame needs few switches between programs.
void widen_pipe(int descriptor);

} // namespace sheet
