// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-init: from a scene file to the first frame.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

#include "formats/cpp/printable.h"
#include "formats/cpp/stream_writer.h"
#include "libsheet/base/files.h"
#include "libsheet/base/filter.h"
#include "libsheet/base/log.h"
#include "libsheet/base/shell_words.h"
#include "libsheet/plan/bath_clinging.h"
#include "libsheet/plan/bath_crushing.h"
#include "libsheet/plan/beside_walls.h"
#include "libsheet/plan/contact_warnings.h"
#include "libsheet/plan/drawing_up.h"
#include "libsheet/plan/drops_at_once.h"
#include "libsheet/plan/face_warnings.h"
#include "libsheet/plan/falling_past.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/hanging_layer.h"
#include "libsheet/plan/held_whole.h"
#include "libsheet/plan/hole_forecast.h"
#include "libsheet/plan/idle_rolls.h"
#include "libsheet/plan/inflow_warnings.h"
#include "libsheet/plan/late_heat.h"
#include "libsheet/plan/mesh_warnings.h"
#include "libsheet/plan/modelled.h"
#include "libsheet/plan/open_rims.h"
#include "libsheet/plan/overlapping.h"
#include "libsheet/plan/parting.h"
#include "libsheet/plan/proposed_ring.h"
#include "libsheet/plan/running_down.h"
#include "libsheet/plan/sinking_back.h"
#include "libsheet/plan/slopes.h"
#include "libsheet/plan/solids_meet.h"
#include "libsheet/plan/symmetry.h"
#include "libsheet/plan/thick_streams.h"
#include "libsheet/plan/unlikely.h"
#include "libsheet/plan/wetting.h"
#include "libsheet/scene/document.h"
#include "libsheet/scene/example.h"
#include "libsheet/scene/explain.h"
#include "libsheet/scene/explain_heat.h"
#include "libsheet/scene/keys.h"
#include "libsheet/scene/read.h"
#include "libsheet/scene/scales.h"
#include "libsheet/solid/solids.h"

namespace {

struct Source {
  std::string file; // "-": standard input
  std::vector<std::string> sets;
  sheet::Quality quality = sheet::Quality::normal;
  std::optional<double> until, fps; // of the ring
};

constexpr std::array qualities{std::pair{"draft", sheet::Quality::draft}, std::pair{"normal", sheet::Quality::normal},
                               std::pair{"fine", sheet::Quality::fine}};

std::string read_text(const Source& source) {
  if (source.file.empty())
    sheet::fail(sheet::ExitCode::usage, "no scene: give a scene file, or --example for one to start from");
  return sheet::read_utf8_file(source.file);
}

sheet::Scene read(const Source& source) {
  return sheet::at_quality(source.file.empty() || source.file == "-"
                               ? sheet::parse_scene(read_text(source), "standard input", source.sets)
                               : sheet::read_scene(source.file, source.sets),
                           source.quality);
}

// The command that makes the first frame.
std::string command_of(const Source& source) {
  std::string init = "sheet-init " + sheet::shell_quoted(source.file == "-" ? "scene.toml" : source.file);
  for (const auto& [word, quality] : qualities)
    if (quality == source.quality && quality != sheet::Quality::normal)
      init += std::string(" --quality ") + word;
  for (const std::string& set : source.sets)
    init += " --set " + sheet::shell_quoted(set);
  return init;
}

// What is wrong with the variants of the scene that the lines of `rows` make: settings KEY=VALUE, separated by tabs.
// Throws one Error (bad_input) with all of it, each line with its row's number.
void check_rows(const Source& source, const std::string& rows) {
  std::istringstream lines(sheet::read_utf8_file(rows));
  const std::string name = rows == "-" ? "standard input" : rows;
  std::string wrong, line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    Source variant = source;
    std::istringstream settings(line);
    for (std::string set; std::getline(settings, set, '\t');)
      if (!set.empty())
        variant.sets.push_back(set);
    try {
      (void)sheet::checked_first_frame(read(variant));
    } catch (const sheet::Error& error) {
      std::istringstream problems(error.what());
      for (std::string problem; std::getline(problems, problem);)
        wrong += fmt::format("{}{}:{}: {}", wrong.empty() ? "" : "\n", name, number, problem);
    }
  }
  if (!wrong.empty())
    throw sheet::Error(sheet::ExitCode::bad_input, wrong);
}

