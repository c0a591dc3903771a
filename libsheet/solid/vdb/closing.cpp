// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/vdb/closing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <unordered_map>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "libsheet/solid/vdb/block_parts.h"
#include "libsheet/solid/vdb/lanes.h"

namespace sheet::solid {
namespace {

constexpr int side = SlabBlocks::side;
using Values = std::array<float, SlabBlocks::voxels>;

// A ball outside, whose center is a voxel or between two.
struct Ball {
  float x, y, z, radius;
};

// A box of voxels, both ends within.
using Region = Eigen::AlignedBox<int, 3>;

Region region_of(const FieldBlock& block) { return {block.origin, block.origin + Voxel::Constant(side - 1)}; }

float distance(const Region& a, const Region& b) { return std::sqrt(static_cast<float>(a.squaredExteriorDistance(b))); }

std::size_t place_in_block(const Voxel& voxel) {
  return static_cast<std::size_t>(voxel.x() << 6 | voxel.y() << 3 | voxel.z());
}

// Blocks by place.
class Blocks {
public:
  Blocks(const std::vector<FieldBlock>& blocks, const std::function<float(const Voxel&)>& elsewhere)
      : blocks_(blocks), elsewhere_(elsewhere) {
    numbers_.reserve(blocks.size());
    for (std::size_t i = 0; i < blocks.size(); ++i)
      numbers_.emplace(block_key(blocks[i].origin / side), i);
  }
  [[nodiscard]] std::size_t size() const { return blocks_.size(); }
  [[nodiscard]] const FieldBlock& operator[](std::size_t i) const { return blocks_[i]; }
  [[nodiscard]] const FieldBlock* find(const Voxel& origin) const {
    const auto found = numbers_.find(block_key(origin / side));
    return found == numbers_.end() ? nullptr : &blocks_[found->second];
  }
  [[nodiscard]] float elsewhere(const Voxel& voxel) const { return elsewhere_(voxel); }

  // Calls see(number) for each that is within `reach` of block i, itself too, in an order that depends on the place of
  // block i alone.
  template <class See> void each_near(std::size_t i, float reach, See see) const {
    const int rings = static_cast<int>(std::ceil(reach / side));
    for (int x = -rings; x <= rings; ++x)
      for (int y = -rings; y <= rings; ++y)
        for (int z = -rings; z <= rings; ++z) {
          const FieldBlock* const near = find(blocks_[i].origin + side * Voxel(x, y, z));
          if (near != nullptr && distance(region_of(*near), region_of(blocks_[i])) <= reach)
            see(static_cast<std::size_t>(near - blocks_.data()));
        }
  }

private:
  const std::vector<FieldBlock>& blocks_;
  const std::function<float(const Voxel&)>& elsewhere_;
  std::unordered_map<std::uint64_t, std::size_t> numbers_;
};

// The values of a block with one more voxel around it, but for its edges and corners.
class Surrounded {
public:
  Surrounded(const Blocks& blocks, const FieldBlock& block) {
    for (int x = 0; x < side; ++x)
      for (int y = 0; y < side; ++y)
        std::copy_n(block.values + place_in_block({x, y, 0}), side, &values_[place({x, y, 0})]);
    for (int axis = 0; axis < 3; ++axis)
      for (const int sign : {-1, 1})
        copy_face(blocks, block.origin + sign * side * Voxel::Unit(axis), axis, sign);
  }
  static constexpr std::array<int, 3> steps{(side + 2) * (side + 2), side + 2, 1}; // to the next voxel of each axis
  [[nodiscard]] const float* at(int x, int y, int z) const { return &values_[place({x, y, z})]; }

private:
  static std::size_t place(const Voxel& voxel) {
    return static_cast<std::size_t>((voxel.x() + 1) * steps[0] + (voxel.y() + 1) * steps[1] + voxel.z() + 1);
  }
  void copy_face(const Blocks& blocks, const Voxel& origin, int axis, int sign) {
    const FieldBlock* const next = blocks.find(origin);
    const float otherwise = next != nullptr ? 0 : blocks.elsewhere(origin);
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        Voxel from, to;
        from[axis] = sign < 0 ? side - 1 : 0;
        to[axis] = sign < 0 ? -1 : side;
        from[(axis + 1) % 3] = to[(axis + 1) % 3] = i;
        from[(axis + 2) % 3] = to[(axis + 2) % 3] = j;
        values_[place(to)] = next != nullptr ? next->values[place_in_block(from)] : otherwise;
      }
  }

