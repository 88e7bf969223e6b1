// The station's clock as the page knows it: four stamps an exchange. The one that can be wrong by least rules: by half its
// round trip, and by what two clocks drift apart since. Page times are performance.timeOrigin + now, ms; the station's are
// nanoseconds of its monotonic clock.

const kKept = 100;
const kRecent = 8;
const kDrift = 1e-4;
const kSleep_ms = 250;

export function now_ms() {
  return performance.timeOrigin + performance.now();
}

export class StationClock {
  #exchanges = [];
  #best = null;
  #wall_ms = Date.now() - now_ms();

  /** An answered ping, at its arrival. */
  take(pong, arrived_ms) {
    const { t0, t1, t2 } = pong;
    if (![t0, t1, t2].every(Number.isFinite)) return;
    const t1_ms = t1 / 1e6;
    const t2_ms = t2 / 1e6;
    const round_ms = Math.max(0, arrived_ms - t0 - (t2_ms - t1_ms));
    this.#forgetAfterSleep();
    this.#exchanges.push({ round_ms, arrived_ms, offset_ms: (t1_ms - t0 + (t2_ms - arrived_ms)) / 2 });
    if (this.#exchanges.length > kKept) this.#exchanges.shift();
    const wrong_ms = (one) => one.round_ms / 2 + kDrift * (arrived_ms - one.arrived_ms);
    this.#best = this.#exchanges.reduce((best, one) => (wrong_ms(one) < wrong_ms(best) ? one : best));
  }

  /** A page's time on the station's clock; null: no ping was answered yet. */
  station_ns(page_ms) {
    this.#forgetAfterSleep();
    return this.#best ? Math.round((page_ms + this.#best.offset_ms) * 1e6) : null;
  }

  /** Of the exchange that rules; null as above. */
  get round_ms() {
    return this.#best?.round_ms ?? null;
  }

  /** Of the link as it is now: the shortest of the last eight; null as above. */
  get recent_ms() {
    const recent = this.#exchanges.slice(-kRecent).map((one) => one.round_ms);
    return recent.length > 0 ? Math.min(...recent) : null;
  }

  /** Another station, another clock. */
  forget() {
    this.#exchanges = [];
    this.#best = null;
  }

  // The page's clock stands still while its machine sleeps, the wall's does not.
  #forgetAfterSleep() {
    const wall_ms = Date.now() - now_ms();
    if (Math.abs(wall_ms - this.#wall_ms) > kSleep_ms) this.forget();
    this.#wall_ms = wall_ms;
  }
}
