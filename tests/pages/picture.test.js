// V-10: the surgeon's picture is grey with its age once nothing new comes; a page that does not read holds nothing up,
// and has the newest picture soon afterwards. What a reader that stands costs the station is console/page_hub's test.

import assert from "node:assert/strict";
import fs from "node:fs";
import { after, before, test } from "node:test";
import { opened, pageAt, shows } from "./browser.js";
import { Delay } from "./delay.js";
import { toFirstTask } from "./session.js";
import { Station, until } from "./station.js";

const kStands_ms = Number(process.env.MOLAR_STANDS_MS ?? 4000);

let station, browser, wire, evaluator, participant;
before(async () => {
  [station, browser] = await Promise.all([Station.started(), opened()]);
  participant = await pageAt(browser, station, "/participant");
  wire = await Delay.before(station);
  evaluator = await pageAt(browser, wire);
  await toFirstTask({ evaluator, participant });
});
after(async () => {
  await browser?.close();
  wire?.stop();
  await station?.stop();
});

// kB of the program and what it started.
function memory_kB() {
  const of = (pid) => Number(/VmRSS:\s+([0-9]+)/.exec(fs.readFileSync(`/proc/${pid}/status`, "utf8"))?.[1] ?? 0);
  return station.pageProcess().map(of).reduce((sum, one) => sum + one, 0);
}

test("a picture is shown, young", { timeout: 120_000 }, async () => {
  await evaluator.bringToFront();
  await evaluator.waitForSelector(".picture:not(.old)", { timeout: 60_000 });
  const bright = await evaluator.$eval(".picture canvas", (canvas) => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return data.some((value, n) => n % 4 !== 3 && value > 40);
  });
  assert.ok(bright, "the picture is black");
});

test("a page that stands still grows nothing, and has the newest picture afterwards", { timeout: 180_000 }, async () => {
  const tools = await evaluator.createCDPSession();
  const before_kB = memory_kB();
  await tools.send("Page.setWebLifecycleState", { state: "frozen" });
  await new Promise((resolve) => setTimeout(resolve, kStands_ms));
  const grown_kB = memory_kB() - before_kB;
  await tools.send("Page.setWebLifecycleState", { state: "active" });
  const began = Date.now();
  await until(() => evaluator.$(".picture:not(.old)"), "a young picture", 20_000);
  console.log(`stood for ${kStands_ms / 1000} s: the page's process grew by ${grown_kB} kB; newest picture after ${Date.now() - began} ms`);
  assert.ok(grown_kB < 1024, `${grown_kB} kB more`);
});

test("a picture that gets no younger is grey and says its age", { timeout: 60_000 }, async () => {
  wire.is_silent = true;
  await evaluator.waitForSelector(".picture.old", { timeout: 10_000 });
  await shows(evaluator, ".picture figcaption", "s old", 10_000);
  await evaluator.waitForSelector(".lamp.link.red", { timeout: 10_000 });
});
