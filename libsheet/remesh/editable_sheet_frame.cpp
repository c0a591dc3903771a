// SPDX-License-Identifier: GPL-3.0-or-later
// The way of a frame into an EditableSheet and out of it.
#include <algorithm>
#include <cstring>

#include "libsheet/remesh/editable_sheet.h"
#include "libsheet/remesh/numbering.h"
#include "libsheet/remesh/row_storage.h"
#include "libsheet/scene/prescribed.h"
#include "libsheet/sheet/carried_springs.h"
#include "libsheet/sheet/edge_rows.h"

namespace sheet::remesh {

using formats::Array;
using formats::Frame;
using formats::Place;
using formats::Transfer;

namespace {

constexpr std::string_view swept_name = "swept_volume";

// Arrays with rules of their own.
bool is_own(const Array& array) {
  return array.name == "position" || array.name == "velocity" || array.name == "triangle" || array.name == "volume" ||
         array.name == swept_name;
}

std::vector<Array> rows_of(const Frame& frame, Place place) {
  std::vector<Array> rows;
  for (const Array& array : frame.arrays)
    if (array.place == place && array.transfer != Transfer::drop && !is_own(array))
      rows.push_back(array);
  return rows;
}

template <class T>
Array made_like(const Array& old, const std::vector<std::uint32_t>& slots, const std::vector<T>& values) {
  Array made = formats::make_array(old.name, old.place, old.type, old.components, old.unit, old.transfer, slots.size(),
                                   old.critical);
  for (std::size_t i = 0; i < slots.size(); ++i)
    made.values<T>()[i] = values[slots[i]];
  return made;
}

Array made_like(const Array& old, const std::vector<std::uint32_t>& slots, Array& rows) {
  Array made = formats::make_array(old.name, old.place, old.type, old.components, old.unit, old.transfer, slots.size(),
                                   old.critical);
  for (std::size_t i = 0; i < slots.size(); ++i)
    std::memcpy(made.data.data() + i * row_size(rows), row_at(rows, slots[i]), row_size(rows));
  return made;
}

// A hold that has let go holds nobody any longer: its bit goes.
void forget_released(const Scene& scene, double time, std::vector<Array>& vertex_rows) {
  const std::uint64_t in_force = scene::holds_in_force(scene, time);
  for (Array& array : vertex_rows)
    if (array.name == "hold")
      for (std::uint64_t& bits : array.values<std::uint64_t>())
        bits &= in_force;
}

// The one solid that a row of `touch` names, if it lets liquid flow along it; none: no_index.
std::uint32_t wall_in(const Scene* scene, const std::byte* row, std::size_t bytes) {
  std::size_t solids = 0, last = 0;
  for (std::size_t bit = 0; bit < 8 * bytes; ++bit) // words are little-endian
    if ((row[bit / 8] >> (bit % 8) & std::byte{1}) != std::byte{0}) {
      ++solids;
      last = bit;
    }
  const bool flows = scene != nullptr && solids == 1 && last < scene->solids.size() &&
                     scene->solids[last].contact != SolidContact::stick;
  return flows ? static_cast<std::uint32_t>(last) : no_index;
}

} // namespace

EditableSheet::EditableSheet(const Frame& frame, const Scene* scene)
    : scene_(scene), mesh_(frame.vertices, triangles(frame)), directors_(frame) {
  const auto x = sheet::positions(frame);
  position_.assign(x.begin(), x.end());
  const auto u = velocities(frame);
  velocity_.assign(u.begin(), u.end());
  const auto volume = volumes(frame);
  volume_.assign(volume.begin(), volume.end());
  for (const Corners& c : triangles(frame))
    shape_.emplace_back(position_[c[0]], position_[c[1]], position_[c[2]]);
  swept_.assign(position_.size(), 0);
  if (const Array* ledger = frame.find(swept_name); ledger != nullptr)
    std::copy_n(ledger->values<double>().begin(), swept_.size(), swept_.begin());
  vertex_rows_ = rows_of(frame, Place::vertex);
  triangle_rows_ = rows_of(frame, Place::triangle);
  for (std::size_t i = 0; i < triangle_rows_.size(); ++i)
    if (triangle_rows_[i].name == "temperature")
      temperature_ = i;
    else if (triangle_rows_[i].name == "liquid")
      liquid_ = i;
  for (std::size_t i = 0; i < triangle_rows_.size(); ++i)
    for (std::uint32_t c = 0; triangle_rows_[i].transfer == Transfer::mean && c < triangle_rows_[i].components; ++c)
      means_.push_back({i, c, {}});
  for (std::uint32_t v = 0; v < position_.size(); ++v) {
    carried_.push_back(carried_volume(v));
    successor_.push_back(v);
  }
  for (const std::uint64_t bits : masks(frame, "inlet"))
    at_inlet_.push_back(bits != 0);
  if (scene != nullptr)
    forget_released(*scene, frame.time, vertex_rows_);
  const bool any_grip = std::any_of(vertex_rows_.begin(), vertex_rows_.end(),
                                    [](const Array& array) { return array.transfer == Transfer::common; });
  for (std::uint32_t v = 0; any_grip && v < position_.size(); ++v)
    grip_.push_back(grip_of(v));
}

std::uint32_t EditableSheet::grip_of(std::uint32_t v) {
  const auto any = [](std::span<const std::byte> mask) {
    return std::ranges::any_of(mask, [](std::byte b) { return b != std::byte{0}; });
  };
  std::vector<std::byte> masks;
  bool by_touch = true;
  std::uint32_t wall = no_index;
  for (Array& array : vertex_rows_)
    if (array.transfer == Transfer::common) {
      const std::span<const std::byte> mask{row_at(array, v), row_size(array)};
      if (array.name == "touch")
        wall = wall_in(scene_, mask.data(), mask.size());
      masks.insert(masks.end(), mask.begin(), mask.end());
      by_touch = by_touch && (array.name == "touch" || !any(mask));
    }
  if (!any(masks))
    return 0;
  auto it = std::find_if(grips_.begin(), grips_.end(), [&](const Grip& grip) { return grip.masks == masks; });
  if (it == grips_.end())
    it = grips_.insert(grips_.end(), {masks, axes_of(v), wall, by_touch});
  return static_cast<std::uint32_t>(it - grips_.begin());
}

void EditableSheet::keep_on_walls(Array& touch, std::span<const Parent> parents) {
  if (std::ranges::all_of(
          parents, [&](const Parent& p) { return wall_in(scene_, row_at(touch, p.row), row_size(touch)) != no_index; }))
    std::memcpy(row_.data(), row_at(touch, std::ranges::max(parents, {}, &Parent::weight).row), row_.size());
}

// A [[hold]] holds its axes; what else holds a vertex holds it in all, but for a solid along which it flows.
Axes EditableSheet::axes_of(std::uint32_t v) {
  for (Array& array : vertex_rows_)
    if (array.transfer == Transfer::common && (scene_ == nullptr || array.name != "hold")) {
      const std::byte* row = row_at(array, v);
      if (std::any_of(row, row + row_size(array), [](std::byte b) { return b != std::byte{0}; }) &&
          !(array.name == "touch" && wall_in(scene_, row, row_size(array)) != no_index))
        return all_axes;
    }
  for (Array& array : vertex_rows_)
    if (scene_ != nullptr && array.name == "hold") {
      std::uint64_t bits = 0;
      std::memcpy(&bits, row_at(array, v), sizeof bits);
      return scene::held_axes(*scene_, bits);
    }
  return 0;
}

bool EditableSheet::held_within(std::uint32_t u, std::uint32_t v) const {
  if (grip(u) == 0 || grip(u) == grip(v))
    return true;
  const std::vector<std::byte>&one = grips_[grip(u)].masks, &other = grips_[grip(v)].masks;
  for (std::size_t i = 0; i < one.size(); ++i)
    if (other.empty() || (one[i] & ~other[i]) != std::byte{0})
      return false;
  return true;
}

void EditableSheet::put(Frame& frame) {
  if (edits_ == 0)
    return;
  const EdgeRows edges(frame);
  CarriedSprings springs(frame);
  const auto [vertices, kept, number] = numbering(mesh_, position_);
  if (!springs.empty()) {
    std::vector<std::uint32_t> successor(frame.vertices);
    for (std::uint32_t v = 0; v < successor.size(); ++v) {
      std::uint32_t end = v;
      while (successor_[end] != end)
        end = successor_[end];
      successor[v] = number[end];
    }
    springs.move(successor);
  }
  std::vector<Array> arrays = std::move(frame.arrays);
  frame.arrays.clear();
  frame.vertices = vertices.size();
  frame.triangles = kept.size();
  const auto rows_named = [](std::vector<Array>& all, const Array& like) -> Array& {
    return *std::find_if(all.begin(), all.end(), [&](const Array& a) { return a.name == like.name; });
  };
  for (Array& array : arrays) {
    if (array.name == "position")
      frame.arrays.push_back(made_like(array, vertices, position_));
    else if (array.name == "velocity")
      frame.arrays.push_back(made_like(array, vertices, velocity_));
    else if (array.name == "volume")
      frame.arrays.push_back(made_like(array, kept, volume_));
    else if (array.name == "triangle") {
      Array made = formats::make_array(array.name, array.place, array.type, array.components, array.unit,
                                       array.transfer, kept.size(), array.critical);
      const auto corners = made.values<Corners>();
      for (std::size_t i = 0; i < kept.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
          corners[i][c] = number[mesh_.corners(kept[i])[c]];
      frame.arrays.push_back(std::move(made));
    } else if (array.name == swept_name)
      continue; // put below
    else if (CarriedSprings::has(array.name))
      frame.arrays.push_back(std::move(array)); // keeps its place in the order; its rows are put below
    else if (array.transfer == Transfer::drop)
      continue;
    else if (array.place == Place::vertex)
      frame.arrays.push_back(made_like(array, vertices, rows_named(vertex_rows_, array)));
    else if (array.place == Place::triangle)
      frame.arrays.push_back(made_like(array, kept, rows_named(triangle_rows_, array)));
    else
      frame.arrays.push_back(std::move(array));
  }
  const Array ledger = formats::make_standard_array(swept_name, vertices.size());
  frame.put(made_like(ledger, vertices, swept_));
  springs.put(frame);
  edges.put(frame);
  directors_.put(kept, frame);
}

} // namespace sheet::remesh
