// SPDX-License-Identifier: GPL-3.0-or-later
// A frame as the page holds it: whole numbers of steps, whose sizes the description says. Half a step is the error:
//   positions  one step for all coordinates of a frame, a power of two, at most 1/512 of the shortest edge: less than a
//              thousandth of any edge is the error (of those that are shorter than an eighth of the edge that a tenth
//              of the edges are shorter than, it is more)
//   thickness  steps of a ten-thousandth of the logarithm: the error is 0.005 % of the thickness
//   velocity   a power of two, at most 1/16384 of the frame's greatest speed
//   others     a power of two, at most 1/4096 of the frame's greatest value; kinds are bytes, and so are numbers of
//   liquids
// (Coordinates beyond 2^30 steps get a larger one.)
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "libsheet/quantities/fields.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::view {

class PackedNumbers;

struct Range {
  double low = 0, high = 0;
};

// Of a quantity (libsheet/quantities/fields.h) in a frame.
struct FieldDescription {
  bool there = true;    // the frame has it
  Range range = {};     // what all but the lowest and the highest hundredth have, SI
  double step = 0;      // SI; 0 of what is not packed by itself
  bool follows = false; // the frame before
};

struct FrameDescription {
  double time = 0; // [s]
  std::uint64_t step = 0, vertices = 0, triangles = 0;
  bool same_mesh = false; // as the frame before; numbers are differences from that where the step is the same, too
  double position_step = 0, velocity_step = 0;             // [m], [m/s]
  bool position_follows = false, velocity_follows = false; // the frame before
  bool moves = false;                                      // it has velocities
  bool liquids = false;                                    // it has several
  std::vector<FieldDescription> fields = {};               // of all fields()
  std::array<double, 3> low{}, high{};                     // of positions [m]
  double volume = 0;                                       // [m³]
};

// Whether a field is packed by itself: the thickness is there in any case, the speed follows from the velocity.
[[nodiscard]] bool is_packed(const Field& field);

inline constexpr double thickness_step = 1e-4; // of its logarithm

struct PackedFrame {
  FrameDescription description;
  // triangles (unless same_mesh), positions (all x, then y, z), thickness of triangles, velocities, the fields that
  // are packed, in their order, numbers of the vertices' liquids
  std::string text;
};

// Packs the frames of a stream, one after the other. Precondition: frames obey the format's rules.
class FramePacker {
public:
  // `liquids`: the number of each vertex's (FrameLiquids); empty of one liquid.
  [[nodiscard]] PackedFrame pack(const formats::Frame& frame, std::span<const std::uint32_t> liquids = {});

private:
  struct Numbers {
    double step = 0;
    std::vector<std::int32_t> numbers;
  };
  FieldDescription pack_field(const formats::Frame& frame, const Field& field, Numbers& kept, bool same_mesh,
                              PackedNumbers& packed);
  // Packs and keeps them; whether they are packed as differences from those kept before.
  bool replace(Numbers& kept, Numbers next, bool same_mesh, PackedNumbers& packed);

  std::vector<Corners> corners_;
  std::uint64_t vertices_ = 0;
  bool first_ = true;
  Numbers positions_, thickness_, velocities_;
  std::vector<Numbers> fields_;
};

} // namespace sheet::view
