// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/picture_file.h"

#include <array>

#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/render/codecs.h"
#include "libsheet/render/display.h"

namespace sheet::render {
namespace {

Image ramp(int w, int h) {
  Image image(w, h);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      image.at(x, y) = {static_cast<float>(x) / static_cast<float>(w), static_cast<float>(y) / static_cast<float>(h),
                        0.25F};
  return image;
}

Picture picture_of(const Image& image) {
  Picture picture;
  picture.light = image;
  return picture;
}

// A pixel of such light of which a part is covered, laid over black, white in linear light.
struct Over {
  float black, white;
};
Over over(float light, float alpha) {
  Picture picture = picture_of(Image(1, 1));
  picture.light.at(0, 0) = Colour::Constant(light);
  picture.alpha = {alpha};
  const Bitmap bitmap = to_bitmap(picture, Tone::linear);
  const float part = static_cast<float>(bitmap.alpha[0]) / 255,
              shown = part * decode_srgb(static_cast<float>(bitmap.bytes[0]) / 255);
  return {shown, shown + 1 - part};
}

// What covers a part of a pixel has its own colour there, undimmed; a highlight on glass keeps its light.
TEST(Display, StraightAlpha) {
  constexpr float level = 1 / 255.0F;
  EXPECT_NEAR(over(0.1F, 0.25F).black, 0.1F, level);
  EXPECT_NEAR(over(0.1F, 0.25F).white, 0.85F, level);
  EXPECT_EQ(over(0, 0).white, 1);
  EXPECT_NEAR(over(0.7F, 0.1F).black, 0.7F, level);
  EXPECT_NEAR(over(0.7F, 0.1F).white, 1, level);
  EXPECT_EQ(over(3, 0.1F).black, 1);
  EXPECT_TRUE(to_bitmap(picture_of(Image(2, 1)), Tone::linear).alpha.empty());
}

TEST(Display, ToneCurve) {
  for (int i = 0; i < 256; ++i) {
    const float x = static_cast<float>(i) / 255;
    EXPECT_NEAR(encode_srgb(decode_srgb(x)), x, 1e-5);
  }
  EXPECT_FLOAT_EQ(shoulder(0.5F), 0.5F);
  EXPECT_NEAR((shoulder(0.6F + 1e-3F) - shoulder(0.6F)) / 1e-3F, 1, 1e-2);
  EXPECT_LT(shoulder(1), shoulder(3));
  EXPECT_LE(shoulder(1e6F), 1);
  for (const float x : {0.0F, 0.01F, 0.18F, 0.6F, 1.0F, 5.0F, 1e5F, 1e20F}) {
    EXPECT_LE(filmic(x), filmic(1.1F * x + 1e-3F));
    EXPECT_LE(filmic(x), 1);
  }
  EXPECT_EQ(filmic(0), 0);
  EXPECT_NEAR(filmic(0.18F), 0.267F, 1e-3F); // by hand
  Image image(1, 1);
  image.at(0, 0) = Colour::Constant(0.18F);
  const auto shown = [&](Tone tone) { return to_bitmap(picture_of(image), tone).bytes[0]; };
  EXPECT_EQ(shown(Tone::linear), 118);
  EXPECT_EQ(shown(Tone::shoulder), 118);
  EXPECT_EQ(shown(Tone::filmic), 141);
}

TEST(Png, GoesRound) {
  const Image image = ramp(37, 20);
  const Bitmap bitmap = to_bitmap(picture_of(image), Tone::linear);
  const Image again = decode_png(encode_png(bitmap), "ramp");
  ASSERT_EQ(again.width, 37);
  const Bitmap same = to_bitmap(picture_of(again), Tone::linear);
  EXPECT_EQ(same.bytes, bitmap.bytes);
}

TEST(Png, HasAlpha) {
  Bitmap bitmap(2, 1);
  bitmap.bytes = {200, 100, 50, 7, 8, 9};
  const std::size_t colour_type = 25; // of the header: 2 RGB, 6 RGBA
  EXPECT_EQ(encode_png(bitmap)[colour_type], 2);
  bitmap.alpha = {255, 0};
  const std::string png = encode_png(bitmap);
  EXPECT_EQ(png[colour_type], 6);
  const Image opaque = decode_png(png, "alpha");
  EXPECT_NEAR(encode_srgb(opaque.at(0, 0)[0]), 200 / 255.0F, 1e-5);
}

// A pixel of Radiance's format: three mantissas and their exponent.
std::string rgbe(int r, int g, int b, int e) {
  return {static_cast<char>(r), static_cast<char>(g), static_cast<char>(b), static_cast<char>(e)};
}

TEST(Hdr, FlatAndRunLengthsAreTheSameLight) {
  const std::string head = "#?RADIANCE\n# made by hand\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n";
  std::string flat = head, runs = head + rgbe(2, 2, 0, 8);
  for (int x = 0; x < 8; ++x)
    flat += rgbe(128, x < 4 ? 64 : 32, 0, 130);
  runs += std::string("\x88\x80", 2);                     // 8 times 128
  runs += std::string("\x84\x40\x04\x20\x20\x20\x20", 7); // 4 times 64, then four as they are
  runs += std::string("\x88\x00", 2) + std::string("\x88\x82", 2);
  for (const std::string& file : {flat, runs}) {
    const Image image = decode_hdr(file, "sky.hdr");
    ASSERT_EQ(image.width, 8);
    ASSERT_EQ(image.height, 1);
    EXPECT_TRUE((image.at(0, 0) == Colour(2, 1, 0)).all());
    EXPECT_TRUE((image.at(7, 0) == Colour(2, 0.5F, 0)).all());
  }
  for (std::size_t length = 0; length < runs.size(); ++length)
    EXPECT_THROW((void)decode_hdr(runs.substr(0, length), "sky.hdr"), Error) << length;
  EXPECT_THROW((void)decode_hdr(head + rgbe(2, 2, 0, 8) + std::string("\x89\x80", 2), "sky.hdr"), Error);
}

TEST(Exr, GoesRoundWithLayers) {
  Picture picture;
  picture.light = ramp(19, 30);
  const std::size_t n = picture.light.pixels.size();
  picture.layers = {std::vector<float>(n, 2),          std::vector<Vec>(n, Vec::UnitY()),
                    std::vector<float>(n, 0.003F),     std::vector<std::uint32_t>(n, sheet_id),
                    std::vector<Vec>(n, Vec::UnitX()), std::vector<Colour>(n, Colour::Constant(0.5F))};
  const std::string bytes = encode_exr(picture);
  for (const char* channel : {"Z", "normal.X", "normal.Y", "normal.Z", "thickness", "id", "velocity.X", "albedo.B"})
    EXPECT_NE(bytes.find(std::string(channel) + '\0'), std::string::npos) << channel;
  const Image again = decode_exr(bytes, "ramp");
  ASSERT_EQ(again.pixels.size(), n);
  for (std::size_t i = 0; i < n; ++i)
    EXPECT_LT((again.pixels[i] - picture.light.pixels[i]).abs().maxCoeff(), 1e-3);
}

TEST(Decoders, RefuseWhatIsNoPicture) {
  Picture picture;
  picture.light = ramp(8, 8);
  const std::string png = encode_png(to_bitmap(picture, Tone::linear)), exr = encode_exr(picture);
  for (std::size_t length = 0; length + 32 < png.size();
       length += 7) // without its end mark alone it is still a picture
    EXPECT_THROW(static_cast<void>(decode_png(png.substr(0, length), "cut.png")), Error) << length;
  for (std::size_t length = 0; length + 1 < exr.size(); length += 7)
    EXPECT_THROW(static_cast<void>(decode_exr(exr.substr(0, length), "cut.exr")), Error) << length;
  EXPECT_THROW(static_cast<void>(read_picture("/nonexistent/a.exr")), Error);
  EXPECT_THROW(static_cast<void>(read_picture("sky.jpg")), Error);
}

TEST(Y4m, KnowsTheColoursOfTheStandard) {
  // 75 % bars of BT.601: R'G'B' 191 to Y' 180, and red to Cr 212 [ITU-R BT.801].
  Bitmap bitmap(3, 3);
  const auto fill_with = [&](std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    for (std::size_t i = 0; i < 9; ++i) {
      bitmap.bytes[3 * i] = r;
      bitmap.bytes[3 * i + 1] = g;
      bitmap.bytes[3 * i + 2] = b;
    }
    const std::string bytes = encode_y4m(bitmap);
    EXPECT_EQ(bytes.size(), 6U + 9 + 4 + 4);
    const auto at = [&](std::size_t i) { return static_cast<int>(static_cast<unsigned char>(bytes[6 + i])); };
    return std::array{at(0), at(9), at(13)};
  };
  EXPECT_EQ(fill_with(255, 255, 255), (std::array{235, 128, 128}));
  EXPECT_EQ(fill_with(0, 0, 0), (std::array{16, 128, 128}));
  EXPECT_EQ(fill_with(191, 191, 191), (std::array{180, 128, 128}));
  EXPECT_EQ(fill_with(191, 0, 0), (std::array{65, 100, 212}));
  EXPECT_EQ(fill_with(0, 0, 191), (std::array{35, 212, 114}));
  EXPECT_EQ(y4m_header(640, 360, 24), "YUV4MPEG2 W640 H360 F24:1 Ip A1:1 C420jpeg\n");
  EXPECT_EQ(y4m_header(640, 360, 29.97), "YUV4MPEG2 W640 H360 F29970:1000 Ip A1:1 C420jpeg\n");
}

} // namespace
} // namespace sheet::render
