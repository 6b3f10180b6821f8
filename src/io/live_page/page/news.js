// SPDX-License-Identifier: Apache-2.0
// The signal for an object that was not there before: a button that leads to it and, on request, a sound.
import { remember, remembered } from "./theme.js";

const KEY = "geoloc-sound";
const SHOWN_MS = 12000;
const TONES_HZ = [880, 1320];
const TONE_S = 0.16;

export class News {
  constructor(banner, soundButton, onSelect) {
    Object.assign(this, { banner, soundButton });
    this.isLoud = remembered(KEY, "off") === "on";
    banner.addEventListener("click", () => {
      banner.hidden = true;
      onSelect(this.newest);
    });
    soundButton.addEventListener("click", () => {
      this.isLoud = !this.isLoud;
      remember(KEY, this.isLoud ? "on" : "off");
      this.showSound();
      if (this.isLoud) this.sound();
    });
    this.showSound();
  }

  showSound() {
    this.soundButton.setAttribute("aria-pressed", this.isLoud);
    this.soundButton.textContent = this.isLoud ? "Sound on" : "Sound off";
  }

  /** `objects`: that were confirmed just now. */
  tell(objects) {
    if (objects.length === 0) return;
    const newest = objects.at(-1);
    this.newest = newest.id;
    const others = objects.length > 1 ? ` and ${objects.length - 1} more` : "";
    this.banner.textContent = `New: ${newest.id} · ${newest.name}${others}`;
    this.banner.hidden = false;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => { this.banner.hidden = true; }, SHOWN_MS);
    if (this.isLoud) this.sound();
  }

  /** Two short tones. Browsers allow sound once the reader has touched the page. */
  sound() {
    this.audio ??= new AudioContext();
    this.audio.resume();
    const gain = this.audio.createGain();
    gain.gain.value = 0.25;
    gain.connect(this.audio.destination);
    TONES_HZ.forEach((hertz, i) => {
      const tone = this.audio.createOscillator();
      const begin = this.audio.currentTime + i * TONE_S;
      tone.frequency.value = hertz;
      tone.connect(gain);
      tone.start(begin);
      tone.stop(begin + TONE_S);
    });
  }
}
