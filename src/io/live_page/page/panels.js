// SPDX-License-Identifier: Apache-2.0
// The lists beside the map. Names come from models and streams and may contain anything, so they are only ever set as
// text.

const MOST_ROWS = 300;

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

function figures(list, entries) {
  list.replaceChildren(...entries.map(([name, value]) =>
    element("div", {}, element("dt", { textContent: name }), element("dd", { textContent: value }))));
}

export function showLights(list, model) {
  const { status, connection, ended, run } = model;
  const lights = [];
  if (run.is_live) {
    lights.push(["link", status?.link_is_good ? "" : "bad", status ? shortLink(status) : "Link"]);
    lights.push(["video", status?.video_is_good ? "" : "bad",
      status?.video_is_good ? `Video ${number(status.video_hz, 0)}/s` : `Video ${status?.video_state ?? ""}`]);
  }
  const page = { live: run.is_live ? "Live" : "Replay", lost: "No answer", connecting: "Connecting" }[connection];
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

export function showRates(card, list, { status, view }) {
  card.hidden = !status && !view;
  const height = [["Height above home", `${number(view?.height_m, 1)} m`], ["Heading", `${number((view?.yaw_deg + 360) % 360, 0)}°`]];
  figures(list, !status ? height : [
    ...height,
    ["Attitude", `${number(status.attitude_hz, 0)} Hz`],
    ["Position", `${number(status.position_hz, 0)} Hz`],
    ["Video", `${number(status.video_hz, 0)} /s`],
    ["Frame times", status.frame_time],
    ["Detection", `${number(status.detect_ms, 0)} ms`],
    ["Capture to result", `${number(status.latency_ms, 0)} ms`],
  ]);
}

export function showCalibration(card, table, rows) {
  card.hidden = !rows;
  if (!rows) return;
  table.replaceChildren(element("tbody", {}, ...rows.map((row) => element("tr", {},
    element("td", { textContent: row.name }),
    element("td", { textContent: number(row.value, row.digits) }),
    element("td", { className: "sigma", textContent: `± ${number(row.sigma, row.digits)}` }),
    element("td", { className: "unit", textContent: row.unit })))));
}

export function showCounters(list, counters) {
  figures(list, Object.entries(counters ?? {}).map(([name, value]) => [name, value.toLocaleString("en")]));
}

function objectRow(object, isSelected, onSelect) {
  const row = element("tr", { className: object.confirmed ? "" : "tentative", tabIndex: 0 },
    element("td", { textContent: object.id }),
    element("td", { className: "name", textContent: object.name, title: object.name }),
    element("td", { textContent: sigmaText(object.major_m) }),
    element("td", { textContent: object.hits }),
    element("td", { textContent: clock(object.last_seen) }));
  row.dataset.id = object.id;
  row.setAttribute("aria-selected", isSelected);
  row.addEventListener("click", () => onSelect(object.id));
  row.addEventListener("keydown", (event) => {
    if (event.key === "Enter") onSelect(object.id);
  });
  return row;
}

export function showObjects(holder, count, objects, selected, onSelect) {
  const all = [...objects.values()].sort((a, b) => b.confirmed - a.confirmed || a.id - b.id);
  const confirmed = all.filter((object) => object.confirmed).length;
  count.textContent = `${confirmed} confirmed, ${all.length - confirmed} tentative`;
  if (all.length === 0) {
    holder.replaceChildren(element("p", { className: "empty", textContent: "None yet." }));
    return;
  }
  const head = element("tr", {}, ...["id", "class", "σ", "hits", "last seen UTC"].map((name) =>
    element("th", { textContent: name, scope: "col" })));
  head.children[1].style.textAlign = "left";
  const focused = document.activeElement?.dataset?.id;
  const body = element("tbody", {}, ...all.slice(0, MOST_ROWS).map((object) =>
    objectRow(object, object.id === selected, onSelect)));
  const scrolled = holder.scrollTop;
  holder.replaceChildren(element("table", {}, element("thead", {}, head), body));
  holder.scrollTop = scrolled;
  if (focused) holder.querySelector(`tr[data-id="${Number(focused)}"]`)?.focus({ preventScroll: true });
}
