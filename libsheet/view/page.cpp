// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/view/page.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "formats/cpp/printable.h"
#include "formats/cpp/stream_reader.h"
#include "libsheet/base/error.h"
#include "libsheet/base/file_roles.h"
#include "libsheet/base/files.h"
#include "libsheet/base/log.h"
#include "libsheet/base/whole_file.h"
#include "libsheet/quantities/scaled_unit.h"
#include "libsheet/quantities/sheet_kinds.h"
#include "libsheet/quantities/wanted.h"
#include "libsheet/render/framing.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/scene/frame_scene.h"
#include "libsheet/sheet/drop_shells.h"
#include "libsheet/sheet/drops.h"
#include "libsheet/view/liquid_looks.h"
#include "libsheet/view/packed_frame.h"
#include "libsheet/view/page_parts.h"
#include "libsheet/view/surroundings.h"

namespace sheet::view {
namespace {

using Json = nlohmann::ordered_json;

// For a text or an attribute of HTML.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text)
    switch (c) {
    case '<':
      out += "&lt;";
      break;
    case '>':
      out += "&gt;";
      break;
    case '&':
      out += "&amp;";
      break;
    case '"':
      out += "&quot;";
      break;
    case '\'':
      out += "&#39;";
      break;
    default:
      out += c;
    }
  return out;
}

// For the inside of a script element: pure ASCII, and nothing in it can end the element or begin a comment.
std::string script_json(const Json& json) {
  std::string out;
  for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace))
    c == '<' ? out += "\\u003c" : out += c;
  return out;
}

std::string data_element(const std::string& id, std::string_view text) {
  return fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id, text);
}

Json to_json(const Range& range) { return {range.low, range.high}; }

Json to_json(const std::vector<FieldDescription>& fields) {
  Json all = Json::array();
  for (const FieldDescription& d : fields)
    all.push_back(d.there ? Json{{"range", to_json(d.range)}, {"step", d.step}, {"follows", d.follows}} : Json());
  return all;
}

Json to_json(const FrameDescription& d) {
  return {{"time", d.time},
          {"step", d.step},
          {"vertices", d.vertices},
          {"triangles", d.triangles},
          {"sameMesh", d.same_mesh},
          {"positionStep", d.position_step},
          {"positionFollows", d.position_follows},
          {"moves", d.moves},
          {"liquids", d.liquids},
          {"velocityStep", d.velocity_step},
          {"velocityFollows", d.velocity_follows},
          {"low", d.low},
          {"high", d.high},
          {"fields", to_json(d.fields)},
          {"volume", d.volume}};
}

Json to_json(const DisplayedColour& colour) {
  Json bytes = Json::array();
  for (const float part : colour)
    bytes.push_back(std::lround(255 * part));
  return bytes;
}

// What the page shows, with units from large to small and what makes them of SI units, and palettes.
// `sheets`: their names.
Json quantities_json(const std::vector<std::string>& sheets) {
  const SheetKinds named(sheets);
  Json all = Json::array();
  for (const Field& field : sheet::fields()) {
    Json json = {{"name", field.name},
                 {"caption", field.caption},
                 {"unit", field.unit == "1" ? "" : field.unit},
                 {"where", name_of(field.where)},
                 {"packed", is_packed(field)},
                 {"symmetric", field.palette.symmetric},
                 {"stops", Json::array()},
                 {"kinds", Json::array()},
                 {"units", Json::array()}};
    for (const PaletteStop& stop : field.palette.stops)
      json["stops"].push_back({stop.place, to_json(stop.colour)});
    const Palette& palette = field.needs == Needs::sheets ? named.palette() : field.palette;
    for (const PaletteKind& kind : palette.kinds)
      json["kinds"].push_back({kind.name, to_json(kind.colour)});
    for (const ScaledUnit& unit : scaled_units(field.unit))
      json["units"].push_back({unit.name, 1 / unit.size});
    all.push_back(json);
  }
  return all;
}

Json to_json(const Placement& placement) {
  Json surfaces = Json::array();
  for (const FlatSurface& s : placement.surfaces)
    surfaces.push_back({{"kind", s.kind}, {"point", s.point}, {"normal", s.normal}});
  return {{"motions", placement.motions}, {"surfaces", surfaces}};
}

