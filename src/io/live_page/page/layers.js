// SPDX-License-Identifier: Apache-2.0
// What the map draws, layer by layer. `pen` holds the canvas's context, the viewport and the colours.
import { drawFlights } from "./fleet.js";
import { roundStep } from "./projection.js";

const FADE_MS = 45000; // a raw fix fades over this time
const LABEL_HALF_PX = 26;
const LABEL_TOP_PX = 20;
const FAINTEST = 0.12;
const SIGMAS = 2;
const LEAST_ELLIPSE_PX = 7;
const EXAGGERATIONS = [1, 2, 5, 10, 20, 50, 100, 200];

export const LAYERS = [
  { key: "objects", name: "confirmed object", on: true },
  { key: "ellipses", name: "2σ ellipse", on: true },
  { key: "tentative", name: "tentative, 2σ to scale", on: true },
  { key: "fixes", name: "raw fix, fading", on: true },
  { key: "path", name: "trajectory", on: true },
  { key: "footprint", name: "camera's footprint", on: true },
  { key: "targets", name: "true target", on: true },
  { key: "flights", name: "where a flight has it, by its colour", on: true },
];

export function drawGrid(pen) {
  const { context, viewport, colours } = pen;
  const step = roundStep(90 / viewport.scale);
  const [west, north] = viewport.toGround([0, 0]);
  const [east, south] = viewport.toGround([viewport.width, viewport.height]);
  context.lineWidth = pen.weight;
  context.font = `14px ${pen.font}`;
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const line = (value, from, to, label) => {
    context.strokeStyle = Math.abs(value) < step / 2 ? colours["grid-strong"] : colours.grid;
    strokeLine(context, from, to);
    context.fillStyle = colours.soft;
    context.fillText(...label);
  };
  const crisp = (pixel) => Math.round(pixel) + 0.5;
  context.textAlign = "center";
  context.textBaseline = "bottom";
  for (let value = Math.ceil(west / step) * step; value <= east; value += step) {
    const x = crisp(viewport.toScreen([value, 0])[0]);
    if (x < LABEL_HALF_PX) continue; // its label would be cut off
    line(value, [x, 0], [x, viewport.height], [text(value, digits, "E"), x, viewport.height - 3]);
  }
  context.textAlign = "left";
  context.textBaseline = "middle";
  for (let value = Math.ceil(south / step) * step; value <= north; value += step) {
    const y = crisp(viewport.toScreen([0, value])[1]);
    if (y > viewport.height - 50 || y < LABEL_TOP_PX) continue; // the scale bar is there
    line(value, [0, y], [viewport.width, y], [text(value, digits, "N"), 5, y - 9]);
  }
}

function text(value, digits, axis) {
  const number = Math.abs(value) < 1e-9 ? "0" : value.toFixed(digits).replace("-", "−");
  return `${number} ${axis}`;
}

function strokeLine(context, from, to) {
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.stroke();
}

function outline(context, points) {
  context.beginPath();
  points.forEach((point, i) => (i === 0 ? context.moveTo(...point) : context.lineTo(...point)));
}

export function drawPath(pen, path, vehicle) {
  if (path.length === 0) return;
  const { context, viewport, colours } = pen;
  outline(context, (vehicle ? [...path, vehicle] : path).map((point) => viewport.toScreen(point)));
  context.lineJoin = "round";
  context.lineWidth = 1.6 * pen.weight;
  context.strokeStyle = colours.trajectory;
  context.stroke();
}

export function drawFootprint(pen, corners) {
  const { context, viewport, colours } = pen;
  outline(context, corners.map((corner) => viewport.toScreen(corner)));
  context.closePath();
  context.globalAlpha = 0.09;
  context.fillStyle = colours.footprint;
  context.fill();
  context.globalAlpha = 0.9;
  context.lineWidth = 1.3 * pen.weight;
  context.strokeStyle = colours.footprint;
  context.stroke();
  context.globalAlpha = 1;
  // The image's top edge is drawn heavier, to show its orientation on the ground.
  context.lineWidth = 3 * pen.weight;
  strokeLine(context, viewport.toScreen(corners[0]), viewport.toScreen(corners[1]));
}

export function drawFixes(pen, fixes, now) {
  const { context, viewport, colours } = pen;
  context.fillStyle = colours.raw;
  for (const [east, north, at] of fixes) {
    const [x, y] = viewport.toScreen([east, north]);
    if (x < -4 || y < -4 || x > viewport.width + 4 || y > viewport.height + 4) continue;
    const age = Math.min(1, Math.max(0, (now - at) / FADE_MS));
    context.globalAlpha = Math.min(1, pen.weight * (0.75 + age * (FAINTEST - 0.75)));
    context.beginPath();
    context.arc(x, y, 2 * pen.weight, 0, 2 * Math.PI);
    context.fill();
  }
  context.globalAlpha = 1;
}

export function drawTargets(pen, targets) {
  const { context, viewport, colours } = pen;
  context.strokeStyle = colours.target;
  context.lineWidth = 1.4 * pen.weight;
  for (const target of targets) {
    const [x, y] = viewport.toScreen(target);
    context.strokeRect(x - 7, y - 7, 14, 14);
  }
}

/** Factor by which confirmed objects' ellipses must be enlarged to be visible: one for all, so that they can be compared. */
export function exaggeration(objects, scale) {
  const axes = objects.map((object) => object.major_m).filter((axis) => axis > 0).sort((a, b) => a - b);
  if (axes.length === 0) return 1;
  const pixels = SIGMAS * axes[axes.length >> 1] * scale;
  return EXAGGERATIONS.find((factor) => factor * pixels >= LEAST_ELLIPSE_PX) ?? EXAGGERATIONS.at(-1);
}

