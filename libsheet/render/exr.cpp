// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <sstream>

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStdIO.h>

#include "libsheet/base/error.h"
#include "libsheet/render/codecs.h"
#include "libsheet/render/picture_file.h"

namespace sheet::render {
namespace {

// A file in memory.
class Input : public Imf::IStream {
public:
  Input(std::istringstream& s, const std::string& file) : Imf::IStream(file.c_str()), stream_(s) {}
  bool read(char c[], int n) override {
    stream_.read(c, n);
    if (stream_.gcount() != n)
      throw std::runtime_error("it ends too soon");
    return stream_.peek() != std::istringstream::traits_type::eof();
  }
  std::uint64_t tellg() override { return static_cast<std::uint64_t>(std::streamoff(stream_.tellg())); }
  void seekg(std::uint64_t position) override {
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(position));
  }

private:
  std::istringstream& stream_;
};

} // namespace

std::string encode_exr(const Picture& picture) {
  const Image& image = picture.light;
  Imf::Header header(image.width, image.height);
  Imf::FrameBuffer buffer;
  const auto row = [&](std::size_t pixel) { return pixel * static_cast<std::size_t>(image.width); };
  const auto channel = [&](const char* name, Imf::PixelType stored, const void* first, std::size_t stride,
                           Imf::PixelType type) {
    header.channels().insert(name, Imf::Channel(stored));
    buffer.insert(name, Imf::Slice(type, const_cast<char*>(static_cast<const char*>(first)), stride, row(stride)));
  };
  std::vector<Imath::half> half;
  for (const Colour& c : image.pixels)
    for (const float x : c)
      half.emplace_back(std::min(x, 65504.0F)); // the largest half
  const char* const colours[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c)
    channel(colours[c], Imf::HALF, half.data() + c, 3 * sizeof(Imath::half), Imf::HALF);
  const std::vector<Imath::half> alpha(picture.alpha.begin(), picture.alpha.end());
  if (!alpha.empty())
    channel("A", Imf::HALF, alpha.data(), sizeof(Imath::half), Imf::HALF);
  const Layers& layers = picture.layers;
  if (!layers.depth.empty()) {
    channel("Z", Imf::FLOAT, layers.depth.data(), sizeof(float), Imf::FLOAT);
    const char* const velocity_names[] = {"velocity.X", "velocity.Y", "velocity.Z"};
    const char* const albedo_names[] = {"albedo.R", "albedo.G", "albedo.B"};
    const char* const axes[] = {"normal.X", "normal.Y", "normal.Z"};
    for (std::size_t c = 0; c < 3; ++c)
      channel(axes[c], Imf::FLOAT, layers.normal[0].data() + c, sizeof(Vec), Imf::FLOAT);
    channel("thickness", Imf::FLOAT, layers.thickness.data(), sizeof(float), Imf::FLOAT);
    for (std::size_t c = 0; c < 3; ++c)
      channel(velocity_names[c], Imf::FLOAT, layers.velocity[0].data() + c, sizeof(Vec), Imf::FLOAT);
    for (std::size_t c = 0; c < 3; ++c)
      channel(albedo_names[c], Imf::FLOAT, layers.albedo[0].data() + c, sizeof(Colour), Imf::FLOAT);
    channel("id", Imf::UINT, layers.id.data(), sizeof(std::uint32_t), Imf::UINT);
  }
  Imf::StdOSStream stream;
  {
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(buffer);
    file.writePixels(image.height);
  } // closing writes the table of lines
  return stream.str();
}

Image decode_exr(const std::string& bytes, const std::string& name) try {
  std::istringstream text(bytes);
  Input input(text, name);
  Imf::RgbaInputFile file(input);
  const Imath::Box2i window = file.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1,
                     height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1 || width > longest_side || height > longest_side)
    fail(ExitCode::bad_input, "{}: {} x {} pixels: a side must have 1 to {}", name, width, height, longest_side);
  Imf::Array2D<Imf::Rgba> values(static_cast<long>(height), static_cast<long>(width));
  file.setFrameBuffer(&values[0][0] - window.min.x - window.min.y * width, 1, static_cast<std::size_t>(width));
  file.readPixels(window.min.y, window.max.y);
  Image image(static_cast<int>(width), static_cast<int>(height));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.at(x, y) = {values[y][x].r, values[y][x].g, values[y][x].b};
  return image;
} catch (const Error&) {
  throw;
} catch (const std::exception& error) {
  fail(ExitCode::bad_input, "{}: not an EXR image that can be read: {}", name, error.what());
}

} // namespace sheet::render
