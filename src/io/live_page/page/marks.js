// SPDX-License-Identifier: Apache-2.0
// Marks of the map that belong to no layer: who is where, and what is new. `pen` as in layers.js.

/** A wide ring around an object that was confirmed a moment ago. */
export function drawNew(pen, object) {
  const { context, viewport, colours } = pen;
  context.beginPath();
  context.arc(...viewport.toScreen(object.at), 17, 0, 2 * Math.PI);
  context.lineWidth = 4 * pen.weight;
  context.strokeStyle = colours.object;
  context.globalAlpha = 0.6;
  context.stroke();
  context.globalAlpha = 1;
}

/** Where the reader stands: a ring with a cross, unlike any object. */
export function drawOwnPlace(pen, place) {
  const { context, viewport, colours } = pen;
  const [x, y] = viewport.toScreen(place);
  const strokes = () => {
    context.beginPath();
    context.arc(x, y, 9, 0, 2 * Math.PI);
    context.moveTo(x - 14, y);
    context.lineTo(x + 14, y);
    context.moveTo(x, y - 14);
    context.lineTo(x, y + 14);
    context.stroke();
  };
  for (const [colour, width] of [[colours.map, 5], [colours.ink, 2.5]]) {
    context.strokeStyle = colour;
    context.lineWidth = width * pen.weight;
    strokes();
  }
}

export function drawVehicle(pen, view) {
  const { context, viewport, colours } = pen;
  const [x, y] = viewport.toScreen(view.vehicle);
  context.save();
  context.translate(x, y);
  context.rotate(view.yaw_deg * Math.PI / 180);
  context.beginPath();
  for (const point of [[0, -12], [8, 9], [0, 4.5], [-8, 9]]) context.lineTo(...point);
  context.closePath();
  context.fillStyle = colours.vehicle;
  context.strokeStyle = colours.map;
  context.lineWidth = 2 * pen.weight;
  context.stroke();
  context.fill();
  context.restore();
}
