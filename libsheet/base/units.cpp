// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/base/units.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <utility>

namespace sheet {
namespace {

// A unit's size in SI: 10^ten * numerator / denominator. Tens are kept apart so that they can go into the decimal text.
struct Unit {
  Dimension dimension;
  int ten = 0;
  double numerator = 1, denominator = 1;
};

struct NamedUnit {
  std::string_view name;
  Unit unit;
  bool prefixes; // may take SI prefixes
};

constexpr double pi = std::numbers::pi;

constexpr std::array units{
    NamedUnit{"m", {{0, 1, 0}}, true},
    NamedUnit{"g", {{1, 0, 0}, -3}, true},
    NamedUnit{"s", {{0, 0, 1}}, true},
    NamedUnit{"min", {{0, 0, 1}, 0, 60}, false},
    NamedUnit{"h", {{0, 0, 1}, 2, 36}, false},
    NamedUnit{"d", {{0, 0, 1}, 0, 86400}, false},
    NamedUnit{"a", {{0, 0, 1}, 0, 31557600}, false}, // a year of 365.25 days
    NamedUnit{"ka", {{0, 0, 1}, 3, 31557600}, false},
    NamedUnit{"Ma", {{0, 0, 1}, 6, 31557600}, false},
    NamedUnit{"yr", {{0, 0, 1}, 0, 31557600}, false},
    NamedUnit{"kyr", {{0, 0, 1}, 3, 31557600}, false},
    NamedUnit{"Myr", {{0, 0, 1}, 6, 31557600}, false},
    NamedUnit{"K", {{0, 0, 0, 1}}, true},
    NamedUnit{"mol", {{0, 0, 0, 0, 1}}, true},
    NamedUnit{"Hz", {{0, 0, -1}}, true},
    NamedUnit{"N", {{1, 1, -2}}, true},
    NamedUnit{"dyn", {{1, 1, -2}, -5}, false},
    NamedUnit{"dyne", {{1, 1, -2}, -5}, false},
    NamedUnit{"Pa", {{1, -1, -2}}, true},
    NamedUnit{"bar", {{1, -1, -2}, 5}, true},
    NamedUnit{"J", {{1, 2, -2}}, true},
    NamedUnit{"W", {{1, 2, -3}}, true},
    NamedUnit{"Pas", {{1, -1, -1}}, true},
    NamedUnit{"P", {{1, -1, -1}, -1}, true},
    NamedUnit{"cps", {{1, -1, -1}, -3}, false}, // centipoise
    NamedUnit{"St", {{0, 2, -1}, -4}, true},
    NamedUnit{"l", {{0, 3, 0}, -3}, true},
    NamedUnit{"L", {{0, 3, 0}, -3}, true},
    NamedUnit{"cc", {{0, 3, 0}, -6}, false},
    NamedUnit{"in", {{0, 1, 0}, 0, 127, 5000}, false},
    NamedUnit{"inch", {{0, 1, 0}, 0, 127, 5000}, false},
    NamedUnit{"ft", {{0, 1, 0}, 0, 381, 1250}, false},
    NamedUnit{"lb", {{1, 0, 0}, -8, 45359237}, false},
    NamedUnit{"lbf", {{1, 1, -2}, -13, 44482216152605}, false},
    NamedUnit{"psi", {{1, -1, -2}, -4, 8896443230521, 129032}, false}, // pounds of force a square inch
    NamedUnit{"rad", {{0, 0, 0}}, true},
    NamedUnit{"deg", {{0, 0, 0}, 0, pi, 180}, false},
    NamedUnit{"°", {{0, 0, 0}, 0, pi, 180}, false},
    NamedUnit{"turn", {{0, 0, 0}, 0, 2 * pi}, false},
    NamedUnit{"rpm", {{0, 0, -1}, 0, pi, 30}, false},
    NamedUnit{"rps", {{0, 0, -1}, 0, 2 * pi}, false},
    NamedUnit{"%", {{0, 0, 0}, -2}, false},
    NamedUnit{"1", {}, false},
};

// Other names of the same, which lists of what is known leave out.
constexpr std::array<std::pair<std::string_view, std::string_view>, 16> spellings{{{"sec", "s"},
                                                                                   {"second", "s"},
                                                                                   {"seconds", "s"},
                                                                                   {"msec", "ms"},
                                                                                   {"minute", "min"},
                                                                                   {"minutes", "min"},
                                                                                   {"hr", "h"},
                                                                                   {"hour", "h"},
                                                                                   {"hours", "h"},
                                                                                   {"day", "d"},
                                                                                   {"days", "d"},
                                                                                   {"year", "a"},
                                                                                   {"years", "a"},
                                                                                   {"Poise", "P"},
                                                                                   {"poise", "P"},
                                                                                   {"centipoise", "cP"}}};

struct Prefix {
  std::string_view name;
  int ten;
};

constexpr std::array prefixes{Prefix{"n", -9}, Prefix{"u", -6}, Prefix{"\u00b5", -6}, Prefix{"\u03bc", -6},
                              Prefix{"m", -3}, Prefix{"c", -2}, Prefix{"d", -1},      Prefix{"k", 3},
                              Prefix{"M", 6},  Prefix{"G", 9}};

std::optional<Unit> find_unit(std::string_view name) {
  if (const auto* other = std::ranges::find(spellings, name, &std::pair<std::string_view, std::string_view>::first);
      other != spellings.end())
    name = other->second;
  for (const NamedUnit& known : units)
    if (known.name == name)
      return known.unit;
  for (const Prefix& prefix : prefixes) {
    if (!name.starts_with(prefix.name))
      continue;
    for (const NamedUnit& known : units)
      if (known.prefixes && known.name == name.substr(prefix.name.size())) {
        Unit unit = known.unit;
        unit.ten += prefix.ten;
        return unit;
      }
  }
  return {};
}

constexpr Dimension kinematic_viscosity{0, 2, -1};
constexpr double zero_celsius = 273.15; // [K], by definition

bool is_celsius(std::string_view name) { return name == "°C" || name == "degC" || name == "\u2103"; }

// a *= b^power
void multiply(Unit& a, const Unit& b, int power) {
  a.dimension.kg += b.dimension.kg * power;
  a.dimension.m += b.dimension.m * power;
  a.dimension.s += b.dimension.s * power;
  a.dimension.K += b.dimension.K * power;
  a.dimension.mol += b.dimension.mol * power;
  a.ten += b.ten * power;
  for (int i = 0; i < std::abs(power); ++i) {
    a.numerator *= power > 0 ? b.numerator : b.denominator;
    a.denominator *= power > 0 ? b.denominator : b.numerator;
  }
}

constexpr int largest_power = 9;
constexpr std::string_view unknown_unit = "unknown unit";

// Recursive descent over a unit's text; the first problem ends it.
class UnitParser {
public:
  UnitParser(std::string_view text, std::string& problem) : rest_(text), whole_(text), problem_(problem) {}

