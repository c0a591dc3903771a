// SPDX-License-Identifier: GPL-3.0-or-later
// Hits among what is moved again and again within a step. A pair of features that was found apart stays so as long as
// its vertices have not gone as far as the room between them, so only few are looked at twice; and the tree is asked
// for the pairs of a vertex when that first moves, then once it has left the box around its way that they were sought
// for.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "libsheet/collide/feature_tree.h"
#include "libsheet/collide/hit.h"
#include "libsheet/geometry/connectivity.h"

namespace sheet::collide {

class PairWatch {
public:
  // The straight ways from `start` to `end` [m] are known to have been looked at; `reach` [m] as in SelfSearch. All but
  // `end` must outlive it.
  PairWatch(const Connectivity& mesh, FeatureTree& tree, std::span<const Vector3> start, std::span<const Vector3> end,
            std::span<const double> reach);

  // The hits with a vertex whose end is not that of the last time, ascending.
  [[nodiscard]] std::vector<Hit> hits(std::span<const Vector3> end);

private:
  using Flags = std::vector<std::uint8_t>;
  struct Watched {
    FeaturePair pair;
    double apart_until; // its vertices together have gone so far [m]
  };

  [[nodiscard]] Flags follow(std::span<const Vector3> end);
  [[nodiscard]] Flags not_watched(const Flags& moved) const;
  void watch(const Flags& vertices);
  [[nodiscard]] std::optional<Hit> look_at(Watched& watched) const;

  const Connectivity& mesh_;
  FeatureTree& tree_;
  std::span<const Vector3> start_;
  std::span<const double> reach_;
  std::vector<Vector3> end_;
  std::vector<double> gone_;        // by each vertex, since the beginning [m]
  std::vector<Vector3> low_, high_; // of the box around each vertex's way for which pairs were sought [m]
  Flags watched_;                   // vertices of which the pairs are known
  std::vector<Watched> pairs_;
};

} // namespace sheet::collide
