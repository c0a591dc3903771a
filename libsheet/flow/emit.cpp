// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/emit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "libsheet/base/error.h"
#include "libsheet/base/log.h"
#include "libsheet/base/magnitudes.h"
#include "libsheet/flow/drowned_inlets.h"
#include "libsheet/flow/entering.h"
#include "libsheet/flow/heat_account.h"
#include "libsheet/flow/inlet.h"
#include "libsheet/flow/inlet_banks.h"
#include "libsheet/flow/inlet_checks.h"
#include "libsheet/flow/outflow.h"
#include "libsheet/flow/row_perturbation.h"
#include "libsheet/geometry/area.h"
#include "libsheet/scene/frame_heat.h"
#include "libsheet/scene/inlet_depth.h"
#include "libsheet/scene/prescribed.h"
#include "libsheet/sheet/account.h"
#include "libsheet/sheet/carried_springs.h"
#include "libsheet/sheet/directors.h"
#include "libsheet/sheet/transfer.h"

namespace sheet::flow {

using formats::Frame;

namespace {

constexpr double shortest_strip = 0.5;  // rows
constexpr double rounding = 1e-12;      // of a row: a strip that is that much too short is not
constexpr double most_triangles = 1e7;  // that may enter at once
constexpr double least_thickness = 0.2; // of a new triangle, over the strip's mean

using Row = std::vector<std::uint32_t>; // a vertex for each of the border's

class Emission {
public:
  // The inflow's inlet has this number, and these chains.
  Emission(Frame& frame, const Scene& scene, std::size_t number, const std::vector<InletChain>& chains)
      : frame_(frame), old_(frame), scene_(scene), inflow_(scene.inflows[number]), number_(number),
        velocity_(scene::inlet_velocity(frame, scene, number)), chains_(chains), perturbation_(scene, number, frame) {
    const auto x = positions(old_);
    const auto origins = frame.find("inlet_origin")->values<Vector3>();
    const auto bits = masks(frame, "inlet");
    x_.assign(x.begin(), x.end());
    origins_.assign(origins.begin(), origins.end());
    bits_.assign(bits.begin(), bits.end());
    for (std::uint32_t v = 0; v < x_.size(); ++v)
      vertices_.keep(v);
    depths_.assign(frame.vertices, 0);
    for (const InletChain& chain : chains) {
      const std::vector<double> depths = scene::inlet_depths(frame, scene, number, chain.border);
      for (std::size_t i = 0; i < depths.size(); ++i)
        depths_[chain.border[i]] = depths[i];
    }
    for (const std::int32_t solid : touched_solids(frame, scene.solids.size()))
      on_wall_.push_back(solid != no_solid &&
                         scene.solids[static_cast<std::size_t>(solid)].contact == SolidContact::flow);
    stays_.assign(frame.triangles, true);
  }

  Emitted run() {
    const double row = row_length();
    for (const InletChain& chain : chains_)
      enter(chain, row);
    release_others();
    if (made_.empty() && !moved_)
      return {};
    put();
    add_to_account(frame_, "emit.volume", "m^3", {&grown_, 1});
    if (scene_.heat) {
      const Liquid liquid = sheet_named(scene_, inflow_.sheet).material.value_or(scene_.material);
      const double weight = liquid.density / scene_.material.density;
      add_heat_to_account(frame_, "emit.heat", scene_, weight * (grown_ * temperature_of_inflow()));
    }
    return {.volume = grown_, .rows = rows_};
  }

private:
  struct Made {
    Corners corners;
    double volume = 0;
    std::vector<Parent> parents = {};
    double temperature = 0; // in scenes with heat [K]
  };

  [[nodiscard]] double row_length() const {
    double length = 0;
    std::size_t edges = 0;
    for (const InletChain& chain : chains_)
      for (std::size_t i = 0; i < chain.edges(); ++i, ++edges)
        length += (origins_[chain.border[chain.after(i)]] - origins_[chain.border[i]]).norm();
    return length / static_cast<double>(edges);
  }