  std::optional<Unit> parse() {
    Unit unit = product(0, true);
    if (problem_.empty() && !rest_.empty())
      fail_at_rest();
    if (!problem_.empty())
      return {};
    return unit;
  }

private:
  Unit product(int depth, bool outermost) {
    Unit result;
    bool divide = outermost && take("/"); // what is left of "1/s" once its number is read
    bool divided = divide;
    for (;;) {
      multiply(result, factor(depth), divide ? -1 : 1);
      if (!problem_.empty())
        return result;
      const bool blank = take(" ");
      while (take(" ")) {
      }
      if (take("/"))
        divide = divided = true;
      else if (take("*") || take("·") || take("."))
        divide = false;
      else if (blank && !rest_.empty() && rest_.front() != ')') {
        if (divided) {
          problem_ = fmt::format("unit \"{}\" is ambiguous: write brackets, as in \"kg/(m*s)\"", whole_);
          return result;
        }
        divide = false;
      } else
        return result;
    }
  }

  Unit factor(int depth) {
    while (take(" ")) {
    }
    Unit base;
    if (take("(")) {
      if (depth == largest_depth) {
        problem_ = "too many brackets in a unit";
        return base;
      }
      base = product(depth + 1, false);
      if (!problem_.empty())
        return base;
      if (!take(")")) {
        problem_ = fmt::format("missing \")\" in unit \"{}\"", whole_);
        return base;
      }
    } else {
      const std::string_view name = take_name();
      const auto found = find_unit(name);
      if (!found) {
        if (name.empty())
          fail_at_rest();
        else if (is_celsius(name))
          problem_ = fmt::format("\"{}\" counts from 273.15 K, so it stands behind a temperature alone: write K", name);
        else
          problem_ = fmt::format("{} \"{}\"", unknown_unit, name);
        return base;
      }
      base = *found;
    }
    Unit result;
    multiply(result, base, power());
    return result;
  }

  int power() {
    if (take("²"))
      return 2;
    if (take("³"))
      return 3;
    const bool caret = take("^");
    int value = 0;
    const bool plus = caret && take("+");
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error == std::errc::invalid_argument && !caret)
      return 1;
    if (error != std::errc{} || std::abs(value) > largest_power || (plus && value < 0)) {
      problem_ =
          fmt::format("a power in a unit must be an integer from -{0} to {0}, in \"{1}\"", largest_power, whole_);
      return 1;
    }
    rest_.remove_prefix(end - rest_.data());
    return value;
  }

