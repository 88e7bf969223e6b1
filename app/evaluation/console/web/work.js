// What the evaluator works with: on the left the surgeon's picture with the last minute in curves, on the right the panel
// of the phase over the notes. The picture says its age, and is grey when it is older than a second.

import { number, withUnit } from "./format.js";
import { h } from "./h.js";
import { notes } from "./notes.js";

const kOld_s = 1;

/** `below`: in place of the curves. */
export function withPicture(app, panel, below = null) {
  return [
    h("div", { key: "left", class: "left" }, picture(app), below ?? curves(app)),
    h("div", { key: "right", class: "right" }, panel, notes(app)),
  ];
}

/** A screen without a picture, beside the notes. */
export function withNotes(app, screen) {
  return [h("div", { key: "wide", class: "wide" }, screen), h("div", { key: "right", class: "right" }, notes(app))];
}

function picture(app) {
  const { age_s } = app.picture;
  const is_old = age_s === null || age_s > kOld_s || !app.link.is_up;
  const seen = age_s === null ? "no picture yet" : `+${number(age_s, age_s < 10 ? 2 : 0)} s`;
  return h(
    "figure",
    { key: "picture", class: `picture${is_old ? " old" : ""}` },
    h("canvas", { key: "canvas", role: "img", "aria-label": "what the surgeon sees", own: (node) => app.picture.drawOn(node) }),
    h("figcaption", {}, is_old && age_s !== null ? `${number(age_s, 1)} s old` : seen),
  );
}

function curves(app) {
  const curve = (name, title, unit, colour) =>
    h(
      "section",
      { key: name, class: "curve", "aria-label": `${title}, last minute` },
      h("h2", {}, title, h("b", { class: name }, withUnit(app.course.newest(name), unit, 1))),
      h("div", { key: "plot", class: "plot", "aria-hidden": "true", own: (node) => app.course.drawIn(node, name, colour) }),
    );
  return h("div", { key: "curves", class: "curves" }, curve("clearance_mm", "clearance", "mm", "#5cc8c0"), curve("force_N", "force |F|", "N", "#f0b867"));
}