  [[nodiscard]] static const Row& lowest(const InletChain& chain) {
    return chain.row.empty() ? chain.border : chain.row;
  }

  // From where the border belongs to the lowest row.
  [[nodiscard]] Vector3 way(const InletChain& chain, std::size_t i) const {
    return x_[lowest(chain)[i]] - origins_[chain.border[i]];
  }

  // Of the sheet at the border's i-th vertex, as its triangles have theirs.
  [[nodiscard]] Vector3 normal(const InletChain& chain, std::size_t i) const {
    const auto of_edge = [&](std::size_t k) -> Vector3 {
      const std::size_t j = chain.after(k);
      const Vector3 edge = origins_[chain.border[j]] - origins_[chain.border[k]];
      return edge.cross(way(chain, k) + way(chain, j));
    };
    const std::size_t last = chain.edges() - 1;
    if (chain.closed)
      return (of_edge(i) + of_edge(i == 0 ? last : i - 1)).normalized();
    return (i == 0 ? of_edge(0) : i > last ? of_edge(last) : Vector3(of_edge(i - 1) + of_edge(i))).normalized();
  }

  // Its length, measured across the border: area over width.
  [[nodiscard]] double gone(const InletChain& chain) const {
    double area = 0, width = 0;
    for (std::size_t i = 0; i < chain.edges(); ++i) {
      const std::size_t j = chain.after(i);
      const Vector3 edge = origins_[chain.border[j]] - origins_[chain.border[i]];
      area += edge.cross(0.5 * (way(chain, i) + way(chain, j))).norm();
      width += edge.norm();
    }
    return area / width;
  }

  void enter(const InletChain& chain, double row) {
    const double length = gone(chain) / row;
    const bool has_strip = !chain.row.empty();
    if (!has_strip && length < shortest_strip - rounding)
      return;
    const double count = std::max(0.0, std::floor(length - shortest_strip + rounding));
    if (2 * count * static_cast<double>(chain.edges()) > most_triangles)
      fail(ExitCode::bad_input,
           "the inlet has moved by {:.3g} rows of {:.3g} m since liquid last entered: take smaller steps, or a coarser "
           "sheet",
           length, row);
    // The border's new vertices before those of the rows between: as if the rows had come one by one.
    const Row border = has_strip ? chain.border : new_row(chain, 0);
    std::vector<Row> rows = {lowest(chain)};
    for (double k = 1; k <= count; ++k)
      rows.push_back(new_row(chain, (length - k) / length));
    rows.push_back(border);
    if (has_strip)
      put_back(chain);
    if (rows.size() == 2 && has_strip)
      return lengthen(chain);
    mark(chain, rows);
    fill(chain, rows);
  }

  void put_back(const InletChain& chain) {
    for (const std::uint32_t v : chain.border) {
      moved_ = moved_ || x_[v] != origins_[v];
      x_[v] = origins_[v];
    }
  }

  // Of what enters through an edge of the border [m].
  [[nodiscard]] double depth(const InletChain& chain, std::size_t edge) const {
    return 0.5 * (depths_[chain.border[edge]] + depths_[chain.border[chain.after(edge)]]);
  }

  // What has entered through an edge of the border: the area that it has swept, as thick as it enters. Where it has
  // become longer on its way, what is there has thinned as much.
  [[nodiscard]] double entered(const InletChain& chain, std::size_t edge) const {
    const std::uint32_t a = chain.border[edge], b = chain.border[chain.after(edge)];
    const auto now = positions(old_);
    if (velocity_.fans_out()) {
      const Vector3 way = 0.5 * (now[a] - origins_[a] + now[b] - origins_[b]);
      return depth(chain, edge) * (origins_[b] - origins_[a]).cross(way).norm();
    }
    return depth(chain, edge) *
           (TriangleArea(origins_[a], origins_[b], now[b]).area + TriangleArea(origins_[a], now[b], now[a]).area);
  }

  [[nodiscard]] double temperature_of_inflow() const {
    return inflow_.temperature ? scene::value_at(*inflow_.temperature, frame_.time) : scene_.heat->temperature;
  }

