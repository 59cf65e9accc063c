// Values that this browser keeps for the page. A browser that stores nothing is no fault: the page then uses the defaults.

/** The value of a key; `storage` is that of the browser, or that of the tab. */
export function stored(key, otherwise = null, storage = globalThis.localStorage) {
  try {
    const text = storage.getItem(key);
    return text === null ? otherwise : JSON.parse(text);
  } catch { return otherwise; }
}

export function store(key, value, storage = globalThis.localStorage) {
  try { storage.setItem(key, JSON.stringify(value)); } catch { /* private window, or full */ }
}
