// What has the focus because the pointer went there, not the Tab key. Nobody who clicked a button means it by the next
// Space: that plays.

let byPointer = false;
let pointed = null;

addEventListener('pointerdown', () => { byPointer = true; }, true);
addEventListener('keydown', () => { byPointer = false; }, true);
addEventListener('focusin', ({ target }) => { pointed = byPointer ? target : null; });

/** Whether a pointer gave the focus to an element. */
export const isPointed = (element) => element === pointed;
