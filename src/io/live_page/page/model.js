// SPDX-License-Identifier: Apache-2.0
// The run as this page knows it, kept up to date by the server's events.

const MOST_FIXES = 3000;
const SILENCE_MS = 4000; // the server sends something every second
const HIDDEN_MS = 10000; // a hidden page gives its place to others
const RETRY_MS = 3000;

export class Model extends EventTarget {
  constructor() {
    super();
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
    this.picture = 0;
    this.objects = new Map();
    this.path = [];
    this.fixes = [];
  }

  /** Applies the changes that the server sends. */
  apply(change) {
    if (change.run) {
      this.reset();
      this.run = change.run;
    }
    for (const key of ["anchor", "ended", "status", "view", "estimator", "targets", "picture"]) {
      if (key in change) this[key] = change[key];
    }
    for (const object of change.objects) this.objects.set(object.id, object);
    if (change.ids) {
      const living = new Set(change.ids);
      for (const id of this.objects.keys()) if (!living.has(id)) this.objects.delete(id);
    }
    if (change.path_begins_anew) this.path = [];
    this.path.push(...change.path);
    this.fixes.push(...change.fixes);
    if (this.fixes.length > MOST_FIXES) this.fixes.splice(0, this.fixes.length - MOST_FIXES);
  }

  confirmed() {
    return [...this.objects.values()].filter((object) => object.confirmed);
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
      model.apply(JSON.parse(event.data));
      heard();
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
