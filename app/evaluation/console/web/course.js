// The last minute in curves: clearance in mm and force in N, 15 points a second, drawn by uPlot (uPlot.txt).

/* global uPlot */

const kKept_s = 60;
const kMarks_s = [-50, -40, -30, -20, -10];
const kAxis = { stroke: "#a9b6c0", grid: { stroke: "#26303a", width: 1 }, ticks: { stroke: "#26303a", width: 1 } };
const kFont = "14px system-ui, sans-serif";

export class Course {
  #t_s = [];
  #values = { clearance_mm: [], force_N: [] };
  #plots = [];
  #due = false;

  take(state) {
    for (const point of state.course ?? []) {
      // A state that comes twice adds nothing; a session that begins anew begins a new minute.
      const newest = this.#t_s.at(-1) ?? -Infinity;
      if (point.t_s < newest - kKept_s) this.#clear();
      else if (point.t_s <= newest) continue;
      this.#t_s.push(point.t_s);
      this.#values.clearance_mm.push(point.clearance_mm ?? null);
      this.#values.force_N.push(point.force_N ?? null);
    }
    let old = 0;
    while (old < this.#t_s.length && this.#t_s[old] < this.#t_s.at(-1) - kKept_s) ++old;
    for (const list of [this.#t_s, ...Object.values(this.#values)]) list.splice(0, old);
    this.#draw();
  }

  newest(name) {
    return this.#values[name].at(-1) ?? null;
  }

  /** Draws one of the two into this element from now on. */
  drawIn(node, name, colour) {
    const made = new uPlot(
      {
        width: 320,
        height: 100,
        padding: [8, 8, 0, 0],
        cursor: { show: false },
        legend: { show: false },
        select: { show: false },
        scales: { x: { time: false, range: (_, low, high) => [high - kKept_s, high] }, y: { range: (_, low, high) => [0, Math.max(high ?? 0, 1)] } },
        axes: [
          { ...kAxis, size: 26, font: kFont, splits: (plot) => kMarks_s.map((s) => plot.scales.x.max + s), values: () => kMarks_s.map((s) => `−${-s} s`) },
          { ...kAxis, size: 40, font: kFont, space: 30 },
        ],
        series: [{}, { stroke: colour, width: 2, points: { show: false }, spanGaps: false }],
      },
      this.#dataOf(name),
      node,
    );
    this.#plots.push({ made, name, node });
    new ResizeObserver(() => {
      const { width, height } = node.getBoundingClientRect();
      if (width > 0 && height > 0) made.setSize({ width: Math.floor(width), height: Math.floor(height) });
    }).observe(node);
  }

  #dataOf(name) {
    return [this.#t_s, this.#values[name]];
  }

  #clear() {
    for (const list of [this.#t_s, ...Object.values(this.#values)]) list.length = 0;
  }

  #draw() {
    if (this.#due) return;
    this.#due = true;
    requestAnimationFrame(() => {
      this.#due = false;
      this.#plots = this.#plots.filter(({ node, made }) => node.isConnected || made.destroy());
      for (const { made, name } of this.#plots) made.setData(this.#dataOf(name));
    });
  }
}
