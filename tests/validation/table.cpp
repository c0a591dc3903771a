// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/validation/table.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "libsheet/base/error.h"

namespace sheet::validation {

namespace {

template <class T> using Names = std::vector<std::pair<const char*, T>>;

const Names<Scheme> schemes{{"sdirk2", Scheme::sdirk2}, {"backward-euler", Scheme::backward_euler}};
const Names<Thickness> thicknesses{{"coupled", Thickness::coupled}, {"explicit", Thickness::as_started}};
const Names<Shell> shells{{"mid-edge", Shell::mid_edge},
                          {"arcs", Shell::arcs},
                          {"hinge", Shell::hinge},
                          {"hinge-paper", Shell::hinge_paper},
                          {"none", Shell::none}};
const Names<Pattern> patterns{
    {"structured", Pattern::structured}, {"equilateral", Pattern::equilateral}, {"irregular", Pattern::irregular}};

template <class T> T parse(const Names<T>& names, const std::string& option, const std::string& word) {
  std::string all;
  for (const auto& [name, value] : names) {
    if (word == name)
      return value;
    all += std::string(" ") + name;
  }
  fail(ExitCode::usage, "--{} is one of{}, not {}", option, all, word);
}

template <class T> const char* print(const Names<T>& names, T wanted) {
  for (const auto& [name, value] : names)
    if (value == wanted)
      return name;
  return "?";
}

double number(const std::string& option, const std::string& word) {
  char* end = nullptr;
  const double x = std::strtod(word.c_str(), &end);
  if (word.empty() || *end || !(x > 0))
    fail(ExitCode::usage, "--{} needs a positive number, not {}", option, word);
  return x;
}

} // namespace

void assign(Settings& s, const std::string& option, const std::string& word) {
  if (option == "set")
    s.set = static_cast<int>(number(option, word));
  else if (option == "edge")
    s.edge = number(option, word);
  else if (option == "steps")
    s.steps = static_cast<int>(number(option, word));
  else if (option == "seed")
    s.seed = static_cast<std::uint64_t>(number(option, word));
  else if (option == "scheme")
    s.scheme = parse(schemes, option, word);
  else if (option == "thickness")
    s.thickness = parse(thicknesses, option, word);
  else if (option == "bending")
    s.bending = parse(shells, option, word);
  else if (option == "pattern")
    s.pattern = parse(patterns, option, word);
  else
    fail(ExitCode::usage, "there is no option --{}", option);
}

std::string header(bool times) {
  return std::string("case\tset\tedge\tsteps\tscheme\tthickness\tbending\tpattern\tseed\tvertices\tmean_edge\tvalue\t"
                     "error\titerations\tfailed") +
         (times ? "\tseconds" : "") + "\tmore\n";
}

std::string row(const Case& c, const Settings& s, const Result& r, bool times) {
  std::string line =
      fmt::format("{}\t{}\t{:.6g}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{:.4g}\t{:.9g}\t{:.4e}\t{}\t{}", c.name, s.set, s.edge,
                  r.steps, print(schemes, s.scheme), print(thicknesses, s.thickness), print(shells, s.bending),
                  print(patterns, s.pattern), s.seed, r.vertices, r.edge, r.value, r.error, r.iterations, r.failed);
  if (times)
    line += fmt::format("\t{:.4g}", r.seconds);
  line += '\t';
  for (const auto& [name, value] : r.more)
    line += fmt::format("{}={:.6g} ", name, value);
  if (line.back() == ' ')
    line.pop_back();
  return line + "\n";
}

std::vector<Stored> read_table(const std::string& path) {
  std::ifstream file(path);
  std::vector<Stored> rows;
  std::vector<std::string> names;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> words;
    std::istringstream in(line);
    for (std::string word; std::getline(in, word, '\t');)
      words.push_back(word);
    if (names.empty()) {
      names = words;
      continue;
    }
    Stored stored;
    for (std::size_t k = 0; k < words.size() && k < names.size(); ++k)
      if (names[k] == "case")
        stored.name = words[k];
      else if (names[k] == "error")
        stored.error = std::strtod(words[k].c_str(), nullptr);
      else if (k < 9)
        assign(stored.settings, names[k], words[k]);
    rows.push_back(stored);
  }
  if (rows.empty())
    fail(ExitCode::io, "{}: no table of results", path);
  return rows;
}

Orders time_order(const Case& c, Settings s) {
  Orders o{};
  for (int k = 0; k < 3; ++k, s.steps *= 2) {
    const Result r = run(c, s);
    o.value[k] = r.value, o.error[k] = r.error;
  }
  o.order = std::log2(std::abs((o.value[0] - o.value[1]) / (o.value[1] - o.value[2])));
  return o;
}

Orders space_order(const Case& c, Settings s) {
  Orders o{};
  for (int k = 0; k < 3; ++k, s.edge /= 2) {
    const Result r = run(c, s);
    double ahead = 0; // from this step size to none
    if (c.in_time) {
      Settings finer = s;
      finer.steps = 2 * (s.steps ? s.steps : c.defaults.steps);
      const double gain = run(c, finer).value - r.value;
      ahead = s.scheme == Scheme::sdirk2 ? gain * 4 / 3 : gain * 2;
    }
    o.value[k] = r.value + ahead, o.error[k] = r.error + ahead;
  }
  o.order = 0.5 * std::log2(std::abs(o.error[0] / o.error[2]));
  return o;
}

} // namespace sheet::validation
