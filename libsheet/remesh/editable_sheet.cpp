// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/editable_sheet.h"

#include <algorithm>
#include <cstring>

#include "libsheet/geometry/triangle_pair.h"
#include "libsheet/remesh/row_storage.h"
#include "libsheet/remesh/thickness.h"

namespace sheet::remesh {

namespace {
const double sliver_cosine = cosine_of_degrees(15);

// Whether two triangles that share an edge lie on each other but for round-off. They do not intersect, and whatever
// becomes of them does.
bool folded_flat(const Corners& a, const TriangleShape& shape_a, const Corners& b, const TriangleShape& shape_b) {
  constexpr double flat = -1 + 1e-9; // 5e-5 from 180 degrees
  return shape_a.normal.dot(shape_b.normal) < flat &&
         std::ranges::count_if(a, [&](std::uint32_t v) { return std::ranges::find(b, v) != b.end(); }) == 2;
}
} // namespace

Box EditableSheet::box_of(const Corners& c) const {
  Box box{position_[c[0]], position_[c[0]]};
  box.add(position_[c[1]]);
  box.add(position_[c[2]]);
  return box;
}

double EditableSheet::temperature(std::uint32_t t) const {
  return temperature_ == none ? 0 : number_at(triangle_rows_[temperature_], t, 0);
}

std::uint32_t EditableSheet::liquid(std::uint32_t t) const {
  return liquid_ == none ? 0 : triangle_rows_[liquid_].values<std::uint32_t>()[t];
}

double EditableSheet::carried_volume(std::uint32_t v) const {
  double sum = 0;
  mesh_.for_fan(v, [&](std::uint32_t side) { sum += volume_[Mesh::triangle_of(side)] / 3; });
  return sum;
}

// Puts the edit's vertex where it will be; its slot may be new.
void EditableSheet::place(const Edit& edit) {
  if (edit.vertex == no_index)
    return;
  if (edit.vertex >= position_.size())
    position_.resize(edit.vertex + 1, Vector3::Zero());
  old_position_ = position_[edit.vertex];
  position_[edit.vertex] = edit.position;
}

bool EditableSheet::check_shapes(const Edit& edit, const Limits& limits) {
  double sharpest = limits.sharpest;
  for (const TriangleShape& old : old_shapes_)
    sharpest = std::max(sharpest, limits.gain > 0 ? better_cosine(old.sharpest, limits.gain) : old.sharpest);
  new_shapes_.clear();
  new_areas_.clear();
  for (std::size_t i = 0; i < edit.added.size(); ++i) {
    const Corners& c = edit.added[i];
    const TriangleShape& made = new_shapes_.emplace_back(position_[c[0]], position_[c[1]], position_[c[2]]);
    if (!(made.area > 0) || made.sharpest > sharpest)
      return false;
    const TriangleShape* former = edit.former.empty() ? nullptr : &old_shapes_[edit.former[i]];
    const bool sliver = former != nullptr && former->sharpest > sliver_cosine; // its normal says little
    if (former != nullptr && !sliver ? made.normal.dot(former->normal) < limits.facing
                                     : made.normal.dot(facing_) < (sliver ? 0 : limits.facing))
      return false;
    new_areas_.push_back(made.area);
  }
  return true;
}

void EditableSheet::flatten_old(const Edit& edit, const PlaneFrame& plane) {
  const auto flat = [&](const Corners& c) {
    return FlatTriangle{plane.flat(position_[c[0]]), plane.flat(position_[c[1]]), plane.flat(position_[c[2]])};
  };
  old_flat_.clear();
  slopes_.clear();
  for (Mean& mean : means_)
    mean.slopes.clear();
  for (const std::uint32_t t : edit.removed) {
    old_flat_.push_back(flat(mesh_.corners(t)));
    std::array<ValueAt, 3> beside;
    std::array<std::uint32_t, 3> others{};
    std::size_t count = 0;
    for (std::uint32_t side = 3 * t; side < 3 * t + 3; ++side)
      if (const std::uint32_t twin = mesh_.twin(side); twin != no_index) {
        const std::uint32_t other = Mesh::triangle_of(twin);
        if (shape_[other].area > 0) {
          others[count] = other;
          beside[count++] = {middle_of(flat(mesh_.corners(other))), volume_[other] / shape_[other].area};
        }
      }
    const auto slope = [&](double value) {
      return shape_[t].area > 0 ? slope_of({middle_of(old_flat_.back()), value}, {beside.data(), count}) : ValueSlope{};
    };
    slopes_.push_back(slope(volume_[t] / shape_[t].area));
    for (Mean& mean : means_) {
      const formats::Array& array = triangle_rows_[mean.array];
      for (std::size_t k = 0; k < count; ++k)
        beside[k].value = number_at(array, others[k], mean.component);
      mean.slopes.push_back(slope(number_at(array, t, mean.component)));
    }
  }
}

// `given`: the overlaps are known, of new triangles that lie within one old one.
void EditableSheet::find_overlap(Edit& edit, const PlaneFrame& plane, bool given) {
  new_flat_.clear();
  for (const Corners& c : edit.added)
    new_flat_.push_back({plane.flat(position_[c[0]]), plane.flat(position_[c[1]]), plane.flat(position_[c[2]])});
  const std::size_t old_count = edit.removed.size();
  const std::size_t new_count = edit.added.size();
  edit.overlap.resize(new_count * old_count);
  ways_.resize(edit.overlap.size());
  for (std::size_t j = 0; j < old_count; ++j)
    for (std::size_t i = 0; i < new_count; ++i) {
      const std::size_t k = i * old_count + j;
      const Overlap overlap =
          given ? Overlap{edit.overlap[k], middle_of(new_flat_[i])} : overlap_of(new_flat_[i], old_flat_[j]);
      edit.overlap[k] = overlap.area;
      ways_[j * new_count + i] =
          overlap.area > 0 ? Eigen::Vector2d(overlap.middle - middle_of(old_flat_[j])) : Eigen::Vector2d::Zero();
    }
  find_all_rises(slopes_, new_count, edit.rise);
}

// rise[i * slopes.size() + j], of old triangle j's quantity where new triangle i covers it.
void EditableSheet::find_all_rises(std::span<const ValueSlope> slopes, std::size_t new_count,
                                   std::vector<double>& rise) {
  const std::size_t old_count = slopes.size();
  rise.resize(new_count * old_count);
  column_.resize(new_count);
  for (std::size_t j = 0; j < old_count; ++j) {
    find_rises(slopes[j], std::span(ways_).subspan(j * new_count, new_count), column_);
    for (std::size_t i = 0; i < new_count; ++i)
      rise[i * old_count + j] = column_[i];
  }
}

void EditableSheet::make_grid() {
  double size = 0;
  for (std::uint32_t t = 0; t < mesh_.triangle_slots(); ++t)
    if (mesh_.has_triangle(t))
      size += box_of(mesh_.corners(t)).half_size();
  const std::size_t count = mesh_.triangle_count();
  grid_.emplace(4 * size / static_cast<double>(count), count);
  for (std::uint32_t t = 0; t < mesh_.triangle_slots(); ++t)
    if (mesh_.has_triangle(t))
      grid_->add(t, box_of(mesh_.corners(t)));
}

// Corners on a line, exactly. Only slivers can be that.
bool EditableSheet::degenerate(const Corners& corners, const TriangleShape& shape) const {
  return shape.sharpest > 1 - 1e-9 && corners_collinear(position_, corners);
}

// Old triangles without area are passed over: they cover nothing, and their sides are those of their neighbours.
// The patch's border stays, so whatever the new triangles meet, they meet outside of the patch, or each other.
bool EditableSheet::intersects(const Edit& edit) {
  for (std::size_t i = 0; i < edit.added.size(); ++i)
    if (degenerate(edit.added[i], new_shapes_[i]))
      return true;
  for (std::size_t i = 0; i < edit.added.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (triangles_intersect(position_, edit.added[i], edit.added[k]) ||
          folded_flat(edit.added[i], new_shapes_[i], edit.added[k], new_shapes_[k]))
        return true;
  Box patch = box_of(edit.added[0]);
  for (const Corners& c : edit.added)
    patch.add(box_of(c));
  bool found = false;
  grid_->for_meeting(patch, [&](std::uint32_t t) {
    if (found || std::find(edit.removed.begin(), edit.removed.end(), t) != edit.removed.end() ||
        degenerate(mesh_.corners(t), shape_[t]))
      return;
    for (std::size_t i = 0; i < edit.added.size() && !found; ++i) {
      const Corners& c = edit.added[i];
      found = box_of(c).overlaps(grid_->box_of(t)) && (triangles_intersect(position_, c, mesh_.corners(t)) ||
                                                       folded_flat(c, new_shapes_[i], mesh_.corners(t), shape_[t]));
    }
  });
  return found;
}

bool EditableSheet::in_strip(std::uint32_t t) const {
  return std::ranges::all_of(mesh_.corners(t), [&](std::uint32_t v) { return at_inlet(v); });
}

bool EditableSheet::make(Edit& edit, const Limits& limits) {
  if (edit.added.empty() && edit.removed.empty())
    return false;
  if (std::ranges::any_of(edit.removed, [&](std::uint32_t t) { return in_strip(t); }))
    return false;
  if (limits.intersections && !grid_)
    make_grid();
  old_shapes_.clear();
  old_areas_.clear();
  old_volumes_.clear();
  Vector3 facing = Vector3::Zero();
  for (const std::uint32_t t : edit.removed) {
    const TriangleShape& old = old_shapes_.emplace_back(shape(t));
    old_areas_.push_back(old.area);
    old_volumes_.push_back(volume_[t]);
    facing += old.area * old.normal;
  }
  facing_ = facing.stableNormalized();
  const bool given = !edit.overlap.empty();
  if (facing_.isZero() && !given)
    return false;
  const PlaneFrame plane(facing_.isZero() ? Vector3::UnitZ() : facing_);
  flatten_old(edit, plane);
  place(edit);
  const auto accepted = [&] {
    if (!check_shapes(edit, limits))
      return false;
    find_overlap(edit, plane, given);
    return share_volume(edit, old_areas_, old_volumes_, new_areas_, limits.thickness) &&
           !(limits.intersections && intersects(edit));
  };
  if (!accepted()) {
    if (edit.vertex != no_index)
      position_[edit.vertex] = old_position_;
    return false;
  }
  commit(edit);
  ++edits_;
  return true;
}

void EditableSheet::commit(const Edit& edit) {
  patch_.clear();
  for (const std::uint32_t t : edit.removed)
    for (const std::uint32_t v : mesh_.corners(t))
      if (std::find(patch_.begin(), patch_.end(), v) == patch_.end())
        patch_.push_back(v);
  Flow before;
  if (!velocity_.empty())
    for (const std::uint32_t v : patch_)
      before.add(carried_[v], velocity_[v]);

  const bool is_new = edit.kind == Edit::Kind::split;
  if (is_new) {
    static_cast<void>(mesh_.add_vertex());
    swept_.resize(position_.size(), 0);
    carried_.resize(position_.size(), 0);
    successor_.resize(position_.size());
    successor_[edit.vertex] = edit.vertex;
    swept_[edit.vertex] = 0;
    patch_.push_back(edit.vertex);
  }
  if (grid_)
    for (const std::uint32_t t : edit.removed)
      grid_->remove(t);
  write_vertex_rows(edit);
  directors_.prepare(mesh_, edit, old_flat_, new_flat_, position_);
  mesh_.replace(edit.removed, edit.added, slots_);
  directors_.commit(slots_);
  write_triangle_rows(edit);
  if (grid_)
    for (const std::uint32_t t : slots_)
      grid_->add(t, box_of(mesh_.corners(t)));
  if (edit.removed_vertex != no_index) {
    mesh_.remove_vertex(edit.removed_vertex);
    successor_[edit.removed_vertex] = edit.vertex;
    std::erase(patch_, edit.removed_vertex);
  }
  for (const std::uint32_t v : patch_)
    carried_[v] = carried_volume(v);

  // The ledger: what an edit sweeps is shared by the vertices that can pay it back.
  if (edit.kind == Edit::Kind::flip)
    for (const std::uint32_t v : patch_)
      swept_[v] += edit.swept / static_cast<double>(patch_.size());
  else if (edit.kind == Edit::Kind::collapse)
    swept_[edit.vertex] += swept_[edit.removed_vertex] + edit.swept;
  else
    swept_[edit.vertex] += edit.swept;

  if (!velocity_.empty()) {
    moving_.clear();
    for (const std::uint32_t v : patch_)
      moving_.push_back({carried_[v], &velocity_[v], held_axes(v)});
    restore_flow(before, moving_);
  }
}

void EditableSheet::write_vertex_rows(const Edit& edit) {
  if (edit.vertex == no_index)
    return;
  if (!velocity_.empty()) {
    Vector3 velocity = Vector3::Zero();
    for (const Parent& p : edit.parents)
      velocity += p.weight * velocity_[p.row];
    velocity_.resize(position_.size());
    velocity_[edit.vertex] = velocity;
  }
  for (formats::Array& array : vertex_rows_) {
    if (edit.keeps_hold && array.transfer == formats::Transfer::common)
      continue;
    row_.resize(row_size(array));
    transfer_row(array, edit.parents, row_.data());
    if (array.name == "touch")
      keep_on_walls(array, edit.parents);
    grow_rows(array, position_.size());
    std::memcpy(row_at(array, edit.vertex), row_.data(), row_.size());
    if (array.transfer == formats::Transfer::conserve && edit.kind == Edit::Kind::split)
      for (const Parent& p : edit.parents) { // what the new vertex got, they gave
        const Parent rest{p.row, 1, 1 - p.share};
        transfer_row(array, {&rest, 1}, row_.data());
        std::memcpy(row_at(array, p.row), row_.data(), row_.size());
      }
  }
  if (!grip_.empty()) {
    grip_.resize(position_.size());
    grip_[edit.vertex] = grip_of(edit.vertex);
  }
}

void EditableSheet::write_triangle_rows(const Edit& edit) {
  volume_.resize(mesh_.triangle_slots());
  shape_.resize(mesh_.triangle_slots());
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    volume_[slots_[i]] = edit.volumes[i];
    shape_[slots_[i]] = new_shapes_[i];
  }
  if (triangle_rows_.empty())
    return;
  write_means(edit);
  if (std::ranges::all_of(triangle_rows_,
                          [](const formats::Array& a) { return a.transfer == formats::Transfer::mean; }))
    return;
  const std::size_t old_count = edit.removed.size(), new_count = edit.added.size();
  std::vector<double> given(old_count, 0);
  for (std::size_t i = 0; i < new_count; ++i)
    for (std::size_t j = 0; j < old_count; ++j)
      given[j] += edit.overlap[i * old_count + j];
  std::vector<std::vector<Parent>> parents(new_count);
  for (std::size_t i = 0; i < new_count; ++i) {
    double covered = 0;
    for (std::size_t j = 0; j < old_count; ++j)
      covered += edit.overlap[i * old_count + j];
    for (std::size_t j = 0; j < old_count; ++j) {
      const double overlap = edit.overlap[i * old_count + j];
      if (overlap > 0)
        parents[i].push_back({edit.removed[j], overlap / covered, overlap / given[j]});
      else if (!(given[j] > 0)) // covered by none of the new ones: all get the same
        parents[i].push_back({edit.removed[j], 0, 1 / static_cast<double>(new_count)});
    }
    if (!(covered > 0)) { // covers none of the old ones: the mean of all, of their amounts nothing
      parents[i].clear();
      for (std::size_t j = 0; j < old_count; ++j)
        parents[i].push_back({edit.removed[j], 1 / static_cast<double>(old_count),
                              given[j] > 0 ? 0 : 1 / static_cast<double>(new_count)});
    }
  }
  for (formats::Array& array : triangle_rows_) {
    if (array.transfer == formats::Transfer::mean)
      continue;
    const std::size_t size = row_size(array);
    row_.resize(size * new_count);
    for (std::size_t i = 0; i < new_count; ++i)
      transfer_row(array, parents[i], row_.data() + i * size);
    grow_rows(array, mesh_.triangle_slots());
    for (std::size_t i = 0; i < new_count; ++i)
      std::memcpy(row_at(array, slots_[i]), row_.data() + i * size, size);
  }
}

// By the rule mean, of the patch before and after.
void EditableSheet::write_means(const Edit& edit) {
  for (const Mean& mean : means_) {
    formats::Array& array = triangle_rows_[mean.array];
    std::vector<double> values;
    for (const std::uint32_t t : edit.removed)
      values.push_back(number_at(array, t, mean.component));
    find_all_rises(mean.slopes, edit.added.size(), rises_);
    const std::vector<double> shared = share_mean(edit, old_areas_, old_volumes_, values, rises_);
    grow_rows(array, mesh_.triangle_slots());
    for (std::size_t i = 0; i < shared.size(); ++i)
      set_number_at(array, slots_[i], mean.component, shared[i]);
  }
}

} // namespace sheet::remesh
