// SPDX-License-Identifier: Apache-2.0
// The video's newest picture with the detector's boxes, fetched when the server announces one.

const LABEL_PX = 14; // on the screen, whatever the size of the picture
const BOX_PX = 1.8;

/** 4 bytes of the JSON's length, little endian, the JSON, the JPEG. */
async function unpack(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const about = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const jpeg = new Blob([new Uint8Array(buffer, 4 + length)], { type: "image/jpeg" });
  return { about, image: await createImageBitmap(jpeg) };
}

/** `pixel`: canvas pixels per screen pixel; `scale`: canvas pixels per frame pixel. */
function drawBox(context, { box, name, confidence }, scale, pixel, colour) {
  const [x, y, width, height] = box.map((value) => value * scale);
  for (const [style, line] of [["#000a", 2 * BOX_PX], [colour, BOX_PX]]) {
    context.strokeStyle = style;
    context.lineWidth = line * pixel;
    context.strokeRect(x, y, width, height);
  }
  const label = `${name.slice(0, 24)} ${Math.round(100 * confidence)} %`;
  const labelWidth = context.measureText(label).width + 8 * pixel;
  const labelHeight = (LABEL_PX + 5) * pixel;
  const left = Math.min(Math.max(0, x - pixel), Math.max(0, context.canvas.width - labelWidth));
  const top = y > labelHeight + 2 * pixel ? y - labelHeight - 2 * pixel : y + height + 2 * pixel;
  context.fillStyle = "#000b";
  context.fillRect(left, top, labelWidth, labelHeight);
  context.fillStyle = "#fff";
  context.fillText(label, left + 4 * pixel, top + LABEL_PX * pixel);
}

export class VideoView {
  constructor(section, canvas, caption) {
    Object.assign(this, { section, canvas, caption });
    this.shown = 0;
    this.isFetching = false;
  }

  /** `newest` is the number of the newest picture. Pictures are requested even before the first, so that one is made. */
  async update(newest, isLive) {
    if (!isLive || this.isFetching || (newest !== 0 && newest === this.shown)) return;
    this.isFetching = true;
    try {
      const answer = await fetch("frame", { cache: "no-store" });
      if (answer.status === 200) this.draw(await unpack(await answer.arrayBuffer()));
    } catch {
      // The server is gone or the picture is damaged; the next one may work.
    } finally {
      this.isFetching = false;
    }
  }

  draw({ about, image }) {
    const { canvas } = this;
    if (canvas.width !== image.width || canvas.height !== image.height) {
      canvas.width = image.width;
      canvas.height = image.height;
    }
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    this.section.hidden = false;
    const pixel = canvas.width / Math.max(1, canvas.clientWidth);
    context.font = `600 ${LABEL_PX * pixel}px system-ui, sans-serif`;
    for (const box of about.boxes) drawBox(context, box, image.width / about.width_px, pixel, "#ffd23f");
    image.close();
    this.shown = about.number;
    const count = about.boxes.length;
    this.caption.textContent =
      `${new Date(about.at).toISOString().slice(11, 23)} UTC · ${about.width_px} × ${about.height_px} · ` +
      `${count === 1 ? "1 detection" : `${count} detections`}`;
  }
}
