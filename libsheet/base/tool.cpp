// SPDX-License-Identifier: GPL-3.0-or-later
// Declaring and parsing options, exit codes. The texts made from the declarations are in tool_text.cpp.
#include "libsheet/base/tool.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <new>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "formats/cpp/stream_frame.h"
#include "libsheet/base/edit_distance.h"
#include "libsheet/base/log.h"
#include "libsheet/base/parallel.h"
#include "libsheet/base/shell_words.h"
#include "libsheet/base/version.h"

namespace sheet {

namespace {

using formats::StreamError;

template <class T> T parse_number(const std::string& text, std::string_view kind) {
  T value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end)
    fail(ExitCode::usage, "\"{}\" is not {}", text, kind);
  return value;
}

template <> double parse_number(const std::string& text, std::string_view kind) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !(std::abs(value) <= std::numeric_limits<double>::max()))
    fail(ExitCode::usage, "\"{}\" is not {}", text, kind);
  return value;
}

template <class T> std::vector<std::string> printed(const std::optional<T>& value) {
  return value ? std::vector{fmt::format("{}", *value)} : std::vector<std::string>{};
}

// The library's exceptions to this program's exit codes.
ExitCode code_of(const StreamError& error) {
  switch (error.kind()) {
  case StreamError::Kind::corrupt:
    return ExitCode::corrupt;
  case StreamError::Kind::value:
    return ExitCode::bad_input;
  case StreamError::Kind::io:
    return ExitCode::io;
  case StreamError::Kind::closed:
    return ExitCode::ok; // nobody wants more of it: not our failure
  }
  return ExitCode::internal;
}

// Thrown by --help and its like after the text has been written.
struct Finished {};

void print_to_stdout(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    fail(ExitCode::io, "cannot write to standard output");
  throw Finished{};
}

// A word that no option has taken.
[[noreturn]] void refuse(const std::string& word, const std::vector<std::string>& spellings, const std::string& tool) {
  if (word.size() < 2 || word[0] != '-')
    fail(ExitCode::usage, "argument \"{}\" is one too many (see {} --help)", word, tool);
  const std::vector<std::string_view> known(spellings.begin(), spellings.end());
  const std::string_view nearest = nearest_word(word.substr(0, word.find('=')), known);
  fail(ExitCode::usage, "unknown option {}{} (see {} --help)", word,
       nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest), tool);
}

} // namespace

Tool::Tool(std::string name, std::string summary, std::string description)
    : name_(std::move(name)), summary_(std::move(summary)), description_(std::move(description)) {}

void Tool::add(Option option) {
  if (!option.is_flag && !option.is_argument)
    for (const std::string& value : option.get())
      option.default_text += (option.default_text.empty() ? "" : " ") + value;
  options_.push_back(std::move(option));
}

void Tool::option(std::string_view names, double& value, std::string_view placeholder, std::string_view text,
                  Provenance provenance) {
  custom(
      names, placeholder, text, [&value](const std::string& s) { value = parse_number<double>(s, "a finite number"); },
      [&value] { return fmt::format("{}", value); }, provenance);
}

void Tool::option(std::string_view names, std::optional<double>& value, std::string_view placeholder,
                  std::string_view text, Provenance provenance) {
  custom(
      names, placeholder, text, [&value](const std::string& s) { value = parse_number<double>(s, "a finite number"); },
      [&value] { return value ? fmt::format("{}", *value) : std::string(); }, provenance);
}

void Tool::option(std::string_view names, std::int64_t& value, std::string_view placeholder, std::string_view text,
                  Provenance provenance) {
  custom(
      names, placeholder, text,
      [&value](const std::string& s) { value = parse_number<std::int64_t>(s, "a whole number"); },
      [&value] { return fmt::format("{}", value); }, provenance);
}

void Tool::option(std::string_view names, std::optional<std::int64_t>& value, std::string_view placeholder,
                  std::string_view text, Provenance provenance) {
  custom(
      names, placeholder, text,
      [&value](const std::string& s) { value = parse_number<std::int64_t>(s, "a whole number"); },
      [&value] { return value ? fmt::format("{}", *value) : std::string(); }, provenance);
}

void Tool::option(std::string_view names, std::string& value, std::string_view placeholder, std::string_view text,
                  Provenance provenance) {
  custom(
      names, placeholder, text, [&value](const std::string& s) { value = s; }, [&value] { return value; }, provenance);
}

void Tool::may_be_empty() { options_.back().may_be_empty = true; }

