// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "libsheet/measure/figures.h"
#include "libsheet/measure/report.h"

namespace sheet {

namespace {

using Json = nlohmann::ordered_json; // writes what is not finite as null

Json arrays_json(const formats::Frame& frame) {
  Json out = Json::array();
  for (const formats::Array& a : frame.arrays)
    out.push_back({{"name", a.name},
                   {"place", name_of(a.place)},
                   {"type", name_of(a.type)},
                   {"components", a.components},
                   {"rows", a.rows},
                   {"unit", a.unit},
                   {"rule", name_of(a.transfer)},
                   {"critical", a.critical},
                   {"bytes", a.data.size()}});
  return out;
}

Json provenance_json(const formats::Frame& frame) {
  Json out = Json::array();
  const formats::Array* array = frame.find("provenance");
  const std::string_view text = array == nullptr ? std::string_view() : array->text();
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    out.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return out;
}

// By the percentages as texts.
Json percentiles_json(const std::vector<double>& v) {
  Json out = Json::object();
  for (std::size_t i = 0; i < percents.size(); ++i)
    out[fmt::format("{}", percents[i])] = v[i];
  return out;
}

Json figure_json(const Figure& figure, const std::vector<double>& v) {
  switch (figure.form) {
  case Figure::Form::scalar:
    break;
  case Figure::Form::vector:
    return v;
  case Figure::Form::range:
    return {{"min", v[0]}, {"mean", v[1]}, {"max", v[2]}};
  case Figure::Form::percentiles:
    return percentiles_json(v);
  case Figure::Form::ends:
    return {{"min", v[0]}, {"max", v[1]}};
  case Figure::Form::box:
    return {{"min", {v[0], v[1], v[2]}}, {"max", {v[3], v[4], v[5]}}};
  }
  return v[0];
}

Json measurements_json(const Measurements& m) {
  Json json = Json::object();
  for (const Figure& figure : figures())
    if (figure.printed && m.has[static_cast<std::size_t>(figure.needs)])
      json[figure.name] = figure_json(figure, figure.values(m));
  const Topology& t = m.topology;
  json["topology"] = {{"components", t.components},
                      {"edges", t.edges},
                      {"boundary_edges", t.boundary_edges},
                      {"boundary_loops", t.boundary_loops},
                      {"euler_characteristic", t.euler_characteristic},
                      {"closed", t.closed},
                      {"unused_vertices", t.unused_vertices},
                      {"pinched_vertices", t.pinched_vertices},
                      {"non_manifold_edges", t.non_manifold_edges}};
  for (const NamedForce& f : m.forces)
    json["forces"][f.name] = {f.force[0], f.force[1], f.force[2]};
  return json;
}

class JsonReport : public Report {
public:
  std::string begin() override { return "["; }
  std::string add(const ReportEntry& e) override {
    const Json object = {{"file", e.file},
                         {"frame", e.index},
                         {"time", e.frame->time},
                         {"step", e.frame->step},
                         {"vertices", e.frame->vertices},
                         {"triangles", e.frame->triangles},
                         {"edges", e.frame->edges},
                         {"measurements", measurements_json(e.measurements)},
                         {"arrays", arrays_json(*e.frame)},
                         {"provenance", provenance_json(*e.frame)}};
    const std::string separator = first_ ? "\n" : ",\n";
    first_ = false;
    // A file's name may be any bytes: those that are not UTF-8 are replaced.
    return separator + object.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  std::string end() override { return "\n]\n"; }

private:
  bool first_ = true;
};

} // namespace

std::unique_ptr<Report> make_json_report() { return std::make_unique<JsonReport>(); }

} // namespace sheet