// What --list-keys prints.
std::string key_list() {
  std::string text;
  for (const auto& [path, key] : sheet::scene::listed_keys())
    text += fmt::format("{}\t{}\t{}\t{}\n", path, sheet::scene::kind_of(key), sheet::scene::unit_of(key), key.help);
  return text;
}

// What --list-files prints.
std::string file_list(const Source& source) {
  const bool piped = source.file == "-";
  sheet::scene::Node document = sheet::scene::parse_toml(read_text(source), piped ? "standard input" : source.file);
  for (std::size_t i = 0; i < source.sets.size(); ++i)
    sheet::scene::apply_set(document, source.sets[i], static_cast<int>(i));
  const auto folder = piped ? std::filesystem::path() : std::filesystem::path(source.file).parent_path();
  std::string text;
  for (const auto& [name, path] : sheet::scene::files_named_in(document))
    text += fmt::format("{}\t{}\n", (folder / name).lexically_normal().string(), path);
  return sheet::formats::printable(text);
}

// Where a ring begins without --check.
void warn_of_symmetry(const sheet::Scene& scene, const sheet::formats::Frame& frame) {
  const auto sheets = scene.inflows.empty() ? std::vector<std::size_t>() : sheet::sheets_in_their_planes(scene);
  if (sheets.empty())
    return;
  std::string sets;
  for (const std::string& set : sheet::small_noise(scene, sheets, sheet::measured_sheets(scene, frame)))
    sets += fmt::format(" --set '{}'", set);
  sheet::log::warning(
      "all is symmetric about the sheet's plane: what is poured grows thicker where it should fold. Let "
      "it begin:{}",
      sets);
}

