// SPDX-License-Identifier: GPL-3.0-or-later
// Report as text and CSV; JSON has a file of its own.
#include "libsheet/measure/report.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "libsheet/health/report.h"

namespace sheet {

namespace {

using formats::Array;
using formats::Frame;

constexpr double degrees = 180 / std::numbers::pi;

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

std::string bounded(const Range& range, std::string_view unit) {
  if (std::isnan(range.least))
    return "none";
  return fmt::format("{:.6g} to {:.6g} {}, mean {:.6g} {}", range.least, range.greatest, unit, range.mean, unit);
}

std::string vector_text(const Eigen::Vector3d& v) { return fmt::format("{:.6g} {:.6g} {:.6g}", v[0], v[1], v[2]); }

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
    line("area", fmt::format("{:.9g} m^2", m.area));
    line("volume", fmt::format("{:.9g} m^3", m.volume));
    line("thickness", bounded(m.thickness, "m"));
    if (std::isnan(m.kinetic_energy)) {
      line("kinetic energy", "unknown without a density (no scene states one; see --density)");
    } else {
      line("kinetic energy", fmt::format("{:.9g} J", m.kinetic_energy));
      line("momentum", vector_text(m.momentum) + " kg m/s");
      line("angular momentum", vector_text(m.angular_momentum) + " kg m^2/s");
    }
    line("bounding box", frame.vertices == 0 ? std::string("none")
                                             : fmt::format("{} to {} m", vector_text(m.low), vector_text(m.high)));
    line("edges", bounded(m.edge, "m"));
    line("angles", frame.triangles == 0 ? std::string("none")
                                        : fmt::format("{:.4g} to {:.4g} degrees, worst aspect {:.4g}",
                                                      m.angle_min * degrees, m.angle_max * degrees, m.aspect_max));
    line("topology", fmt::format("{}, pieces {}, boundary loops {}, Euler characteristic {}",
                                 t.closed ? "closed" : "open", t.components, t.boundary_loops, t.euler_characteristic));
    for (const NamedForce& f : m.forces)
      line("force of " + f.name,
           std::isnan(f.force[0]) ? std::string("not known before a step") : vector_text(f.force) + " N");
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

std::string csv_quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos)
    return text;
  std::string out = "\"";
  for (const char c : text)
    out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

// "nan" whatever the NaN's sign.
std::string number(double x) { return std::isnan(x) ? "nan" : fmt::format("{}", x); }

class CsvReport : public Report {
public:
  std::string add(const ReportEntry& e) override {
    const Frame& f = *e.frame;
    const Measurements& m = e.measurements;
    const Topology& t = m.topology;
    std::string out;
    if (first_) {
      for (const NamedForce& force : m.forces)
        forces_.push_back(force.name);
      out = header(e.many_files, forces_);
      first_ = false;
    }
    out += fmt::format("{},{},{},{}", e.index, f.time, f.vertices, f.triangles);
    for (const double x : {m.area, m.volume, m.thickness.least, m.thickness.mean, m.thickness.greatest,
                           m.kinetic_energy, m.momentum[0], m.momentum[1], m.momentum[2], m.low[0], m.high[0], m.low[1],
                           m.high[1], m.low[2], m.high[2], m.angle_min * degrees, m.edge.least, m.edge.greatest})
      out += "," + number(x);
    out += fmt::format(",{}", f.step);
    for (const double x : {m.angular_momentum[0], m.angular_momentum[1], m.angular_momentum[2], m.angle_max * degrees,
                           m.edge.mean, m.aspect_max})
      out += "," + number(x);
    out += fmt::format(",{},{},{},{}", t.components, t.boundary_loops, t.euler_characteristic, t.closed ? 1 : 0);
    for (std::size_t i = 0; i < forces_.size(); ++i)
      for (int axis = 0; axis < 3; ++axis)
        out += "," + number(i < m.forces.size() ? m.forces[i].force[axis] : absent);
    return out + (e.many_files ? "," + csv_quoted(e.file) : "") + "\n";
  }
  std::string end() override { return first_ ? header(false, {}) : ""; }

private:
  static std::string header(bool many_files, const std::vector<std::string>& forces) {
    std::string more;
    for (const std::string& name : forces)
      for (const char axis : {'x', 'y', 'z'})
        more += fmt::format(",force_of_{}_{}", name, axis);
    std::ranges::replace(more, ' ', '_');
    return std::string("frame,time,vertices,triangles,area,volume,thickness_min,thickness_mean,thickness_max,"
                       "kinetic_energy,momentum_x,momentum_y,momentum_z,x_min,x_max,y_min,y_max,z_min,z_max,"
                       "angle_min_degrees,edge_min,edge_max,step,angular_momentum_x,angular_momentum_y,"
                       "angular_momentum_z,angle_max_degrees,edge_mean,aspect_max,components,boundary_loops,"
                       "euler_characteristic,closed") +
           more + (many_files ? ",file\n" : "\n");
  }
  bool first_ = true;
  std::vector<std::string> forces_; // of the first frame's scene
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