void Tool::option(std::string_view names, std::vector<std::string>& values, std::string_view placeholder,
                  std::string_view text, std::vector<std::string> completions) {
  Option o;
  o.names = names;
  o.placeholder = placeholder;
  o.text = text;
  o.is_list = true;
  o.words = std::move(completions);
  o.set = [&values](const std::string& s) { values.push_back(s); };
  o.get = [&values] { return values; };
  add(std::move(o));
}

void Tool::flag(std::string_view names, bool& value, std::string_view text, Provenance provenance) {
  Option o;
  o.names = names;
  o.text = text;
  o.is_flag = true;
  o.provenance = provenance;
  o.set = [&value](const std::string&) { value = true; };
  o.get = [&value] { return value ? std::vector<std::string>{""} : std::vector<std::string>{}; };
  add(std::move(o));
}

void Tool::choice_of_word(std::string_view names, std::vector<std::string> words, std::string_view text,
                          std::function<void(std::size_t)> set, std::function<std::size_t()> get) {
  Option o;
  o.names = names;
  o.text = text;
  constexpr std::size_t widest = 80; // of a line of help
  o.placeholder = fmt::format("{}", fmt::join(words, "|"));
  if (o.placeholder.size() > widest) {
    o.placeholder = "WORD";
    o.text += fmt::format("; one of {}", fmt::join(words, ", "));
  }
  o.set = [set = std::move(set), words](const std::string& s) {
    const auto it = std::find(words.begin(), words.end(), s);
    if (it == words.end())
      fail(ExitCode::usage, "\"{}\" is not one of {}", s, fmt::join(words, ", "));
    set(static_cast<std::size_t>(it - words.begin()));
  };
  o.get = [get = std::move(get), words] { return std::vector{words[get()]}; };
  o.words = std::move(words);
  add(std::move(o));
}

void Tool::custom(std::string_view names, std::string_view placeholder, std::string_view text,
                  std::function<void(const std::string&)> set, std::function<std::string()> print,
                  Provenance provenance, std::vector<std::string> words) {
  Option o;
  o.names = names;
  o.placeholder = placeholder;
  o.text = text;
  o.provenance = provenance;
  o.set = std::move(set);
  o.get = [print = std::move(print)] {
    const std::string value = print();
    return value.empty() ? std::vector<std::string>{} : std::vector{value};
  };
  o.words = std::move(words);
  add(std::move(o));
}

void Tool::argument(std::string_view name, std::string& value, std::string_view text) {
  Option o;
  o.names = o.placeholder = name;
  o.text = text;
  o.is_argument = true;
  o.provenance = Provenance::omit;
  o.set = [&value](const std::string& s) { value = s; };
  o.get = [&value] { return std::vector{value}; };
  add(std::move(o));
}

void Tool::required_argument(std::string_view name, std::string& value, std::string_view text) {
  argument(name, value, text);
  options_.back().is_required = true;
}

void Tool::arguments(std::string_view name, std::vector<std::string>& values, std::string_view text) {
  Option o;
  o.names = o.placeholder = name;
  o.text = text;
  o.is_argument = o.is_list = true;
  o.provenance = Provenance::omit;
  o.set = [&values](const std::string& s) { values.push_back(s); };
  o.get = [&values] { return values; };
  add(std::move(o));
}

void Tool::example(std::string command, std::string text) {
  examples_.emplace_back(std::move(command), std::move(text));
}
void Tool::exit_status(std::string text) { exit_status_ = std::move(text); }
void Tool::section(std::string title, std::string text) { sections_.emplace_back(std::move(title), std::move(text)); }

// What is asked of the program itself comes before everything that may be wrong with the rest of the line.
void Tool::tell_of_itself(int argc, char** argv) const {
  for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i) {
    const std::string_view word = argv[i];
    if (word == "-h" || word == "--help")
      print_to_stdout(help_text());
    if (word == "--version")
      print_to_stdout(fmt::format("{} {}\n", name_, version_text));
    if (word == "--man")
      print_to_stdout(man_page());
    if (word == "--completion")
      print_to_stdout(completion_script());
  }
}

// The words of the command line, in which --title= has a word of its own for what is empty: CLI11 would take the next.
std::vector<std::string> Tool::words_of(int argc, char** argv) const {
  std::vector<std::string> words(argv + 1, argv + argc);
  for (auto word = words.begin(); word != words.end() && *word != "--"; ++word) {
    if (!word->starts_with("--") || word->find('=') != word->size() - 1)
      continue;
    const std::string name = word->substr(0, word->size() - 1);
    const bool has_value = std::ranges::any_of(options_, [&](const Option& option) {
      const std::vector<std::string> spellings = CLI::detail::split(option.names, ',');
      return !option.is_flag && std::ranges::find(spellings, name) != spellings.end();
    });
    if (has_value) {
      *word = name;
      word = words.insert(word + 1, "");
    }
  }
  return words;
}

