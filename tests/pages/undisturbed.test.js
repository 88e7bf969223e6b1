// V-03: ten notes a second and the surgeon's picture cost the servo nothing: parts of one session with a page that writes
// and looks, and parts in which none is open, in turn. All processes beside the rehearsal together stay below 20 % of a
// core. MOLAR_SOAK_MINUTES: six pairs of ten seconds, else one of four.

import assert from "node:assert/strict";
import fs from "node:fs";
import { after, before, test } from "node:test";
import { opened, pageAt, shows } from "./browser.js";
import { toFirstTask } from "./session.js";
import { Station } from "./station.js";

const is_long = process.env.MOLAR_SOAK_MINUTES !== undefined;
const kPairs = is_long ? 6 : 1;
const kPart_s = is_long ? 10 : 4;
const kNotesPerSecond = 10;

let station, browser;
before(async () => {
  const change = (text) => text.replace('success = "M1.drilling >= 500 s"', 'success = "O1.bone > 100000 mm3"');
  [station, browser] = await Promise.all([Station.started({ change }), opened()]);
  const [evaluator, participant] = [await pageAt(browser, station), await pageAt(browser, station, "/participant")];
  await toFirstTask({ evaluator, participant });
  await Promise.all([evaluator.close(), participant.close()]);
});
after(async () => {
  await browser?.close();
  await station?.stop();
});

const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** Deadlines that the servo has missed until now. */
async function missed(page) {
  await shows(page, ".lamp.servo", "missed");
  await pause(700);
  return Number(/([0-9]+) missed/.exec(await page.$eval(".lamp.servo", (lamp) => lamp.textContent))[1]);
}

/** Seconds of processor that the processes beside the rehearsal have had: seat with its kept states, page, voice. */
function besides_s() {
  const kTicks_per_s = 100;
  let all = 0;
  for (const pid of station.besides()) {
    try {
      const fields = fs.readFileSync(`/proc/${pid}/stat`, "utf8").split(") ").at(-1).split(" ");
      all += (Number(fields[11]) + Number(fields[12])) / kTicks_per_s;
    } catch {
      // It has ended meanwhile.
    }
  }
  return all;
}

test("a page that writes and looks costs the servo nothing", { timeout: 600_000 }, async () => {
  const [quiet, busy] = [[], []];
  let share = 0;
  for (let n = 0; n < kPairs; ++n) {
    let page = await pageAt(browser, station);
    let before = await missed(page);
    await page.close();
    await pause(1000 * kPart_s);
    page = await pageAt(browser, station);
    let now = await missed(page);
    quiet.push(now - before);
    await page.bringToFront();
    await page.waitForSelector(".picture:not(.old)", { timeout: 60_000 });
    before = await missed(page);
    const [cpu_s, began] = [besides_s(), performance.now()];
    for (let note = 0; note < kPart_s * kNotesPerSecond; ++note) {
      await page.keyboard.press("1");
      await page.keyboard.type(`n${note}`);
      await page.keyboard.press("Enter");
      await pause(Math.max(0, began + ((note + 1) * 1000) / kNotesPerSecond - performance.now()));
    }
    share = Math.max(share, ((besides_s() - cpu_s) / (performance.now() - began)) * 1000);
    now = await missed(page);
    busy.push(now - before);
    await page.close();
  }
  const sum = (all) => all.reduce((one, other) => one + other, 0);
  const ticks = 1000 * kPart_s * kPairs;
  console.log(`deadlines missed in ${kPairs} pairs of ${kPart_s} s: ${quiet.join(", ")} without, ${busy.join(", ")} with; the processes beside it ${(100 * share).toFixed(1)} % of a core at most`);
  assert.equal(station.events("note").length, kPairs * kPart_s * kNotesPerSecond);
  if (process.env.MOLAR_STRICT) {
    assert.ok(sum(busy) - sum(quiet) <= 0.001 * ticks, `${sum(busy)} of ${ticks}, ${sum(quiet)} without`);
    assert.ok(share <= 0.2, `${100 * share} %`);
  }
});
