// What the address says: which revision is shown, and which moment of it.

export const frameOfAddress = () => numberAfter(location.hash, /[#&]frame=(\d+)/);
export const revisionOfAddress = () => numberAfter(location.search, /[?&]revision=(\d+)/);
function numberAfter(text, pattern) {
  const match = pattern.exec(text);
  return match ? Number(match[1]) : null;
}

/** Keep the moment in the address, once it rests: browsers refuse to be told sixty times a second. */
let resting;
export function remember(clock) {
  clearTimeout(resting);
  if (clock.playing) return;
  resting = setTimeout(() => {
    if (document.body.dataset.view === 'result') history.replaceState(null, '', `${location.pathname}${location.search}#frame=${clock.frame}`);
  }, 250);
}
