// SPDX-License-Identifier: GPL-3.0-or-later
// validate: runs validation cases and prints rows of tab-separated values.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "libsheet/base/error.h"
#include "libsheet/base/parallel.h"
#include "tests/validation/table.h"

using namespace sheet;
using namespace sheet::validation;

namespace {

constexpr const char* usage_text =
    "validate --list                      the cases, their sets and default sizes\n"
    "validate CASE... [options]           rows of results; lists (1,2,3) are swept, each combination\n"
    "  --set N  --edge X (over the case's length)  --steps N  --scheme sdirk2|backward-euler\n"
    "  --thickness coupled|explicit  --bending mid-edge|arcs|hinge|hinge-paper|none\n"
    "  --pattern structured|equilateral|irregular  --seed N\n"
    "  --no-times                         leaves out the column of seconds, so that the same run prints the same\n"
    "  --series                           the run itself instead, a row a step (V1, V2, V3)\n"
    "  --threads N                        default 1\n"
    "validate --orders CASE... [options]  observed orders in time and space, halving twice from the settings\n"
    "validate --check FILE...             runs what the tables say and compares the errors with theirs\n";

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> words(1);
  for (const char c : list)
    if (c == ',')
      words.emplace_back();
    else
      words.back() += c;
  return words;
}

void list_cases() {
  for (const Case& c : cases())
    std::printf("%-4s %s; %s, edge %g, %d steps\n", c.name.c_str(), c.title.c_str(), c.quantity.c_str(),
                c.defaults.edge, c.defaults.steps);
}

void sweep(const Case& c, const std::vector<Settings>& all, bool times, bool series) {
  for (const Settings& s : all) {
    const Result r = run(c, s);
    if (!series) {
      std::fputs(row(c, s, r, times).c_str(), stdout);
    } else {
      std::printf("case\tset\t%s\n", c.series.c_str());
      for (const auto& values : r.series) {
        std::printf("%s\t%d", c.name.c_str(), s.set);
        for (const double x : values)
          std::printf("\t%.8g", x);
        std::putchar('\n');
      }
    }
    std::fflush(stdout);
  }
}

void orders(const Case& c, const std::vector<Settings>& all) {
  for (const Settings& s : all) {
    const auto print = [&](const char* of, const Orders& o) {
      std::printf("%s\t%d\t%s\t%.4g\t%d\t%.4e\t%.4e\t%.4e\t%.3f\n", c.name.c_str(), s.set, of, s.edge, s.steps,
                  o.error[0], o.error[1], o.error[2], o.order);
      std::fflush(stdout);
    };
    if (c.in_time)
      print(s.scheme == Scheme::sdirk2 ? "time (sdirk2)" : "time (backward-euler)", time_order(c, s));
    if (c.in_space)
      print("space", space_order(c, s));
  }
}

// Stored errors hold to 2 % of themselves and 1e-7 (1e-10 where they are round-off).
int check(const std::string& path) {
  int bad = 0;
  for (const Stored& stored : read_table(path)) {
    const Result r = run(find_case(stored.name), stored.settings);
    const double off = std::abs(r.error - stored.error), round_off = std::abs(stored.error) < 1e-10 ? 1e-10 : 1e-7;
    const bool good = off <= std::max(0.02 * std::abs(stored.error), round_off);
    std::printf("%s %s set %d edge %g steps %d: error %.4e, stored %.4e\n", good ? "ok  " : "FAIL", stored.name.c_str(),
                stored.settings.set, stored.settings.edge, stored.settings.steps, r.error, stored.error);
    bad += !good;
  }
  return bad ? 1 : 0;
}

int run_tool(const std::vector<std::string>& arguments) {
  std::vector<std::string> names;
  std::vector<std::pair<std::string, std::vector<std::string>>> lists;
  bool times = true, series = false, order = false, check_tables = false;
  int threads = 1;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const std::string& a = arguments[k];
    if (a == "--help" || a == "--list") {
      a == "--help" ? void(std::fputs(usage_text, stdout)) : list_cases();
      return 0;
    }
    if (a == "--no-times")
      times = false;
    else if (a == "--series")
      series = true;
    else if (a == "--orders")
      order = true;
    else if (a == "--check")
      check_tables = true;
    else if (a.rfind("--", 0) != 0)
      names.push_back(a);
    else if (k + 1 == arguments.size())
      fail(ExitCode::usage, "{} needs a value", a);
    else if (a == "--threads")
      threads = std::stoi(arguments[++k]);
    else
      lists.emplace_back(a.substr(2), split(arguments[k + 1])), ++k;
  }
  if (names.empty())
    fail(ExitCode::usage, "which case? See validate --help");
  const ThreadLimit limit(threads);
  if (check_tables) {
    int bad = 0;
    for (const std::string& path : names)
      bad |= check(path);
    return bad;
  }
  if (order)
    std::printf("case\tset\torder_in\tedge\tsteps\terror_1\terror_2\terror_4\torder\n");
  else if (!series)
    std::fputs(header(times).c_str(), stdout);
  for (const std::string& name : names) {
    const Case& c = find_case(name);
    std::vector<Settings> all{c.defaults};
    for (const auto& [option, words] : lists) {
      std::vector<Settings> more;
      for (const Settings& s : all)
        for (const std::string& word : words)
          assign(more.emplace_back(s), option, word);
      all = more;
    }
    if (order)
      orders(c, all);
    else
      sweep(c, all, times, series);
  }
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  try {
    return run_tool({argv + 1, argv + argc});
  } catch (const Error& e) {
    std::fprintf(stderr, "validate: %s\n", e.what());
    return static_cast<int>(e.code());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "validate: %s\n", e.what());
    return 1;
  }
}
