// Elements in one line each.

export const $ = (id) => document.getElementById(id);

/** `make('li', { className: 'x', onclick }, 'text', child)`. Text is text: nothing a file says becomes markup. */
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name.includes('-') || name === 'role') element.setAttribute(name, value);
    else element[name] = value;
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

/** An element of a drawing: `makeSvg('path', { class: 'line', d })`. */
export function makeSvg(tag, attributes, text = '') {
  const element = document.createElementNS(document.querySelector('svg').namespaceURI, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.textContent = text;
  return element;
}

/** Words that only a screen reader reads. */
export const screenReaderText = (text) => make('span', { className: 'unseen' }, text);

/** Have a screen reader say a sentence. */
export const announce = (sentence) => { $('announce').textContent = sentence; };

/** A colour of the style sheet, for canvases. */
export const styleValue = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** Call back when the person's system goes from light to dark or back, until `signal` ends it. */
export function onThemeChange(listener, signal) {
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', listener, { signal });
}

/** Call back when an element changes its size, until `signal` ends it. */
export function onResize(element, listener, signal) {
  const observer = new ResizeObserver(listener);
  observer.observe(element);
  signal?.addEventListener('abort', () => observer.disconnect());
}

/** Call back once, when an element is first seen, unless `signal` ends it before. */
export function onFirstSeen(element, listener, signal) {
  const observer = new IntersectionObserver((entries) => {
    if (!entries.some(({ isIntersecting }) => isIntersecting)) return;
    observer.disconnect();
    listener();
  });
  observer.observe(element);
  signal?.addEventListener('abort', () => observer.disconnect());
}

/** At most one call a screen frame, however often it is asked for. */
export function oncePerFrame(action) {
  let asked = false;
  return () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => { asked = false; action(); });
  };
}

/** Resolves once the screen shows what the page is now; in a tab that nobody sees, soon. */
export function nextPaint() {
  return new Promise((done) => {
    requestAnimationFrame(() => setTimeout(done));
    setTimeout(done, 200);
  });
}

/** Scroll a list, and nothing around it, until a row of it is seen. The list is its rows' offset parent. */
export function scrollToRow(list, row) {
  const { scrollTop, clientHeight } = list;
  if (!row || !clientHeight) return; // another list is shown
  const top = row.offsetTop;
  if (top < scrollTop || top + row.offsetHeight > scrollTop + clientHeight) list.scrollTop = top - clientHeight / 2;
}

/** A canvas made as sharp as the screen; answers its context, in CSS pixels, with its size. */
export function sharpContext(canvas) {
  const { clientWidth: width, clientHeight: height } = canvas;
  const ratio = devicePixelRatio || 1;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height };
}
