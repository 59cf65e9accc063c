// What the address says: which result is shown, which revision of it, and which moment.

const REST = 250; // ms that the moment rests before it is written down: browsers refuse to be told sixty times a second

export const resultOfAddress = () => /^\/view\/([^/]+)$/.exec(location.pathname)?.[1];
export const revisionOfAddress = () => numberAfter(location.search, /[?&]revision=(\d+)/);
export const frameOfAddress = () => numberAfter(location.hash, /[#&]frame=(\d+)/);

function numberAfter(text, pattern) {
  const match = pattern.exec(text);
  return match ? Number(match[1]) : null;
}

let resting;

/** Keep the moment in the address, so that a link opens there. */
export function remember(clock) {
  clearTimeout(resting);
  if (clock.playing) return;
  resting = setTimeout(() => {
    if (document.body.dataset.view === 'result') history.replaceState(null, '', `${location.pathname}${location.search}#frame=${clock.frame}`);
  }, REST);
}
