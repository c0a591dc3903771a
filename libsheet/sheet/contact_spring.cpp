// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/sheet/contact_spring.h"

#include <algorithm>

namespace sheet {

namespace {

using formats::Array;

constexpr std::array columns = {"contact_weight", "contact_normal",    "contact_rest",
                                "contact_anchor", "contact_stiffness", "contact_since"};

// The numbers of one spring, in the order of the columns.
std::array<std::span<double>, columns.size()> numbers(ContactSpring& s) {
  return {s.weights, {s.normal.data(), 3}, {&s.rest, 1}, {s.anchor.data(), 3}, s.stiffness, {&s.since, 1}};
}

} // namespace

std::vector<ContactSpring> read_springs(const formats::Frame& frame) {
  const Array* vertices = frame.find("contact_vertex");
  if (vertices == nullptr)
    return {};
  const auto rows = vertices->values<std::array<std::uint32_t, 4>>();
  std::vector<ContactSpring> springs(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    springs[i].vertices = rows[i];
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const Array* column = frame.find(columns[c]);
    if (column == nullptr) // contact_since, in streams whose contacts have no dates
      continue;
    auto from = column->values<double>().begin();
    for (ContactSpring& s : springs) {
      const std::span<double> to = numbers(s)[c];
      std::copy_n(from, to.size(), to.begin());
      from += static_cast<std::ptrdiff_t>(to.size());
    }
  }
  return springs;
}

void write_springs(formats::Frame& frame, std::span<const ContactSpring> springs) {
  frame.erase("contact_vertex");
  for (const char* column : columns)
    frame.erase(column);
  if (springs.empty())
    return;
  Array vertices = formats::make_standard_array("contact_vertex", springs.size());
  for (std::size_t i = 0; i < springs.size(); ++i)
    vertices.values<std::array<std::uint32_t, 4>>()[i] = springs[i].vertices;
  frame.put(std::move(vertices));
  const std::size_t written = columns.size() - (springs[0].since == ContactSpring::undated ? 1 : 0);
  for (std::size_t c = 0; c < written; ++c) {
    Array values = formats::make_standard_array(columns[c], springs.size());
    auto to = values.values<double>().begin();
    for (ContactSpring s : springs)
      to = std::ranges::copy(numbers(s)[c], to).out;
    frame.put(std::move(values));
  }
}

} // namespace sheet
