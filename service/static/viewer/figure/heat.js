// Colours of strain. At rest the body's own clay, then through amber and vermilion to a dark violet: lightness falls
// all the way, so that the order is read without telling hues apart.

export const HEAT = ['#d5d2ca', '#f0c15a', '#e8712e', '#ae1f57', '#43106b'];

/** Colour moves with strain to this power: most of a body is strained a little, and a little should be seen. */
export const BEND = 0.7;

/** The key to the heat colours. A gradient of the style: the first canvas of a page has it wait for the graphics. */
export function drawHeatKey() {
  document.querySelector('#heat i').style.background = `linear-gradient(to right, ${HEAT.join(', ')})`;
}
