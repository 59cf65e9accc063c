// Dragging a cut: it moves only after the pointer has clearly moved, keeps its distance from the pointer, and Escape puts
// it back.

const STILL = { mouse: 3, pen: 5, touch: 8 }; // pixels that a hand moves without meaning to

export class CutDrag {
  #editor; #end = new AbortController(); #grip = null;

  /** Take hold of `cut` of `editor` where a pointer pressed. `onCancel()` is called when a person takes it back. */
  constructor(editor, cut, { clientX, pointerType }, onCancel) {
    this.cut = cut;
    this.moved = false;
    this.#editor = editor;
    this.#grip = { x: clientX, still: STILL[pointerType] || STILL.mouse, frame: editor.segments[cut].end };
    editor.select(cut);
    addEventListener('keydown', (event) => {
      if (event.key !== 'Escape') return;
      event.stopPropagation();
      this.cancel();
      onCancel();
    }, { capture: true, signal: this.#end.signal });
  }

  /** The pointer is at `clientX`, where one pixel is so many frames. `snap(frame)` answers the frame to take. */
  moveTo(clientX, framesPerPixel, snap) {
    const { x, still, frame } = this.#grip;
    if (!this.moved) {
      if (Math.abs(clientX - x) <= still) return;
      this.moved = true;
      this.#grip.x += Math.sign(clientX - x) * still; // so that the cut starts from where it is
      this.#editor.beginDrag();
    }
    this.#editor.dragTo(Math.round(snap(frame + (clientX - this.#grip.x) * framesPerPixel)));
  }

  /** The pointer is let go: what was moved is saved. */
  end() {
    this.#end.abort();
    if (this.moved) this.#editor.endDrag();
  }

  cancel() {
    this.#end.abort();
    if (this.moved) this.#editor.cancelDrag();
  }
}