  // A name runs to the next digit, sign or blank; "1" (as in 1/s) is one too.
  std::string_view take_name() {
    if (rest_.starts_with("1") && (rest_.size() == 1 || rest_[1] < '0' || rest_[1] > '9')) {
      rest_.remove_prefix(1);
      return "1";
    }
    std::size_t end = 0;
    while (end < rest_.size() && std::string_view(" */^()+-.0123456789").find(rest_[end]) == std::string_view::npos &&
           !rest_.substr(end).starts_with("·") && !rest_.substr(end).starts_with("²") &&
           !rest_.substr(end).starts_with("³"))
      ++end;
    const std::string_view name = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return name;
  }

  bool take(std::string_view token) {
    if (!rest_.starts_with(token))
      return false;
    rest_.remove_prefix(token.size());
    return true;
  }

  void fail_at_rest() {
    problem_ = rest_.empty() ? fmt::format("unit \"{}\" ends too early", whole_)
                             : fmt::format("cannot read \"{}\" in unit \"{}\"", rest_, whole_);
  }

  static constexpr int largest_depth = 8;
  std::string_view rest_, whole_;
  std::string& problem_;
};

// With other ways to write a blank, a dot and a negative power made those that are read.
std::string with_plain_signs(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 10> signs{{{"\u00a0", " "},
                                                                                 {"\u2009", " "},
                                                                                 {"\u202f", " "},
                                                                                 {"\u22c5", "·"},
                                                                                 {"\u2219", "·"},
                                                                                 {"\u2212", "-"},
                                                                                 {"\u207b\u00b9", "-1"},
                                                                                 {"\u207b\u00b2", "-2"},
                                                                                 {"\u207b\u00b3", "-3"},
                                                                                 {"\u207b\u2074", "-4"}}};
  std::string plain(text);
  for (const auto& [other, sign] : signs)
    for (std::size_t at = plain.find(other); at != std::string::npos; at = plain.find(other, at + sign.size()))
      plain.replace(at, other.size(), sign);
  return plain;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
    text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t'))
    text.remove_suffix(1);
  return text;
}

// The decimal number that `text` begins with, cut off; empty if there is none.
std::string_view take_number(std::string_view& text) {
  const auto digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
  std::size_t end = 0;
  bool any = false;
  if (!text.empty() && (text[0] == '+' || text[0] == '-'))
    ++end;
  for (; digit(end); ++end)
    any = true;
  if (end < text.size() && text[end] == '.')
    for (++end; digit(end); ++end)
      any = true;
  if (!any)
    return {};
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    std::size_t exponent = end + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-'))
      ++exponent;
    if (digit(exponent)) {
      while (digit(exponent))
        ++exponent;
      end = exponent;
    }
  }
  const std::string_view number = text.substr(0, end);
  text.remove_prefix(end);
  return number;
}

// The double nearest to number * 10^ten.
std::optional<double> read_decimal(std::string_view number, int ten) {
  if (number.starts_with('+'))
    number.remove_prefix(1);
  const std::size_t mark = number.find_first_of("eE");
  long exponent = ten;
  if (mark != std::string_view::npos) {
    std::string_view written = number.substr(mark + 1);
    if (written.starts_with('+'))
      written.remove_prefix(1);
    int value = 0;
    if (std::from_chars(written.data(), written.data() + written.size(), value).ec != std::errc{})
      return {};
    exponent += value;
  }
  const std::string text = fmt::format("{}e{}", number.substr(0, mark), exponent);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    return {};
  return value;
}

// "; known: m, in, inch, prefixes as in mm": the names of units of that dimension; "" without one.
std::string known_units(const Dimension& dimension) {
  std::string list, with_prefix;
  for (const NamedUnit& known : units)
    if (known.unit.dimension == dimension) {
      list += fmt::format("{}{}", list.empty() ? "; known: " : ", ", known.name);
      if (known.prefixes && with_prefix.empty())
        with_prefix = fmt::format(", prefixes as in m{}", known.name);
    }
  if (dimension == quantity::temperature.dimension)
    list += ", degC";
  return list + with_prefix;
}

// Quotable text: not endless, no control characters.
std::string excerpt(std::string_view text, std::size_t longest = 60) {
  std::string result;
  for (const char c : text.substr(0, longest))
    result += static_cast<unsigned char>(c) < ' ' ? '?' : c;
  if (text.size() > longest)
    result += "...";
  return result;
}

} // namespace

std::string shortest(double value) { return fmt::format("{}", value); }

