// SPDX-License-Identifier: GPL-3.0-or-later
// Radiance's picture format, RGBE [Ward 1991, Real Pixels, in Graphics Gems II]: a head of lines, and for each pixel
// three mantissas with an exponent of their own.
#include <array>
#include <cmath>
#include <sstream>
#include <string_view>

#include "libsheet/base/error.h"
#include "libsheet/render/codecs.h"

namespace sheet::render {
namespace {

using Pixel = std::array<unsigned char, 4>;

class Reader {
public:
  Reader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(&name) {}

  Image read() {
    Image image = read_head();
    std::vector<Pixel> row(static_cast<std::size_t>(image.width));
    for (int y = 0; y < image.height; ++y) {
      read_row(row);
      for (int x = 0; x < image.width; ++x)
        image.at(x, y) = light(row[static_cast<std::size_t>(x)]);
    }
    return image;
  }

private:
  static Colour light(const Pixel& p) {
    if (p[3] == 0)
      return Colour::Zero();
    const float unit = std::ldexp(1.0F, static_cast<int>(p[3]) - (128 + 8));
    return unit * Colour(p[0], p[1], p[2]);
  }

  [[noreturn]] void refuse(const std::string& why) const {
    fail(ExitCode::bad_input, "{}: not a Radiance image that can be read: {}", *name_, why);
  }

  std::string_view line() {
    const std::size_t end = bytes_.find('\n', place_);
    if (end == std::string_view::npos)
      refuse("its head ends too soon");
    const std::string_view result = bytes_.substr(place_, end - place_);
    place_ = end + 1;
    return result;
  }

  Image read_head() {
    if (!line().starts_with("#?"))
      refuse("it does not begin with #?RADIANCE");
    for (std::string_view text = line(); !text.empty(); text = line())
      if (text.starts_with("FORMAT=") && text != "FORMAT=32-bit_rle_rgbe")
        refuse("its colours are not red, green and blue (FORMAT=32-bit_rle_rgbe)");
    std::istringstream size{std::string(line())};
    std::string down, along;
    std::int64_t height = 0, width = 0;
    if (!(size >> down >> height >> along >> width) || down != "-Y" || along != "+X")
      refuse("its size is not given as -Y HEIGHT +X WIDTH");
    if (width < 1 || height < 1 || width > longest_side || height > longest_side)
      fail(ExitCode::bad_input, "{}: {} x {} pixels: a side must have 1 to {}", *name_, width, height, longest_side);
    return {static_cast<int>(width), static_cast<int>(height)};
  }

  unsigned char byte() {
    if (place_ >= bytes_.size())
      refuse("it ends too soon");
    return static_cast<unsigned char>(bytes_[place_++]);
  }

  // A row in runs begins with 2, 2 and its length; else its pixels stand one behind the other.
  void read_row(std::vector<Pixel>& row) {
    Pixel first;
    for (unsigned char& b : first)
      b = byte();
    if (first[0] == 2 && first[1] == 2 && (std::size_t{first[2]} << 8 | first[3]) == row.size() && row.size() >= 8) {
      for (std::size_t part = 0; part < 4; ++part)
        read_runs(row, part);
      return;
    }
    row[0] = first;
    for (std::size_t x = 1; x < row.size(); ++x)
      for (unsigned char& b : row[x])
        b = byte();
  }

  // Of one of the four bytes: above 128, so many times the next one; else so many as they are.
  void read_runs(std::vector<Pixel>& row, std::size_t part) {
    for (std::size_t x = 0; x < row.size();) {
      const unsigned count = byte();
      const bool is_run = count > 128;
      const std::size_t length = is_run ? count - 128 : count;
      if (length == 0 || length > row.size() - x)
        refuse("a run is longer than its row");
      const unsigned char repeated = is_run ? byte() : '\0';
      for (const std::size_t end = x + length; x < end; ++x)
        row[x][part] = is_run ? repeated : byte();
    }
  }

  std::string_view bytes_;
  const std::string* name_;
  std::size_t place_ = 0;
};

} // namespace

Image decode_hdr(const std::string& bytes, const std::string& name) { return Reader(bytes, name).read(); }

} // namespace sheet::render