using Sink = std::function<void(std::string_view)>; // takes the page, piece by piece

// Writes what one stream brings and gathers its description.
class StreamWriter {
public:
  // `materials`: as in ViewOptions.
  StreamWriter(const Sink& write, std::size_t number, const std::string& name,
               const std::vector<std::size_t>& materials = {})
      : write_(write), number_(number), materials_(materials) {
    description_ = {
        {"name", name}, {"frames", Json::array()}, {"thicknessStep", thickness_step}, {"up", {0, 1, 0}},
        {"scene", ""},  {"solids", Json::array()}, {"liquids", Json::array()},        {"placements", Json::array()}};
  }

  void add(const formats::Frame& frame) {
    if (!scene_)
      take_scene(frame);
    constexpr DropShells small_balls{.partings = 1};
    const formats::Frame shown = knows_drops(frame) ? with_drop_shells(frame, small_balls) : frame;
    const PackedFrame packed = packer_.pack(shown, take_liquids(shown));
    Json& frames = description_["frames"];
    write_(data_element(fmt::format("frame-{}-{}", number_, frames.size()), packed.text));
    frames.push_back(to_json(packed.description));
    frames.back()["placement"] = placement_at(frame.time);
  }

  [[nodiscard]] const Json& description() const { return description_; }
  // Of the first scene.
  [[nodiscard]] std::vector<std::string> names_of_sheets() const {
    return scene_ ? sheet_names(*scene_) : std::vector<std::string>{};
  }

private:
  // Surroundings are those of the first scene of the stream.
  void take_scene(const formats::Frame& frame) {
    const Scene* scene = scenes_.find(frame);
    if (scene == nullptr)
      return;
    scene_ = *scene;
    description_["scene"] = std::string(frame.find("scene")->text());
    const auto up = render::up_of(scene);
    description_["up"] = {up[0], up[1], up[2]};
    solids_ = pack_solids(*scene);
    for (std::size_t i = 0; i < solids_.size(); ++i) {
      const PackedSolid& solid = solids_[i];
      write_(data_element(fmt::format("solid-{}-{}", number_, i), solid.text));
      description_["solids"].push_back({{"number", solid.solid},
                                        {"vertices", solid.vertices},
                                        {"triangles", solid.triangles},
                                        {"step", solid.step}});
    }
  }

  // The numbers of the vertices' liquids, none if they have one; those that have come get their colours.
  std::vector<std::uint32_t> take_liquids(const formats::Frame& frame) {
    const Scene* scene = scenes_.find(frame);
    if (scene == nullptr) {
      add_looks({"liquid 1"}, liquid_thickness(frame, {}, 1));
      return {};
    }
    if (!tells_liquids(*scene, frame)) {
      if (!std::exchange(told_liquids_, true))
        log::warning(
            "the frame at {} s of {} does not say which triangle is of which of its scene's liquids: all is shown "
            "as the first one ({})",
            frame.time, std::string(description_["name"]), scene::keep_liquid);
      add_looks(names_of_liquids(*scene), liquid_thickness(frame, {}, liquids_of(*scene).size()));
      return {};
    }
    const FrameLiquids liquids(*scene, frame);
    add_looks(names_of_liquids(*scene), liquid_thickness(frame, liquids.numbers(), liquids.all().size()));
    return liquids.numbers_at_vertices(frame);
  }

  void add_looks(const std::vector<std::string>& names, const std::vector<double>& thickness) {
    Json& looks = description_["liquids"];
    if (looks.empty())
      for (const std::string& name : names)
        looks.push_back({{"name", name}, {"colour", Json()}});
    for (std::size_t i = 0; i < std::min(looks.size(), thickness.size()) && !materials_.empty(); ++i)
      if (Json& colour = looks[i]["colour"]; colour.is_null() && thickness[i] > 0)
        colour = to_json(colour_on_white(render::preset(materials_[i % materials_.size()]), thickness[i]));
  }

  // The number of the description's placement; most surroundings stand still and need one.
  std::size_t placement_at(double time) {
    Json& placements = description_["placements"];
    const Placement placement = scene_ ? place_surroundings(*scene_, solids_, time) : Placement{};
    if (placements.empty() || !(placement == placed_))
      placements.push_back(to_json(placement));
    placed_ = placement;
    return placements.size() - 1;
  }