  // Of the strip behind an edge of the border [m³ K].
  [[nodiscard]] double warmth_of_strip(const InletChain& chain, std::size_t edge) const {
    double warmth = 0;
    for (const std::uint32_t t : chain.strip[edge])
      warmth += volumes(old_)[t] * temperatures(old_)[t];
    return warmth;
  }

  // The strip takes up what has entered.
  void lengthen(const InletChain& chain) {
    for (std::size_t i = 0; i < chain.edges(); ++i) {
      const double enters = entered(chain, i);
      if (!(enters > 0))
        continue;
      double area = 0, volume = enters;
      for (const std::uint32_t t : chain.strip[i]) {
        area += area_of(triangles(old_)[t]);
        volume += volumes(old_)[t];
      }
      const double mixed = scene_.heat ? (warmth_of_strip(chain, i) + enters * temperature_of_inflow()) / volume : 0;
      for (const std::uint32_t t : chain.strip[i])
        lengthened_.push_back({t, volume / area * area_of(triangles(old_)[t]), mixed});
      grown_ += enters;
    }
  }

  // `part` of the way from the border's place to the lowest row.
  Row new_row(const InletChain& chain, double part) {
    Row row;
    for (std::size_t i = 0; i < chain.border.size(); ++i) {
      const Parent parent{chain.border[i], 1, 0};
      const Vector3 origin = origins_[parent.row];
      row.push_back(static_cast<std::uint32_t>(x_.size()));
      vertices_.add({&parent, 1});
      x_.emplace_back(origin + part * way(chain, i));
      if (part > 0 && !perturbation_.none())
        x_.back() += perturbation_.at(origin, x_[lowest(chain)[i]], part, rows_, i) * normal(chain, i);
      origins_.push_back(origin);
      entering_.push_back(entering_velocity(chain, i, part));
      bits_.push_back(0);
    }
    ++rows_;
    return row;
  }

  // Of a vertex that is put at a part of the way from the border's i-th to the lowest row. What fans out is turned by
  // its tension on that way.
  [[nodiscard]] Vector3 entering_velocity(const InletChain& chain, std::size_t i, double part) const {
    const Vector3 enters = velocity_.at(frame_.time, origins_[chain.border[i]]);
    const auto known = velocities(old_);
    if (!velocity_.fans_out() || known.empty())
      return enters;
    return enters + part * (known[lowest(chain)[i]] - enters);
  }

  // Of this inlet; those of others stay.
  void set_bits(std::uint32_t v, std::uint64_t bits) {
    const std::size_t shift = bits_of_an_inlet * number_;
    bits_[v] = (bits_[v] & ~(of_inlet(~std::uint64_t{0}, 0) << shift)) | bits << shift;
  }

  // Whether the strip lies on a wall at the border's i-th vertex. The border itself is where the scene has put it,
  // which may be a little above.
  [[nodiscard]] bool lies(const InletChain& chain, std::size_t i) const {
    return on_wall_[chain.border[i]] || on_wall_[lowest(chain)[i]];
  }

  // The last row is the border, that before it the first one behind it.
  void mark(const InletChain& chain, const std::vector<Row>& rows) {
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (std::size_t i = 0; i < chain.border.size(); ++i) {
        const std::size_t from_border = rows.size() - 1 - r;
        set_bits(rows[r][i], from_border == 0   ? in_inlet | at_inlet_border
                             : from_border == 1 ? behind_inlet | (lies(chain, i) ? in_inlet : 0)
                                                : 0);
      }
  }

