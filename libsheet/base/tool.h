// SPDX-License-Identifier: GPL-3.0-or-later
// The command line of a program: one declaration an option; parsing, help, man page, shell completion, defaults and
// provenance all come from it. Option values live in the library's own option structs, which never see argv.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libsheet/base/error.h"

namespace sheet {

class Tool {
public:
  // `summary`: one line without full stop; `description`: a paragraph or more for help and man page.
  Tool(std::string name, std::string summary, std::string description);

  enum class Provenance {
    record, // the option changes the result: it is printed back into the stream
    omit,   // it does not (verbosity, threads, file names)
  };

  // `names`: "--fps" or "-o,--output". `placeholder` names the value and its unit ("FPS", "SECONDS"). The value that
  // the variable has now is the default. An optional is a setting that may be absent; its default is that.
  void option(std::string_view names, double& value, std::string_view placeholder, std::string_view text,
              Provenance provenance = Provenance::record);
  void option(std::string_view names, std::optional<double>& value, std::string_view placeholder, std::string_view text,
              Provenance provenance = Provenance::record);
  void option(std::string_view names, std::int64_t& value, std::string_view placeholder, std::string_view text,
              Provenance provenance = Provenance::record);
  void option(std::string_view names, std::optional<std::int64_t>& value, std::string_view placeholder,
              std::string_view text, Provenance provenance = Provenance::record);
  // A text must not be empty, which is what a variable of a script gives that is not set, unless may_be_empty().
  void option(std::string_view names, std::string& value, std::string_view placeholder, std::string_view text,
              Provenance provenance = Provenance::record);
  void may_be_empty(); // the option that was declared last
  // May be given again and again. `completions`: what the shell offers for a value.
  void option(std::string_view names, std::vector<std::string>& values, std::string_view placeholder,
              std::string_view text, std::vector<std::string> completions = {});
  void flag(std::string_view names, bool& value, std::string_view text, Provenance provenance = Provenance::record);
  // One of several words, each of which stands for a value.
  template <class T>
  void choice(std::string_view names, T& value, std::vector<std::pair<std::string, T>> words, std::string_view text) {
    std::vector<std::string> spelled;
    for (const auto& [word, meaning] : words)
      spelled.push_back(word);
    choice_of_word(
        names, std::move(spelled), text, [&value, words](std::size_t chosen) { value = words[chosen].second; },
        [&value, words] {
          std::size_t i = 0;
          while (words[i].second != value)
            ++i;
          return i;
        });
  }
  // A value that the caller parses: `set` throws Error to refuse, `print` gives the text of the value now ("" for
  // none). The shell offers `words`.
  void custom(std::string_view names, std::string_view placeholder, std::string_view text,
              std::function<void(const std::string&)> set, std::function<std::string()> print,
              Provenance provenance = Provenance::record, std::vector<std::string> words = {});
  // Arguments without a dash. `file` completes file names in the shell; they are not part of provenance.
  void argument(std::string_view name, std::string& value, std::string_view text);
  void arguments(std::string_view name, std::vector<std::string>& values, std::string_view text);
  void required_argument(std::string_view name, std::string& value, std::string_view text);

  void example(std::string command, std::string text);
  // Further man page section.
  void section(std::string title, std::string text);
  // Where a program's exit codes are not those of ExitCode.
  void exit_status(std::string text);

  // Declares the options of every program (--help, --version, -q, -v, --threads), parses, calls `body`, turns errors
  // into messages on stderr and exit codes. SIGPIPE is ignored: writes to a closed pipe throw and end the program
  // quietly.
  [[nodiscard]] int run(int argc, char** argv, const std::function<void()>& body);

  // The program, its version and the options that differ from their defaults, in the order of declaration:
  // "sheet-step (0.1.0) --tolerance 0.001".
  [[nodiscard]] std::string command_line() const;

  [[nodiscard]] const std::string& name() const noexcept { return name_; }

private:
  struct Option {
    std::string names, placeholder, text, default_text;
    bool is_flag = false, is_list = false, is_argument = false, is_required = false, may_be_empty = false;
    Provenance provenance = Provenance::record;
    std::vector<std::string> words;                // that the shell offers for a value
    std::function<void(const std::string&)> set;   // called once a value
    std::function<std::vector<std::string>()> get; // the values now; none: absent
  };
  void add(Option option);
  void choice_of_word(std::string_view names, std::vector<std::string> words, std::string_view text,
                      std::function<void(std::size_t)> set, std::function<std::size_t()> get);
  [[nodiscard]] std::vector<std::string> words_of(int argc, char** argv) const;
  void parse(int argc, char** argv);
  void tell_of_itself(int argc, char** argv) const;
  [[nodiscard]] std::string synopsis() const;
  [[nodiscard]] std::string help_text() const;
  [[nodiscard]] std::string man_page() const;          // --man: troff
  [[nodiscard]] std::string completion_script() const; // --completion: bash
  [[nodiscard]] static std::string default_note(const Option& option);

  std::string name_, summary_, description_;
  std::vector<Option> options_;
  std::vector<std::pair<std::string, std::string>> examples_, sections_;
  std::string exit_status_ = "0 success, 1 internal error, 2 wrong usage, 3 bad input, 4 truncated or corrupt stream, "
                             "5 the numerical solution did not converge, 6 input or output error.";
  std::int64_t threads_ = 0;
  bool quiet_ = false, verbose_ = false;
  std::size_t first_common_ = 0; // options_ from here on are those of every program
};

} // namespace sheet
