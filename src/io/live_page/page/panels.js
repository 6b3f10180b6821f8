// SPDX-License-Identifier: Apache-2.0
// The figures beside the map. Names come from models and streams and may contain anything, so they are only ever set as
// text.
import { explain } from "./meanings.js";

export function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

/** "7.1", "−0.021", "–" for unknown. */
export function number(value, digits) {
  return Number.isFinite(value) ? value.toFixed(digits).replace("-", "−") : "–";
}

export function sigmaText(sigma_m) {
  if (!Number.isFinite(sigma_m)) return "–";
  return sigma_m < 1 ? `${number(100 * sigma_m, sigma_m < 0.1 ? 1 : 0)} cm` : `${number(sigma_m, 2)} m`;
}

export function clock(ms) {
  return Number.isFinite(ms) ? new Date(ms).toISOString().slice(11, 19) : "–";
}

/** "NE 45°, 120 m". */
export function wayText({ azimuth_deg, distance_m }) {
  const point = ["N", "NE", "E", "SE", "S", "SW", "W", "NW"][Math.round(azimuth_deg / 45) % 8];
  const distance = distance_m < 10 ? `${number(distance_m, 1)} m`
    : distance_m < 10000 ? `${number(distance_m, 0)} m` : `${number(distance_m / 1000, 1)} km`;
  return `${point} ${number(Math.round(azimuth_deg) % 360, 0)}°, ${distance}`;
}

/** Sets the texts of a list of named figures. What is there stays, so that a finger on it does not lose it. */
export function figures(list, entries) {
  const names = entries.map(([name]) => name);
  const shown = [...list.querySelectorAll("dt")].map((dt) => dt.textContent);
  if (names.join() !== shown.join()) {
    list.replaceChildren(...names.map((name) =>
      explain(element("div", {}, element("dt", { textContent: name }), element("dd")), name)));
  }
  list.querySelectorAll("dd").forEach((dd, i) => {
    if (dd.textContent !== entries[i][1]) dd.textContent = entries[i][1];
  });
}

export function showLights(list, model) {
  const { status, connection, ended, run } = model;
  const lights = [];
  if (run.is_fleet) {
    if (run.is_live) lights.push(["broker", status?.link_is_good ? "" : "bad", status?.link_is_good ? "Broker" : "No broker"]);
  } else if (run.is_live) {
    lights.push(["link", status?.link_is_good ? "" : "bad", status ? shortLink(status) : "Link"]);
    lights.push(["video", status?.video_is_good ? "" : "bad",
      status?.video_is_good ? `Video ${number(status.video_hz, 0)}/s` : `Video ${status?.video_state ?? ""}`]);
  }
  const page = { live: run.is_live ? "Live" : run.is_fleet ? "Fleet" : "Replay", lost: "No answer", connecting: "Connecting" }[connection];
  lights.push(["page", connection === "lost" ? "bad" : ended ? "off" : "", ended ? "Run ended" : page]);
  list.replaceChildren(...lights.map(([id, state, text]) =>
    element("li", { id: `light-${id}`, className: state, textContent: text })));
}

function shortLink(status) {
  if (!status.link_is_good) return "No telemetry";
  return `Telemetry ${number(status.attitude_hz, 0)} Hz`;
}

/** What keeps the run from locating objects, as the program states it; empty if nothing does. */
export function trouble(model) {
  if (model.connection === "lost") return "geoloc does not answer. This is the last that was known.";
  const { status, ended } = model;
  if (!status || ended) return "";
  return [status.warning, status.link_is_good ? "" : status.link, status.video_is_good ? "" : status.video]
    .filter(Boolean).join(" · ");
}

export function showRates(card, list, { status, view, run }) {
  card.hidden = (!status && !view) || run.is_fleet === true;
  const own = [["Vehicle's height", `${number(view?.height_m, 1)} m`],
    ["Heading", `${number(Math.round(view?.yaw_deg + 360) % 360, 0)}°`]];
  figures(list, !status ? own : [
    ...own,
    ["Attitude", `${number(status.attitude_hz, 0)} Hz`],
    ["Position", `${number(status.position_hz, 0)} Hz`],
    ["Video", `${number(status.video_hz, 0)} /s`],
    ["Frame times", status.frame_time],
    ["Detection", `${number(status.detect_ms, 0)} ms`],
    ["Capture to result", `${number(status.latency_ms, 0)} ms`],
    ...(status.fleet ? [["Fleet", status.fleet.replace("fleet: ", "")]] : []),
  ]);
}

export function showCalibration(card, table, rows) {
  card.hidden = !rows;
  if (!rows) return;
  const body = table.tBodies[0];
  while (body.rows.length < rows.length) {
    body.append(element("tr", {}, ...["", "value", "sigma", "unit"].map((className) => element("td", { className }))));
  }
  rows.forEach((row, i) => {
    explain(body.rows[i], row.name);
    const sign = row.value > 0 ? "+" : "";
    const texts = [row.name, `${sign}${number(row.value, row.digits)}`, `± ${number(row.sigma, row.digits)}`, row.unit];
    texts.forEach((text, column) => { body.rows[i].cells[column].textContent = text; });
  });
}

export function showCounters(list, counters) {
  figures(list, Object.entries(counters ?? {}).map(([name, value]) => [name, value.toLocaleString("en")]));
}
