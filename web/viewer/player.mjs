// SPDX-License-Identifier: GPL-3.0-or-later
// The current frame and the playback. Independent of how a frame is drawn.

export const speeds = [0.1, 0.25, 0.5, 1, 2, 4];

export class Player {
  #next_tick = 0;

  /** @param {Record<string, any>} header  of the page */
  constructor(header) {
    this.frames = header.frames;
    this.frames_per_second = header.frames_per_second || 30;
    this.first_frame = header.first_frame ?? 0;
    this.frame_step = header.frame_step || 1;
    this.frame = 0;
    this.playing = false;
    this.loop = true;
    this.speed = 1;
    this.listeners = [];
  }

  /** Calls `listener` now, and after every change of the frame or of the playback. */
  on_change(listener) {
    this.listeners.push(listener);
    listener();
  }

  /** The frame of the scene for a frame of the page. */
  scene_frame(frame = this.frame) {
    return this.first_frame + frame * this.frame_step;
  }

  /** The frame of the page nearest to a frame of the scene. */
  page_frame(scene_frame) {
    return this.#clamped(Math.round((scene_frame - this.first_frame) / this.frame_step));
  }

  goto(frame) {
    const wanted = this.#clamped(Math.round(frame));
    if (wanted === this.frame || Number.isNaN(wanted)) return;
    this.frame = wanted;
    this.#changed();
  }

  /** Stops, and moves by some frames. */
  step(by) {
    this.pause();
    this.goto(this.frame + by);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    cancelAnimationFrame(this.#next_tick);  // or it would find the player playing again, beside the next one
    this.#changed();
  }

  play() {
    if (this.frames < 2 || this.playing) return;
    if (this.frame === this.frames - 1) this.frame = 0;
    this.playing = true;
    this.#changed();
    let then = performance.now();
    let due = 0;
    const tick = (now) => {
      if (!this.playing) return;
      due += (Math.max(0, now - then) / 1000) * this.frames_per_second * this.speed;
      then = now;
      const whole = Math.floor(due);
      due -= whole;
      if (whole > 0) this.#advance(whole);
      if (this.playing) this.#next_tick = requestAnimationFrame(tick);
    };
    this.#next_tick = requestAnimationFrame(tick);
  }

  set_speed(speed) {
    this.speed = speed;
    this.#changed();
  }

  /** @param {1 | -1} by  one faster or slower */
  change_speed(by) {
    const at = speeds.indexOf(this.speed) + by;
    if (speeds[at]) this.set_speed(speeds[at]);
  }

  set_loop(loop) {
    this.loop = loop;
    this.#changed();
  }

  /** A slow screen skips frames, but keeps time. */
  #advance(by) {
    const next = this.frame + by;
    if (next < this.frames) return this.goto(next);
    if (this.loop) return this.goto(next % this.frames);
    this.goto(this.frames - 1);
    this.pause();
  }

  #clamped(frame) {
    return Math.max(0, Math.min(this.frames - 1, frame));
  }

  #changed() {
    this.listeners.forEach((listener) => listener());
  }
}
