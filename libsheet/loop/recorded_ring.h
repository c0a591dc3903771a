// SPDX-License-Identifier: GPL-3.0-or-later
// The ring that made a frame, as a line of the frame's provenance:
// "1 sheet-loop (0.1.0) --fps 24 -- 'sheet-step | sheet-collide'".
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"

namespace sheet {

// What a ring makes of a frame depends on these.
struct RecordedRing {
  std::string pipeline; // without its stages' --threads, on which no bit depends
  std::optional<double> fps;
  std::string keep; // "": the default
  friend bool operator==(const RecordedRing&, const RecordedRing&) = default;
};

// The pipeline without its stages' --threads.
[[nodiscard]] std::string without_threads(const std::string& pipeline);

// The ring that has made the frame, the last one if they were several; none if its provenance tells none. Throws Error
// (bad_input) if a line of it cannot be read.
[[nodiscard]] std::optional<RecordedRing> recorded_ring(const formats::Frame& frame);

// Whether the pipeline has nothing but stages of this program's own family, whose options name no files: what a stream
// that somebody else has made may do here. Anything else is a command of its author's.
[[nodiscard]] bool is_harmless(const std::string& pipeline);

// Makes it the frame's last ring, unless it is: a line at the end of the provenance, counted up if it is there already.
void record_ring(formats::Frame& frame, const RecordedRing& ring);

// The same, also if it is the last one, where `sets` (KEY=VALUE) change the scene from this frame on.
void record_change(formats::Frame& frame, const RecordedRing& ring, const std::vector<std::string>& sets);

} // namespace sheet
