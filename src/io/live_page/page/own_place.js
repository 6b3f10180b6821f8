// SPDX-License-Identifier: Apache-2.0
// Where the reader stands: asked of the browser on request only, or tapped on the map where the browser does not tell.
import { toMetres } from "./projection.js";

export class OwnPlace extends EventTarget {
  constructor(button, hint, map, model) {
    super();
    Object.assign(this, { button, hint, map, model });
    this.degrees = null; // [latitude, longitude]
    this.watch = null;
    button.addEventListener("click", () => (this.isOn() ? this.stop() : this.begin()));
  }

  isOn() {
    return this.button.getAttribute("aria-pressed") === "true";
  }

  /** East and north [m] in the run's frame, or null. */
  at() {
    return this.degrees && this.model.anchor && toMetres(this.model.anchor, this.degrees);
  }

  begin() {
    this.button.setAttribute("aria-pressed", true);
    if (!isSecureContext || !navigator.geolocation) {
      this.ask("The browser tells positions only to pages from this computer or over https.");
      return;
    }
    this.watch = navigator.geolocation.watchPosition(
      ({ coords }) => this.set([coords.latitude, coords.longitude]),
      ({ message }) => { if (!this.degrees) this.ask(`The browser does not tell where you are (${message || "no reason given"}).`); },
      { enableHighAccuracy: true, maximumAge: 5000 });
  }

  stop() {
    if (this.watch !== null) navigator.geolocation.clearWatch(this.watch);
    this.watch = null;
    this.map.onTap = null;
    this.hint.hidden = true;
    this.button.setAttribute("aria-pressed", false);
    this.set(null);
  }

  ask(why) {
    this.hint.textContent = `${why} Tap the map where you stand.`;
    this.hint.hidden = false;
    this.map.onTap = (pixel) => {
      this.map.onTap = null;
      this.hint.hidden = true;
      this.set(this.map.degreesAt(pixel));
    };
  }

  set(degrees) {
    this.degrees = degrees;
    this.dispatchEvent(new Event("change"));
  }
}
