// SPDX-License-Identifier: GPL-3.0-or-later
// Light or dark: the system's setting, until the button overrides it.

export class Theme {
  /** @param {HTMLButtonElement} button */
  constructor(button) {
    this.button = button;
    this.listeners = [];
    this.system = matchMedia('(prefers-color-scheme: dark)');
    this.system.addEventListener('change', () => this.#apply());
    this.chosen = undefined;
    button.addEventListener('click', () => {
      this.chosen = this.scheme === 'dark' ? 'light' : 'dark';
      this.#apply();
    });
    this.#apply();
  }

  /** @returns {'light' | 'dark'} */
  get scheme() {
    return this.chosen ?? (this.system.matches ? 'dark' : 'light');
  }

  on_change(listener) {
    this.listeners.push(listener);
    listener(this.scheme);
  }

  #apply() {
    document.documentElement.dataset.theme = this.scheme;
    this.button.textContent = this.scheme === 'dark' ? 'Light' : 'Dark';
    this.button.setAttribute('aria-label', `Change to ${this.scheme === 'dark' ? 'light' : 'dark'} colours`);
    this.listeners.forEach((listener) => listener(this.scheme));
  }
}
