// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-loop: runs a pipeline of stages as a ring and keeps the frames that are wanted.
#include <csignal>

#include "libsheet/base/tool.h"
#include "libsheet/loop/loop.h"
#include "libsheet/loop/stop_condition.h"
#include "libsheet/scene/keys.h"

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-loop", "run stages in a ring, step after step",
      "Starts the given shell pipeline once, sends the last frame of the input through it, and sends what comes "
      "back through it again, until the time, the number of steps or a condition is reached. Each frame is complete, "
      "so "
      "every kept frame is a checkpoint.\n"
      "The next output time is stamped into the frame, and sheet-step never steps past it. If a stage dies, the "
      "message names it, and what was kept is whole.");
  sheet::LoopOptions o;
  using Provenance = sheet::Tool::Provenance;
  tool.option("--until", o.until, "SECONDS", "end when the frame's time is there; a step ends exactly then",
              Provenance::omit);
  tool.option("--fps", o.fps, "FPS", "output times are the multiples of 1/FPS; steps end exactly at them");
  tool.option("--steps", o.steps, "N", "end at step N (in a ring without sheet-step: after N rounds)",
              Provenance::omit);
  tool.option("--stop-when", o.stop_when, "CONDITION",
              "end as soon as it holds, such as 'y_max > 40 mm' or 'vertices > 20000': a number of the frame that "
              "sheet-info --csv prints, or vertices or triangles, and a bound; looked at after each step. May be given "
              "again and again: the first that holds ends the run",
              sheet::StopCondition::names());
  tool.option("--keep", o.keep, "output|last|N",
              "frames to keep: those at output times (the default with --fps), the last only, or every N-th step "
              "(the default without --fps is 1). The first frame, except with last, and the final one are kept too");
  tool.option(
      "--resume", o.resume, "FILE",
      "go on with this stream: a run that was interrupted, or one that shall become longer. New frames are added "
      "to it; the result is the same, byte for byte, as without the interruption. A run that is made longer is that of "
      "one go if it had ended at an output time (--until 0.125 with --fps 24, not 0.1): steps end at --until, and a "
      "frame is kept there",
      Provenance::omit);
  tool.option(
      "--set", o.sets, "KEY=VALUE",
      "go on with another scene: change a key as sheet-init's --set does, in a run that has begun; may be given "
      "again and again. Frames from here on carry the new scene, and their provenance says what was changed and "
      "when. What the frames have settled stays: the sheet, which holds and solids there are, where they are now",
      sheet::scene::begun_settings());
  tool.option(
      "--checkpoint", o.checkpoint, "FILE",
      "keep the newest frame in FILE, replaced as a whole, also when the run fails; --resume starts from it if it is "
      "newer than the stream's last frame",
      Provenance::omit);
  tool.option("--checkpoint-every", o.checkpoint_every, "SECONDS", "of the clock on the wall", Provenance::omit);
  tool.option(
      "--progress", o.progress, "FILE",
      "tell other programs how far the run is: FILE is replaced as a whole, five times a second at most, by a line of "
      "JSON with state (running, done or interrupted; a run that fails leaves running), time and until [s], step and "
      "steps, frames, elapsed and left [s of the clock on the wall]; null is what is not known",
      Provenance::omit);
  tool.option("-i,--input", o.input, "FILE", "stream to start from; - for standard input", Provenance::omit);
  tool.option("-o,--output", o.output, "FILE",
              "stream to write; - for standard output. A file that is there is kept as FILE~", Provenance::omit);
  bool no_provenance = false;
  tool.flag("--no-provenance", no_provenance, "do not record pipeline and options in the frames", Provenance::omit);
  tool.argument(
      "PIPELINE", o.pipeline,
      "the stages, as one shell command, behind --; with --resume it may be left out: the stream's frames know "
      "the pipeline that made them, and the --fps and --keep that go with it");
  tool.example("sheet-init bunny.toml | sheet-loop --until 2 --fps 24 -- 'sheet-step | sheet-collide' > run.sheet",
               "two seconds of a film");
  tool.example("sheet-loop --resume run.sheet --until 4",
               "two seconds more, or go on after an interruption, with the same stages");
  tool.example("sheet-loop --resume run.sheet --set tear.below='1 mm' --until 6 -- 'sheet-tear | sheet-step'",
               "and two more, in which thin places tear");
  tool.example("sheet-init a.toml | sheet-loop --steps 100 --keep 10 -- 'sheet-step --dt 0.001' > run.sheet",
               "a hundred steps, every tenth kept");
  tool.example("sheet-init a.toml | sheet-loop --until 10 --stop-when 'y_max > 40 mm' -- sheet-step > run.sheet",
               "ten seconds, or until the sheet is 40 mm high");
  int signal = 0;
  const int code = tool.run(argc, argv, [&] {
    o.provenance = !no_provenance;
    signal = sheet::run_loop(o);
  });
  if (signal != 0) { // die of it, so that a calling script stops too
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  return code;
}
