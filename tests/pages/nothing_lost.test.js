// V-13: a reload, a page that stands still and a wire that is cut while something is typed: no note is lost, none is
// there twice, and each has the time at which it was begun.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { opened, pageAt, shows } from "./browser.js";
import { Delay } from "./delay.js";
import { toFirstTask, write } from "./session.js";
import { Station, stationNow, until } from "./station.js";

const kSlow_ns = 500e6;

let station, browser, wire, evaluator;
before(async () => {
  [station, browser] = await Promise.all([Station.started(), opened()]);
  const participant = await pageAt(browser, station, "/participant");
  wire = await Delay.before(station);
  evaluator = await pageAt(browser, wire);
  await toFirstTask({ evaluator, participant });
});
after(async () => {
  await browser?.close();
  wire?.stop();
  await station?.stop();
});

/** Opens a line and types into it; the time of its first letter. */
async function begin(words) {
  await evaluator.keyboard.press("1");
  const t_ns = stationNow();
  await evaluator.keyboard.type(words);
  return t_ns;
}

async function onceInTheLog(text, t_ns) {
  await until(() => station.events("note").some(({ data }) => data.text === text), `the note “${text}”`);
  // What is sent again comes at once with the link's return.
  await new Promise((resolve) => setTimeout(resolve, 700));
  const found = station.events("note").filter(({ data }) => data.text === text);
  assert.equal(found.length, 1, text);
  if (t_ns) assert.ok(Math.abs(found[0].t_ns - t_ns) < kSlow_ns, `${text}: wrong by ${(found[0].t_ns - t_ns) / 1e6} ms`);
}

test("a reload leaves the open line as it was", { timeout: 120_000 }, async () => {
  const t_ns = await begin("before the reload");
  await evaluator.reload();
  await evaluator.waitForSelector("#line");
  assert.equal(await evaluator.$eval("#line", (field) => field.value), "before the reload");
  await evaluator.keyboard.type(", after");
  await evaluator.keyboard.press("Enter");
  await onceInTheLog("before the reload, after", t_ns);
});

test("a page that stands still goes on where it was", { timeout: 120_000 }, async () => {
  const t_ns = await begin("before it stood");
  const tools = await evaluator.createCDPSession();
  await tools.send("Page.setWebLifecycleState", { state: "frozen" });
  await new Promise((resolve) => setTimeout(resolve, 3000));
  await tools.send("Page.setWebLifecycleState", { state: "active" });
  await tools.detach();
  await evaluator.keyboard.type(", after");
  await evaluator.keyboard.press("Enter");
  await onceInTheLog("before it stood, after", t_ns);
});

test("a wire that is cut: red within 2 s, notes follow with their times", { timeout: 240_000 }, async () => {
  const first_ns = await begin("one while it is cut");
  const port = await wire.close();
  await evaluator.waitForSelector(".banner.red", { timeout: 4000 });
  await evaluator.keyboard.press("Enter");
  const times = [first_ns];
  for (const name of ["two", "three"]) {
    times.push(await begin(`${name} while it is cut`));
    await evaluator.keyboard.press("Enter");
  }
  await shows(evaluator, ".note.going", "three while it is cut");
  await new Promise((resolve) => setTimeout(resolve, Number(process.env.MOLAR_CUT_MS ?? 0)));
  await wire.mend(port);
  for (const [n, name] of ["one", "two", "three"].entries()) await onceInTheLog(`${name} while it is cut`, times[n]);
  await evaluator.waitForFunction(() => !document.querySelector(".note.going, .banner"), { timeout: 20_000, polling: 50 });
});

test("a wire that falls silent is noticed, and the page is loaded anew over it", { timeout: 120_000 }, async () => {
  wire.is_silent = true;
  await evaluator.waitForSelector(".banner.red", { timeout: 4000 });
  await write(evaluator, "1", "said into the silence");
  wire.is_silent = false;
  await evaluator.reload();
  await onceInTheLog("said into the silence");
});

test("what was sent and never answered is said again on the next wire", { timeout: 120_000 }, async () => {
  wire.is_silent = true;
  const t_ns = await begin("sent, not answered");
  await evaluator.keyboard.press("Enter");
  await evaluator.waitForSelector(".note.going");
  wire.cut();
  wire.is_silent = false;
  await onceInTheLog("sent, not answered", t_ns);
});

test("a page that is closed in mid-word is taken up by the next one", { timeout: 120_000 }, async () => {
  const t_ns = await begin("in mid-w");
  await until(() => evaluator.evaluate(() => new Promise((resolve) => {
    const opening = indexedDB.open("molar");
    opening.onsuccess = () => {
      const request = opening.result.transaction("lines").objectStore("lines").getAll();
      request.onsuccess = () => resolve(request.result.some(({ line }) => line.text === "in mid-w"));
    };
  })), "the line in the database");
  await evaluator.close();
  evaluator = await pageAt(browser, wire);
  await evaluator.waitForSelector("#line");
  await evaluator.keyboard.type("ord");
  await evaluator.keyboard.press("Enter");
  await onceInTheLog("in mid-word", t_ns);
});

test("a second page sees, and writes once it takes over", { timeout: 120_000 }, async () => {
  const second = await pageAt(browser, station);
  await second.waitForSelector(".banner.amber");
  await write(second, "1", "must not be said");
  await shows(second, ".banner", "Another page writes");
  // The one button there is before the notes.
  await second.keyboard.press("Tab");
  await second.keyboard.press("Enter");
  await second.waitForFunction(() => !document.querySelector(".banner"), { polling: 50 });
  await write(second, "1", "said by the second");
  await onceInTheLog("said by the second");
  await shows(evaluator, ".banner", "Another page writes");
  assert.ok(!station.events("note").some(({ data }) => data.text === "must not be said"));
  await second.close();
});