// What --check prints; of that, what --ring does.
std::string explained(Source source, bool ring_alone) {
  const sheet::Scene with_heat = read(source), scene = sheet::scene::as_it_starts(with_heat);
  const sheet::solid::Solids kept(scene); // each mesh is read once
  const sheet::formats::Frame frame = sheet::checked_first_frame(with_heat);
  const std::vector<sheet::scene::Measured> measured = sheet::measured_on_solids(scene, frame);
  sheet::scene::Explanation explanation = sheet::scene::explain(with_heat, measured, sheet::modelled(with_heat));
  if (const auto sheets = sheet::sheets_in_their_planes(scene); !sheets.empty()) {
    explanation.warnings.emplace_back("all is symmetric about the sheet's plane: it would grow thicker where it should "
                                      "fold. [[sheet]] perturbation lets it begin, as in the ring below");
    std::ranges::copy(sheet::small_noise(scene, sheets, measured), std::back_inserter(source.sets));
  }
  std::ranges::copy(sheet::unlikely_values(with_heat), std::back_inserter(explanation.warnings));
  std::ranges::copy(sheet::mesh_warnings(scene, frame), std::back_inserter(explanation.warnings));
  if (std::ranges::any_of(sheet::scene::scales_of_sheets(scene, measured), [&](const sheet::scene::Scales& scales) {
        return sheet::scene::warning_of_biot(with_heat, scales).has_value();
      }))
    source.sets.emplace_back("heat.profile=3");
  const sheet::RingWishes wishes{source.quality, source.until, source.fps};
  const double until = sheet::proposed_ring(with_heat, frame, wishes).until;
  // a first look, until sooner, begins as the run does that goes on with it
  const double whole = std::max(until, sheet::proposed_ring(with_heat, frame, {source.quality, {}, {}}).until);
  if (const auto parting = sheet::must_part(with_heat, frame, whole)) {
    const std::string adhesion = fmt::format("\"{:.2g} Pa\"", parting->adhesion);
    explanation.warnings.push_back(fmt::format(
        "{}, but what touches a solid never comes off. adhesion = {} in [contact] lets it, as in the ring below",
        parting->why, adhesion));
    source.sets.push_back("contact.adhesion=" + adhesion);
  }
  const std::string init = command_of(source);
  std::ranges::copy(sheet::contact_warnings(scene, frame, until), std::back_inserter(explanation.warnings));
  std::ranges::copy(sheet::warnings_of_solids_that_meet(scene, frame, until), std::back_inserter(explanation.warnings));
  std::ranges::copy(sheet::warnings_of_solids_that_meet_what_is_held(scene, frame, until),
                    std::back_inserter(explanation.warnings));
  std::ranges::copy(sheet::inflow_warnings(scene, frame), std::back_inserter(explanation.warnings));
  std::ranges::copy(sheet::idle_roll_warnings(scene, frame), std::back_inserter(explanation.warnings));
  for (const std::string& warning :
       {sheet::falling_past_warning(scene, frame), sheet::falling_on_warning(with_heat, frame, until),
        sheet::falling_behind_rolls_warning(scene, frame), sheet::drawing_up_warning(scene, frame, until),
        sheet::thick_stream_warning(scene, frame, until), sheet::wetting_warning(scene, frame, until),
        sheet::bath_crushing_warning(scene, frame), sheet::held_whole_warning(scene, frame),
        sheet::overlapping_warning(scene), sheet::open_rim_warning(scene, frame),
        sheet::beside_walls_warning(scene, frame), sheet::bath_clinging_warning(scene, frame),
        sheet::sinking_back_warning(scene, frame, until), sheet::drawing_along_warning(scene, frame, until),
        sheet::hanging_layer_warning(scene, frame, until), sheet::drops_at_once_warning(scene, frame)})
    if (!warning.empty())
      explanation.warnings.push_back(warning);
  for (const std::string& late :
       {sheet::late_running_warning(scene, frame, until), sheet::late_spreading_warning(scene, frame, until),
        sheet::late_overrun_warning(scene, frame, until), sheet::late_heat_warning(with_heat, frame, until),
        sheet::few_frames_warning(with_heat, frame, wishes)})
    if (!source.until && !late.empty())
      explanation.warnings.push_back(late);
  std::ranges::copy(sheet::face_warnings(scene, frame, until), std::back_inserter(explanation.warnings));
  std::ranges::copy(sheet::hole_scales(scene, frame), std::back_inserter(explanation.scales));
  std::ranges::copy(sheet::hole_warnings(scene, frame), std::back_inserter(explanation.warnings));
  return sheet::formats::printable(ring_alone ? sheet::ring_lines(with_heat, frame, wishes, init)
                                              : sheet::scene::to_text(explanation) +
                                                    sheet::ring_text(with_heat, frame, wishes, init));
}

} // namespace

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-init", "make the first frame of a sheet from a scene",
      "Reads a scene (TOML: what is physical, with units), builds the sheet's mesh, thickness and holds, and writes "
      "a stream of one frame. The scene travels along in the frame, and every stage reads from there what "
      "concerns it.\nEvery key is checked; all that is wrong is told at once, with file, line and the nearest "
      "known key.");
  Source source;
  std::string output = "-", rows;
  bool example = false, check = false, ring = false, no_provenance = false, list_files = false, list_keys = false;
  tool.argument("SCENE", source.file, "scene file; - for standard input");
  tool.option("--set", source.sets, "KEY=VALUE",
              "change or add a key of the scene, as in material.viscosity=50 or "
              "'hold.0.kind=pinned'; may be given again and again",
              sheet::scene::begun_settings());
  tool.flag("--check", check,
            "explain the scene instead: what will be modelled, what not, the dimensionless numbers that say why it "
            "matters, and the ring to run; refuses what any stage would refuse at the first frame",
            sheet::Tool::Provenance::omit);
  tool.choice("--quality", source.quality, {qualities.begin(), qualities.end()},
              "edges as long as the scene says (normal), twice as long (draft) or half as long (fine); the ring of "
              "--check then steps less or more accurately, too");
  tool.option("--until", source.until, "SECONDS", "end of the ring that --check and --ring propose",
              sheet::Tool::Provenance::omit);
  tool.option("--fps", source.fps, "FPS", "frames a second of the same", sheet::Tool::Provenance::omit);
  tool.flag("--ring", ring,
            "print the ring of --check alone, for a program to read: lines \"first COMMAND\", \"until SECONDS\", "
            "\"fps FPS\", \"stages PIPELINE\", and what is to be expected of it: \"frames N\", \"megabytes MB\", "
            "\"steps N\", \"seconds S\"",
            sheet::Tool::Provenance::omit);
  tool.option("--check-rows", rows, "FILE",
              "check many variants of the scene instead: each line of FILE (- for standard input) has settings as "
              "--set takes them, separated by tabs; tells what is wrong with which line, and refuses what --check does",
              sheet::Tool::Provenance::omit);
  tool.flag("--example", example, "print a commented scene that shows every table and key",
            sheet::Tool::Provenance::omit);
  tool.flag(
      "--list-keys", list_keys,
      "print every key that a scene may have, one a line: key, kind of value, SI unit and what it is, separated by "
      "tabs; N stands for the number of a [[hold]] and its like",
      sheet::Tool::Provenance::omit);
  tool.flag(
      "--list-files", list_files,
      "print every file that the scene names, one a line: where it is, seen from here, and the key that names it, "
      "separated by a tab",
      sheet::Tool::Provenance::omit);
  tool.option("-o,--output", output, "FILE", "stream to write; - for standard output", sheet::Tool::Provenance::omit);
  tool.flag("--no-provenance", no_provenance, "leave out the record of program and options",
            sheet::Tool::Provenance::omit);
  tool.example("sheet-init --example > scene.toml", "start a scene of your own");
  tool.example("sheet-init --check scene.toml", "what will it model?");
  tool.example("sheet-init --check --until 0.5 --fps 100 scene.toml", "the same, with the ring to that time");
  tool.example("sheet-init scene.toml --set material.viscosity='50 Pa*s' > first.sheet",
               "the first frame, with a change");
  tool.example("sheet-init --list-keys | grep viscosity", "what may a scene say of it?");
  tool.example("sheet-init --list-files scene.toml", "what else does the scene need?");
  tool.example("printf 'sheet.thickness=2 mm\\nsheet.thickness=3 mm\\n' | sheet-init --check-rows - scene.toml",
               "are all of these scenes well?");
  return tool.run(argc, argv, [&] {
    for (const auto& [name, value] : {std::pair("--until", source.until), std::pair("--fps", source.fps)})
      if (value && !(*value > 0))
        sheet::fail(sheet::ExitCode::usage, "{}: {} is not a positive number", name, *value);
      else if (value && !check && !ring)
        sheet::fail(sheet::ExitCode::usage, "{} belongs to the ring of --check or --ring", name);
    if (!rows.empty()) {
      check_rows(source, rows);
      return;
    }
    if (example || check || ring || list_keys || list_files) {
      const std::string text = example      ? std::string(sheet::scene::example())
                               : list_keys  ? key_list()
                               : list_files ? file_list(source)
                                            : explained(source, ring);
      sheet::OutputFile file(output, sheet::OutputFile::Content::text);
      file.write(text);
      file.close();
      return;
    }
    const sheet::Scene scene = read(source);
    sheet::formats::Frame frame = sheet::checked_first_frame(scene);
    warn_of_symmetry(scene, frame);
    if (!no_provenance)
      sheet::record_provenance(frame, tool.command_line());
    sheet::log::detail("{} vertices, {} triangles", frame.vertices, frame.triangles);
    sheet::OutputFile file(output, sheet::OutputFile::Content::binary);
    sheet::formats::StreamWriter writer(file.descriptor(), file.name());
    file.start();
    writer.write(frame);
    writer.end();
    file.close();
  });
}
