// The motions of a collection as cards: a picture of the most typical segment, the name, the colour, and what can be done with it.

import { make } from '../dom.js';
import { count, duration } from '../number_format.js';

export class MotionCards {
  #list; #ways; #cards = new Map();

  /**
   * `ways.change(motion, changes)` changes a name or a colour and answers a promise; `ways.together(motion)` plays all of a motion,
   * `ways.similar(motion)` searches for it, `ways.picture(motion, canvas)` draws its exemplar.
   */
  constructor(list, ways) {
    this.#list = list;
    this.#ways = ways;
  }

  /** Show the motions. A card stays, and with it what a person writes there. */
  show(motions) {
    const wanted = new Map(motions.map((motion) => [motion.id, this.#cards.get(motion.id) ?? this.#card(motion.id)]));
    for (const [id, { item }] of this.#cards) if (!wanted.has(id)) item.remove();
    this.#cards = wanted;
    for (const motion of motions) this.#fill(wanted.get(motion.id), motion);
    [...wanted.values()].forEach(({ item }, place) => { if (this.#list.children[place] !== item) this.#list.insertBefore(item, this.#list.children[place] ?? null); });
  }

  #card(id) {
    const card = { motion: null, pictured: '' };
    const change = (field, changes) => this.#change(card, field, changes);
    card.picture = make('canvas', { width: 192, height: 144, 'aria-hidden': 'true' });
    card.name = make('input', { autocomplete: 'off', spellcheck: false, maxLength: 100, onchange: () => change(card.name, { name: card.name.value.trim() }) });
    card.colour = make('input', { type: 'color', onchange: () => change(card.colour, { colour: card.colour.value }) });
    card.facts = make('span', { className: 'facts' });
    card.problem = make('span', { className: 'problem-line', role: 'alert' });
    card.play = make('button', { type: 'button', onclick: () => this.#ways.together(card.motion) }, 'Side by side');
    card.find = make('button', { type: 'button', onclick: () => this.#ways.similar(card.motion) }, 'Find similar');
    card.item = make('li', { className: 'motion-card', 'data-motion': id }, card.picture,
      make('span', { className: 'called' }, card.colour, card.name), card.facts, card.problem, make('span', { className: 'ways' }, card.play, card.find));
    return card;
  }

  #fill(card, motion) {
    const { name, colour, seconds, segments, takes, exemplar } = motion;
    if (!card.motion || card.name !== document.activeElement) card.name.value = name;
    card.motion = motion;
    card.colour.value = colour;
    card.item.style.setProperty('--colour', colour);
    card.name.setAttribute('aria-label', `Name of motion ${name}`);
    card.colour.setAttribute('aria-label', `Colour of ${name}`);
    card.play.setAttribute('aria-label', `Side by side: ${name}`);
    card.find.setAttribute('aria-label', `Find similar to ${name}`);
    card.play.disabled = card.find.disabled = !exemplar;
    card.facts.textContent = `${duration(seconds)} · ${count(segments, 'segment')} in ${count(takes, 'take')}`;
    const wanted = exemplar ? `${exemplar.animation} ${exemplar.start} ${exemplar.end}` : '';
    if (wanted && wanted !== card.pictured) this.#ways.picture(motion, card.picture);
    card.pictured = wanted;
  }

  async #change(card, field, changes) {
    const { name, colour } = card.motion;
    card.problem.textContent = '';
    if (changes.name === name || changes.name === '') { card.name.value = name; return; }
    try { await this.#ways.change(card.motion, changes); } catch ({ message }) {
      card.problem.textContent = message;
      card.name.value = name;
      card.colour.value = colour;
      field.focus();
    }
  }
}