std::string describe(const Dimension& dimension) {
  struct Named {
    std::string_view name;
    Dimension dimension;
    std::string_view unit;
  };
  static constexpr std::array extra{Named{"an area", {0, 2, 0}, "m^2"},
                                    Named{"a volume", {0, 3, 0}, "m^3"},
                                    Named{"a surface tension or stiffness", {1, 0, -2}, "N/m"},
                                    Named{"a force", {1, 1, -2}, "N"},
                                    Named{"an energy", {1, 2, -2}, "J"},
                                    Named{"a power", {1, 2, -3}, "W"},
                                    Named{"a kinematic viscosity", kinematic_viscosity, "m^2/s"},
                                    Named{"a flow rate", {0, 3, -1}, "m^3/s"},
                                    Named{"a mass per area", {1, -2, 0}, "kg/m^2"}};
  if (dimension == Dimension{})
    return "a plain number or angle";
  for (const Named& known : extra)
    if (known.dimension == dimension)
      return fmt::format("{} ({})", known.name, known.unit);
  for (const Quantity& known :
       {quantity::length, quantity::time, quantity::mass, quantity::velocity, quantity::acceleration,
        quantity::turning_rate, quantity::viscosity, quantity::density, quantity::pressure, quantity::conductance,
        quantity::temperature, quantity::specific_heat, quantity::conductivity, quantity::heat_transfer})
    if (known.dimension == dimension)
      return fmt::format("{} ({})", known.name, known.unit);
  std::string unit;
  const auto append = [&](std::string_view name, int power) {
    if (power == 0)
      return;
    if (!unit.empty())
      unit += '*';
    unit += name;
    if (power != 1)
      unit += fmt::format("^{}", power);
  };
  append("kg", dimension.kg);
  append("m", dimension.m);
  append("s", dimension.s);
  append("K", dimension.K);
  append("mol", dimension.mol);
  return "a quantity in " + unit;
}

std::string mismatch(const Quantity& expected, std::string_view got) {
  return fmt::format("expected {} such as \"{}\", got {}", expected.name, expected.example, got);
}

std::optional<double> read_quantity(std::string_view text, const Quantity& expected, std::string& problem) {
  constexpr std::size_t longest_text = 200;
  problem.clear();
  const std::string plain = with_plain_signs(text);
  std::string_view rest = trim(plain);
  if (rest.empty() || rest.size() > longest_text) {
    problem = mismatch(expected, rest.empty() ? "an empty text" : "a text that is too long");
    return {};
  }
  const std::string_view number = take_number(rest);
  if (number.empty()) {
    problem = mismatch(expected, fmt::format("\"{}\", which does not begin with a number", excerpt(text)));
    return {};
  }
  if (rest.size() > 1 && rest[0] == ',' && rest[1] >= '0' && rest[1] <= '9') {
    problem = mismatch(expected, fmt::format("\"{}\": write a decimal point, not a comma", excerpt(text)));
    return {};
  }
  rest = trim(rest);
  if (expected.name == quantity::turning_rate.name && rest.ends_with("Hz")) {
    problem = mismatch(expected,
                       fmt::format("\"{}\", which may be turns or radians: write turn/s, rpm or rad/s", excerpt(text)));
    return {};
  }
  Unit unit{expected.dimension};
  const bool celsius = expected.dimension == quantity::temperature.dimension && is_celsius(rest);
  if (!rest.empty() && !celsius) {
    const auto parsed = UnitParser(rest, problem).parse();
    if (!parsed) {
      const std::string known = problem.starts_with(unknown_unit) ? known_units(expected.dimension) : "";
      problem = fmt::format("expected {} such as \"{}\": {}{}", expected.name, expected.example, excerpt(problem, 300),
                            known);
      return {};
    }
    unit = *parsed;
    if (unit.dimension != expected.dimension) {
      problem = mismatch(expected, describe(unit.dimension));
      if (unit.dimension == kinematic_viscosity && expected.dimension == quantity::viscosity.dimension)
        problem += ": multiply it by the density, as 1000 cSt * 1.4 g/cm^3 = 1400 mPa*s";
      return {};
    }
  }
  const auto decimal = read_decimal(number, unit.ten);
  const double value = decimal ? *decimal * unit.numerator / unit.denominator + (celsius ? zero_celsius : 0) : HUGE_VAL;
  if (!std::isfinite(value)) {
    problem = fmt::format("\"{}\" is beyond the range of numbers", excerpt(text));
    return {};
  }
  return value;
}

double parse_quantity(std::string_view text, const Quantity& expected, ExitCode code) {
  std::string problem;
  const auto value = read_quantity(text, expected, problem);
  if (!value)
    throw Error(code, problem);
  return *value;
}

} // namespace sheet
