// The page from its beginning: unpacks the streams while the first frame is shown.

import {readAddress} from "./address.js";
import {fit, listen, offerQuantities} from "./hands.js";
import {draw, show} from "./showing.js";
import {$, canvas, findExtent, streams, times} from "./state.js";

async function start() {
  const say = text => { $("message").textContent = text; };
  if (!canvas.gl)
    return say("This browser has no WebGL 2, or it is switched off: nothing can be drawn.");
  const count = streams.reduce((n, s) => n + s.times.length, 0);
  let done = 0;
  for (const stream of streams) {
    await stream.unpackSolids();
    await stream.unpackNext();
    ++done;
  }
  findExtent();
  fit();
  $("time").max = times.length - 1;
  for (const id of ["play", "time", "clock"])
    $(id).hidden = times.length === 1;
  document.querySelector("footer").classList.toggle("still", times.length === 1);
  offerQuantities();
  listen();
  document.body.dataset.state = "unpacking";
  show(true);
  for (const stream of streams)
    while (stream.frames.length < stream.times.length) {
      await stream.unpackNext();
      if (++done % 8 === 0) {
        say(`frame ${done} of ${count}`);
        await new Promise(resolve => setTimeout(resolve));
      }
    }
  say("");
  readAddress();
  draw();
  document.body.dataset.state = "ready";
  show(true);
}

start().catch(error => {
  document.body.dataset.state = "failed";
  $("message").textContent = `This page cannot be shown: ${error.message}`;
});
