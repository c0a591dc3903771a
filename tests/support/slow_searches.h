// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles that make searches against convex solids long: nearly in contact with a box, all sizes small beside theirs.
#pragma once
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "libsheet/solid/convex_distance.h"
#include "libsheet/solid/shapes.h"

namespace sheet::test {

// A box of a frame's scene, which counts how often it is asked.
class CountedBox : public solid::ConvexDistance {
public:
  CountedBox() : box_(solid::make_distance(scene::SolidBox{{0.3, 0.02, 0.3}})) {}
  [[nodiscard]] solid::Box3 bounds() const override { return box_->bounds(); }
  [[nodiscard]] solid::Near nearest(const Vector3& x) const override {
    ++count_;
    return box_->nearest(x);
  }
  // Evaluations since the last call.
  [[nodiscard]] long count() const { return std::exchange(count_, 0); }

private:
  std::unique_ptr<const solid::SolidDistance> box_;
  mutable long count_ = 0;
};

struct SlowSearch {
  std::string name;
  solid::MovingTriangle moving;
};

// `gap`: least distance from the box at the start [m].
inline std::vector<SlowSearch> slow_searches(double gap) {
  const auto over = [&](double x, double y, double z) { return Vector3(x, 0.01 + gap + y, z); };
  std::vector<SlowSearch> result;
  // The corner that is near rises, the others fall through the face.
  result.push_back({"one corner rises, two fall",
                    {{over(-0.0428, 3e-4, -0.1), over(-0.0482, 0, -0.0727), over(-0.0171, 4e-5, -0.0748)},
                     {over(-0.0428, -1.8e-3, -0.1), over(-0.0482, 1.5e-3, -0.0727), over(-0.0171, -1.8e-3, -0.0748)}}});
  result.push_back({"all fall, nearly parallel to a face",
                    {{over(-0.014, 0, 0.1), over(-0.0017, 6e-5, 0.0736), over(-0.0314, 1.7e-4, 0.073)},
                     {over(-0.014, -1.5e-3, 0.1), over(-0.0017, -1.5e-3, 0.0736), over(-0.0314, -1.5e-3, 0.073)}}});
  // Over the edge x = 0.15, y = 0.01, along which it slides.
  const double away = gap * std::sqrt(0.5);
  const auto beside = [&](double along, double z) { return Vector3(0.15 + away + along, 0.01 + away - along, z); };
  const solid::Triangle3 tilted{beside(-0.011, 0), beside(0.012, 0.003), beside(0.002, 0.03)};
  solid::Triangle3 slid = tilted;
  for (Vector3& x : slid)
    x.z() += 1e-3;
  result.push_back({"along an edge", {tilted, slid}});
  solid::Triangle3 fallen = tilted;
  for (Vector3& x : fallen)
    x -= Vector3(1e-3, 1e-3, 0);
  result.push_back({"down on an edge", {tilted, fallen}});
  return result;
}

} // namespace sheet::test
