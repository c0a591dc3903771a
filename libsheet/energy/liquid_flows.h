// SPDX-License-Identifier: GPL-3.0-or-later
// The flow curves of a stage's liquids, as a term keeps them: which is whose, at the rest rates that Newton asks for.
#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "libsheet/energy/stage.h"

namespace sheet {

class LiquidFlows {
public:
  // The stage's state outlives the stage's terms.
  void begin(const Stage& stage) {
    numbers_ = stage.liquids.size() > 1 ? std::span<const std::uint32_t>(stage.start->liquids)
                                        : std::span<const std::uint32_t>{};
    liquids_.clear();
    flows_.clear();
    for (const StageLiquid& of : stage.liquids) {
      liquids_.push_back(of.liquid);
      flows_.push_back(of.flow);
    }
    newtonian_ = std::ranges::all_of(flows_, &FlowCurve::newtonian);
  }

  [[nodiscard]] bool newtonian() const { return newtonian_; } // all of them
  [[nodiscard]] bool several() const { return flows_.size() > 1; }
  [[nodiscard]] const FlowCurve& numbered(std::size_t liquid) const { return flows_[liquid]; }
  [[nodiscard]] const FlowCurve& of(std::size_t triangle) const {
    return flows_[numbers_.empty() ? 0 : numbers_[triangle]];
  }

  // See term.h. References to curves stay good.
  void rest_at(std::span<const double> rates) {
    for (std::size_t i = 0; i < flows_.size(); ++i)
      flows_[i] = FlowCurve(liquids_[i], rates[i]);
  }

private:
  std::vector<Liquid> liquids_ = {{}};
  std::vector<FlowCurve> flows_ = {{}}; // by the liquids' numbers
  std::span<const std::uint32_t> numbers_;
  bool newtonian_ = true;
};

} // namespace sheet
