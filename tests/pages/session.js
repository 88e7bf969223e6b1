// The way to a task, by keys alone, as evaluator and participant would go it.

import { inPhase, shows } from "./browser.js";
import { kConsent } from "./station.js";

/** 9, once it may be pressed. */
export async function goOn(page, phase) {
  await page.waitForSelector(".keys .key.main", { timeout: 90_000 });
  await page.keyboard.press("9");
  await inPhase(page, phase);
}

/** On the participant's page: yes to all but those. */
export async function consentByKeys(page, refused = []) {
  await inPhase(page, "consent");
  await page.waitForSelector("fieldset");
  // The text scrolls, so it takes the first Tab; then one for each stream.
  await page.keyboard.press("Tab");
  for (const stream of kConsent) {
    await page.keyboard.press("Tab");
    await page.keyboard.press(refused.includes(stream) ? "n" : "y");
    await page.waitForSelector(`[data-stream="${stream}"] .chosen`);
  }
}

/** From the start, or from the consent, into the first task. */
export async function toFirstTask({ evaluator, participant, is_in_consent = false }, refused = []) {
  if (!is_in_consent) await goOn(evaluator, "consent");
  await consentByKeys(participant, refused);
  await goOn(evaluator, "warm-up");
  await goOn(evaluator, "tasks");
  await beginTask(evaluator, "Task 1 of 2");
}

export async function beginTask(evaluator, words) {
  // The servo runs some seconds after the phase has begun.
  await evaluator.waitForSelector(".lamp.servo", { timeout: 90_000 });
  await evaluator.keyboard.press("5");
  await evaluator.keyboard.press("5");
  await shows(evaluator, ".panel h2", words, 90_000);
}

/** A whole line: its key, its words, Enter. */
export async function write(evaluator, key, words) {
  await evaluator.keyboard.press(key);
  await evaluator.keyboard.type(words);
  await evaluator.keyboard.press("Enter");
}
