// Ways to a result: from files, from an animation of before, from parameters. While they lead there the page waits.

import * as api from '../service/api.js';
import { waitUntilDone } from '../service/job_status.js';
import { untilAnswered } from '../service/retry.js';
import { $ } from '../dom.js';
import { revisionInAddress, showView } from '../views.js';
import { resetProgress, showPause, showStage, showStatus } from './progress.js';

export class Opening {
  #page; #task = new AbortController();

  /**
   * `page.prepare()` fetches what shows a result, and `page.show(result, status, viewer)` shows it; `page.refuse(problem, name, again)` says why there is none; `page.leave()`
   * goes where a person who waits no longer goes.
   */
  constructor(page) { this.#page = page; }

  /** Begin a task; the one before ends. Answers the signal that ends it. */
  begin() {
    this.#task.abort();
    this.#task = new AbortController();
    return this.#task.signal;
  }

  /** Upload the files of one animation, have them segmented, show the result. */
  files(files) {
    const { name } = files[0];
    return this.#lead(name, () => this.files(files), async (signal) => {
      showStage('upload', 0);
      const animation = await api.upload(files, (share) => showStage('upload', share), signal);
      await this.#follow(await api.segment(animation.id), signal);
    });
  }

  /** Open an animation of before: as it was edited last; else its newest result, or the one on its way; else a new one. */
  animation(animation) {
    return this.#lead(animation.name, () => this.animation(animation), async (signal) => {
      const { segmentations } = await api.segmentationsOf(animation.id);
      const find = (wanted) => segmentations.find(wanted);
      const known = find(({ id }) => id === animation.edited) || find(({ status }) => status === 'done')
        || find(({ status }) => ['queued', 'running'].includes(status));
      await this.#follow(known || await api.segment(animation.id), signal);
    });
  }

  /** Segment an animation with `parameters`, and show the result. */
  segmentation(animationId, name, parameters) {
    return this.#lead(name, () => this.segmentation(animationId, name, parameters), async (signal) => {
      await this.#follow(await api.segment(animationId, parameters), signal);
    });
  }

  /** Show the result whose id the address has. */
  address(id, again) { return this.#lead('', again, (signal) => this.#wait(id, signal)); }

  async #lead(name, again, way) {
    const signal = this.begin();
    $('subject').textContent = '';
    resetProgress(name);
    showView('waiting', name);
    this.#page.prepare().catch(() => {}); // while the result is on its way
    this.#onCancel(async () => {});
    try { await way(signal); } catch (problem) { this.#page.refuse(problem, name, again); }
  }

  /** What the button of the wait does beside leaving. */
  #onCancel(cancel) { $('waiting-cancel').onclick = () => cancel().finally(() => this.#page.leave()); }

  async #follow({ id }, signal) {
    if (signal.aborted) return;
    history.pushState(null, '', `/view/${id}`);
    await this.#wait(id, signal);
  }

  /** Wait until a segmentation is done, then show it. */
  async #wait(id, signal) {
    const status = await waitUntilDone(id, (now) => {
      if (now.status === 'running') import('../figure/scene.js'); // needed soon: fetched while we wait
      if (now.name) $('waiting-name').textContent = now.name;
      // To cancel a finished segmentation would delete it.
      this.#onCancel(now.status === 'done' ? async () => {} : () => api.cancel(id).catch(() => {}));
      showStatus(now);
    }, signal, showPause);
    const viewer = api.viewer(id); // fetched beside the result, as the figure takes longest
    viewer.catch(() => {}); // the figure panel shows the problem
    const result = await untilAnswered(() => api.result(id, revisionInAddress() ?? status.revision), signal, showPause);
    await this.#page.prepare();
    if (!signal.aborted) this.#page.show(result, status, viewer);
  }
}
