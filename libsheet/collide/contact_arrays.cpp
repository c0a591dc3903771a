// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/contact_arrays.h"

namespace sheet::collide {

namespace {

using formats::Array;

struct Column {
  const char* name;
  const char* unit;
  std::uint32_t components;
};

constexpr std::array columns = {Column{"contact_weight", "1", 4}, Column{"contact_normal", "1", 3},
                                Column{"contact_rest", "m", 1}, Column{"contact_anchor", "m", 3},
                                Column{"contact_stiffness", "N/m", 2}};

// The numbers of one spring, in the order of the columns.
std::array<double*, columns.size()> numbers(ContactSpring& s) {
  return {s.weights.data(), s.normal.data(), &s.rest, s.anchor.data(), s.stiffness.data()};
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
    const auto values = frame.find(columns[c].name)->values<double>();
    for (std::size_t i = 0; i < springs.size(); ++i)
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * columns[c].components), columns[c].components,
                  numbers(springs[i])[c]);
  }
  return springs;
}

void write_springs(formats::Frame& frame, std::span<const ContactSpring> springs) {
  frame.erase("contact_vertex");
  for (const Column& column : columns)
    frame.erase(column.name);
  if (springs.empty())
    return;
  const auto array = [&](const char* name, formats::Type type, std::uint32_t components, const char* unit) {
    return formats::make_array(name, formats::Place::frame, type, components, unit, formats::Transfer::drop,
                               springs.size());
  };
  Array vertices = array("contact_vertex", formats::Type::uint32, 4, "1");
  for (std::size_t i = 0; i < springs.size(); ++i)
    vertices.values<std::array<std::uint32_t, 4>>()[i] = springs[i].vertices;
  frame.put(std::move(vertices));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    Array values = array(columns[c].name, formats::Type::float64, columns[c].components, columns[c].unit);
    auto out = values.values<double>().begin();
    for (ContactSpring s : springs)
      out = std::copy_n(numbers(s)[c], columns[c].components, out);
    frame.put(std::move(values));
  }
}

} // namespace sheet::collide
