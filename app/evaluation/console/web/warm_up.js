// Warm-up: the participant drills a block and says aloud what they think; the level of the voice, and the time left.

import { minutes, number } from "./format.js";
import { h } from "./h.js";

const kQuiet_dB = -60;
const kGood_dB = -40;
const kLoud_dB = -6;

export function warmUpPanel({ state }) {
  return h(
    "section",
    { class: "panel", key: "warm-up", "aria-label": "warm-up" },
    h("h2", {}, "Warm-up"),
    h("p", { class: "say" }, "The participant drills a block and thinks aloud. Help them to keep talking."),
    h("p", { class: "clock" }, h("b", {}, minutes(state.warm_up?.left_s)), " min left"),
    level(state.voice),
    state.hold && !state.may_continue && h("p", { class: "hold amber" }, state.hold),
  );
}

function level(voice) {
  if (!voice) return h("p", { class: "quiet", key: "level" }, "No microphone: the voice is not recorded.");
  const part = Math.min(1, Math.max(0, (voice.level_dB - kQuiet_dB) / -kQuiet_dB));
  const light = voice.level_dB > kLoud_dB ? "red" : voice.level_dB > kGood_dB ? "green" : "amber";
  const words = light === "red" ? "too loud" : light === "green" ? "good" : "too quiet";
  return h(
    "div",
    { class: "level", key: "level" },
    h("span", {}, `voice ${number(voice.level_dB, 0)} dB`),
    h("span", { class: "bar", "aria-hidden": "true" }, h("span", { class: `part ${light}`, style: { width: `${(100 * part).toFixed(0)}%` } })),
    h("span", { class: light }, voice.speech ? `${words}, speech` : words),
  );
}