  void fill(const InletChain& chain, const std::vector<Row>& rows) {
    // The diagonals of neighbouring cells lean to and fro, going on from those of the strip.
    const bool other_way = !chain.strip.empty() && !has_corner(triangles(old_)[chain.strip[0][0]], chain.row[1]);
    const std::size_t first = made_.size();
    for (std::size_t r = 0; r + 1 < rows.size(); ++r)
      for (std::size_t i = 0; i < chain.edges(); ++i) {
        const std::size_t j = chain.after(i);
        const std::uint32_t a = rows[r][i], b = rows[r][j], above = rows[r + 1][i], above_next = rows[r + 1][j];
        const double one = (x_[b] - x_[above]).norm(), other = (x_[a] - x_[above_next]).norm();
        const bool alike = std::abs(one - other) < 1e-6 * one; // else the shorter one
        if (alike ? ((i + r) % 2 == 0) != other_way : one < other) {
          made_.push_back({{b, a, above}});
          made_.push_back({{b, above, above_next}});
        } else {
          made_.push_back({{a, above, above_next}});
          made_.push_back({{a, above_next, b}});
        }
      }
    for (std::size_t i = 0; i < chain.edges(); ++i) {
      std::vector<Made*> behind;
      for (std::size_t k = first + 2 * i; k < made_.size(); k += 2 * chain.edges())
        behind.insert(behind.end(), {&made_[k], &made_[k + 1]});
      give_volumes(chain, i, behind);
    }
  }

  // Volumes of the new triangles behind an edge of the border, and where the rest of what they carry comes from.
  // Without a strip all have entered; else they share what the strip has and what has entered.
  void give_volumes(const InletChain& chain, std::size_t edge, std::span<Made* const> made) {
    if (!chain.strip.empty())
      return share_volume(chain, edge, made);
    double sum = 0;
    for (Made* m : made) {
      m->temperature = scene_.heat ? temperature_of_inflow() : 0;
      sum += m->volume = depth(chain, edge) * area_of(m->corners) / lengthening(chain, edge, m->corners);
      m->parents = {{chain.behind[edge], 1, 0}};
    }
    grown_ += sum;
  }

  // By how much longer the border's edge is once it has come to a triangle's middle.
  [[nodiscard]] double lengthening(const InletChain& chain, std::size_t edge, const Corners& c) const {
    if (!velocity_.fans_out())
      return 1;
    const std::size_t next = chain.after(edge);
    const Vector3 start = origins_[chain.border[next]] - origins_[chain.border[edge]];
    const Vector3 end = x_[lowest(chain)[next]] - x_[lowest(chain)[edge]];
    const double all = start.cross(0.5 * (way(chain, edge) + way(chain, next))).norm() / start.norm();
    return 1 + way_of(chain, edge, c) / all * (end.norm() / start.norm() - 1);
  }

  // Thickness is the inflow's at the border, falls as edges get longer from there on, and besides changes in proportion
  // to the way.
  void share_volume(const InletChain& chain, std::size_t edge, std::span<Made* const> made) {
    double sum = 0, left = 1;
    const double enters = entered(chain, edge);
    double volume = enters, area = 0, moment = 0;
    for (const std::uint32_t t : chain.strip[edge]) {
      volume += volumes(old_)[t];
      stays_[t] = false;
    }
    std::vector<double> areas, ways;
    for (const Made* m : made) {
      areas.push_back(area_of(m->corners) / lengthening(chain, edge, m->corners));
      ways.push_back(way_of(chain, edge, m->corners));
      area += areas.back();
      moment += areas.back() * ways.back();
    }
    const double enters_as = depth(chain, edge), slope = (volume - enters_as * area) / moment;
    for (std::size_t k = 0; k < made.size(); ++k)
      sum += made[k]->volume = areas[k] * std::max(enters_as + slope * ways[k], least_thickness * volume / area);
    double others = 0;
    for (Made* m : made) {
      m->volume = m == made.back() ? volume - others : m->volume * (volume / sum);
      others += m->volume;
      const double share = m == made.back() ? left : m->volume / volume;
      left -= share;
      for (const std::uint32_t t : chain.strip[edge])
        m->parents.push_back({t, 0.5, share});
    }
    if (scene_.heat)
      give_temperatures(warmth_of_strip(chain, edge) / (volume - enters), volume - enters, made);
    grown_ += enters;
  }

