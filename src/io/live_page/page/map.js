// SPDX-License-Identifier: Apache-2.0
// The map: a canvas with a metric grid that is moved and zoomed by mouse, touch and keys.
import { Cells, crowdsOf, drawCrowds } from "./crowds.js";
import { drawFlights } from "./fleet.js";
import * as layers from "./layers.js";
import * as marks from "./marks.js";
import { Viewport, toDegrees, typical } from "./projection.js";

const REACH_PX = 22; // of a tap, which may be with gloves
const KEY_STEP_PX = 60;
const CROWD_ZOOM = 3; // by a tap on a crowd
const TOOLS_PX = 68; // the buttons at the right edge
const COLOURS = ["map", "grid", "grid-strong", "ink", "soft", "object", "tentative", "raw", "trajectory", "footprint",
  "target", "vehicle"];
// A corner of the image near the horizon lies far away, and would make all else small.
const FARTHEST_CORNER = 8; // times the vehicle's height
const FEW_OBJECTS = 3; // one of so few cannot be told to be false by the others
const MOST_TO_AIM_AT = 2000;

/** Of more objects than that, so many: enough to tell where they are. */
function sampleOf(objects) {
  const stride = Math.ceil(objects.length / MOST_TO_AIM_AT);
  return stride < 2 ? objects : objects.filter((_, i) => i % stride === 0);
}

export class GroundMap extends EventTarget {
  /** `visible(key)`: whether a layer is drawn. `background(pen)`: draws what is below all layers. */
  constructor(canvas, model, visible, background) {
    super();
    this.canvas = canvas;
    this.model = model;
    this.visible = visible;
    this.background = background;
    this.viewport = new Viewport();
    this.mode = "fit"; // "fit": all in view; "follow": the vehicle stays in the middle; "free"
    this.selected = null;
    this.own = null; // where the reader stands [m]
    this.onTap = null; // takes the next tap in place of the objects
    this.factor = 1;
    this.crowds = [];
    this.pointers = new Map();
    this.readColours();
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.listen();
  }