  std::array<float, (side + 2) * (side + 2) * (side + 2)> values_{};
};

// Where a block has ridges of f that lie lower than `length`.
Region find_ridges(const Blocks& blocks, const FieldBlock& block, float length, float depth) {
  constexpr float as_on_slopes = 0.95F * 0.95F; // the gradient of f is 1 there
  Region ridges;
  const Surrounded f(blocks, block);
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) {
        const float* const here = f.at(x, y, z);
        if (!(*here > -depth && *here < length - 0.25F))
          continue;
        float ascent = 0; // squared
        for (const int step : Surrounded::steps) {
          const float up = std::max({here[step] - *here, here[-step] - *here, 0.0F});
          ascent += up * up;
        }
        if (ascent < as_on_slopes)
          ridges.extend(block.origin + Voxel(x, y, z));
      }
  return ridges;
}

// The balls outside around the voxels of a block.
std::vector<Ball> find_balls(const Blocks& blocks, const FieldBlock& block, float length) {
  std::vector<Ball> balls;
  const Surrounded f(blocks, block);
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) {
        const float* const here = f.at(x, y, z);
        if (!(*here >= length && *here < length + closing_margin))
          continue;
        const Eigen::Vector3f center = (block.origin + Voxel(x, y, z)).cast<float>();
        balls.push_back({center[0], center[1], center[2], *here - length});
        for (int axis = 0; axis < 3; ++axis)
          for (const int sign : {-1, 1}) {
            const float next = here[sign * Surrounded::steps[static_cast<std::size_t>(axis)]];
            if (next >= length)
              continue;
            Eigen::Vector3f place = center;
            place[axis] += static_cast<float>(sign) * (*here - length) / (*here - next);
            balls.push_back({place[0], place[1], place[2], 0});
          }
      }
  return balls;
}

// The first voxel of one of the eight parts of a block, counted from the block's.
Voxel place_of(std::size_t part) { return part_side * Voxel(part >> 2 & 1, part >> 1 & 1, part & 1); }

Region part_of(const FieldBlock& block, std::size_t part) {
  const Voxel low = block.origin + place_of(part);
  return {low, low + Voxel::Constant(part_side - 1)};
}

// The new values of a block, from balls near it.
class Erosion {
public:
  Erosion(float length, float depth) : length_(length), depth_(depth) {}

  void begin(const FieldBlock& block) {
    block_ = &block;
    balls_.clear();
    at_middles_.clear();
    std::copy_n(block.values, values_.size(), values_.begin());
    for (std::size_t part = 0; part < parts_.size(); ++part)
      parts_[part] = {lowest_in(place_of(part)), false};
    farthest_.fill(length_ + depth_);
  }

  // Which parts a way up from there comes to a ridge from.
  void add_ridges(const Region& ridges) {
    for (std::size_t part = 0; part < parts_.size(); ++part)
      parts_[part].changes =
          parts_[part].changes || distance(ridges, part_of(*block_, part)) <= length_ - parts_[part].lowest + 1;
  }
  [[nodiscard]] bool changes() const {
    return std::ranges::any_of(parts_, [](const Part& part) { return part.changes; });
  }

  SHEET_FOR_EACH_PROCESSOR void add_balls(const std::vector<Ball>& balls) {
    const Voxel& first = block_->origin;
    LanePlace middles;
    find_middles(first.x(), first.y(), first.z(), middles);
    for (const Ball& ball : balls) {
      Lanes d;
      find_distance(ball, middles, d);
      keep_lanes(d, at_middles_.emplace_back());
      for (std::size_t part = 0; part < lane_count; ++part)
        farthest_[part] = std::min(farthest_[part], at_middles_.back()[part] + part_half_diagonal);
      balls_.push_back(ball);
    }
  }

  const Values& erode() {
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      if (!parts_[part].changes)
        continue;
      near_.clear();
      for (std::size_t i = 0; i < balls_.size(); ++i)
        if (at_middles_[i][part] - part_half_diagonal <= farthest_[part])
          near_.push_back(balls_[i]);
      for (int rows = 0; rows < part_side * part_side / 2; ++rows)
        erode_rows(place_of(part) + Voxel(rows / 2, rows % 2 * 2, 0));
    }
    return values_;
  }

