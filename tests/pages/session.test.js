// V-12: a whole session by keys alone, both sizes at every screen: nothing outside, nothing cut off, nothing serious found
// by axe-core, no request but to the own origin, no violation of the policy; and the log tells what was said.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { faultsOf, findings, inPhase, kSizes, misfits, opened, pageAt, shows } from "./browser.js";
import { beginTask, consentByKeys, goOn, write } from "./session.js";
import { kConsent, Station, until } from "./station.js";

let station, browser, evaluator, participant;
before(async () => {
  [station, browser] = await Promise.all([Station.started(), opened()]);
  evaluator = await pageAt(browser, station);
  participant = await pageAt(browser, station, "/participant");
});
after(async () => {
  await browser?.close();
  await station?.stop();
});

async function look(page, screen) {
  for (const size of kSizes) {
    await page.setViewport(size);
    await new Promise((resolve) => setTimeout(resolve, 200));
    assert.deepEqual(await misfits(page), [], `${screen} at ${size.width} x ${size.height}`);
  }
  assert.deepEqual(await findings(page), [], screen);
}

// Keys go to the page in front.
async function at(page) {
  await page.bringToFront();
  return page;
}

async function answer(questionnaire, items, keys) {
  await at(participant);
  for (let n = 0; n < items; ++n) {
    await shows(participant, ".asked p", `${n + 1} of ${items}`);
    await participant.keyboard.press(keys[n % keys.length]);
    await participant.waitForFunction(() => document.querySelector(".onward .main"), { polling: 50 });
    if (n === 0) await look(participant, `${questionnaire}: a question`);
    await participant.keyboard.press("Enter");
  }
  await participant.waitForSelector("#submit:focus");
  await look(participant, `${questionnaire}: last look`);
  await participant.keyboard.press("Enter");
}

test("a whole session by keys alone", { timeout: 300_000 }, async () => {
  await at(evaluator);
  await inPhase(evaluator, "prepare");
  await look(evaluator, "prepare");
  await look(participant, "participant: welcome");
  await goOn(evaluator, "consent");
  await look(evaluator, "consent");
  await at(participant);
  await consentByKeys(participant, ["audio"]);
  await look(participant, "participant: consent");

  await at(evaluator);
  await goOn(evaluator, "warm-up");
  await look(evaluator, "warm-up");
  await goOn(evaluator, "tasks");
  await beginTask(evaluator, "Task 1 of 2");
  await shows(evaluator, ".picture figcaption", "+0");
  await look(evaluator, "task");

  await evaluator.keyboard.press("1");
  await evaluator.keyboard.type("looks 4 the pedal");
  await evaluator.keyboard.down("Shift");
  await evaluator.keyboard.press("Digit2");
  await evaluator.keyboard.up("Shift");
  await look(evaluator, "an open line");
  await evaluator.keyboard.press("Enter");
  await write(evaluator, "2", "cannot see how deep");
  await evaluator.keyboard.press("1");
  await evaluator.keyboard.type("dropped");
  await evaluator.keyboard.press("Escape");
  await evaluator.keyboard.press("ArrowDown");
  await evaluator.keyboard.press("3");
  await evaluator.keyboard.press("4");
  await write(evaluator, "6", "told where to begin");
  await write(evaluator, "7", "depth: How deep the bur is cannot be seen");
  await shows(evaluator, ".note.kept", "depth: How deep");
  await evaluator.keyboard.type("?");
  await evaluator.waitForSelector(".sheet");
  await look(evaluator, "sheet of keys");
  await evaluator.keyboard.press("Escape");

  await evaluator.keyboard.press("5");
  await look(evaluator, "task…");
  await evaluator.keyboard.press("4");
  await shows(evaluator, ".tag", "paused");
  await evaluator.keyboard.press("5");
  await evaluator.keyboard.press("4");
  await evaluator.keyboard.press("5");
  await write(evaluator, "2", "wished to go on");
  await shows(evaluator, ".results .partly", "open");
  await beginTask(evaluator, "Task 2 of 2");
  // The participant takes the words back: by keys of the evaluator's.
  await evaluator.keyboard.press("8");
  await look(evaluator, "withdraw…");
  // Of log, picture, quotes and reuse, which are allowed.
  await evaluator.keyboard.press("3");
  await evaluator.keyboard.press("Enter");
  await write(evaluator, "2", "SECRET WORDS");
  await shows(evaluator, ".note.kept", "(words not kept)");
  await evaluator.keyboard.press("5");
  await write(evaluator, "1", "did it well");

  await goOn(evaluator, "debrief");
  await look(evaluator, "debrief");
  await at(participant);
  await participant.waitForSelector(".words.large input");
  await look(participant, "participant: debrief");
  for (let n = 0; n < 5; ++n) {
    await participant.keyboard.press("Tab");
    await participant.keyboard.type(`answer ${n}`);
  }
  await participant.keyboard.press("Enter");
  await participant.keyboard.press("Enter");

  await at(evaluator);
  await goOn(evaluator, "questionnaires");
  await look(evaluator, "questionnaires");
  await answer("sus", 10, ["5", "ArrowRight", "2"]);
  await shows(participant, ".questions p", "NASA task load");
  await answer("tlx-raw", 6, ["ArrowRight", "ArrowLeft"]);
  await look(participant, "participant: thanks");

  await at(evaluator);
  await goOn(evaluator, "close");
  await look(evaluator, "close");
  assert.deepEqual([...(await faultsOf(evaluator)), ...(await faultsOf(participant))], []);
  await evaluator.keyboard.press("9");
  await shows(evaluator, ".title", "Done");
  await look(evaluator, "done");
  await evaluator.keyboard.press("9");
  assert.equal(await station.end(), 0, station.words);

  const of = (type) => station.events(type).map(({ data }) => data);
  assert.deepEqual(of("consent").map(({ stream, given }) => [stream, given]), [...kConsent.map((stream) => [stream, stream !== "audio"]), ["quotes", false]]);
  const notes = of("note");
  assert.deepEqual(notes.map(({ kind, text, severity }) => [kind, text, severity]), [
    ["behaviour", "looks 4 the pedal", 2],
    ["comment", "cannot see how deep", undefined],
    ["comment", undefined, undefined],
  ]);
  assert.deepEqual(of("prompt").map(({ prompt }) => prompt), ["why"]);
  assert.equal(of("bookmark").length, 1);
  assert.deepEqual(of("task.stop").map(({ task, result, by }) => [task, result, by]), [["open", "partly", "evaluator"], ["again", "success", "evaluator"]]);
  assert.equal(of("submit").length, 3);
  assert.equal(station.events("answer").filter(({ data }) => data.questionnaire === "sus").length, 10);
  assert.ok(!JSON.stringify(station.events()).includes("SECRET"));
  await until(() => of("session.stop").length === 1, "the log's end");
});
