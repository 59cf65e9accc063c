// A worker that starts the browser's graphics. The first to ask for WebGL waits for them, on a machine without a graphics
// card for a second or more; the page answers meanwhile, because it is the worker that waits.

globalThis.OffscreenCanvas && new OffscreenCanvas(1, 1).getContext('webgl2');
postMessage('started');