private:
  struct Part {
    float lowest = 0; // of the values above -depth
    bool changes = false;
  };

  [[nodiscard]] float lowest_in(const Voxel& part) const {
    float lowest = std::numeric_limits<float>::infinity();
    for (int i = 0; i < part_side * part_side * part_side; ++i) {
      const float value = values_[place_in_block(part + Voxel(i / 16, i / 4 % 4, i % 4))];
      if (value > -depth_)
        lowest = std::min(lowest, value);
    }
    return lowest;
  }

  [[gnu::always_inline]] static void find_distance(const Ball& ball, const LanePlace& place, Lanes& d) {
    const Lanes x = place.x - ball.x, y = place.y - ball.y, z = place.z - ball.z;
    const Lanes squared = x * x + y * y + z * z;
    for (int i = 0; i < lane_count; ++i)
      d[i] = __builtin_sqrtf(squared[i]);
    d -= ball.radius;
  }

  // Eight voxels: two rows of four.
  SHEET_FOR_EACH_PROCESSOR void erode_rows(const Voxel& rows) {
    const std::size_t offset = place_in_block(rows);
    const std::array<float*, 2> values{&values_[offset], &values_[offset + side]};
    bool any = false;
    for (int i = 0; i < lane_count; ++i) {
      const float value = values[i / part_side][i % part_side];
      any = any || (value > -depth_ && value < length_);
    }
    if (!any)
      return;
    const Voxel first = block_->origin + rows;
    const LanePlace place{static_cast<float>(first.x()) + Lanes{},
                          static_cast<float>(first.y()) + Lanes{0, 0, 0, 0, 1, 1, 1, 1},
                          static_cast<float>(first.z()) + Lanes{0, 1, 2, 3, 0, 1, 2, 3}};
    Lanes least = length_ + depth_ + Lanes{};
    for (const Ball& ball : near_) {
      Lanes d;
      find_distance(ball, place, d);
      least = d < least ? d : least;
    }
    constexpr float too_far = 0.05F; // by which d is too large on average, at most
    for (int i = 0; i < lane_count; ++i) {
      float& value = values[i / part_side][i % part_side];
      const float eroded = least[i] < length_ + depth_ ? length_ - least[i] + too_far : -depth_;
      if (value < length_)
        value = std::max(std::min(value, eroded), -depth_);
    }
  }

  float length_, depth_;
  const FieldBlock* block_ = nullptr;
  Values values_{};
  std::array<Part, 8> parts_;
  KeptLanes farthest_{};
  std::vector<Ball> balls_, near_;
  std::vector<KeptLanes> at_middles_;
};

template <class Work> void each(std::size_t count, Work work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 16), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      work(i);
  });
}

} // namespace

void close_field(const std::vector<FieldBlock>& field, const std::function<float(const Voxel&)>& elsewhere,
                 float length, float depth) {
  const float reach = length + depth + 1;
  const Blocks blocks(field, elsewhere);
  std::vector<Region> ridges(blocks.size());
  each(blocks.size(), [&](std::size_t i) { ridges[i] = find_ridges(blocks, blocks[i], length, depth); });
  std::vector<char> changes(blocks.size(), 0);
  each(blocks.size(), [&](std::size_t i) {
    blocks.each_near(i, reach, [&](std::size_t j) {
      if (!ridges[j].isEmpty() && distance(ridges[j], region_of(blocks[i])) <= reach)
        changes[i] = 1;
    });
  });
  std::vector<std::vector<Ball>> balls(blocks.size());
  each(blocks.size(), [&](std::size_t i) {
    bool wanted = false;
    blocks.each_near(i, reach + closing_margin, [&](std::size_t j) { wanted = wanted || changes[j] != 0; });
    if (wanted)
      balls[i] = find_balls(blocks, blocks[i], length);
  });
  std::vector<std::unique_ptr<Values>> values(blocks.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks.size(), 16), [&](const auto& range) {
    Erosion erosion(length, depth);
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      if (changes[i] == 0)
        continue;
      erosion.begin(blocks[i]);
      blocks.each_near(i, reach, [&](std::size_t j) {
        if (!ridges[j].isEmpty())
          erosion.add_ridges(ridges[j]);
      });
      if (!erosion.changes())
        continue;
      blocks.each_near(i, reach + closing_margin, [&](std::size_t j) { erosion.add_balls(balls[j]); });
      values[i] = std::make_unique<Values>(erosion.erode());
    }
  });
  each(blocks.size(), [&](std::size_t i) {
    if (values[i] != nullptr)
      std::ranges::copy(*values[i], blocks[i].values);
  });
}

} // namespace sheet::solid
