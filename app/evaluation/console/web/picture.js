// The surgeon's picture: JPEG messages drawn as they arrive, each answered once it is drawn, so the station sends no more
// than this page can take. The age is told by the page (work.js), which greys a picture that is older than a second.

const kMagic = 0x4d4c5250;
const kHead = 16;

export class Picture {
  #app;
  #canvas = null;
  #bitmap = null;
  /** Of the picture that is shown, on the station's clock; null: none came yet. */
  t_ns = null;

  constructor(app) {
    this.#app = app;
  }

  /** The canvas to draw on from now on. */
  drawOn(canvas) {
    this.#canvas = canvas;
    this.#draw();
  }

  get age_s() {
    const { clock } = this.#app;
    const now = clock.station_ns(performance.timeOrigin + performance.now());
    return this.t_ns === null || now === null ? null : Math.max(0, (now - this.t_ns) / 1e9);
  }

  async take(buffer) {
    const head = new DataView(buffer);
    if (buffer.byteLength <= kHead || head.getUint32(0, true) !== kMagic) return;
    const serial = head.getUint32(4, true);
    const t_ns = Number(head.getBigUint64(8, true));
    try {
      const bitmap = await createImageBitmap(new Blob([new Uint8Array(buffer, kHead)], { type: "image/jpeg" }));
      // Decoded out of turn: the newer one stays.
      if (this.t_ns === null || t_ns >= this.t_ns) {
        this.#bitmap?.close();
        this.#bitmap = bitmap;
        this.t_ns = t_ns;
        this.#draw();
      } else {
        bitmap.close();
      }
    } catch {
      // A damaged picture is not shown; it is answered all the same, or the stream would stand.
    }
    this.#app.send({ kind: "drawn", picture: serial });
  }

  #draw() {
    const [canvas, bitmap] = [this.#canvas, this.#bitmap];
    if (!canvas || !bitmap) return;
    if (canvas.width !== bitmap.width || canvas.height !== bitmap.height) {
      canvas.width = bitmap.width;
      canvas.height = bitmap.height;
    }
    canvas.getContext("2d", { alpha: false }).drawImage(bitmap, 0, 0);
  }
}
