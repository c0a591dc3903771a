// SPDX-License-Identifier: GPL-3.0-or-later
// Report as text and CSV; JSON has a file of its own.
#include "libsheet/measure/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "libsheet/health/report.h"
#include "libsheet/measure/csv.h"
#include "libsheet/measure/figures.h"

namespace sheet {

namespace {

using formats::Array;
using formats::Frame;

std::string_view text_of(const Frame& frame, std::string_view name) {
  const Array* array = frame.find(name);
  return array != nullptr && array->type == formats::Type::text ? array->text() : std::string_view();
}

std::string table_of(const Frame& frame) {
  std::string out;
  for (const Array& a : frame.arrays)
    out += fmt::format("    {:<18} {:<8} {:<11} {:<5} {:<12}{} {} bytes\n", a.name, name_of(a.place),
                       a.components == 1 ? std::string(name_of(a.type))
                                         : fmt::format("{} x {}", name_of(a.type), a.components),
                       a.unit, name_of(a.transfer), a.critical ? " critical" : "", a.data.size());
  return out;
}

std::string vector_text(double x, double y, double z) { return fmt::format("{:.6g} {:.6g} {:.6g}", x, y, z); }

// What text says of a figure; "" if there is nothing to say.
std::string told_of(const Figure& figure, const Measurements& m) {
  if (figure.needs_density && std::isnan(m.kinetic_energy))
    return figure.name == "kinetic_energy" ? "unknown without a density (no scene states one; see --density)" : "";
  const std::vector<double> v = figure.values(m);
  if (figure.needs != Needs::nothing && figure.form == Figure::Form::scalar && std::isnan(v[0]))
    return ""; // of a liquid that has the rest of its kind
  const std::string unit = figure.unit == "1" ? "" : " " + figure.unit;
  switch (figure.form) {
  case Figure::Form::scalar:
    return fmt::format("{:.9g}{}", v[0], unit);
  case Figure::Form::vector:
    return std::isnan(v[0]) ? "none" : fmt::format("{}{}", vector_text(v[0], v[1], v[2]), unit);
  case Figure::Form::range:
    return std::isnan(v[0]) ? "none" : fmt::format("{:.6g} to {:.6g}{}, mean {:.6g}{}", v[0], v[2], unit, v[1], unit);
  case Figure::Form::percentiles:
    return std::isnan(v[0]) ? "none"
                            : fmt::format("{:.6g}{} (1 % of the area), {:.6g} (5 %), {:.6g} (50 %), {:.6g} (95 %), "
                                          "{:.6g} (99 %)",
                                          v[0], unit, v[1], v[2], v[3], v[4]);
  case Figure::Form::ends:
    return std::isnan(v[0]) ? "none"
                            : fmt::format("{:.4g} to {:.4g}{}, worst aspect {:.4g}", v[0], v[1], unit, m.aspect_max);
  case Figure::Form::box:
    return std::isnan(v[0])
               ? "none"
               : fmt::format("{} to {}{}", vector_text(v[0], v[1], v[2]), vector_text(v[3], v[4], v[5]), unit);
  }
  return "";
}

class TextReport : public Report {
public:
  std::string add(const ReportEntry& e) override {
    const Frame& frame = *e.frame;
    const Measurements& m = e.measurements;
    const Topology& t = m.topology;
    std::string out;
    if (first_ || e.file != file_) {
      out += fmt::format("{}{}\n", first_ ? "" : "\n", e.file);
      table_.clear();
      provenance_.clear();
      file_ = e.file;
    }
    out += fmt::format("frame {}: step {}, time {} s, {} vertices, {} triangles\n", e.index, frame.step, frame.time,
                       frame.vertices, frame.triangles);
    if (std::string table = table_of(frame); table != table_) {
      out +=
          (table_.empty() ? "  arrays (name, place, type, unit, transfer rule, size):\n" : "  arrays now:\n") + table;
      table_ = std::move(table);
    }
    if (const std::string_view text = text_of(frame, "provenance"); text != provenance_) {
      out += "  made by (count, command):\n";
      for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = std::min(text.find('\n', start), text.size());
        out += fmt::format("    {}\n", text.substr(start, end - start));
        start = end + 1;
      }
      provenance_ = text;
    }
    const auto line = [&](std::string_view name, const std::string& text) {
      out += fmt::format("  {:<18} {}\n", name, text);
    };
    for (const Figure& figure : figures())
      if (figure.printed && m.has[static_cast<std::size_t>(figure.needs)] &&
          figure.name != "aspect_max") // that stands behind the angles
        if (const std::string told = told_of(figure, m); !told.empty())
          line(figure.caption, told);
    line("topology", fmt::format("{}, pieces {}, boundary loops {}, Euler characteristic {}",
                                 t.closed ? "closed" : "open", t.components, t.boundary_loops, t.euler_characteristic));
    for (const NamedForce& f : m.forces)
      line("force of " + f.name, std::isnan(f.force[0]) ? std::string("not known before a step")
                                                        : vector_text(f.force[0], f.force[1], f.force[2]) + " N");
    if (t.unused_vertices + t.pinched_vertices + t.non_manifold_edges > 0)
      line("", fmt::format("unused vertices {}, pinched vertices {}, non-manifold edges {}", t.unused_vertices,
                           t.pinched_vertices, t.non_manifold_edges));
    first_ = false;
    return out;
  }
  std::string end() override { return first_ ? "no frames\n" : ""; }

private:
  std::string file_, table_, provenance_;
  bool first_ = true;
};

struct Cell {
  std::string column, text;
};

// These columns stand first, in this order: who reads them by their place finds them there. New ones follow.
constexpr std::array<std::string_view, 32> first_columns = {"frame",
                                                            "time",
                                                            "vertices",
                                                            "triangles",
                                                            "area",
                                                            "volume",
                                                            "thickness_min",
                                                            "thickness_mean",
                                                            "thickness_max",
                                                            "kinetic_energy",
                                                            "momentum_x",
                                                            "momentum_y",
                                                            "momentum_z",
                                                            "x_min",
                                                            "x_max",
                                                            "y_min",
                                                            "y_max",
                                                            "z_min",
                                                            "z_max",
                                                            "angle_min_degrees",
                                                            "edge_min",
                                                            "edge_max",
                                                            "step",
                                                            "angular_momentum_x",
                                                            "angular_momentum_y",
                                                            "angular_momentum_z",
                                                            "angle_max_degrees",
                                                            "edge_mean",
                                                            "aspect_max",
                                                            "components",
                                                            "boundary_loops",
                                                            "euler_characteristic"};

// A row's cells, in the order of the columns; forces stand last. `has`: by Needs.
std::vector<Cell> cells_of(const ReportEntry& e, const std::array<bool, kinds_of_needs>& has) {
  const Frame& f = *e.frame;
  const Topology& t = e.measurements.topology;
  std::vector<Cell> cells = {{"frame", fmt::format("{}", e.index)},
                             {"time", fmt::format("{}", f.time)},
                             {"vertices", fmt::format("{}", f.vertices)},
                             {"triangles", fmt::format("{}", f.triangles)},
                             {"step", fmt::format("{}", f.step)},
                             {"components", fmt::format("{}", t.components)},
                             {"boundary_loops", fmt::format("{}", t.boundary_loops)},
                             {"euler_characteristic", fmt::format("{}", t.euler_characteristic)},
                             {"closed", t.closed ? "1" : "0"}};
  for (const Figure& figure : figures()) {
    if (!figure.printed || !has[static_cast<std::size_t>(figure.needs)])
      continue;
    const std::vector<std::string> columns = figure.columns();
    const std::vector<double> values = figure.values(e.measurements);
    for (std::size_t i = 0; i < columns.size(); ++i)
      cells.push_back({columns[i], csv_number(values[i])});
  }
  std::ranges::stable_sort(cells, {}, [](const Cell& cell) { return std::ranges::find(first_columns, cell.column); });
  return cells;
}

class CsvReport : public Report {
public:
  std::string add(const ReportEntry& e) override {
    const Measurements& m = e.measurements;
    std::string out;
    if (first_) {
      for (const NamedForce& force : m.forces)
        forces_.push_back(force.name);
      has_ = m.has;
      out = header(e, forces_);
      first_ = false;
    }
    for (const Cell& cell : cells_of(e, has_))
      out += (cell.column == first_columns[0] ? "" : ",") + cell.text;
    for (std::size_t i = 0; i < forces_.size(); ++i)
      for (int axis = 0; axis < 3; ++axis)
        out += "," + csv_number(i < m.forces.size() ? m.forces[i].force[axis] : absent);
    return out + (e.many_files ? "," + csv_quoted(e.file) : "") + "\n";
  }
  std::string end() override {
    if (!first_)
      return "";
    const Frame frame;
    ReportEntry nothing;
    nothing.frame = &frame;
    for (const Field& field : fields())
      if (field.in_figures)
        nothing.measurements.fields.push_back({&field, {}});
    return header(nothing, {});
  }

private:
  [[nodiscard]] std::string header(const ReportEntry& entry, const std::vector<std::string>& forces) const {
    std::string line;
    for (const Cell& cell : cells_of(entry, has_))
      line += (line.empty() ? "" : ",") + cell.column;
    for (const std::string& name : forces)
      for (const char axis : {'x', 'y', 'z'})
        line += fmt::format(",force_of_{}_{}", name, axis);
    std::ranges::replace(line, ' ', '_');
    return line + (entry.many_files ? ",file\n" : "\n");
  }
  bool first_ = true;
  std::array<bool, kinds_of_needs> has_{true}; // of the first frame's scene
  std::vector<std::string> forces_;
};

class HealthReport : public Report {
public:
  std::string add(const ReportEntry& e) override {
    const std::string before = e.file == file_ ? std::string() : end();
    const std::string report = health::report(*e.frame);
    file_ = e.file;
    text_ = fmt::format("{}: {}\n", file_, report.empty() ? "nothing went wrong that anybody noticed" : report);
    return before;
  }
  std::string end() override { return std::exchange(text_, {}); }

private:
  std::string file_, text_; // of the newest frame
};

} // namespace

std::unique_ptr<Report> make_health_report() { return std::make_unique<HealthReport>(); }
std::unique_ptr<Report> make_text_report() { return std::make_unique<TextReport>(); }
std::unique_ptr<Report> make_csv_report() { return std::make_unique<CsvReport>(); }

} // namespace sheet
