// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/inlet_banks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

#include "libsheet/flow/crossings.h"
#include "libsheet/flow/inlet.h"
#include "libsheet/scene/inlet_depth.h"
#include "libsheet/scene/prescribed.h"

namespace sheet::flow {

namespace {

// Which vertex follows on a rim, the sheet on the left, and which goes before.
struct Rim {
  std::map<std::uint32_t, std::uint32_t> next, before;
};

Rim rim_of(const formats::Frame& frame) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (const Corners& c : triangles(frame))
    for (std::size_t i = 0; i < 3; ++i)
      sides.emplace(c[i], c[(i + 1) % 3]);
  Rim rim;
  for (const auto& [a, b] : sides)
    if (!sides.contains({b, a})) {
      rim.next.emplace(a, b);
      rim.before.emplace(b, a);
    }
  return rim;
}

class Banks {
public:
  Banks(formats::Frame& frame, const Scene& scene, const solid::Solids& solids)
      : frame_(frame), scene_(scene), solids_(solids), rim_(rim_of(frame)),
        touched_(touched_solids(frame, scene.solids.size())) {}

  // At both ends of a chain.
  void hold(const InletChain& chain) {
    const std::size_t last = chain.border.size() - 1;
    hold(chain.border.front(), chain.row.front(), chain.row[1], rim_.before);
    hold(chain.border.back(), chain.row.back(), chain.row[last - 1], rim_.next);
  }

private:
  [[nodiscard]] bool flows(std::uint32_t v) const {
    return touched_[v] != no_solid &&
           scene_.solids[static_cast<std::size_t>(touched_[v])].contact == SolidContact::flow;
  }

  struct Move {
    std::uint32_t vertex;
    Vector3 forwards; // along the wall, unit
    double behind;    // [m]
  };

  // `onwards`: along the rim away from the border. Where what is held back would meet another layer, nothing moves.
  void hold(std::uint32_t border, std::uint32_t row, std::uint32_t inner,
            const std::map<std::uint32_t, std::uint32_t>& onwards) {
    const std::vector<Move> moves = behind(border, row, inner, onwards);
    const auto x = positions(frame_);
    std::vector<Vector3> before;
    std::vector<bool> moved(frame_.vertices, false);
    for (const Move& move : moves) {
      before.push_back(x[move.vertex]);
      x[move.vertex] += move.behind * move.forwards;
      moved[move.vertex] = true;
    }
    if (moves.empty() || moved_triangles_cross(x, triangles(frame_), moved)) {
      for (std::size_t i = 0; i < moves.size(); ++i)
        x[moves[i].vertex] = before[i];
      return;
    }
    if (const auto u = velocities(frame_); !u.empty())
      for (const auto& [v, forwards, behind] : moves)
        u[v] += std::max(0.0, -forwards.dot(u[v])) * forwards;
  }

  // What has come behind the row, from its end on.
  [[nodiscard]] std::vector<Move> behind(std::uint32_t border, std::uint32_t row, std::uint32_t inner,
                                         const std::map<std::uint32_t, std::uint32_t>& onwards) const {
    std::vector<Move> moves;
    if (!flows(row))
      return moves;
    const auto x = positions(frame_);
    const Vector3 along = (x[row] - x[inner]).normalized();
    const Vector3 way = x[row] - x[border];
    for (auto at = onwards.find(row); at != onwards.end(); at = onwards.find(at->second)) {
      const std::uint32_t v = at->second;
      if (masks(frame_, "inlet")[v] != 0 || !flows(v))
        break;
      const Vector3 normal = solids_.at(static_cast<std::size_t>(touched_[v]), x[v], frame_.time).normal;
      Vector3 forwards = normal.cross(along);
      if (forwards.dot(way) < 0)
        forwards = -forwards;
      forwards.normalize();
      const double distance = -forwards.dot(x[v] - x[row]);
      if (!(std::abs(distance) < 0.5 * way.norm()))
        break;
      if (distance > 0)
        moves.push_back({v, forwards, distance});
    }
    return moves;
  }

  formats::Frame& frame_;
  const Scene& scene_;
  const solid::Solids& solids_;
  Rim rim_;
  std::vector<std::int32_t> touched_;
};

} // namespace

void hold_banks(formats::Frame& frame, const Scene& scene, const solid::Solids& solids) {
  if (frame.find("inlet") == nullptr)
    return;
  std::optional<Banks> banks; // for whoever needs them
  for (std::size_t i = 0; i < scene.inflows.size(); ++i) {
    if (!scene::in_force(scene.inflows[i], frame.time) ||
        !(scene::inlet_depth(frame, scene, i) > scene.inflows[i].thickness))
      continue;
    if (!banks)
      banks.emplace(frame, scene, solids);
    for (const InletChain& chain : find_inlet(frame, i))
      if (!chain.closed && !chain.row.empty())
        banks->hold(chain);
  }
}

} // namespace sheet::flow
