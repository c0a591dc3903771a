// SPDX-License-Identifier: GPL-3.0-or-later
// What sheet-info prints: frames, their arrays and their measurements as text, JSON or CSV.
#pragma once
#include <memory>
#include <string>

#include "libsheet/measure/measure.h"

namespace sheet {

struct ReportEntry {
  std::string file;
  bool many_files = false;
  std::uint64_t index = 0; // of the frame in its file
  const formats::Frame* frame = nullptr;
  Measurements measurements;
};

// The text to print before, for each frame, and after.
class Report {
public:
  virtual ~Report() = default;
  [[nodiscard]] virtual std::string begin() { return {}; }
  [[nodiscard]] virtual std::string add(const ReportEntry& entry) = 0;
  [[nodiscard]] virtual std::string end() { return {}; }
};

// For people. Arrays and provenance are told again only where they have changed since the frame before.
[[nodiscard]] std::unique_ptr<Report> make_text_report();
// One JSON document, an array with an object a frame, each on a line of its own. Numbers read back to the same bits;
// what does not exist or is infinite is null.
[[nodiscard]] std::unique_ptr<Report> make_json_report();
// A header and a row a frame; what does not exist is nan. With several files the last column names the file.
[[nodiscard]] std::unique_ptr<Report> make_csv_report();
// For each file, what its last frame says of trouble on the way there.
[[nodiscard]] std::unique_ptr<Report> make_health_report();

} // namespace sheet