  const Sink& write_;
  std::size_t number_;
  std::vector<std::size_t> materials_;
  Json description_;
  FramePacker packer_;
  scene::FrameScene scenes_;
  std::vector<PackedSolid> solids_;
  std::optional<Scene> scene_;
  bool told_liquids_ = false;
  Placement placed_;
};

std::string title_of(const ViewOptions& o) {
  if (!o.title.empty())
    return o.title;
  std::string title;
  for (const std::string& input : o.inputs)
    title += (title.empty() ? "" : ", ") + (input == "-" ? "standard input" : input);
  return title;
}

void write_head(const Sink& write, const std::string& title) {
  const std::vector<PagePart>& parts = page_parts();
  std::string html(parts[0].text);
  const auto put = [&](std::string_view mark, const std::string& text) {
    for (std::size_t at = html.find(mark); at != std::string::npos; at = html.find(mark, at + text.size()))
      html.replace(at, mark.size(), text);
  };
  put("{{STYLE}}", std::string(parts[1].text));
  put("{{TITLE}}", escaped(formats::printable(title)));
  write(html);
}

// Of the sheets of all streams, whose numbers have one key: those that are called differently are called by number.
void join_names(const std::vector<std::string>& more, std::vector<std::string>& names) {
  for (std::size_t i = 0; i < more.size(); ++i)
    if (i == names.size())
      names.push_back(more[i]);
    else if (names[i] != more[i])
      names[i] = fmt::format("sheet {}", i + 1);
}

void write_scripts(const Sink& write, const Json& streams, const std::vector<std::string>& sheets) {
  const auto write_data = [&](std::string_view id, const Json& json) {
    write(fmt::format("<script type=\"application/json\" id=\"{}\">{}</script>\n", id, script_json(json)));
  };
  write_data("streams", streams);
  write_data("quantities", quantities_json(sheets));
  write("<script>\n\"use strict\";\n(() => {\n");
  const std::vector<PagePart>& parts = page_parts();
  for (std::size_t i = 2; i < parts.size(); ++i)
    write(parts[i].text);
  write("})();\n</script>\n</body>\n</html>\n");
}

// Returns what was wrong with the stream behind its last whole frame, if anything was.
std::exception_ptr write_stream(const std::string& input, const std::optional<double>& wanted, StreamWriter& writer) {
  const InputFile in(input);
  formats::StreamReader reader(in.descriptor(), in.name());
  formats::Frame frame;
  try {
    while (reader.read(frame)) {
      if (wanted)
        want_thickness(frame, *wanted);
      writer.add(frame);
    }
  } catch (const formats::StreamError& error) {
    if (reader.frames() == 0 || error.kind() != formats::StreamError::Kind::corrupt)
      throw;
    log::warning("the page has the whole frames of {}: {}", in.name(), reader.frames());
    return std::current_exception();
  }
  if (reader.frames() == 0)
    fail(ExitCode::bad_input, "{} has no frames: there is nothing to see", in.name());
  return nullptr;
}

} // namespace

void write_page(const ViewOptions& options) {
  for (const std::string& input : options.inputs)
    claim_file(input, FileRole::input); // before the output is made
  std::exception_ptr cut;
  write_whole_file(options.output, [&](OutputFile& file) {
    const Sink write = [&](std::string_view text) { file.write(text); };
    write_head(write, title_of(options));
    Json streams = Json::array();
    std::vector<std::string> sheets;
    for (const std::string& input : options.inputs) {
      StreamWriter writer(write, streams.size(), input == "-" ? "standard input" : input, options.materials);
      if (const std::exception_ptr error = write_stream(input, options.wanted, writer); error && !cut)
        cut = error;
      streams.push_back(writer.description());
      join_names(writer.names_of_sheets(), sheets);
    }
    write_scripts(write, streams, sheets);
  });
  if (cut)
    std::rethrow_exception(cut);
}

std::string page_of(const formats::Frame& frame, const std::string& name) {
  std::string page;
  const Sink write = [&](std::string_view text) { page += text; };
  write_head(write, name);
  StreamWriter writer(write, 0, name);
  writer.add(frame);
  write_scripts(write, Json::array({writer.description()}), writer.names_of_sheets());
  return page;
}

} // namespace sheet::view
