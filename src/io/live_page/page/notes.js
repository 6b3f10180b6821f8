// SPDX-License-Identifier: Apache-2.0
// An operator's notes of the selected object: a name, and whether it is what it seems. The estimator is not told.
import { element } from "./panels.js";

const LONGEST_NAME = 60; // characters
const VERDICTS = [["confirmed", "✓ Confirm"], ["dismissed", "✗ Dismiss"]];

export class Notes {
  /** Before the server has said so, nothing may be changed. */
  constructor() {
    this.mayChange = false;
    this.object = null;
    this.name = element("input", { type: "text", maxLength: LONGEST_NAME, placeholder: "Name", ariaLabel: "Name", enterKeyHint: "done" });
    this.name.addEventListener("change", () => this.send());
    this.buttons = VERDICTS.map(([verdict, text]) => {
      const button = element("button", { type: "button", textContent: text });
      button.addEventListener("click", () => {
        this.verdict = this.verdict === verdict ? "" : verdict;
        this.send();
      });
      return button;
    });
    this.trouble = element("p", { className: "trouble", hidden: true });
    this.trouble.setAttribute("role", "alert");
    this.section = element("div", { className: "notes", hidden: true }, this.name, ...this.buttons, this.trouble);
  }

  show(object) {
    this.section.hidden = !this.mayChange || !object.confirmed;
    const isOther = this.object !== object.id;
    this.object = object.id;
    this.verdict = object.verdict ?? "";
    if (isOther) this.trouble.hidden = true;
    if (isOther || document.activeElement !== this.name) this.name.value = object.operator_name ?? "";
    this.buttons.forEach((button, i) => button.setAttribute("aria-pressed", VERDICTS[i][0] === this.verdict));
  }

  async send() {
    const query = new URLSearchParams({ name: this.name.value.trim(), verdict: this.verdict });
    let answer = "geoloc does not answer.";
    try {
      const got = await fetch(`objects/${this.object}/note?${query}`, { method: "POST" });
      answer = got.ok ? "" : await got.text();
    } catch {
      // It is said below.
    }
    this.trouble.textContent = answer === "" ? "" : `Not kept: ${answer}`;
    this.trouble.hidden = answer === "";
  }
}
