// Asked in a worker of its own: who draws WebGL here. The first to ask waits until the browser has started its graphics,
// seconds on a slow machine, and the page had better not be that one.

const gl = globalThis.OffscreenCanvas && new OffscreenCanvas(1, 1).getContext('webgl2');
const names = gl?.getExtension('WEBGL_debug_renderer_info');
postMessage(gl ? gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER) : '');
