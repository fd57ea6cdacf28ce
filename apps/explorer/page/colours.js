// The colours of kappa^-1: cividis, which looks the same with and without a weakness for red and green, and lighter means
// larger. J. R. Nunez, C. R. Anderton, R. S. Renslow, PLoS ONE 13 (2018) e0199239.

const stops = [
  [0, 34, 78], [18, 53, 112], [59, 73, 108], [87, 93, 109], [112, 113, 115], [138, 134, 120], [165, 156, 116],
  [195, 179, 105], [225, 204, 85], [254, 232, 56],
];

/** 256 colours, each as the number that a pixel of a canvas is. */
export const palette = Uint32Array.from({ length: 256 }, (_, index) => {
  const place = (index / 255) * (stops.length - 1);
  const below = Math.min(Math.floor(place), stops.length - 2);
  const [red, green, blue] = [0, 1, 2].map((k) =>
    Math.round(stops[below][k] + (place - below) * (stops[below + 1][k] - stops[below][k])));
  return (255 << 24) | (blue << 16) | (green << 8) | red;
});
