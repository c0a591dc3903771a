// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-watch: a stage that shows a run in a browser while it goes on.
#include "libsheet/base/filter.h"
#include "libsheet/base/log.h"
#include "libsheet/watch/watch_stage.h"

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-watch", "show a run in a browser while it goes on",
      "Passes frames through unchanged and shows them on a page, whose address it prints: the newest frame to turn and "
      "ask, step, time, the time that is left, and curves of volume, area, thickness and energies. As the last "
      "stage of a ring it sees every step. The run waits for no browser: what comes faster than it can be "
      "measured or shown is passed over. When the stream ends, so does the page.\n"
      "Only this machine can see it, unless --address says otherwise; then anybody who reaches that address can. "
      "Nothing can be changed through it.");
  sheet::FilterOptions filter;
  filter.no_provenance = true; // the frames are those of a run that nobody looks at
  sheet::watch::WatchOptions o;
  using Provenance = sheet::Tool::Provenance;
  tool.argument("INPUT", filter.input, "stream to read; - for standard input");
  tool.option("-o,--output", filter.output, "FILE", "stream to write; - for standard output", Provenance::omit);
  tool.option("--port", o.port, "PORT",
              "of the page; 0 for any that is free. Without it, the first free one from 8000 on", Provenance::omit);
  tool.option("--address", o.address, "ADDRESS", "of this machine to answer at, IPv4; 0.0.0.0 for all of them",
              Provenance::omit);
  tool.option("--until", o.until, "SECONDS", "the run's end, to tell the time that is left", Provenance::omit);
  tool.example("sheet-init a.toml | sheet-loop --until 2 --fps 24 -- 'sheet-step | sheet-watch' > run.sheet",
               "then open http://127.0.0.1:8000/");
  return tool.run(argc, argv, [&] {
    sheet::watch::WatchStage stage(o);
    sheet::log::note("{}", stage.url());
    sheet::run_filter(tool, filter, [&](sheet::formats::Frame& frame) { stage.show(frame); });
  });
}