void Tool::parse(int argc, char** argv) {
  CLI::App app;
  app.set_help_flag();
  app.allow_extras();
  for (const Option& option : options_) {
    const auto set = [&option](const CLI::results_t& values) {
      for (const std::string& value : values) {
        try {
          if (value.empty() && !option.may_be_empty)
            fail(ExitCode::usage, "nothing is given: \"\" is what a variable gives that is not set");
          option.set(value);
        } catch (const Error& error) {
          fail(ExitCode::usage, "{}: {} (see {} --help)", option.names, error.what(), log::program());
        }
      }
      return true;
    };
    if (option.is_flag) {
      app.add_flag_callback(option.names, [&option] { option.set(""); });
      continue;
    }
    CLI::Option* o = app.add_option(option.names, set);
    o->expected(1);
    if (option.is_list && option.is_argument)
      o->expected(1, CLI::detail::expected_max_vector_size)->allow_extra_args();
    if (option.is_list && !option.is_argument)
      o->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)->expected(1)->allow_extra_args(false);
    else if (!option.is_list)
      o->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    if (option.is_required)
      o->required();
  }
  bool help = false, version = false, man = false, completion = false;
  app.add_flag("-h,--help", help);
  app.add_flag("--version", version);
  app.add_flag("--man", man);
  app.add_flag("--completion", completion);
  tell_of_itself(argc, argv);
  try {
    std::vector<std::string> words = words_of(argc, argv);
    std::ranges::reverse(words); // as CLI11 takes them
    app.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    fail(ExitCode::usage, "{} (see {} --help)", error.what(), name_);
  }
  std::vector<std::string> spellings;
  for (const Option& option : options_)
    for (const std::string& spelling : CLI::detail::split(option.names, ','))
      if (spelling[0] == '-')
        spellings.push_back(spelling);
  for (const std::string& extra : app.remaining()) {
    if (extra != "--") // CLI11 leaves the separator behind
      refuse(extra, spellings, name_);
  }
}

int Tool::run(int argc, char** argv, const std::function<void()>& body) {
  log::set_program(name_);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN); // a file may not grow further: as on a full disk
  first_common_ = options_.size();
  option("--threads", threads_, "N", "threads to use; 0 means one for each core", Provenance::omit);
  flag("-q,--quiet", quiet_, "errors only", Provenance::omit);
  flag("-v,--verbose", verbose_, "say more about what is done", Provenance::omit);
  const auto report = [](ExitCode code, const char* message) {
    log::error(message);
    return static_cast<int>(code);
  };
  try {
    parse(argc, argv);
    if (quiet_ && verbose_)
      fail(ExitCode::usage, "-q and -v exclude each other");
    log::set_level(quiet_ ? log::Level::quiet : verbose_ ? log::Level::verbose : log::Level::normal);
    const ThreadLimit limit(threads_);
    body();
    return 0;
  } catch (const Finished&) {
    return 0;
  } catch (const Error& error) {
    return report(error.code(), error.what());
  } catch (const StreamError& error) {
    return error.kind() == StreamError::Kind::closed ? 0 : report(code_of(error), error.what());
  } catch (const std::bad_alloc&) {
    return report(ExitCode::io, "not enough memory");
  } catch (const std::length_error&) {
    return report(ExitCode::io, "not enough memory");
  } catch (const std::filesystem::filesystem_error& error) {
    return report(ExitCode::io, error.what());
  } catch (const std::exception& error) {
    if (std::string_view(error.what()).starts_with("pthread_create has failed")) // oneTBB's, where a stack has no room
      return report(ExitCode::io, "not enough memory for another thread");
    return report(ExitCode::internal, fmt::format("internal error: {}", error.what()).c_str());
  }
}

std::string Tool::command_line() const {
  std::string line = fmt::format("{} ({})", name_, version_text);
  for (const Option& option : options_) {
    if (option.provenance == Provenance::omit)
      continue;
    const std::vector<std::string> values = option.get();
    std::string joined;
    for (const std::string& value : values)
      joined += (joined.empty() ? "" : " ") + value;
    if (!option.is_flag && joined == option.default_text)
      continue;
    const std::string name = option.names.substr(option.names.rfind(',') + 1);
    for (const std::string& value : values) {
      line += " " + name;
      if (!option.is_flag)
        line += " " + shell_quoted(value);
    }
  }
  return line;
}

} // namespace sheet
