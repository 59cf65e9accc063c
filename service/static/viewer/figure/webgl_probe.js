// A worker that starts WebGL and posts the name of its renderer. The first caller waits until the browser has started its
// graphics, without a graphics card for a second or more. The worker waits, so the page does not.

const gl = globalThis.OffscreenCanvas && new OffscreenCanvas(1, 1).getContext('webgl2');
const names = gl?.getExtension('WEBGL_debug_renderer_info');
postMessage(gl ? gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER) : '');
