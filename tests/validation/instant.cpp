// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/validation/instant.h"

#include <chrono>

#include "libsheet/base/error.h"
#include "libsheet/energy/stage_setup.h"
#include "libsheet/energy/term_table.h"

namespace sheet::validation {

Instant solve_instant(const State& s, const Model& model, double dt, const Place& place,
                      const std::function<void(Stage&)>& frames) {
  const auto before = std::chrono::steady_clock::now();
  Terms terms = make_terms(model, s.mesh);
  LinearSystem system(s.mesh, terms, model.has_angles());
  Stage stage = first_stage(s, model.liquid, dt, s.time + dt, model.has_angles());
  raise_as_started(stage);
  if (frames)
    frames(stage);
  for (const auto& term : terms)
    term->begin(stage);
  Instant r;
  r.begin = r.end = stage.begin;
  place_held(model.holds, stage, stage.end_time, r.end);
  if (place)
    place(stage, r.end);
  const std::vector<char> held = held_unknowns(model.holds, stage);
  const Eigen::VectorXd scale = step_scale(s, stage.begin.size());
  NewtonOptions options;
  options.tolerance = 1e-12;
  system.constrain({.held = held}, 1e-10);
  const Unknowns start = r.end;
  const NewtonReport report =
      minimize(system, terms, scale, start, options, evaluate_first(system, terms, r.end), r.end);
  r.iterations = report.iterations;
  if (!report.converged && !(report.last_step < 1e-9))
    fail(ExitCode::not_converged, "an instant did not converge (last step {})", report.last_step);
  r.next = s;
  for (std::uint32_t v = 0; v < s.positions.size(); ++v)
    r.next.positions[v] = stage.position(r.end, v);
  r.next.director_angles = director_angles(stage, r.end);
  r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  system.constrain({}, 0);
  r.potential = system.gradient(terms, r.end, r.reaction).value;
  for (std::size_t k = 0; k < static_cast<std::size_t>(r.reaction.size()); ++k)
    if (held.empty() || !held[k])
      r.reaction[static_cast<Eigen::Index>(k)] = 0;
  return r;
}

} // namespace sheet::validation
