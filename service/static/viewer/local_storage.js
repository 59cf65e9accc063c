// Values that this browser keeps for the page. A browser that stores nothing is no fault: the page then uses the defaults.

export function stored(key, otherwise = null) {
  try {
    const text = localStorage.getItem(key);
    return text === null ? otherwise : JSON.parse(text);
  } catch { return otherwise; }
}

export function store(key, value) {
  try { localStorage.setItem(key, JSON.stringify(value)); } catch { /* private window, or full */ }
}
