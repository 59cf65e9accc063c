// The page of results: the one on screen, or the one to go back to, and every control of it, wired once.

import * as api from './service/api.js';
import { $, announce, make } from './dom.js';
import { addEditToolbar } from './editing/edit_toolbar.js';
import { showEditedResults } from './editing/edited_results.js';
import { offerLoop, playLoop } from './editing/segment_loop.js';
import { addKeyboard } from './keyboard.js';
import { addLabelButtons } from './labels/label_buttons.js';
import { count, takeSummary } from './number_format.js';
import { addReviewTools } from './panels/cut_review.js';
import { addExportMenu } from './panels/export_menu.js';
import { addRevisionList, openRevision, showRevisions } from './panels/revision_list.js';
import { addSegmentList } from './panels/segment_list.js';
import { addFormNote, addSegmentationForm, offerMethods, resegment, showFormNote } from './panels/segmentation_form.js';
import { addSharing, showLookOnly } from './panels/share.js';
import { addTakeMenu, showTakes } from './panels/take_menu.js';
import { Result } from './result_view.js';
import { addTabs } from './roving_focus.js';
import { addComparison } from './timeline/comparison.js';
import { addPlayerControls, addViewControls } from './timeline/navigation.js';
import { frameInAddress, lookOnly, rememberFrame, showView } from './views.js';

export class ResultPage {
  #page; #changed;

  /** `page` leads elsewhere: its `goTo`, `leave`, `clear`, `opening` and `startBatch`. */
  constructor(page) {
    this.#page = page;
    this.shown = null; // the Result
    this.#changed = this.#wire();
    offerMethods();
  }

  /** The address of the result. */
  get address() { return `/view/${this.shown.document.id}#frame=${this.shown.playhead.frame}`; }

  show(result, status, viewer) {
    this.shown?.close();
    showFormNote('');
    showLookOnly();
    this.#showTitle(result, status);
    announce(`${status.name}: ${count(result.motions, 'motion')} in ${count(result.segments.length, 'segment')}.`);
    this.shown = new Result(result, status, () => this.#changed());
    this.shown.figurePanel.colourBy(document.querySelector('#looks input:checked').value);
    this.seek(frameInAddress());
    this.shown.playhead.listen(rememberFrame);
    this.shown.figurePanel.open(result.id, viewer);
    showTakes(status.animation, result.source);
    this.#changed();
  }

  /** Show the result again that was on screen before. */
  showAgain() { this.#showTitle(this.shown.document, this.shown.status); }

  seek(frame) { if (frame !== null) this.shown?.playhead.seek(frame); }

  /** Whether the page may leave the result on screen: open edits are saved first. */
  async leave() {
    this.shown?.playhead.toggle(false);
    if (!this.shown?.editor.saving.open) return true;
    return this.shown.editor.saving.flush().then(() => true, () => confirm('The service could not save your last edits. Leave anyway?'));
  }

  /** Leave the result for good. */
  clear() {
    this.shown?.close();
    this.shown = null;
    $('subject').textContent = '';
    for (const id of ['takes', 'take-place']) $(id).hidden = true;
  }

  #showTitle(result, { name }) {
    showView('result', name);
    $('subject').textContent = [name, takeSummary(result)].filter(Boolean).join(' · ');
    $('result-title').textContent = name;
  }

  /** Show a take of the animation on screen. */
  async #openTake(take) {
    const { status, document } = this.shown;
    if (!(await this.#page.leave())) return showTakes(status.animation, document.source);
    this.#page.opening.segmentation(status.animation, status.name, { ...document.parameters, take, motions: 'auto' });
  }

  /** Cut all takes of the animation on screen, each by itself. */
  #openTakes(takes) {
    const { status: { animation, name }, document: { parameters } } = this.shown;
    this.#page.clear();
    this.#page.startBatch(`${name}, ${count(takes.length, 'take')}`, takes.map(({ index, name: take }) => ({
      name: take, send: () => api.segment(animation, { ...parameters, take: index, motions: 'auto' }),
    })));
  }

  /** Wire every control of the result. Answers a function to call whenever what is shown has changed. */
  #wire() {
    const onScreen = () => (document.body.dataset.view === 'result' ? this.shown : null);
    addPlayerControls(onScreen);
    addViewControls(onScreen);
    addComparison(onScreen);
    addLabelButtons(onScreen);
    addKeyboard(onScreen);
    addSharing(() => ({ id: this.shown.document.id, revision: this.shown.editor.saving.shown, frame: this.shown.playhead.frame }));
    const showTab = addTabs($('tabs'));
    addSegmentList(onScreen);
    addRevisionList();
    addReviewTools(() => { showTab('tab-review'); return onScreen()?.review; });
    addTakeMenu({ open: (take) => this.#openTake(take), batch: (takes) => this.#openTakes(takes) });
    addSegmentationForm({ resegment: (changes) => resegment(this.shown, changes, this.#page.opening.begin()), current: () => this.shown });
    $('play-loop').addEventListener('click', () => playLoop(this.shown));
    return this.#wireEdits(() => onScreen()?.editor);
  }

  #wireEdits(editor) {
    const open = (number, dropping) => openRevision(this.shown, number, dropping);
    const showEdits = addEditToolbar(editor, { loadTheirs: () => open(editor().saving.theirs, true) });
    const showLinks = addExportMenu(() => {
      if (!editor()) return null;
      const { saving, segments, affected } = editor();
      return { id: this.shown.document.id, revision: saving.shown, dirty: saving.open, keep: () => saving.flush(), segments, affected };
    });
    addEventListener('beforeunload', (event) => { if (editor()?.saving.open) event.preventDefault(); });
    addEventListener('visibilitychange', () => { if (document.hidden && editor()?.saving.kind === 'waiting') editor().saving.flush().catch(() => {}); });
    let listed = '';
    return () => {
      if (!editor()) return;
      showEdits();
      offerLoop(this.shown);
      showLinks();
      const { saving } = editor();
      const state = `${this.shown.document.id} ${saving.shown} ${saving.newest}`;
      if (state === listed) return;
      listed = state;
      this.#showHistory(saving, open);
    };
  }

  #showHistory(saving, open) {
    const { document: { id }, status: { animation } } = this.shown;
    showRevisions(id, saving.shown, open);
    showEditedResults(animation, this.shown.document, { open: (other) => this.#page.goTo(`/view/${other}`), offer: (other) => this.#offerEdits(other) });
    if (location.search && !lookOnly() && saving.shown === saving.newest) history.replaceState(null, '', location.pathname + location.hash);
  }

  /** Say that the same take is edited elsewhere, and offer to go there. */
  #offerEdits({ id, motions }) {
    addFormNote(`You have edited this take with ${count(motions, 'motion')} before. `,
      make('button', { type: 'button', onclick: () => this.#page.goTo(`/view/${id}`) }, 'Show the edits'));
  }
}
