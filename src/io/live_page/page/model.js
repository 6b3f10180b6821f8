// SPDX-License-Identifier: Apache-2.0
// The run as this page knows it, kept up to date by the server's events.

const MOST_FIXES = 3000;
const SILENCE_MS = 4000; // the server sends something every second
const HIDDEN_MS = 10000; // a hidden page gives its place to others
const RETRY_MS = 3000;
const NEW_MS = 15000; // an object is marked as new for this long

export class Model extends EventTarget {
  constructor() {
    super();
    this.filter = { class: "", sigma_m: Infinity };
    this.reset();
    this.connection = "connecting";
    this.heardAt = performance.now();
  }

  reset() {
    this.run = { name: "", is_live: true };
    this.anchor = null;
    this.ended = false;
    this.status = null;
    this.view = null;
    this.estimator = null;
    this.targets = [];
    this.flights = [];
    this.picture = 0;
    this.playback = null;
    this.isCatchingUp = false; // what there was before this page comes a part at a time
    this.notShown = 0; // objects for which the server has no room
    this.objects = new Map();
    this.touch();
    this.confirmedAt = new Map(); // by id, in the page's time; objects that were there before it have none
    this.path = [];
    this.fixes = [];
  }

  /** Applies the changes that the server sends. Returns the objects that were confirmed by them. */
  apply(change) {
    if (change.run) {
      this.reset();
      this.run = change.run;
    }
    for (const key of ["anchor", "ended", "status", "view", "estimator", "targets", "flights", "picture", "playback"]) {
      if (key in change) this[key] = change[key];
    }
    if ("not_shown" in change) this.notShown = change.not_shown;
    for (const id of change.removed ?? []) this.objects.delete(id);
    const isOld = change.run || this.isCatchingUp || change.playback?.seeking;
    const confirmed = this.takeObjects(change.objects, isOld ? -Infinity : performance.now());
    this.isCatchingUp = Boolean(change.run || this.isCatchingUp) && change.more === true;
    if (change.ids) {
      const living = new Set(change.ids);
      for (const id of this.objects.keys()) if (!living.has(id)) this.objects.delete(id);
    }
    if (change.objects.length > 0 || change.removed || change.ids) this.touch();
    if (change.path_begins_anew) this.path = [];
    this.path.push(...change.path);
    this.fixes.push(...change.fixes);
    if (this.fixes.length > MOST_FIXES) this.fixes.splice(0, this.fixes.length - MOST_FIXES);
    return isOld || this.playback?.seeking ? [] : confirmed;
  }

  takeObjects(objects, now) {
    const confirmed = objects.filter((object) => object.confirmed && !this.confirmedAt.has(object.id));
    for (const object of confirmed) this.confirmedAt.set(object.id, now);
    for (const object of objects) this.objects.set(object.id, object);
    return confirmed;
  }

  isNew(id) {
    return performance.now() - (this.confirmedAt.get(id) ?? -Infinity) < NEW_MS;
  }

  /** Lists are formed anew when they are asked for after a change. */
  touch() {
    this.lists = {};
  }

  setFilter(filter) {
    this.filter = filter;
    this.touch();
    this.dispatchEvent(new Event("change"));
  }

  /** The objects that the filter lets through. Not to be changed. */
  shown() {
    const { filter } = this;
    this.lists.shown ??= [...this.objects.values()].filter((object) => (filter.class === "" || object.name === filter.class) &&
      (filter.sigma_m === Infinity || (object.major_m ?? Infinity) <= filter.sigma_m));
    return this.lists.shown;
  }

  /** Not to be changed. */
  confirmed() {
    this.lists.confirmed ??= [...this.objects.values()].filter((object) => object.confirmed);
    return this.lists.confirmed;
  }

  /** Names of the classes that there are, in order. */
  classes() {
    this.lists.classes ??= [...new Set([...this.objects.values()].map((object) => object.name))].sort();
    return this.lists.classes;
  }
}

/** Connects a model to the server while the page is visible. */
export function connect(model) {
  let source = null;
  let hiddenTimer = 0;

  const say = (connection) => {
    if (model.connection === connection) return;
    model.connection = connection;
    model.dispatchEvent(new Event("connection"));
  };
  const heard = () => {
    model.heardAt = performance.now();
    say("live");
  };
  const open = () => {
    if (source) return;
    model.heardAt = performance.now();
    source = new EventSource("events");
    source.onmessage = (event) => {
      const confirmed = model.apply(JSON.parse(event.data));
      heard();
      if (confirmed.length > 0) model.dispatchEvent(new CustomEvent("news", { detail: confirmed }));
      model.dispatchEvent(new Event("change"));
    };
    source.addEventListener("alive", heard);
    source.onerror = () => {
      say("lost");
      if (source.readyState !== EventSource.CLOSED) return;
      close();
      setTimeout(open, RETRY_MS);
    };
  };
  const close = () => {
    if (source) source.close();
    source = null;
  };

  document.addEventListener("visibilitychange", () => {
    clearTimeout(hiddenTimer);
    if (document.hidden) hiddenTimer = setTimeout(close, HIDDEN_MS);
    else open();
  });
  setInterval(() => {
    if (source && performance.now() - model.heardAt > SILENCE_MS) say("lost");
  }, 1000);
  open();
}