export function drawEllipse(pen, object, factor) {
  const { context, viewport, colours } = pen;
  if (object.major_m === null || object.minor_m === null) return;
  const [x, y] = viewport.toScreen(object.at);
  const pixels = SIGMAS * (object.confirmed ? factor : 1) * viewport.scale;
  context.beginPath();
  context.ellipse(x, y, Math.max(0.5, object.major_m * pixels), Math.max(0.5, object.minor_m * pixels),
    (object.azimuth_deg - 90) * Math.PI / 180, 0, 2 * Math.PI);
  const colour = object.confirmed ? colours.object : colours.tentative;
  context.fillStyle = colour;
  context.globalAlpha = 0.13;
  context.fill();
  context.globalAlpha = 0.75;
  context.lineWidth = 1.1 * pen.weight;
  context.strokeStyle = colour;
  context.setLineDash(object.confirmed ? [] : [4, 3]);
  context.stroke();
  context.setLineDash([]);
  context.globalAlpha = 1;
}

export function drawObject(pen, object, isSelected) {
  const { context, viewport, colours } = pen;
  const [x, y] = viewport.toScreen(object.at);
  if (isSelected) {
    context.beginPath();
    context.arc(x, y, 11, 0, 2 * Math.PI);
    context.lineWidth = 2.5 * pen.weight;
    context.strokeStyle = colours.ink;
    context.stroke();
  }
  context.beginPath();
  context.lineWidth = 1.5 * pen.weight;
  if (object.verdict === "dismissed") {
    for (const turn of [-1, 1]) {
      context.moveTo(x - 5, y - 5 * turn);
      context.lineTo(x + 5, y + 5 * turn);
    }
    context.strokeStyle = colours.soft;
  } else if (object.confirmed) {
    context.arc(x, y, 3.8, 0, 2 * Math.PI);
    context.fillStyle = colours.object;
    context.strokeStyle = colours.map;
    context.fill();
  } else {
    outline(context, [[x, y - 5.5], [x + 5.5, y], [x, y + 5.5], [x - 5.5, y]]);
    context.closePath();
    context.strokeStyle = colours.tentative;
  }
  context.stroke();
}

/** Ids beside the objects, where there is room. */
export function drawLabels(pen, objects) {
  const { context, viewport, colours } = pen;
  context.font = `600 14px ${pen.font}`;
  context.textAlign = "left";
  context.textBaseline = "middle";
  context.lineWidth = 3 * pen.weight;
  const taken = [];
  for (const object of objects) {
    const [x, y] = viewport.toScreen(object.at);
    const label = String(object.id);
    const box = [x + 7, y - 18, x + 9 + 9 * label.length, y - 3];
    if (taken.some((other) => box[0] < other[2] && other[0] < box[2] && box[1] < other[3] && other[1] < box[3])) continue;
    taken.push(box);
    context.strokeStyle = colours.map;
    context.strokeText(label, box[0], y - 11);
    context.fillStyle = colours.ink;
    context.fillText(label, box[0], y - 11);
  }
}

export function drawScaleBar(pen) {
  const { context, viewport, colours } = pen;
  const metres = roundStep(70 / viewport.scale);
  const length = metres * viewport.scale;
  const [x, y] = [12, viewport.height - 30];
  outline(context, [[x, y - 5], [x, y], [x + length, y], [x + length, y - 5]]);
  context.lineJoin = "miter";
  context.lineWidth = 5 * pen.weight;
  context.strokeStyle = colours.map;
  context.stroke();
  context.lineWidth = 2 * pen.weight;
  context.strokeStyle = colours.ink;
  context.stroke();
  context.font = `600 14px ${pen.font}`;
  context.textAlign = "left";
  context.textBaseline = "bottom";
  context.lineWidth = 3 * pen.weight;
  context.strokeStyle = colours.map;
  const label = metres >= 1000 ? `${metres / 1000} km` : metres < 1 ? `${Math.round(metres * 100)} cm` : `${metres} m`;
  context.strokeText(label, x + 5, y - 3);
  context.fillStyle = colours.ink;
  context.fillText(label, x + 5, y - 3);
}

/** One of a layer's marks, in the middle of a viewport of 22 x 16 m at 1 px/m. */
export function drawSymbol(pen, key) {
  const object = { at: [0, 0], confirmed: key !== "tentative", major_m: 4.5, minor_m: 2.8, azimuth_deg: 70 };
  const draw = {
    objects: () => drawObject(pen, object, false),
    tentative: () => {
      drawEllipse(pen, { ...object, minor_m: 3.6 }, 1);
      drawObject(pen, object, false);
    },
    ellipses: () => drawEllipse(pen, object, 1),
    fixes: () => drawFixes(pen, [[-6, -1, 0], [0, 2, 20000], [6, -2, 45000]], 45000),
    path: () => drawPath(pen, [[-9, -3], [-2, 3], [3, -2], [9, 3]], null),
    footprint: () => drawFootprint(pen, [[-8, 6], [8, 6], [8, -6], [-8, -6]]),
    targets: () => drawTargets(pen, [[0, 0]]),
    flights: () => drawFlights(pen, [{ verdict: "fused", at: [[-4, 0]] }, { verdict: "quarantined", at: [[5, 0]] }]),
  };
  draw[key]();
}