  // What was in the strip is farthest from the border, what has entered behind it. `made`: two triangles a row, from
  // the farthest one on; `old`: the strip's temperature, `left`: its volume.
  void give_temperatures(double old, double left, std::span<Made* const> made) const {
    for (std::size_t k = 0; k + 1 < made.size(); k += 2) {
      const double volume = made[k]->volume + made[k + 1]->volume, part = std::min(1.0, left / volume);
      left = std::max(0.0, left - volume);
      made[k]->temperature = made[k + 1]->temperature = part * old + (1 - part) * temperature_of_inflow();
    }
  }

  // Of a triangle's middle from the border, across it.
  [[nodiscard]] double way_of(const InletChain& chain, std::size_t edge, const Corners& c) const {
    const Vector3 a = origins_[chain.border[edge]], b = origins_[chain.border[chain.after(edge)]];
    return (b - a).cross((x_[c[0]] + x_[c[1]] + x_[c[2]]) / 3 - a).norm() / (b - a).norm();
  }

  [[nodiscard]] double area_of(const Corners& c) const {
    const double area = TriangleArea(x_[c[0]], x_[c[1]], x_[c[2]]).area;
    if (!(area > 0))
      fail(ExitCode::bad_input, "at the inlet, the triangle ({}, {}, {}) would get the area {} m^2", c[0], c[1], c[2],
           area);
    return area;
  }

  static bool has_corner(const Corners& c, std::uint32_t v) { return c[0] == v || c[1] == v || c[2] == v; }

  // What is marked but belongs to no strip: somebody has remeshed it.
  void release_others() {
    std::vector<bool> keeps(frame_.vertices, false);
    for (const InletChain& chain : chains_)
      for (const Row* row : {&chain.border, &chain.row})
        for (const std::uint32_t v : *row)
          keeps[v] = true;
    const auto bits = frame_.find("inlet")->values<std::uint64_t>();
    for (std::size_t v = 0; v < bits.size(); ++v)
      if (!keeps[v]) {
        set_bits(static_cast<std::uint32_t>(v), 0);
        bits[v] = bits_[v];
      }
  }

  void put() {
    const CarriedSprings springs(frame_);
    const Directors directors(frame_);
    for (const Lengthened& l : lengthened_) {
      volumes(frame_)[l.triangle] = l.volume;
      if (scene_.heat)
        temperature(l.triangle) = l.temperature;
    }
    if (!made_.empty())
      rebuild();
    std::copy(x_.begin(), x_.end(), positions(frame_).begin());
    frame_.erase("start_position"); // it was another border's
    springs.put(frame_);
    if (!made_.empty())
      directors.put(vertices_, frame_);
    if (scene_.contact && scene_.contact->self)
      check_room(frame_, scene_, number_);
  }

  void rebuild() {
    const std::span<const Corners> old_corners = triangles(old_);
    Lineage lineage;
    std::vector<Corners> corners;
    for (std::uint32_t t = 0; t < old_corners.size(); ++t)
      if (stays_[t]) {
        lineage.keep(t);
        corners.push_back(old_corners[t]);
      }
    const std::size_t kept = corners.size();
    for (const Made& made : made_) {
      lineage.add(made.parents);
      corners.push_back(made.corners);
    }
    const std::size_t old_vertices = frame_.vertices;
    transfer_frame(frame_, vertices_, lineage, corners);
    for (std::size_t k = 0; k < made_.size(); ++k) {
      volumes(frame_)[kept + k] = made_[k].volume;
      if (scene_.heat)
        temperature(kept + k) = made_[k].temperature;
    }
    std::copy(bits_.begin(), bits_.end(), frame_.find("inlet")->values<std::uint64_t>().begin());
    std::copy(origins_.begin(), origins_.end(), frame_.find("inlet_origin")->values<Vector3>().begin());
    const auto v = velocities(frame_);
    std::ranges::copy(entering_, v.begin() + static_cast<std::ptrdiff_t>(old_vertices));
  }

  [[nodiscard]] double& temperature(std::size_t triangle) {
    return frame_.find("temperature")->values<double>()[triangle];
  }

