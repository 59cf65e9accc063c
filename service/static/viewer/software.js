// Whether this machine draws by its processor, for want of a graphics card.

const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

let asked = null;
let slow = false;

/** Find out; resolves once it is known. What cannot be found out is taken for a graphics card. */
export function askGraphics() {
  asked ??= new Promise((done) => {
    const worker = new Worker(new URL('./graphics.js', import.meta.url));
    worker.onmessage = ({ data }) => { slow = SOFTWARE.test(data); worker.terminate(); done(); };
    worker.onerror = () => done();
  });
  return asked;
}

/** Whether it does, as far as `askGraphics` has found out. */
export const drawnBySoftware = () => slow;
