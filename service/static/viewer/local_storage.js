// What the page remembers on this machine. A browser that keeps nothing is no fault: then nothing is remembered.

export function stored(key, otherwise = null) {
  try {
    const text = localStorage.getItem(key);
    return text === null ? otherwise : JSON.parse(text);
  } catch { return otherwise; }
}

export function store(key, value) {
  try { localStorage.setItem(key, JSON.stringify(value)); } catch { /* private window, or full */ }
}
