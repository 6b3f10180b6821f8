// SPDX-License-Identifier: Apache-2.0
// Connects the parts of the page.
import { Details } from "./details.js";
import { showFlights } from "./fleet.js";
import { LAYERS } from "./layers.js";
import { GroundMap } from "./map.js";
import { showMeanings } from "./meanings.js";
import { Model, connect } from "./model.js";
import { News } from "./news.js";
import { ObjectList } from "./object_list.js";
import { OwnPlace } from "./own_place.js";
import * as panels from "./panels.js";
import { wayTo } from "./projection.js";
import { ReplayBar } from "./replay_bar.js";
import { Theme } from "./theme.js";
import { TileLayer } from "./tiles.js";
import { VideoView } from "./video.js";

const get = (id) => document.getElementById(id);
const LISTS_MS = 400; // lists are rebuilt at most this often, so that people can read them

const model = new Model();
const theme = new Theme(get("theme"));
const shown = Object.fromEntries(LAYERS.map((layer) => [layer.key, layer.on]));
let tiles = null;
const map = new GroundMap(get("map-canvas"), model, (key) => shown[key], (pen) => tiles?.draw(pen, model.anchor));
const video = new VideoView(get("video"), get("video-canvas"), get("video-caption"));
const details = new Details(get("selected"), () => map.select(null));
const news = new News(get("news"), get("sound"), (id) => map.select(id));
const replay = new ReplayBar(get("replay"));
let mayChange = false;
const own = new OwnPlace(get("own-place"), get("hint"), map, model);
const list = new ObjectList({
  list: get("objects"), count: get("object-count"), more: get("more"),
  filters: { class: get("class-filter"), sigma: get("sigma-filter") },
}, model, (id) => map.select(id));

/** A fleet has no camera; a run has no flights. */
function isInRun({ key }) {
  if (key === "targets" || key === "flights") return model[key].length > 0;
  return !model.run.is_fleet || ["objects", "ellipses"].includes(key);
}

function showLegend() {
  get("layers").replaceChildren(...LAYERS.filter(isInRun).map((layer) => {
    const box = panels.element("input", { type: "checkbox", checked: shown[layer.key] });
    box.addEventListener("change", () => {
      shown[layer.key] = box.checked;
      map.redraw();
    });
    return panels.element("li", {}, panels.element("label", {}, box, map.symbol(layer.key),
      panels.element("span", { textContent: layer.name })));
  }));
  get("enlarged").textContent = map.factor > 1 ? `2σ ellipse, drawn ×${map.factor}` : "";
}

/** Named directions to an object, for its details. */
function waysTo(object) {
  const ways = [];
  if (model.view) ways.push(["From vehicle", panels.wayText(wayTo(model.view.vehicle, object.at))]);
  if (own.at()) ways.push(["From you", panels.wayText(wayTo(own.at(), object.at))]);
  return ways;
}

function showLists() {
  map.own = own.at();
  list.show(map.selected, map.own);
  showFlights(get("flights-card"), get("flights"), model.flights);
  panels.showRates(get("rates-card"), get("rates"), model);
  panels.showCalibration(get("calibration-card"), get("calibration"), model.estimator?.calibration);
  if (!model.run.is_fleet) panels.showCounters(get("counters"), model.estimator?.counters);
  get("counters-card").hidden = model.run.is_fleet === true;
  const selected = model.objects.get(map.selected);
  if (selected) details.show(selected, waysTo(selected));
  else details.hide();
}

function showState() {
  panels.showLights(get("lights"), model);
  const time = model.status ? new Date(1000 * model.status.elapsed_s).toISOString().slice(11, 19)
    : model.view ? `${panels.clock(model.view.at)} UTC` : "";
  get("run").textContent = [model.run.name, time].filter(Boolean).join(" · ");
  replay.show(model.playback, mayChange);
  document.title = `${model.confirmed().length} objects · geoloc`;
  const trouble = panels.trouble(model);
  get("notice").hidden = trouble === "";
  if (get("notice").textContent !== trouble) get("notice").textContent = trouble;
}

function showReadout() {
  const degrees = map.pointed && map.degreesAt(map.pointed);
  if (!degrees) return;
  const [east, north] = map.viewport.toGround(map.pointed);
  get("readout").textContent = `${degrees[0].toFixed(6)}, ${degrees[1].toFixed(6)} · ` +
    `${panels.number(east, 1)} E ${panels.number(north, 1)} N m`;
}

let listsDue = 0;
let legend = "";
model.addEventListener("change", () => {
  map.redraw();
  showState();
  video.update(model.picture, model.run.is_live && !model.ended);
  const layers = LAYERS.filter(isInRun).map(({ key }) => key).join();
  if (layers !== legend) {
    legend = layers;
    showLegend();
  }
  if (!listsDue) {
    listsDue = setTimeout(() => {
      listsDue = 0;
      showLists();
    }, LISTS_MS);
  }
});
model.addEventListener("connection", showState);
model.addEventListener("news", ({ detail }) => news.tell(detail));
own.addEventListener("change", () => {
  showLists();
  map.redraw();
});
map.addEventListener("select", showLists);
map.addEventListener("exaggeration", showLegend);
map.addEventListener("point", showReadout);
map.addEventListener("mode", () => {
  for (const mode of ["fit", "follow"]) get(mode).setAttribute("aria-pressed", map.mode === mode);
});
get("zoom-in").addEventListener("click", () => map.zoom(1.5));
get("zoom-out").addEventListener("click", () => map.zoom(1 / 1.5));
for (const mode of ["fit", "follow"]) {
  get(mode).addEventListener("click", () => map.setMode(map.mode === mode ? "free" : mode));
}
theme.addEventListener("change", () => {
  map.readColours();
  showLegend();
});
get("legend").open = innerWidth >= 900;
showMeanings(get("meaning"));

fetch("settings").then((answer) => answer.json()).then((settings) => {
  mayChange = settings.may_change;
  details.notes.mayChange = mayChange;
  if (!settings.tile_url) return;
  tiles = new TileLayer(settings.tile_url, () => map.redraw());
  get("attribution").textContent = settings.tile_attribution;
  map.redraw();
}).catch(() => {});
showLegend();
showState();
connect(model);
