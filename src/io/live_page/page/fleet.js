// SPDX-License-Identifier: Apache-2.0
// The flights of a fleet: each has its colour, in the list and on the map.
import { element, number } from "./panels.js";

const GOLDEN_ANGLE_DEG = 137.508; // neighbours in the list differ most
const ARM_PX = 3.5;

/** Of the flight at this place in the list. Shape, not hue, tells one that is left out. */
export function colourOf(place) {
  const isDark = getComputedStyle(document.documentElement).colorScheme === "dark" ||
    (document.documentElement.dataset.theme === "system" && matchMedia("(prefers-color-scheme: dark)").matches);
  return `hsl(${(210 + place * GOLDEN_ANGLE_DEG) % 360} 75% ${isDark ? 65 : 38}%)`;
}

function isLeftOut(flight) {
  return flight.verdict === "quarantined" || flight.verdict === "too far";
}

/** Where each flight has its objects: an upright cross, and an oblique one of a flight whose objects are left out. */
export function drawFlights(pen, flights) {
  const { context, viewport } = pen;
  context.lineWidth = 1.6 * pen.weight;
  flights.forEach((flight, place) => {
    context.strokeStyle = colourOf(place);
    context.beginPath();
    for (const at of flight.at) {
      const [x, y] = viewport.toScreen(at);
      const arms = isLeftOut(flight) ? [[1, 1], [1, -1]] : [[1, 0], [0, 1]];
      for (const [right, down] of arms) {
        context.moveTo(x - ARM_PX * right, y - ARM_PX * down);
        context.lineTo(x + ARM_PX * right, y + ARM_PX * down);
      }
    }
    context.stroke();
  });
}

function withSigma(value, sigma) {
  return `${value > 0 ? "+" : ""}${number(value, 2)} ± ${number(sigma, 2)}`;
}

function line(flight, place) {
  const mark = element("span", { className: "swatch", textContent: isLeftOut(flight) ? "✕" : "✚", ariaHidden: "true" });
  mark.style.color = colourOf(place);
  const name = element("td", {}, element("strong", {}, mark, ` ${flight.flight}`),
    element("div", { className: `verdict ${flight.verdict.replace(" ", "-")}`, textContent: flight.verdict }));
  if (flight.reason) name.append(element("div", { className: "reason", textContent: flight.reason }));
  return element("tr", {}, name, ...[withSigma(flight.error_m[0], flight.sigma_m[0]),
    withSigma(flight.error_m[1], flight.sigma_m[1]), `${flight.shared} of ${flight.objects}`]
    .map((textContent) => element("td", { textContent })));
}

/** The flights, what became of them, and what each is off by. */
export function showFlights(card, table, flights) {
  card.hidden = flights.length === 0;
  table.tBodies[0].replaceChildren(...flights.map(line));
}