  readColours() {
    const style = getComputedStyle(document.documentElement);
    this.colours = Object.fromEntries(COLOURS.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
    this.weight = Number(style.getPropertyValue("--weight")) || 1;
    this.font = getComputedStyle(document.body).fontFamily;
    this.redraw();
  }

  resize() {
    const ratio = devicePixelRatio || 1;
    this.viewport.width = this.canvas.clientWidth;
    this.viewport.height = this.canvas.clientHeight;
    this.canvas.width = Math.round(this.viewport.width * ratio);
    this.canvas.height = Math.round(this.viewport.height * ratio);
    this.redraw();
  }

  setMode(mode) {
    if (this.mode === mode) return;
    this.mode = mode;
    this.dispatchEvent(new Event("mode"));
    this.redraw();
  }

  select(id) {
    if (this.selected === id) return;
    this.selected = id;
    this.dispatchEvent(new Event("select"));
    this.redraw();
  }

  redraw() {
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.isDue = false;
      this.draw();
    });
  }

  aim() {
    const { model, viewport } = this;
    if (this.mode === "follow" && model.view) viewport.centre = model.view.vehicle;
    if (this.mode !== "fit") return;
    const seen = this.cornersInView();
    const flown = typical([...model.path, ...(model.view ? [model.view.vehicle] : [])]);
    const objects = sampleOf(model.confirmed()).filter((object) => object.verdict !== "dismissed").map((object) => object.at);
    const found = objects.length > FEW_OBJECTS ? typical(objects) : typical([...objects, ...seen, ...flown]);
    viewport.fit([...flown, ...seen, ...found, ...typical(model.targets)], TOOLS_PX);
  }

  cornersInView() {
    const { view } = this.model;
    if (!view?.footprint) return [];
    const reach = FARTHEST_CORNER * Math.max(1, view.height_m);
    return view.footprint.filter(([x, y]) => Math.hypot(x - view.vehicle[0], y - view.vehicle[1]) <= reach);
  }

  draw() {
    const { model, viewport } = this;
    this.aim();
    const context = this.canvas.getContext("2d");
    const ratio = this.canvas.width / Math.max(1, viewport.width);
    const pen = { context, viewport, colours: this.colours, font: this.font, weight: this.weight };
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = this.colours.map;
    context.fillRect(0, 0, viewport.width, viewport.height);
    this.background(pen);
    layers.drawGrid(pen);
    const now = model.view?.at ?? 0;
    if (this.visible("footprint") && model.view?.footprint) layers.drawFootprint(pen, model.view.footprint);
    if (this.visible("path")) layers.drawPath(pen, model.path, model.view?.vehicle);
    if (this.visible("targets")) layers.drawTargets(pen, model.targets);
    this.drawObjects(pen, now);
    if (this.own) marks.drawOwnPlace(pen, this.own);
    if (model.view) marks.drawVehicle(pen, model.view);
    layers.drawScaleBar(pen);
  }

  drawObjects(pen, now) {
    const isApart = (object) => object.id === this.selected || this.model.isNew(object.id);
    const shown = this.shownObjects();
    if (!this.cells?.isOf(shown, this.viewport.scale)) this.cells = new Cells(shown, this.viewport.scale);
    const { single, crowds } = crowdsOf(this.cells, this.viewport, isApart);
    const factor = layers.exaggeration(single.filter((object) => object.confirmed), this.viewport.scale);
    if (factor !== this.factor) {
      this.factor = factor;
      this.dispatchEvent(new Event("exaggeration"));
    }
    this.crowds = crowds;
    if (this.visible("flights") && crowds.length === 0) drawFlights(pen, this.model.flights);
    drawCrowds(pen, crowds);
    if (this.visible("ellipses")) for (const object of single.filter((one) => one.verdict !== "dismissed")) layers.drawEllipse(pen, object, factor);
    if (this.visible("fixes")) layers.drawFixes(pen, this.model.fixes, now);
    for (const object of single) {
      if (this.model.isNew(object.id)) marks.drawNew(pen, object);
      layers.drawObject(pen, object, object.id === this.selected);
    }
    layers.drawLabels(pen, single.filter((object) => object.confirmed || object.id === this.selected));
  }

  /** The same list until the objects, the filter or the layers change. */
  shownObjects() {
    const ofModel = this.model.shown();
    const layers = ["objects", "tentative"].map((key) => this.visible(key)).join();
    if (this.shown?.ofModel !== ofModel || this.shown.layers !== layers) {
      const list = ofModel.filter((object) => this.visible(object.confirmed ? "objects" : "tentative"));
      this.shown = { ofModel, layers, list };
    }
    return this.shown.list;
  }

  /** A small picture of a layer's mark, for the legend. */
  symbol(key) {
    const canvas = document.createElement("canvas");
    const ratio = devicePixelRatio || 1;
    const viewport = new Viewport();
    Object.assign(viewport, { width: 22, height: 16, scale: 1 });
    canvas.width = viewport.width * ratio;
    canvas.height = viewport.height * ratio;
    const context = canvas.getContext("2d");
    context.scale(ratio, ratio);
    layers.drawSymbol({ context, viewport, colours: this.colours, font: this.font, weight: 1 }, key);
    return canvas;
  }

  objectAt(pixel) {
    let best = null;
    let nearest = REACH_PX;
    for (const object of this.shownObjects()) {
      const [x, y] = this.viewport.toScreen(object.at);
      const distance = Math.hypot(x - pixel[0], y - pixel[1]);
      if (distance < nearest) [best, nearest] = [object.id, distance];
    }
    return best;
  }

  pan(dx, dy) {
    this.viewport.pan(dx, dy);
    this.setMode("free");
    this.redraw();
  }

  zoom(factor, pixel = [this.viewport.width / 2, this.viewport.height / 2]) {
    this.viewport.zoom(factor, pixel);
    if (this.mode === "fit") this.setMode("free");
    this.redraw();
  }

  degreesAt(pixel) {
    return this.model.anchor && toDegrees(this.model.anchor, this.viewport.toGround(pixel));
  }

  listen() {
    const { canvas } = this;
    canvas.addEventListener("pointerdown", (event) => this.press(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (event) => this.release(event));
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-0.0016 * Math.max(-300, Math.min(300, event.deltaY))), [event.offsetX, event.offsetY]);
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => this.key(event, true));
    document.addEventListener("keydown", (event) => this.key(event, false));
  }

  press(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
    if (this.pointers.size === 1) this.travelled = 0;
  }

  move(event) {
    const now = [event.offsetX, event.offsetY];
    this.pointed = now;
    this.dispatchEvent(new Event("point"));
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
    const other = [...this.pointers].find(([id]) => id !== event.pointerId)?.[1];
    this.pointers.set(event.pointerId, now);
    this.travelled += Math.hypot(dx, dy);
    if (this.travelled < 4) return;
    if (!other) {
      this.pan(dx, dy);
      return;
    }
    const spread = (point) => Math.max(20, Math.hypot(point[0] - other[0], point[1] - other[1]));
    this.pan(dx / 2, dy / 2);
    this.zoom(spread(now) / spread(before), [(now[0] + other[0]) / 2, (now[1] + other[1]) / 2]);
  }

  release(event) {
    const isClick = event.type === "pointerup" && this.pointers.size === 1 && this.travelled < 4;
    this.pointers.delete(event.pointerId);
    if (!isClick) return;
    const pixel = [event.offsetX, event.offsetY];
    const crowd = this.crowds.find(({ at, radius_px }) => Math.hypot(at[0] - pixel[0], at[1] - pixel[1]) <= Math.max(REACH_PX, radius_px));
    if (this.onTap) this.onTap(pixel);
    else if (crowd) this.zoom(CROWD_ZOOM, crowd.at);
    else this.select(this.objectAt(pixel));
  }

  /** The arrows scroll the page unless the map is in focus; all other keys work everywhere but in fields. */
  key(event, isInMap) {
    if (event.defaultPrevented || (!isInMap && event.target.closest?.("input, select, textarea, dialog"))) return;
    const actions = {
      ArrowLeft: () => this.pan(KEY_STEP_PX, 0),
      ArrowRight: () => this.pan(-KEY_STEP_PX, 0),
      ArrowUp: () => this.pan(0, KEY_STEP_PX),
      ArrowDown: () => this.pan(0, -KEY_STEP_PX),
      "+": () => this.zoom(1.5),
      "-": () => this.zoom(1 / 1.5),
      f: () => this.setMode("fit"),
      v: () => this.setMode("follow"),
      Escape: () => this.select(null),
    };
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action || (event.key.startsWith("Arrow") && !isInMap) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action();
  }
}
