// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/loop/recorded_ring.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <regex>
#include <sstream>

#include <fmt/format.h>

#include "libsheet/base/error.h"
#include "libsheet/base/filter.h"
#include "libsheet/base/shell_words.h"
#include "libsheet/base/version.h"

namespace sheet {

namespace {

constexpr std::string_view program = "sheet-loop";

std::string text_of(const formats::Frame& frame) {
  const formats::Array* array = frame.find("provenance");
  return array == nullptr ? std::string() : std::string(array->text());
}

std::string line_of(const RecordedRing& ring, const std::vector<std::string>& sets) {
  std::string line = fmt::format("{} ({})", program, version_text);
  if (ring.fps)
    line += fmt::format(" --fps {}", *ring.fps);
  if (!ring.keep.empty())
    line += " --keep " + shell_quoted(ring.keep);
  for (const std::string& set : sets)
    line += " --set " + shell_quoted(set);
  return line + " -- " + shell_quoted(ring.pipeline);
}

double parse_fps(const std::string& word) {
  double fps = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), fps);
  if (error != std::errc{} || stop != word.data() + word.size() || !(fps > 0))
    fail(ExitCode::bad_input, "the frame's provenance: --fps {} is not a positive number; give the stages behind --",
         word);
  return fps;
}

// Of a line of the provenance; none if it is another program's, or tells no pipeline.
std::optional<RecordedRing> parse_ring(const std::string& line) {
  const std::vector<std::string> words = shell_words(line);
  if (words.size() < 3 || words[1] != program) // the count, the program, its version
    return {};
  RecordedRing ring;
  for (std::size_t i = 3; i + 1 < words.size(); i += 2) {
    if (words[i] == "--") {
      ring.pipeline = words[i + 1];
      return ring;
    }
    if (words[i] == "--fps")
      ring.fps = parse_fps(words[i + 1]);
    else if (words[i] == "--keep")
      ring.keep = words[i + 1];
  }
  return {};
}

// Moves the line to the end of the provenance, if it is there.
void move_to_the_end(formats::Frame& frame, const std::string& line) {
  std::istringstream lines(text_of(frame));
  std::string others, moved;
  for (std::string old; std::getline(lines, old);) {
    std::string& text = old.substr(std::min(old.size(), old.find(' ') + 1)) == line ? moved : others;
    text += (text.empty() ? "" : "\n") + old;
  }
  if (!moved.empty())
    frame.put_text("provenance", others.empty() ? moved : others + "\n" + moved);
}

} // namespace

std::string without_threads(const std::string& pipeline) {
  static const std::regex option(R"( +--threads[ =]+[0-9]+(?=[ |)]|$))");
  return std::regex_replace(pipeline, option, "");
}

bool is_harmless(const std::string& pipeline) {
  static const std::string value = "[0-9A-Za-z.+][0-9A-Za-z.+-]*";
  static const std::string word = "(-[qv]|--(?!output|failed)[a-z-]+(=" + value + ")?|" + value + ")";
  static const std::string stage = " *sheet-(collide|emit|merge|pass|remesh|step|tear)( +" + word + ")* *";
  static const std::regex whole(stage + "(\\|" + stage + ")*");
  return std::regex_match(pipeline, whole);
}

std::optional<RecordedRing> recorded_ring(const formats::Frame& frame) {
  std::optional<RecordedRing> last;
  std::istringstream lines(text_of(frame));
  for (std::string line; std::getline(lines, line);)
    if (auto ring = parse_ring(line))
      last = std::move(ring);
  return last;
}

void record_ring(formats::Frame& frame, const RecordedRing& ring) {
  if (recorded_ring(frame) == ring)
    return;
  const std::string line = line_of(ring, {});
  move_to_the_end(frame, line);
  record_provenance(frame, line);
}

void record_change(formats::Frame& frame, const RecordedRing& ring, const std::vector<std::string>& sets) {
  record_provenance(frame, fmt::format("{} # from step {}, t = {} s", line_of(ring, sets), frame.step, frame.time));
}

} // namespace sheet
