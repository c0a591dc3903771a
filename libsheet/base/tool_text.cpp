// SPDX-License-Identifier: GPL-3.0-or-later
// Help, man page and bash completion, made from a Tool's declarations.
#include <algorithm>
#include <cctype>

#include <fmt/core.h>

#include "libsheet/base/tool.h"
#include "libsheet/base/version.h"

namespace sheet {

namespace {

constexpr std::size_t width = 100; // columns of the help text

// Wraps `text` to `width`, every line behind `indent` blanks; keeps line breaks and lines that start with a blank.
std::string wrapped(std::string_view text, std::size_t indent) {
  std::string out;
  std::size_t start = 0;
  while (start <= text.size()) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    std::string_view line = text.substr(start, end - start);
    start = end + 1;
    while (line.size() > width - indent && line[0] != ' ') {
      std::size_t cut = line.rfind(' ', width - indent);
      if (cut == std::string_view::npos)
        break;
      out += std::string(indent, ' ') + std::string(line.substr(0, cut)) + "\n";
      line.remove_prefix(cut + 1);
    }
    out += (line.empty() ? "" : std::string(indent, ' ') + std::string(line)) + "\n";
  }
  return out;
}

// Text for troff: backslashes and leading dots must not act.
std::string troff(std::string_view text) {
  std::string out;
  bool line_start = true;
  for (const char c : text) {
    if (line_start && (c == '.' || c == '\''))
      out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    line_start = c == '\n';
  }
  return out;
}

std::string spaced_names(const std::string& names) {
  std::string out;
  for (const char c : names)
    out += c == ',' ? std::string(", ") : std::string(1, c);
  return out;
}

} // namespace

std::string Tool::synopsis() const {
  std::string out = name_ + " [OPTION]...";
  for (const Option& o : options_)
    if (o.is_argument)
      out += o.is_required ? " " + o.placeholder : fmt::format(" [{}]{}", o.placeholder, o.is_list ? "..." : "");
  return out;
}

std::string Tool::default_note(const Option& option) {
  if (option.is_flag || option.is_argument || option.default_text.empty())
    return {};
  return fmt::format(" (default {})", option.default_text);
}

std::string Tool::help_text() const {
  std::string out = fmt::format("{} - {}\n\nUsage: {}\n\n{}", name_, summary_, synopsis(), wrapped(description_, 0));
  const auto list = [&](std::string_view title, auto wanted) {
    std::string lines;
    for (std::size_t i = 0; i < options_.size(); ++i) {
      const Option& o = options_[i];
      if (!wanted(i, o))
        continue;
      std::string head = o.is_argument ? o.placeholder : spaced_names(o.names);
      if (!o.is_argument && !o.placeholder.empty())
        head += " " + o.placeholder;
      const std::string text = wrapped(o.text + default_note(o), 26);
      lines +=
          head.size() < 23 ? fmt::format("  {:<24}{}", head, text.substr(26)) : fmt::format("  {}\n{}", head, text);
    }
    if (!lines.empty())
      out += fmt::format("\n{}:\n{}", title, lines);
  };
  list("Arguments", [&](std::size_t, const Option& o) { return o.is_argument; });
  list("Options", [&](std::size_t i, const Option& o) { return !o.is_argument && i < first_common_; });
  list("Options of every program", [&](std::size_t i, const Option&) { return i >= first_common_; });
  out += fmt::format("  {:<24}{}\n  {:<24}{}\n", "-h, --help", "this text", "--version", "name and version");
  for (const auto& [title, text] : sections_)
    out += fmt::format("\n{}:\n{}", title, wrapped(text, 2));
  out += "\nExit status:\n" + wrapped(exit_status_, 2);
  if (!examples_.empty())
    out += "\nExamples:\n";
  for (const auto& [command, text] : examples_)
    out += fmt::format("  {}\n{}", command, wrapped(text, 6));
  return out;
}

std::string Tool::man_page() const {
  std::string out = fmt::format(".TH {} 1 \"\" \"sheet {}\" \"Sheet\"\n.SH NAME\n{} \\- {}\n", name_, version_text,
                                troff(name_), troff(summary_));
  out += fmt::format(".SH SYNOPSIS\n.B {}\n.SH DESCRIPTION\n{}\n", troff(synopsis()), troff(description_));
  out += ".SH OPTIONS\n";
  const auto entry = [&](const std::string& head, const std::string& text) {
    out += fmt::format(".TP\n.B {}\n{}\n", troff(head), troff(text));
  };
  for (const Option& o : options_) {
    const std::string head = o.is_argument ? o.placeholder : spaced_names(o.names) + " " + o.placeholder;
    entry(head, o.text + default_note(o));
  }
  entry("-h, --help", "show a summary of options");
  entry("--version", "show name and version");
  for (const auto& [title, text] : sections_) {
    std::string upper = title;
    for (char& c : upper)
      c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    out += fmt::format(".SH {}\n{}\n", troff(upper), troff(text));
  }
  out += fmt::format(".SH EXIT STATUS\n{}\n", troff(exit_status_));
  if (!examples_.empty())
    out += ".SH EXAMPLES\n";
  for (const auto& [command, text] : examples_)
    out += fmt::format(".TP\n.B {}\n{}\n", troff(command), troff(text));
  out += ".SH SEE ALSO\n.BR sheet\\-init (1),\n.BR sheet\\-loop (1),\n.BR sheet\\-info (1)\n";
  return out;
}

std::string Tool::completion_script() const {
  std::string function = "_" + name_;
  for (char& c : function)
    c = c == '-' ? '_' : c;
  std::string words = "--help --version", cases;
  for (const Option& o : options_) {
    if (o.is_argument)
      continue;
    std::string pattern;
    for (const char c : o.names)
      pattern += c == ',' ? '|' : c;
    for (const char c : " " + o.names)
      words += c == ',' ? ' ' : c;
    std::string choices;
    for (const std::string& word : o.words)
      choices += (choices.empty() ? "" : " ") + word;
    if (!choices.empty())
      cases += fmt::format(
          "    {})\n      mapfile -t COMPREPLY < <(compgen -W '{}' -- \"$word\")\n{}      return\n      ;;\n", pattern,
          choices, choices.back() == '=' ? "      compopt -o nospace\n" : "");
    else if (!o.is_flag && o.placeholder != "FILE")
      cases += fmt::format("    {})\n      COMPREPLY=()\n      return\n      ;;\n", pattern);
  }
  return fmt::format("# bash completion for {0}\n"
                     "{1}() {{\n"
                     "  local word=\"${{COMP_WORDS[COMP_CWORD]}}\" before=\"${{COMP_WORDS[COMP_CWORD - 1]}}\"\n"
                     "  case $before in\n{2}  esac\n"
                     "  if [[ $word == -* ]]; then\n"
                     "    mapfile -t COMPREPLY < <(compgen -W '{3}' -- \"$word\")\n"
                     "  else\n"
                     "    mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n"
                     "  fi\n"
                     "}}\n"
                     "complete -o filenames -F {1} {0}\n",
                     name_, function, cases, words);
}

} // namespace sheet
