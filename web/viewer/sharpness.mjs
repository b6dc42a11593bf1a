// SPDX-License-Identifier: GPL-3.0-or-later
// The number of pixels drawn per pixel of the page: two, for smooth edges; on slow machines one during motion.

const fine = 2;
const quick = 1;
const most_pixels = 8e6;
const slow_ms = 40;      // from a draw until the browser is ready for the next one
const slow_draws = 5;    // this many in a row mean a slow machine
const pause_ms = 250;    // after which a still picture is drawn finely

export class Sharpness {
  /**
   * @param {() => boolean} moving  whether it plays, or the camera is being moved
   * @param {() => void} change     called when the picture must be redrawn with another ratio
   */
  constructor(moving, change) {
    this.moving = moving;
    this.change = change;
    this.quick = false;
    this.slow = 0;
  }

  /** Whether the picture has its finest resolution. */
  get settled() {
    return !this.quick && this.timer === undefined;
  }

  ratio(width, height) {
    return Math.min(this.quick ? quick : fine, Math.sqrt(most_pixels / (width * height)));
  }

  /** Before each draw. @param {number} now  milliseconds */
  next_draw(now) {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.#rest(), pause_ms);
    if (!this.moving()) return;
    this.#measure(now);
    this.#set(this.slow >= slow_draws);
  }

  /** The gap between two draws would not do: a page that plays slowly draws seldom on any machine. */
  #measure(begin) {
    requestAnimationFrame(() => {
      if (this.slow < slow_draws) this.slow = performance.now() - begin > slow_ms ? this.slow + 1 : 0;
    });
  }

  #rest() {
    // A motion may end without another draw.
    this.timer = this.moving() ? setTimeout(() => this.#rest(), pause_ms) : undefined;
    if (this.timer !== undefined) return;
    this.#set(false);
  }

  #set(quick) {
    if (quick === this.quick) return;
    this.quick = quick;
    this.change();
  }
}
