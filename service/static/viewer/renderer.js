// The WebGL renderer, as fine as this machine draws it smoothly: without a graphics card there is no anti-aliasing,
// and a pixel is a pixel.

import { WebGLRenderer } from 'three';

const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;
let software = null;
const FINEST = 2; // pixels to a CSS pixel; more is not seen

export function rendererOn(canvas) {
  const slow = drawnBySoftware();
  const renderer = new WebGLRenderer({ canvas, antialias: !slow, alpha: true, stencil: false });
  renderer.setPixelRatio(slow ? 1 : Math.min(devicePixelRatio, FINEST));
  return renderer;
}

/** Whether this machine draws by its processor. */
export function drawnBySoftware() {
  software ??= softwareDraws();
  return software;
}

function softwareDraws() {
  const gl = document.createElement('canvas').getContext('webgl2');
  if (!gl) return false; // the renderer itself will say what is missing
  const names = gl.getExtension('WEBGL_debug_renderer_info');
  const name = gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return SOFTWARE.test(name);
}
