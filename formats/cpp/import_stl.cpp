// SPDX-License-Identifier: MIT
// STL: triangles without connectivity, ASCII ("solid ... facet ... vertex x y z ...") or binary (80 bytes of anything,
// the count, 50 bytes a triangle, little endian). Vertices with equal coordinates become one.
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "formats/cpp/byte_scan.h"
#include "formats/cpp/mesh_assembler.h"
#include "formats/cpp/text_scan.h"
#include "formats/cpp/text_start.h"

namespace sheet::formats {

namespace {

constexpr std::size_t header_bytes = 84, triangle_bytes = 50;

struct PointHash {
  std::size_t operator()(const std::array<double, 3>& p) const {
    std::uint64_t h = 0x9E3779B97F4A7C15U;
    for (const double x : p) {
      h ^= std::bit_cast<std::uint64_t>(x);
      h *= 0xFF51AFD7ED558CCDU;
      h ^= h >> 32;
    }
    return static_cast<std::size_t>(h);
  }
};

class PointMerger {
public:
  explicit PointMerger(MeshAssembler& mesh) : mesh_(mesh) {}
  std::int64_t index(std::array<double, 3> p) {
    for (double& x : p)
      x += 0.0; // makes -0 equal to 0 in its bits too
    const auto [place, is_new] = index_.try_emplace(p, static_cast<std::int64_t>(mesh_.points.size()));
    if (is_new)
      mesh_.points.push_back(p);
    return place->second;
  }

private:
  MeshAssembler& mesh_;
  std::unordered_map<std::array<double, 3>, std::int64_t, PointHash> index_;
};

void read_binary(std::string_view bytes, const std::string& name, MeshAssembler& mesh) {
  const std::uint64_t count = load_number<std::uint32_t>(bytes.data() + 80, ByteOrder::little);
  const std::uint64_t expected = header_bytes + count * triangle_bytes;
  if (bytes.size() < expected)
    mesh_fail(name, "byte 80",
              "the file claims " + std::to_string(count) + " triangles and should have " + std::to_string(expected) +
                  " bytes but has " + std::to_string(bytes.size()) + "; it was cut short or is no STL file");
  if (bytes.size() > expected)
    mesh.note("byte " + std::to_string(expected) + " and what follows the last triangle passed over");
  PointMerger merger(mesh);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::size_t start = header_bytes + i * triangle_bytes;
    std::array<std::int64_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<double, 3> p{};
      for (std::size_t d = 0; d < 3; ++d) {
        const std::size_t at = start + 12 * (k + 1) + 4 * d;
        p[d] = load_number<float>(bytes.data() + at, ByteOrder::little);
        if (!std::isfinite(p[d]))
          mesh_fail(name, "byte " + std::to_string(at), "a coordinate is not finite");
      }
      corners[k] = merger.index(p);
    }
    mesh.add_face(corners, start);
  }
}

// Whether it is a keyword, which some programs write in capitals. `keyword`: in small letters.
bool is_word(std::string_view word, std::string_view keyword) {
  return std::ranges::equal(word, keyword, {},
                            [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
}

void expect(TextScan& text, std::string_view word) {
  const std::string_view found = text.word_across_lines();
  if (!is_word(found, word))
    text.fail("expected " + quoted(word) + ", found " + (found.empty() ? "the end of the file" : quoted(found)));
}

void read_ascii(std::string_view bytes, const std::string& name, MeshAssembler& mesh) {
  TextScan text(bytes, name, 0);
  PointMerger merger(mesh);
  text.next_filled_line();
  text.word(); // "solid"; the rest of the line is its name
  while (text.next_line()) {
    std::string_view word = text.word_across_lines();
    while (is_word(word, "facet")) {
      const std::uint64_t line = text.line();
      expect(text, "normal");
      for (int d = 0; d < 3; ++d)
        text.word_across_lines(); // many programs write nonsense here; the corners' order is what counts
      expect(text, "outer");
      expect(text, "loop");
      std::array<std::int64_t, 3> corners{};
      for (std::int64_t& corner : corners) {
        expect(text, "vertex");
        std::array<double, 3> p{};
        for (double& x : p)
          x = text.to_real(text.word_across_lines(), "a coordinate");
        corner = merger.index(p);
      }
      expect(text, "endloop");
      expect(text, "endfacet");
      mesh.add_face(corners, line);
      word = text.word_across_lines();
    }
    if (word.empty())
      break;
    if (!is_word(word, "endsolid") && !is_word(word, "solid"))
      text.fail("expected 'facet' or 'endsolid', found " + quoted(word));
  }
}

} // namespace

MeshImport import_stl(std::string_view bytes, const std::string& name) {
  // Some programs start binary files with "solid" too: the size decides, then the word and whether text follows.
  const bool size_fits = bytes.size() >= header_bytes &&
                         bytes.size() == header_bytes + triangle_bytes * std::uint64_t{load_number<std::uint32_t>(
                                                                             bytes.data() + 80, ByteOrder::little)};
  if (!size_fits) {
    bytes = without_mark(bytes);
    if (const std::string error = find_no_text(bytes); !error.empty())
      mesh_fail(name, "", error);
  }
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  const bool says_solid = first != bytes.npos && is_word(bytes.substr(first, 5), "solid") &&
                          bytes.substr(0, header_bytes).find('\0') == bytes.npos;
  if (!says_solid && bytes.size() < header_bytes)
    mesh_fail(name, "", "neither ASCII STL (no 'solid' at its start) nor binary STL (shorter than 84 bytes)");
  const bool binary = size_fits || !says_solid;
  MeshAssembler mesh(name, binary ? "byte" : "line");
  if (binary)
    read_binary(bytes, name, mesh);
  else
    read_ascii(bytes, name, mesh);
  return std::move(mesh).finish({});
}

} // namespace sheet::formats
