// Colours of motions. Twelve that stay apart for every kind of colour vision (found by search: the nearest pair is
// 0.096 apart in OKLab under simulated protanopia, deuteranopia and tritanopia; tests/browser/test_palette.py measures it),
// then the same twelve with stripes, then with dots. A name always stands beside a colour.

export const COLOURS = [
  '#4a85ee', '#e36927', '#176c5f', '#fadb86', '#a860af', '#b1c426',
  '#9deef9', '#b23308', '#8a9784', '#f0acad', '#6a40b0', '#8fb8fe',
];

const luminance = (hex) => {
  const linear = [1, 3, 5].map((i) => {
    const c = parseInt(hex.slice(i, i + 2), 16) / 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
};

export const motionColour = (motion) => COLOURS[motion % COLOURS.length];

/** Black or white, whichever is read more easily on the colour. */
export const inkOver = (hex) => (luminance(hex) > 0.179 ? '#000000' : '#ffffff');

/** Which texture goes over the colour: 0 none, 1 stripes, 2 dots, 3 both ways striped, then again. */
export const textureNumber = (motion) => Math.floor(motion / COLOURS.length) % 4;

const tiles = new Map();

/** A canvas fill of a motion: its colour and, from the thirteenth motion on, its texture. */
export const motionFill = (motion, context) => texturedFill(motionColour(motion), textureNumber(motion), context);

/** A canvas fill of a colour, with a texture over it unless its number is 0. */
export const texturedFill = (colour, texture, context) => (texture ? context.createPattern(tileOf(colour, texture), 'repeat') : colour);

function tileOf(colour, texture) {
  const key = `${colour} ${texture}`;
  if (!tiles.has(key)) tiles.set(key, drawTile(colour, texture));
  return tiles.get(key);
}

function drawTile(colour, texture) {
  const tile = document.createElement('canvas');
  tile.width = tile.height = 12;
  const context = tile.getContext('2d');
  context.fillStyle = colour;
  context.fillRect(0, 0, 12, 12);
  context.strokeStyle = context.fillStyle = inkOver(colour);
  context.globalAlpha = 0.45;
  context.lineWidth = 2;
  const stroke = (points) => { context.beginPath(); points.forEach(([x, y], i) => (i % 2 ? context.lineTo(x, y) : context.moveTo(x, y))); context.stroke(); };
  if (texture === 1 || texture === 3) stroke([[-3, 9], [9, -3], [3, 15], [15, 3]]);
  if (texture === 3) stroke([[-3, 3], [9, 15], [3, -3], [15, 9]]);
  if (texture === 2) { context.beginPath(); context.arc(6, 6, 2.5, 0, 7); context.fill(); }
  return tile;
}

/** The same fill for lists; the style sheet draws the textures. */
export const motionSwatch = (motion) => swatchOf(motionColour(motion), textureNumber(motion));

/** A mark of a colour with a texture. */
export function swatchOf(colour, texture) {
  const mark = document.createElement('i');
  mark.className = 'swatch';
  mark.setAttribute('aria-hidden', 'true');
  mark.style.backgroundColor = colour;
  mark.dataset.texture = texture;
  mark.style.color = inkOver(colour);
  return mark;
}

/** Write a segment's name into an element, on its motion's colour. */
export function writeTag(element, segment) {
  element.textContent = segment.name;
  element.style.background = motionColour(segment.motion);
  element.style.color = inkOver(motionColour(segment.motion));
}
