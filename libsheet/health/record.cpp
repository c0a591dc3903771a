// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/health/record.h"

#include <algorithm>
#include <cmath>

#include "libsheet/base/error.h"

namespace sheet::health {

namespace {

constexpr std::string_view name = "health";
constexpr std::size_t columns = 12;

using Numbers = std::array<double, columns>;

Row row_of(const Numbers& n) {
  return {.kind = n[0],
          .times = n[1],
          .first = n[2],
          .last = n[3],
          .worst = n[4],
          .worst_time = n[5],
          .share = n[6],
          .place = n[8] != 0 ? std::optional<Vector3>({n[9], n[10], n[11]}) : std::nullopt,
          .amount = n[7]};
}

Numbers numbers_of(const Row& r) {
  const Vector3 place = r.place.value_or(Vector3::Zero());
  return {r.kind,    r.times,   r.first,  r.last, r.worst, r.worst_time, r.share, r.amount, r.place.has_value() * 1.0,
          place.x(), place.y(), place.z()};
}

bool is_worse(const Kind& kind, double value, double than) { return kind.least ? value < than : value > than; }

bool reaches(const Row& row, const Kind& kind, const Limit& limit, std::uint64_t steps) {
  return !is_worse(kind, limit.worst, row.worst) && row.share >= limit.share &&
         row.times >= static_cast<double>(limit.times) && row.times >= limit.of_steps * static_cast<double>(steps);
}

void put(formats::Frame& frame, const std::vector<Row>& rows) {
  formats::Array array = formats::make_standard_array(name, rows.size());
  std::ranges::transform(rows, array.values<Numbers>().begin(), numbers_of);
  frame.put(std::move(array));
}

} // namespace

void note(formats::Frame& frame, const Observation& seen) {
  const auto number = static_cast<double>(seen.trouble);
  std::vector<Row> all = rows(frame);
  auto row = std::ranges::lower_bound(all, number, {}, &Row::kind);
  const bool is_new = row == all.end() || row->kind != number;
  if (is_new)
    row = all.insert(row, {.kind = number, .first = frame.time});
  ++row->times;
  row->last = frame.time;
  if (is_new || is_worse(kind_of(seen.trouble), seen.value, row->worst)) {
    row->worst = seen.value;
    row->worst_time = frame.time;
    row->place = seen.place;
  }
  row->share = std::max(row->share, seen.share);
  row->amount += seen.amount;
  put(frame, all);
}

std::vector<Row> rows(const formats::Frame& frame) {
  const formats::Array* array = frame.find(name);
  if (array == nullptr)
    return {};
  if (const std::string error = formats::find_array_error(frame, *array); !error.empty())
    fail(ExitCode::bad_input, "{}", error);
  std::vector<Row> all;
  std::ranges::transform(array->values<Numbers>(), std::back_inserter(all), row_of);
  return all;
}

Verdict verdict(const Row& row, std::uint64_t steps) {
  const Kind* kind = find_kind(row.kind);
  if (kind == nullptr || !reaches(row, *kind, kind->noted, steps))
    return Verdict::slight;
  return reaches(row, *kind, kind->serious, steps) ? Verdict::serious : Verdict::noted;
}

} // namespace sheet::health
