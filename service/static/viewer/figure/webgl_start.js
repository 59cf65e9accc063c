// A worker that starts WebGL. The first caller waits until the browser has started its graphics, without a graphics card for a
// second or more. The worker waits, so the page does not.

globalThis.OffscreenCanvas && new OffscreenCanvas(1, 1).getContext('webgl2');
postMessage('started');
