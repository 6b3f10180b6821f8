// SPDX-License-Identifier: Apache-2.0
// A background of map tiles (Web Mercator, 256 px), if a URL is configured.
import { toDegrees, toMetres } from "./projection.js";

const MOST_TILES = 256; // kept
const MOST_DRAWN = 64;
const TILE_PX = 256;
const MOST_ZOOM = { own: 23, other: 19 }; // files of ours are enlarged there, other servers have no such tiles

const longitudeOf = (x, n) => x / n * 360 - 180;
const latitudeOf = (y, n) => Math.atan(Math.sinh(Math.PI * (1 - 2 * y / n))) * 180 / Math.PI;
const columnOf = (longitude, n) => (longitude + 180) / 360 * n;
const rowOf = (latitude, n) => (1 - Math.asinh(Math.tan(latitude * Math.PI / 180)) / Math.PI) / 2 * n;

export class TileLayer {
  constructor(url, onLoad) {
    this.url = url;
    this.mostZoom = url.includes("://") ? MOST_ZOOM.other : MOST_ZOOM.own;
    this.onLoad = onLoad;
    this.tiles = new Map();
  }

  tile(z, x, y) {
    const key = `${z}/${x}/${y}`;
    const known = this.tiles.get(key);
    if (known) return known;
    if (this.tiles.size >= MOST_TILES) this.tiles.delete(this.tiles.keys().next().value);
    const image = new Image();
    image.onload = this.onLoad;
    image.src = this.url.replace("{z}", z).replace("{x}", x).replace("{y}", y);
    this.tiles.set(key, image);
    return image;
  }

  draw({ context, viewport }, anchor) {
    if (!anchor) return;
    const [north, west] = toDegrees(anchor, viewport.toGround([0, 0]));
    const [south, east] = toDegrees(anchor, viewport.toGround([viewport.width, viewport.height]));
    const wanted = (viewport.width * devicePixelRatio / TILE_PX) * 360 / Math.max(1e-9, east - west);
    const z = Math.max(0, Math.min(this.mostZoom, Math.round(Math.log2(wanted))));
    const n = 2 ** z;
    const columns = [Math.floor(columnOf(west, n)), Math.floor(columnOf(east, n))];
    const rows = [Math.floor(rowOf(north, n)), Math.floor(rowOf(south, n))];
    if ((columns[1] - columns[0] + 1) * (rows[1] - rows[0] + 1) > MOST_DRAWN) return;
    for (let x = columns[0]; x <= columns[1]; ++x) {
      for (let y = Math.max(0, rows[0]); y <= Math.min(n - 1, rows[1]); ++y) {
        const image = this.tile(z, ((x % n) + n) % n, y);
        if (!image.complete || image.naturalWidth === 0) continue;
        const [left, top] = viewport.toScreen(toMetres(anchor, [latitudeOf(y, n), longitudeOf(x, n)]));
        const [right, bottom] = viewport.toScreen(toMetres(anchor, [latitudeOf(y + 1, n), longitudeOf(x + 1, n)]));
        context.drawImage(image, left, top, right - left + 0.5, bottom - top + 0.5);
      }
    }
  }
}
