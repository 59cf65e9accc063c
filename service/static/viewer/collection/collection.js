// A collection as the page knows it: its document, and those of its takes that are loaded.

import * as api from '../service/api.js';
import * as collections from '../service/collections.js';
import { textureNumber } from '../palette.js';

const PAGE = 100; // takes that are loaded at first, and with every "Show more"
const BY_NAME = new Intl.Collator('en', { numeric: true });

export class Collection {
  document = null; takes = []; next = null;

  constructor(id) { this.id = id; }

  get working() { return this.document.status === 'working'; }

  /** Takes that are labelled, and so have segments. */
  get labelled() { return this.takes.filter(({ status }) => status === 'labelled'); }

  /** Load it, or load it anew: as many takes as there were. */
  async load() {
    const wanted = Math.max(PAGE, this.takes.length);
    const document = await collections.collection(this.id);
    let page = await collections.takes(this.id);
    const found = [...page.takes];
    while (page.next && found.length < wanted) {
      page = await api.more(page.next);
      found.push(...page.takes);
    }
    this.document = document;
    this.next = page.next;
    this.#set(found);
  }

  /** Load the takes after those that are loaded. */
  async more() {
    const page = await api.more(this.next);
    this.next = page.next;
    this.#set([...this.takes, ...page.takes]);
  }

  /** Load every take, for what is saved. */
  async all() { while (this.next) await this.more(); }

  /** A take by its animation. */
  async take(animation) { return this.known(animation) ?? collections.take(this.id, animation); }

  /** The same if it is loaded. */
  known(animation) { return this.takes.find((take) => take.animation === animation); }

  /** A motion with its texture: from the thirteenth on, colours come again. */
  motion(id) {
    const at = this.document.motions.findIndex((motion) => motion.id === id);
    return at < 0 ? { id, name: 'another motion', colour: '#888888', texture: 0 } : { ...this.document.motions[at], texture: textureNumber(at) };
  }

  /** Segments with the names and colours of their motions. */
  coloured(segments) {
    return segments.map((segment) => {
      const { name, colour, texture } = this.motion(segment.motion);
      return { ...segment, name, colour, texture };
    });
  }

  #set(takes) {
    const once = new Map(takes.map((take) => [take.animation, take]));
    this.takes = [...once.values()].sort((one, other) => BY_NAME.compare(one.name, other.name));
  }
}