  Frame& frame_;
  const Frame& old_; // the same, to read
  const Scene& scene_;
  const scene::Inflow& inflow_;
  std::size_t number_;
  scene::InletVelocity velocity_;
  const std::vector<InletChain>& chains_;
  RowPerturbation perturbation_;
  std::vector<Vector3> x_, origins_;
  std::vector<double> depths_;    // of what enters, for the border's old vertices [m]
  std::vector<Vector3> entering_; // velocities of new vertices [m/s]
  std::vector<std::uint64_t> bits_;
  std::vector<bool> on_wall_; // of the old vertices: on which liquid flows
  Lineage vertices_;
  std::vector<bool> stays_; // for each old triangle
  std::vector<Made> made_;
  struct Lengthened {
    std::uint32_t triangle;
    double volume, temperature; // new ones [m³], [K]
  };
  std::vector<Lengthened> lengthened_;
  double grown_ = 0;
  std::size_t rows_ = 0;
  bool moved_ = false;
};

} // namespace

namespace {

// Marks nobody any more.
void release(Frame& frame, std::size_t number) {
  const std::uint64_t own = of_inlet(~std::uint64_t{0}, 0) << (bits_of_an_inlet * number);
  for (std::uint64_t& bits : frame.find("inlet")->values<std::uint64_t>())
    bits &= ~own;
}

// What has entered at one inlet.
Emitted emit_at(Frame& frame, const Scene& scene, std::size_t number) {
  const scene::Inflow& inflow = scene.inflows[number];
  const std::vector<InletChain> chains = find_inlet(frame, number);
  const bool ended = !scene::in_force(inflow, frame.time);
  if (!ended)
    check_inlet(frame, scene, inflow, chains);
  if (!chains.empty()) {
    const Emitted emitted = Emission(frame, scene, number, chains).run();
    if (ended)
      release(frame, number);
    return emitted;
  }
  if (!ended && has_entered(scene, inflow.sheet, frame))
    fail(ExitCode::bad_input,
         "the inlet{} is gone, so nothing can flow in: no edge of the sheet's border has both ends marked in the array "
         "\"inlet\"",
         scene.inflows.size() > 1 ? fmt::format(" of [[inflow]] number {} (from 0)", number) : "");
  return {};
}

} // namespace

Emitted emit(Frame& frame, const Scene& scene) {
  scene::check_temperatures(scene, frame);
  const bool ended = std::ranges::none_of(
      scene.inflows, [&](const scene::Inflow& inflow) { return scene::in_force(inflow, frame.time); });
  if (frame.find("inlet") == nullptr) {
    if (ended)
      return {};
    fail(ExitCode::bad_input, "the frame does not say where its inlet is (array \"inlet\"): make it with sheet-init");
  }
  Emitted result;
  for (std::size_t i = 0; i < scene.inflows.size(); ++i) {
    const Emitted at = emit_at(frame, scene, i);
    result.volume += at.volume;
    result.rows += at.rows;
  }
  if (ended) {
    for (const char* array : {"inlet", "inlet_origin"})
      frame.erase(array);
    scene::erase_inlet_depths(frame);
  }
  return result;
}

void EmitStage::emit(Frame& frame) {
  check_magnitudes(frame);
  const Scene& scene = scenes_.of(frame);
  if (!scene.outflows.empty())
    if (const Dropped out = let_out(frame, scene); out.volume > 0)
      log::detail("step {}: {} m^3 left, {} triangles", frame.step, out.volume, out.triangles);
  if (const double volume = let_enter(frame, scene); volume > 0)
    log::detail("step {}: a sheet of {} m^3 enters", frame.step, volume);
  if (scene.inflows.empty())
    return;
  const Emitted emitted = flow::emit(frame, scene);
  if (scenes_.changed())
    solids_.reset();
  if (!solids_ && scene::flows_on_solids(scene))
    solids_.emplace(scene);
  if (solids_) {
    drown_inlets(frame, scene, *solids_);
    hold_banks(frame, scene, *solids_);
  }
  log::detail("step {}: {} m^3 entered, {} new rows of vertices", frame.step, emitted.volume, emitted.rows);
}

} // namespace sheet::flow
