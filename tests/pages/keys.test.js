// The evaluator's keys and the page's clock, without a browser.

import assert from "node:assert/strict";
import { test } from "node:test";
import { web } from "./web.js";

const { StationClock } = await web("clock.js");
const { press, rated, typed } = await web("keys.js");

const kContext = { prompt: "why", streams: ["log", "quotes"] };
const at = (t_ns) => ({ page_ms: t_ns / 1e6, t_ns, rtt_ms: 1 });

/** Keys one after the other; longer words are typed. What was said. */
function said(...keys) {
  const all = [];
  let line = null;
  for (const [n, key] of keys.entries()) {
    if (key.length > 1 && !["Enter", "Escape"].includes(key)) {
      line = typed(line, key, at(n));
    } else {
      const pressed = press(line, key, at(n), kContext);
      line = pressed.line;
      if (pressed.said) all.push([pressed.said.type, pressed.said.data, pressed.said.at.t_ns]);
    }
  }
  return all;
}

test("each key says what the terminal's says", () => {
  assert.deepEqual(said("1", "looks", "Enter"), [["note", { kind: "behaviour", text: "looks" }, 1]]);
  assert.deepEqual(said("2", "no 2", "Enter"), [["note", { kind: "comment", text: "no 2" }, 1]]);
  assert.deepEqual(said("3"), [["prompt", { prompt: "why" }, 0]]);
  assert.deepEqual(said("4"), [["bookmark", { label: "" }, 0]]);
  assert.deepEqual(said("5", "2", "so far", "Enter"), [["task", { result: "partly", reason: "so far" }, 2]]);
  assert.deepEqual(said("5", "4", "5", "5"), [["task", { result: "pause" }, 1], ["task", { result: "next" }, 3]]);
  assert.deepEqual(said("6", "told", "Enter"), [["help", { reason: "told" }, 1]]);
  assert.deepEqual(said("7", "depth: not seen", "Enter"), [["problem", { problem: "depth", title: "not seen" }, 1]]);
  assert.deepEqual(said("8", "2", "Enter"), [["consent", { stream: "quotes", given: false }, 2]]);
});

test("what is dropped, empty or not chosen says nothing", () => {
  assert.deepEqual(said("1", "looks", "Escape", "1", "Enter", "5", "Escape", "8", "Enter", "Escape", "5", "7", "Escape"), []);
  assert.deepEqual(said("8", "7", "Enter"), []);
});

test("a line has the time of its first letter, also when it was empty again", () => {
  let line = press(null, "1", at(0), kContext).line;
  line = typed(line, "a", at(5));
  line = typed(line, "ab", at(9));
  assert.equal(line.at.t_ns, 5);
  line = typed(typed(line, "", at(10)), "c", at(12));
  assert.equal(line.at.t_ns, 12);
});

test("severity is set and taken back", () => {
  const line = typed(press(null, "7", at(0), kContext).line, "a: b", at(1));
  assert.equal(press(rated(line, 3), "Enter", at(2), kContext).said.data.severity, 3);
  assert.equal(press(rated(rated(line, 3), 3), "Enter", at(2), kContext).said.data.severity, undefined);
});

test("a line is no longer than the station takes, in any script", () => {
  const line = typed(press(null, "1", at(0), kContext).line, "骨".repeat(5000), at(1));
  assert.ok(new TextEncoder().encode(line.text).length <= 2000);
  assert.ok(line.text.length > 600);
});

test("the clock is wrong by half of the shortest round trip at most", () => {
  // A generator of Lehmer's, so that the run is the same each time.
  let seed = 7;
  const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
  for (let run = 0; run < 500; ++run) {
    const offset_ms = 1e6 * random();
    const clock = new StationClock();
    let t_ms = 1000;
    for (let n = 0; n < 20; ++n) {
      const [up_ms, work_ms, down_ms] = [40 * random(), 3 * random(), 40 * random()];
      const t1 = (t_ms + up_ms + offset_ms) * 1e6;
      clock.take({ t0: t_ms, t1, t2: t1 + work_ms * 1e6 }, t_ms + up_ms + work_ms + down_ms);
      t_ms += 100;
      const error_ms = Math.abs(clock.station_ns(t_ms) / 1e6 - (t_ms + offset_ms));
      assert.ok(error_ms <= clock.round_ms / 2 + 1e-3, `${error_ms} of ${clock.round_ms}`);
    }
  }
});
