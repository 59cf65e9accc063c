// The list of key-frames, each with its pose. It is filled when a person looks at it, and a pose is drawn when its row is seen.

import { $, make, onFirstSeen, screenReaderText } from '../dom.js';
import { portraitCanvas } from '../figure/thumbnails.js';
import { frameText, onFrameNumbering } from '../number_format.js';
import { motionSwatch } from '../palette.js';
import { addRovingFocus, setTabStop } from '../roving_focus.js';
import { placeFrom } from '../timeline/key_frames.js';

export class KeyFrameList {
  #list = $('poses'); #result; #document = null; #rows = []; #filled = null; #waits = false; #signal; #current = null;

  constructor(result, signal) {
    this.#result = result;
    this.#signal = signal;
    this.#list.replaceChildren();
    result.playhead.listen(() => this.#mark());
    onFrameNumbering(() => { this.#filled = null; this.show(this.#document); }, signal);
  }

  /** Show the key-frames of a document. */
  show(document) {
    this.#document = document;
    $('poses-hint').textContent = document.key_frames.length ? 'Peaks of the energy curve: the poses that tell most. J and K go from one to the next.'
      : 'This take has no key-frames.';
    $('save-poses').disabled = !document.key_frames.length;
    if (this.#waits || this.#filled === document.key_frames) return;
    this.#waits = true;
    onFirstSeen(this.#list, () => { this.#waits = false; this.#fill(); }, this.#signal);
  }

  #fill() {
    const { key_frames: keys, segments } = this.#document;
    if (this.#filled === keys) return;
    this.#filled = keys;
    this.#rows = keys.map((key) => this.#row(key, segments[this.#result.segmentIndexAt(key.frame)]));
    this.#current = null;
    this.#list.replaceChildren(...this.#rows.map((row) => make('li', {}, row)));
    setTabStop(this.#list, 'button');
    this.#mark();
  }

  #row({ frame, energy }, { motion, name }) {
    const picture = make('span', { className: 'picture' });
    onFirstSeen(picture, () => picture.append(portraitCanvas(this.#result.thumbnails, frame)), this.#signal);
    return make('button', { type: 'button', className: 'pose', tabIndex: -1, onclick: () => this.#go(frame) },
      picture, motionSwatch(motion), make('span', { className: 'name', title: name }, name),
      screenReaderText(' key-frame '), make('span', { className: 'from' }, frameText(frame)),
      screenReaderText(' energy '), make('span', { className: 'long' }, energy.toFixed(2)));
  }

  #go(frame) {
    const { editor, playhead, range } = this.#result;
    editor.select(-1);
    playhead.toggle(false);
    playhead.seek(frame);
    range.reveal(frame);
  }

  /** Mark the row of the frame of the playhead. */
  #mark() {
    if (!this.#rows.length || this.#result.playhead.playing) return;
    const { frame } = this.#result.playhead;
    const place = placeFrom(this.#filled, frame);
    const row = this.#filled[place]?.frame === frame ? this.#rows[place] : null;
    if (row === this.#current) return;
    this.#current?.removeAttribute('aria-current');
    this.#current = row;
    row?.setAttribute('aria-current', 'true');
  }
}

/** Wire the list once; `save()` downloads its poses. */
export function addKeyFrameList(save) {
  addRovingFocus($('poses'), 'button');
  $('save-poses').addEventListener('click', save);
}
