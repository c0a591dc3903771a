// When the picture is drawn and words are written.

import {drawPicture} from "./picture.js";
import {drawMarks, tell} from "./words.js";

let waiting = false, tellLater = false;

export function draw() {
  waiting = false;
  if (document.body.dataset.state === "loading")
    return;
  drawPicture();
  drawMarks();
}

// Asks for a picture soon; `told`: texts and panel have changed too.
export function show(told = false) {
  tellLater ||= told;
  if (waiting)
    return;
  waiting = true;
  requestAnimationFrame(() => {
    draw();
    if (tellLater) {
      tellLater = false;
      tell();
    }
  });
}
