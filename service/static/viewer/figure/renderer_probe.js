// What draws WebGL here: a graphics card, or the browser's own software.

const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i; // renderers without a graphics card

let renderer = null;

/** Have a worker start WebGL, once; resolves to the name of the renderer, or to nothing if the worker fails. */
export function probeRenderer() {
  renderer ??= new Promise((done) => {
    const worker = new Worker(new URL('./webgl_probe.js', import.meta.url));
    worker.onmessage = worker.onerror = ({ data }) => { worker.terminate(); done(data); };
  });
  return renderer;
}

/** Whether a renderer of this name is software. */
export const isSoftware = (name) => SOFTWARE.test(name);
