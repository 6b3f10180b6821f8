// SPDX-License-Identifier: Apache-2.0
// The selected object: its position in four notations, and the history of its estimate.
import { Notes } from "./notes.js";
import { nameOf, showPicture } from "./object_list.js";
import { clock, element, figures, number, sigmaText } from "./panels.js";

const SVG = "http://www.w3.org/2000/svg";
const NOTATIONS = [["degrees", "Degrees"], ["dms", "DMS"], ["utm", "UTM"], ["mgrs", "MGRS"]];
const CHART = { height: 96, left: 62, bottom: 20, top: 10 };

function svg(tag, attributes, text) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

/** The clipboard API works on secure pages only, and a page reached over a network by http is not secure. */
async function copy(text, button) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = element("textarea", { value: text });
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
  }
  button.textContent = "Copied";
  setTimeout(() => { button.textContent = "Copy"; }, 1200);
}

function placeList() {
  return element("dl", { className: "place" }, ...NOTATIONS.flatMap(([, name]) => {
    const place = element("dd");
    const button = element("button", { type: "button", textContent: "Copy", ariaLabel: `Copy ${name}` });
    button.addEventListener("click", () => copy(place.textContent, button));
    return [element("dt", { textContent: name }), place, button];
  }));
}

/** Sigma over time, logarithmic: it falls by powers of ten. */
function sigmaChart(history, width) {
  const points = history.filter(([, , sigma]) => sigma > 0);
  const { height, left, bottom, top } = CHART;
  const chart = svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": "Sigma over time" });
  if (points.length < 2) return chart;
  const [begin, end] = [points[0][0], points.at(-1)[0]];
  const sigmas = points.map(([, , sigma]) => Math.log10(sigma));
  const [low, high] = [Math.min(...sigmas) - 0.05, Math.max(...sigmas) + 0.05];
  const x = (at) => left + (width - left - 4) * (at - begin) / Math.max(1, end - begin);
  const y = (sigma) => top + (height - top - bottom) * (high - Math.log10(sigma)) / (high - low);
  for (const sigma of [10 ** high, 10 ** low]) {
    chart.append(svg("line", { class: "axis", x1: left, x2: width, y1: y(sigma), y2: y(sigma) }),
      svg("text", { x: left - 6, y: y(sigma) + 4, "text-anchor": "end" }, sigmaText(sigma)));
  }
  chart.append(
    svg("path", { class: "line", d: points.map(([at, , sigma], i) => `${i ? "L" : "M"}${x(at).toFixed(1)} ${y(sigma).toFixed(1)}`).join("") }),
    svg("text", { x: left, y: height - 1 }, clock(begin)),
    svg("text", { x: (left + width) / 2, y: height - 1, "text-anchor": "middle" }, "σ over time"),
    svg("text", { x: width, y: height - 1, "text-anchor": "end" }, clock(end)));
  return chart;
}

/** `ways`: named directions to the object, as texts. */
function facts(object, ways) {
  return [
    ...ways,
    ["σ major, minor", `${sigmaText(object.major_m)}, ${sigmaText(object.minor_m)}`],
    ["Major axis", `${number(object.azimuth_deg, 0)}° from north`],
    ["Object's height", `${number(object.height_m, 2)} m${object.sigma_height_m === undefined ? "" : ` ± ${sigmaText(object.sigma_height_m)}`}`],
    ...(object.height_msl_m === undefined ? [] : [["Above sea level", `${number(object.height_msl_m, 1)} m`]]),
    ...(object.height_ellipsoid_m === undefined ? [] : [["Above the ellipsoid", `${number(object.height_ellipsoid_m, 1)} m`]]),
    ["Class", object.name],
    ["Confidence", `${number(100 * object.confidence, 1)} %`],
    ...(object.speed_mps === undefined ? [] : [
      ["Speed, course", `${number(object.speed_mps, 1)} m/s, ${number(object.course_deg, 0)}°`],
    ]),
    ["Hits", String(object.hits)],
    ["First seen", `${clock(object.first_seen)} UTC`],
    ["Last seen", `${clock(object.last_seen)} UTC`],
  ];
}

export class Details {
  constructor(section, onClose) {
    this.section = section;
    this.shown = "";
    const close = element("button", { type: "button", className: "close", textContent: "×", ariaLabel: "Close" });
    close.addEventListener("click", onClose);
    this.title = element("h2");
    this.place = placeList();
    this.notes = new Notes();
    this.picture = element("img", { className: "picture", alt: "The object, cut from the video", hidden: true });
    this.figures = element("dl", { className: "figures" });
    this.chart = element("div");
    section.replaceChildren(element("header", {}, this.title, close), this.picture, this.notes.section, this.place, this.figures, this.chart);
  }

  hide() {
    this.section.hidden = true;
    this.shown = "";
  }

  /** `object` is the list's entry. Asks the server for the rest if it has changed. */
  async show(object, ways) {
    this.notes.show(object);
    showPicture(this.picture, object);
    const version = `${object.id} ${object.hits} ${object.at} ${object.major_m} ${nameOf(object)}`;
    if (this.current?.id === object.id) figures(this.figures, facts(this.current, ways));
    if (version === this.shown) return;
    this.shown = version;
    const answer = await fetch(`objects/${object.id}`, { cache: "no-store" }).catch(() => null);
    if (!answer?.ok || this.shown !== version) return;
    const { object: current, coordinates, history } = await answer.json();
    this.current = current;
    this.title.textContent = `${current.id} · ${nameOf(current)}${current.confirmed ? "" : " (tentative)"}`;
    [...this.place.querySelectorAll("dd")].forEach((place, i) => {
      place.textContent = coordinates[NOTATIONS[i][0]];
    });
    const isOther = this.section.hidden || this.seen !== current.id;
    this.seen = current.id;
    this.section.hidden = false;
    figures(this.figures, facts(current, ways));
    this.chart.replaceChildren(sigmaChart(history, Math.max(240, this.chart.clientWidth)));
    if (isOther) this.section.scrollIntoView({ block: "nearest" }); // it may be far above the list
  }
}
