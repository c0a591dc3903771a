// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/measure/check_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace sheet {

std::string check_kinds() {
  return " rule          a standard array is missing or breaks a rule of the format\n"
         " scene         the scene cannot be read\n"
         " not_finite    a value of any array is NaN or infinite\n"
         " out_of_range  a triangle names a vertex that does not exist\n"
         " repeated      a triangle names a vertex twice\n"
         " volume        a triangle's volume is not positive\n"
         " unused        a vertex belongs to no triangle\n"
         " duplicate     two triangles have the same vertices\n"
         " non_manifold  more than two triangles meet at an edge\n"
         " orientation   two triangles at an edge have opposite positive sides\n"
         " pinched       triangles meet at a vertex without being neighbours across edges\n"
         " degenerate    a triangle's corners lie exactly on a line\n"
         " intersection  two triangles intersect";
}

std::string findings_text(const formats::Frame& frame, std::uint64_t index, std::span<const Finding> findings) {
  std::string out;
  for (const Finding& f : findings) {
    out += fmt::format("frame {} (step {}): {}: {} ({})\n", index, frame.step, f.kind, f.count, f.text);
    for (const std::string& example : f.examples)
      out += fmt::format("  {}\n", example);
    if (f.count > f.examples.size() && !f.examples.empty())
      out += fmt::format("  and {} more\n", f.count - f.examples.size());
  }
  return out;
}

std::string findings_json(const formats::Frame& frame, std::uint64_t index, std::span<const Finding> findings) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const Finding& f : findings)
    list.push_back({{"kind", f.kind}, {"text", f.text}, {"count", f.count}, {"examples", f.examples}});
  const Json object = {{"frame", index}, {"step", frame.step}, {"time", frame.time}, {"findings", list}};
  return object.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace sheet
