// The view of a collection: its motions as cards, its takes as a table, what would change, and all that a person does there.

import * as collections from '../service/collections.js';
import { $, make } from '../dom.js';
import { askForName } from '../name_dialog.js';
import { count, duration } from '../number_format.js';
import { showView } from '../views.js';
import { addToCollection } from './additions.js';
import { Collection } from './collection.js';
import { drawPicture, FigurePictures } from './figure_pictures.js';
import { MotionCards } from './motion_cards.js';
import { awaitProposal, showProposals } from './proposals.js';
import { saveClips, saveCollection } from './saving.js';
import { addSideBySide, showSideBySide } from './side_by_side.js';
import { addSimilar, showSimilar } from './similar.js';
import { addTableFocus } from './table_focus.js';
import { TakeDialog } from './take_dialog.js';
import { fillTakeTable } from './take_table.js';

const SOON = 1200; // ms until it is looked at again while takes wait

export class CollectionView {
  #collection = null; #closing = new AbortController(); #pictures = null; #cards = null; #dialog; #goTo; #said = '';

  /** Wire the view once. `goTo(address)` leads to another view. */
  constructor(goTo) {
    this.#goTo = goTo;
    this.#dialog = new TakeDialog({
      open: (take, frame) => this.#open(take, frame),
      similar: (take, segment) => this.#similar({ ...segment, animation: take.animation }, `${take.name}, ${segment.start_seconds.toFixed(1)} to ${segment.end_seconds.toFixed(1)} s`),
      correct: (take, segments) => this.#correct(take, segments),
      clips: (take, note) => saveClips(this.#collection, take, note),
      remove: (take) => this.#remove(take),
    });
    addTableFocus($('takes-table'));
    addSimilar();
    addSideBySide();
    this.#wire();
  }

  /** Show a collection by its id. Throws what the service refuses. */
  async open(id) {
    this.close();
    this.#closing = new AbortController();
    const { signal } = this.#closing;
    const collection = new Collection(id);
    await collection.load();
    if (signal.aborted) return;
    this.#collection = collection;
    this.#pictures = new FigurePictures($('pictures-place'), signal);
    $('motion-cards').replaceChildren();
    $('collection-additions').replaceChildren();
    this.#said = '';
    this.#cards = new MotionCards($('motion-cards'), {
      change: (motion, changes) => this.#changeMotion(motion, changes),
      together: (motion) => showSideBySide(collection, motion),
      similar: (motion) => this.#similar(motion.exemplar, motion.name),
      picture: (motion, canvas) => this.#drawExemplar(motion, canvas),
    });
    showView('collection', collection.document.name);
    this.#show();
    this.#showProposals();
    this.#follow(signal);
  }

  /** Leave it. */
  close() {
    this.#closing.abort();
    for (const id of ['take-dialog', 'similar', 'together']) $(id).close();
  }

  /** Add files, grouped by animation, to the collection on screen. */
  async add(groups) {
    await addToCollection(this.#collection.id, groups, () => this.#reload());
    this.#follow(this.#closing.signal);
  }

  #wire() {
    const rename = async ({ target }) => {
      const { document } = this.#collection;
      this.#collection.document = await collections.renameCollection(document.id, target.value.trim()).catch(({ message }) => { this.#say(message); return document; });
      this.#show();
    };
    $('collection-name').addEventListener('change', rename);
    $('collection-recut').addEventListener('click', () => this.#recut());
    $('takes-more').addEventListener('click', () => this.#collection.more().then(() => this.#show(), ({ message }) => this.#say(message)));
    for (const button of $('collection-save').querySelectorAll('button')) {
      button.addEventListener('click', () => {
        $('collection-save').open = false;
        saveCollection(this.#collection, button.dataset.saved).catch(({ message }) => this.#say(message));
      });
    }
  }

  /** Look at it again and again while takes wait to be labelled. */
  async #follow(signal) {
    while (this.#collection.working) {
      await new Promise((done) => setTimeout(done, SOON));
      if (signal.aborted || document.body.dataset.view !== 'collection') return;
      await this.#reload().catch(() => this.#say('The service does not answer. The page tries again.'));
    }
  }

  async #reload() {
    const { version } = this.#collection.document;
    await this.#collection.load();
    if (this.#collection.document.version !== version) this.#show();
  }

  #show() {
    const collection = this.#collection;
    const { name, motions } = collection.document;
    $('collection-title').textContent = name;
    if ($('collection-name') !== document.activeElement || !$('collection-name').value) $('collection-name').value = name;
    this.#showFacts();
    this.#cards.show(motions);
    fillTakeTable($('takes-table'), collection, { open: (take, frame) => this.#open(take, frame), list: (take) => this.#dialog.show(collection, take) });
    $('takes-more').hidden = !collection.next;
    const failed = collection.takes.filter(({ status }) => status === 'failed');
    $('failed-takes').hidden = !failed.length;
    $('failed-rows').replaceChildren(...failed.map((take) => this.#failedRow(take)));
  }

  #showFacts() {
    const { takes, waiting, failed, seconds, motions } = this.#collection.document;
    const facts = [count(takes, 'take'), seconds && duration(seconds), count(motions.length, 'motion'),
      waiting && `${waiting} of ${takes} still to be labelled`, failed && `${failed} not comparable`];
    $('collection-facts').textContent = [facts.filter(Boolean).join(' · '), this.#said].filter(Boolean).join('. ');
  }

  #say(sentence) {
    this.#said = sentence;
    this.#showFacts();
  }

  #failedRow(take) {
    return make('li', {}, make('strong', {}, take.name), make('span', { className: 'row-note problem-line' }, take.problem?.detail ?? 'It could not be compared.'),
      make('button', { type: 'button', onclick: () => this.#remove(take) }, 'Remove', make('span', { className: 'unseen' }, ` ${take.name}`)));
  }

  #open(take, frame) { this.#goTo(`/view/${take.segmentation}#frame=${frame}`); }

  #similar(range, what) {
    showSimilar(this.#collection, range, what, this.#pictures, (take, frame) => this.#open(take, frame));
  }

  async #drawExemplar({ exemplar: { animation, start, end } }, canvas) {
    const take = await this.#collection.take(animation).catch(() => null);
    if (take) await drawPicture(this.#pictures, take.segmentation, Math.floor((start + end) / 2), canvas);
  }

  async #changeMotion(motion, changes) {
    this.#collection.document = await collections.changeMotion(this.#collection.id, motion.id, changes);
    this.#show();
    this.#showProposals();
  }

  async #correct(take, segments) {
    const corrected = await collections.correctTake(this.#collection.id, take, segments);
    await this.#reload();
    if (corrected.proposal) this.#awaitProposal(corrected.proposal);
    return this.#collection.known(take.animation) ?? corrected;
  }

  async #recut() {
    const wanted = await askForName({ title: 'Cut all takes together anew', label: 'Motions', value: 'auto', action: 'Show what would change' });
    if (wanted === null) return;
    await collections.proposeRecut(this.#collection.id, Number(wanted) || 'auto').then(({ id }) => this.#awaitProposal(id), ({ message }) => this.#say(message));
  }

  async #awaitProposal(id) {
    this.#say('What would change is being worked out …');
    const collection = this.#collection;
    const sentence = await awaitProposal(collection, id).catch(({ message }) => message);
    if (collection !== this.#collection) return;
    this.#say(sentence);
    this.#showProposals();
  }

  #showProposals() {
    const decided = async () => { this.#say(''); await this.#reload(); await showProposals(this.#collection, decided); };
    return showProposals(this.#collection, decided).catch(({ message }) => this.#say(message));
  }

  async #remove({ animation, name }) {
    if (!confirm(`Take ${name} out of the collection? The animation itself stays.`)) return;
    await collections.removeTake(this.#collection.id, animation).catch(({ message }) => this.#say(message));
    await this.#reload();
  }
}

/** Make a collection of animations; answers its address. */
export async function makeCollection(animations) {
  const { id } = await collections.createCollection(count(animations.length, 'take'), animations);
  return `/collection/${id}`;
}
