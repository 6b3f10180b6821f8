// SPDX-License-Identifier: Apache-2.0
// The list of objects: newest first, each with all that is needed to go there. Rows are kept and changed in place, so
// that neither a finger nor a picture loses them.
import { clock, element, sigmaText, wayText } from "./panels.js";
import { wayTo } from "./projection.js";

const MOST_ROWS = 300;
const LAST_ROW_PX = 8; // hidden below the edge

export class ObjectList {
  /** `filters`: the selects of class and sigma. */
  constructor({ list, count, more, filters }, model, onSelect) {
    Object.assign(this, { list, count, more, filters, model, onSelect });
    this.rows = new Map();
    this.empty = element("li", { className: "empty", textContent: "None yet." });
    for (const filter of Object.values(filters)) {
      filter.addEventListener("change", () => {
        model.setFilter({ class: filters.class.value, sigma_m: Number(filters.sigma.value) || Infinity });
      });
    }
    list.addEventListener("scroll", () => this.showMore());
    more.addEventListener("click", () => list.scrollBy({ top: list.clientHeight, behavior: "smooth" }));
  }

  /** `operator`: where the reader stands [m], or null. */
  show(selected, operator) {
    const { model } = this;
    this.showClasses();
    const isDismissed = (object) => object.verdict === "dismissed";
    // Those that were confirmed while this page looked come first: the difference is NaN where neither was.
    const confirmedAt = (object) => model.confirmedAt.get(object.id) ?? -Infinity;
    const all = model.shown();
    const first = firstOf(all, MOST_ROWS, (a, b) => isDismissed(a) - isDismissed(b) || b.confirmed - a.confirmed ||
      confirmedAt(b) - confirmedAt(a) || b.first_seen - a.first_seen || b.id - a.id);
    const total = model.objects.size + model.notShown;
    const confirmed = all.filter((object) => object.confirmed).length;
    this.count.textContent = `${confirmed} confirmed, ${all.length - confirmed} tentative` +
      (all.length < total ? ` of ${total}` : "");
    const wanted = first.map((object) => this.row(object, object.id === selected, operator));
    if (wanted.length === 0) {
      this.empty.textContent = total > 0 ? "None of these." : "None yet.";
      wanted.push(this.empty);
    }
    this.place(wanted);
    this.showMore();
  }

  /** Puts the rows in order, moving none that is in its place. */
  place(wanted) {
    const { list } = this;
    const keep = new Set(wanted);
    for (const child of [...list.children]) if (!keep.has(child)) child.remove();
    wanted.forEach((row, i) => {
      if (list.children[i] !== row) list.insertBefore(row, list.children[i] ?? null);
    });
    for (const [id, row] of this.rows) if (!keep.has(row)) this.rows.delete(id);
  }

  row(object, isSelected, operator) {
    const row = this.rows.get(object.id) ?? this.make(object.id);
    const { view } = this.model;
    const ways = [view && `${wayText(wayTo(view.vehicle, object.at))} from vehicle`,
      operator && `${wayText(wayTo(operator, object.at))} from you`];
    const texts = {
      title: `${object.id} · ${nameOf(object)}`,
      sigma: `σ ${sigmaText(object.major_m)}`,
      coordinates: placeText(object),
      way: ways.filter(Boolean).join("\n"),
      seen: `${object.hits} hits · ${clock(object.last_seen)} UTC`,
    };
    for (const [name, text] of Object.entries(texts)) {
      const part = row.querySelector(`.${name}`);
      if (part.textContent !== text) part.textContent = text;
    }
    row.className = [object.confirmed ? "" : "tentative", object.verdict ?? "", this.model.isNew(object.id) ? "new" : ""]
      .filter(Boolean).join(" ");
    row.firstChild.setAttribute("aria-pressed", isSelected);
    showPicture(row.querySelector("img"), object);
    return row;
  }

  make(id) {
    const part = (className) => element("span", { className });
    const button = element("button", { type: "button" }, element("img", { alt: "", hidden: true }),
      part("mark"), part("title"), part("sigma"),
      part("coordinates"), part("way"), part("seen"));
    button.addEventListener("click", () => this.onSelect(id));
    const row = element("li", {}, button);
    row.dataset.id = id;
    this.rows.set(id, row);
    return row;
  }

  /** Offers the classes that there are. */
  showClasses() {
    const select = this.filters.class;
    const names = this.model.classes();
    if (names.join("\n") === this.classes) return;
    this.classes = names.join("\n");
    const chosen = select.value;
    const options = names.map((name) => element("option", { value: name, textContent: name }));
    select.replaceChildren(select.options[0], ...options);
    select.value = names.includes(chosen) ? chosen : "";
    if (select.value !== chosen) select.dispatchEvent(new Event("change"));
  }

  /** Says how many rows are below the list's edge, which a hidden scroll bar would not. */
  showMore() {
    const edge = this.list.getBoundingClientRect().bottom - LAST_ROW_PX;
    const below = [...this.list.children].filter((row) => row.getBoundingClientRect().bottom > edge + 2 * LAST_ROW_PX).length;
    this.more.hidden = below === 0;
    if (below > 0) this.more.textContent = `↓ ${below} more`;
  }
}

/** The first of them in that order, without all others being brought in order. */
function firstOf(items, count, compare) {
  let first = [];
  let last = null;
  for (const item of items) {
    if (last !== null && compare(item, last) >= 0) continue;
    first.push(item);
    if (first.length < 2 * count) continue;
    first = first.sort(compare).slice(0, count);
    last = first.at(-1);
  }
  return first.sort(compare).slice(0, count);
}

/** Loads an object's best picture, if there is one that is not shown yet. */
export function showPicture(image, object) {
  image.hidden = !object.picture;
  const address = `objects/${object.id}/picture?${object.picture}`;
  if (object.picture && image.getAttribute("src") !== address) image.src = address;
}

/** What an operator calls it, or its class. */
export function nameOf(object) {
  return object.operator_name ?? object.name;
}

/** Degrees to a centimetre. */
export function placeText({ latitude_deg, longitude_deg }) {
  if (!Number.isFinite(latitude_deg)) return "–";
  return `${latitude_deg.toFixed(7)}, ${longitude_deg.toFixed(7)}`;
}
