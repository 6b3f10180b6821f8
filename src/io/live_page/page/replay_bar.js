// SPDX-License-Identifier: Apache-2.0
// Pause, place and speed of a replay.

function duration(ms) {
  const seconds = Math.max(0, Math.round(ms / 1000));
  return `${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, "0")}`;
}

export class ReplayBar {
  constructor(bar) {
    this.bar = bar;
    this.pause = bar.querySelector("#pause");
    this.place = bar.querySelector("#place");
    this.time = bar.querySelector("#replay-time");
    this.speed = bar.querySelector("#speed");
    this.isHeld = false;
    this.pause.addEventListener("click", () => this.send({ paused: this.state.paused ? 0 : 1 }));
    this.speed.addEventListener("change", () => this.send({ speed: this.speed.value }));
    this.place.addEventListener("input", () => {
      this.isHeld = true;
      this.showTime(this.wanted());
    });
    this.place.addEventListener("change", () => {
      this.isHeld = false;
      this.send({ at: Math.round(this.wanted()) });
    });
  }

  wanted() {
    return this.state.begin + Number(this.place.value) / Number(this.place.max) * (this.state.end - this.state.begin);
  }

  /** `state`: what the server tells of the replay; `mayChange`: whether it takes wishes from here. */
  show(state, mayChange) {
    this.bar.hidden = !state;
    if (!state) return;
    this.state = state;
    this.place.disabled = !mayChange;
    this.pause.hidden = this.speed.hidden = !mayChange; // the bar tells where the replay is, then
    this.pause.textContent = state.paused ? "▶" : "❚❚";
    this.pause.setAttribute("aria-label", state.paused ? "Play" : "Pause");
    if (document.activeElement !== this.speed) this.showSpeed(state.speed);
    if (this.isHeld) return;
    this.place.value = Number(this.place.max) * (state.at - state.begin) / Math.max(1, state.end - state.begin);
    this.showTime(state.at);
  }

  showTime(at) {
    this.time.textContent = `${duration(at - this.state.begin)} / ${duration(this.state.end - this.state.begin)}`;
  }

  /** A speed that is not on offer, as by --speed, is added. */
  showSpeed(speed) {
    if (![...this.speed.options].some((option) => Number(option.value) === speed)) {
      const text = speed === 0 ? "fastest" : `× ${speed}`;
      this.speed.add(Object.assign(document.createElement("option"), { value: speed, textContent: text }));
    }
    this.speed.value = [...this.speed.options].find((option) => Number(option.value) === speed).value;
  }

  async send(wish) {
    await fetch(`playback?${new URLSearchParams(wish)}`, { method: "POST" }).catch(() => {});
  }
}
