// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/loop/select.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "libsheet/base/error.h"

namespace sheet {

namespace {

template <class T> std::optional<T> parse_number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    return {};
  return value;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> items(1);
  for (const char c : text)
    if (c == ',')
      items.emplace_back();
    else
      items.back() += c;
  return items;
}

std::string without_blanks_around(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? std::string() : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

} // namespace

bool IndexRange::has(std::int64_t index, std::int64_t total) const {
  const auto from_start = [total](std::int64_t i) { return i < 0 ? i + total : i; };
  return index >= from_start(first) && (last == -1 || index <= from_start(last));
}

std::vector<IndexRange> parse_indices(const std::string& text) {
  std::vector<IndexRange> ranges;
  for (const std::string& blanks : split(text)) {
    const std::string item = without_blanks_around(blanks);
    const std::size_t dash = item.find('-', 1); // a first one is a sign
    const auto first = parse_number<std::int64_t>(item.substr(0, dash));
    auto last = first;
    if (dash != std::string::npos)
      last =
          dash + 1 == item.size() ? std::optional<std::int64_t>(-1) : parse_number<std::int64_t>(item.substr(dash + 1));
    if (!first || !last)
      fail(ExitCode::usage, "\"{}\" is not a frame's index (-1 is the last) or a range such as 10-20, 10- or -3--1",
           item);
    if ((*first < 0) == (*last < 0) && *first > *last)
      fail(ExitCode::usage, "the range {} ends before it starts", item);
    ranges.push_back({*first, *last});
  }
  return ranges;
}

std::vector<TimeRange> parse_times(const std::string& text) {
  std::vector<TimeRange> ranges;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const std::string& item : split(text)) {
    const std::size_t colon = item.find(':');
    const auto end = [&](const std::string& number, double otherwise) {
      const auto value = number.empty() ? otherwise : parse_number<double>(number);
      if (!value || std::isnan(*value))
        fail(ExitCode::usage, "\"{}\" is not a time in seconds or a range such as 1:2, 1: or :2", item);
      return *value;
    };
    if (colon == std::string::npos)
      ranges.push_back({end(item, std::numeric_limits<double>::quiet_NaN()), 0, true});
    else
      ranges.push_back({end(item.substr(0, colon), -infinity), end(item.substr(colon + 1), infinity), false});
    if (!ranges.back().nearest && ranges.back().first > ranges.back().last)
      fail(ExitCode::usage, "the range {} ends before it starts", item);
  }
  return ranges;
}

Selector::Selector(SelectOptions options, Write write)
    : options_(std::move(options)), write_(std::move(write)), nearest_(options_.times.size(), -1),
      distance_(options_.times.size(), std::numeric_limits<double>::infinity()) {}

Selector::Fate Selector::fate_of(std::int64_t index, double time, std::int64_t seen, bool ended) const {
  if (options_.indices.empty() && options_.times.empty())
    return Fate::in;
  bool open = false;
  for (const IndexRange& range : options_.indices) {
    // An end -k is the frame seen - k now and moves on as long as frames come.
    const std::int64_t first = range.first < 0 ? seen + range.first : range.first;
    const std::int64_t last = range.last < 0 ? seen + range.last : range.last;
    const bool behind_first = index >= first, before_last = index <= last;
    const bool may_move_behind = range.first < 0 && !ended, may_come_before = range.last < 0 && !ended;
    if (behind_first && before_last && !may_move_behind)
      return Fate::in;
    open |= behind_first && (before_last || may_come_before);
  }
  for (std::size_t i = 0; i < options_.times.size(); ++i) {
    const TimeRange& range = options_.times[i];
    if (!range.nearest && range.first <= time && time <= range.last)
      return Fate::in;
    if (range.nearest && nearest_[i] == index) {
      if (ended)
        return Fate::in;
      open = true;
    }
  }
  return open ? Fate::open : Fate::out;
}

bool Selector::wants_more() const {
  if (options_.first && written_ >= *options_.first)
    return false;
  if (options_.indices.empty() || !options_.times.empty())
    return true;
  return std::any_of(options_.indices.begin(), options_.indices.end(),
                     [&](const IndexRange& range) { return range.first < 0 || range.last < 0 || seen_ <= range.last; });
}

void Selector::pick(const formats::Frame& frame) {
  if (matched_++ % options_.every != 0 || (options_.first && written_ >= *options_.first))
    return;
  ++written_;
  write_(frame);
}

void Selector::settle(bool ended) {
  for (Pending& p : pending_)
    if (p.fate == Fate::open) {
      p.fate = fate_of(p.index, p.frame.time, seen_, ended);
      if (p.fate == Fate::out)
        p.frame = {};
    }
  std::erase_if(pending_, [](const Pending& p) { return p.fate == Fate::out; });
  while (!pending_.empty() && pending_.front().fate == Fate::in) {
    pick(pending_.front().frame);
    pending_.pop_front();
  }
}

bool Selector::add(formats::Frame&& frame) {
  const std::int64_t index = seen_++;
  earliest_ = index == 0 ? frame.time : std::min(earliest_, frame.time);
  latest_ = index == 0 ? frame.time : std::max(latest_, frame.time);
  for (std::size_t i = 0; i < options_.times.size(); ++i) {
    const double distance = std::abs(frame.time - options_.times[i].first);
    if (options_.times[i].nearest && (distance < distance_[i] || nearest_[i] < 0)) {
      distance_[i] = distance;
      nearest_[i] = index;
    }
  }
  const Fate fate = fate_of(index, frame.time, seen_, false);
  if (fate == Fate::in && pending_.empty())
    pick(frame);
  else if (fate != Fate::out)
    pending_.push_back({index, std::move(frame), fate});
  settle(false);
  return wants_more();
}

void Selector::end() {
  settle(true);
  if (written_ == 0 && seen_ == 0)
    fail(ExitCode::bad_input, "no frame to select: the stream has none");
  if (written_ == 0)
    fail(ExitCode::bad_input, "no frame is selected: the stream has frames 0 to {}, times {} to {} s", seen_ - 1,
         earliest_, latest_);
}

} // namespace sheet
