// SPDX-License-Identifier: Apache-2.0
// Light, dark, or high contrast for sunlight, in place of the system's choice.

const KEY = "geoloc-theme";
// The palette has its dark colours under this condition; each theme puts its own in place.
const DARK_WHEN = { system: "(prefers-color-scheme: dark)", dark: "all", light: "not all", sun: "not all" };

function darkRule() {
  return [...document.styleSheets].flatMap((sheet) => [...sheet.cssRules])
    .find((rule) => rule instanceof CSSMediaRule && rule.cssText.includes("--page"));
}

/** Browsers that keep nothing still have the themes. */
export function remembered(key, otherwise) {
  try {
    return localStorage.getItem(key) ?? otherwise;
  } catch {
    return otherwise;
  }
}

export function remember(key, value) {
  try {
    localStorage.setItem(key, value);
  } catch {
    // The choice lasts as long as the page, then.
  }
}

export class Theme extends EventTarget {
  constructor(select) {
    super();
    this.rule = darkRule();
    select.value = remembered(KEY, "system");
    if (!(select.value in DARK_WHEN)) select.value = "system";
    select.addEventListener("change", () => {
      remember(KEY, select.value);
      this.apply(select.value);
    });
    matchMedia(DARK_WHEN.system).addEventListener("change", () => this.dispatchEvent(new Event("change")));
    this.apply(select.value);
  }

  apply(name) {
    document.documentElement.dataset.theme = name;
    this.rule.media.mediaText = DARK_WHEN[name];
    this.dispatchEvent(new Event("change"));
  }
}
