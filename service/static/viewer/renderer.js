// The WebGL renderer, as fine as this machine draws it smoothly: without a graphics card there is no anti-aliasing,
// and a pixel is a pixel.

import { WebGLRenderer } from 'three';
import { drawnBySoftware } from './software.js';

const FINEST = 2; // pixels to a CSS pixel; more is not seen

export function rendererOn(canvas) {
  const slow = drawnBySoftware();
  const renderer = new WebGLRenderer({ canvas, antialias: !slow, alpha: true, stencil: false });
  renderer.setPixelRatio(slow ? 1 : Math.min(devicePixelRatio, FINEST));
  return renderer;
}
