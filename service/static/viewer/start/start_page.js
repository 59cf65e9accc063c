// The first screen: what one gets in a short loop, samples to try, and the collections and animations of before.

import { addDemonstration, showDemonstration } from './demonstration.js';
import { addRecent, showRecent } from './recent_animations.js';
import { showCollections } from './recent_collections.js';
import { addSamples } from './samples.js';

export class StartPage {
  #goTo;

  /** Wire it once. `openFiles(files)`, `openAnimation(animation)` and `goTo(address)` lead on. */
  constructor({ openFiles, openAnimation, goTo }) {
    this.#goTo = goTo;
    addRecent(openAnimation);
    addSamples(openFiles);
    addDemonstration();
  }

  show() {
    showRecent();
    showCollections((id) => this.#goTo(`/collection/${id}`));
    showDemonstration();
  }
}
