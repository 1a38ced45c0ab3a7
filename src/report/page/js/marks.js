// The labels of lines across a plot, where no other one stands.

/** Points of a curve beyond this number are not looked at one by one. */
const LOOKED_AT = 2000;

/** The parts of the frame that curves cover: rectangles [x, y, w, h]. */
function coveredByCurves(plot) {
  return plot.shown
    .filter((s) => s.kind !== "own")
    .flatMap((s) => {
      const from = plot.view ? Math.max(0, before(s.x, plot.X[0])) : 0;
      const to = plot.view ? Math.min(s.x.length, before(s.x, plot.X[1]) + 2) : s.x.length;
      const stride = Math.max(1, Math.ceil((to - from) / LOOKED_AT));
      const spots = [];
      for (let k = from; k < to; k += stride)
        if (Number.isFinite(s.y[k])) spots.push([plot.sx(s.x[k]), clamp(plot.sy(s.y[k]), -1e3, 1e3)]);
      return covered(spots);
    });
}

/** The places for the label of a mark, the best first: [x, y, alignment]. */
function markPlaces(plot, mark, width) {
  const { x0, x1, y0, y1 } = plot;
  if (mark.x === undefined) {
    const height = plot.sy(mark.y);
    if (height < y0 - 1 || height > y1 + 1) return [];
    const at = (off) => clamp(plot.sy(mark.y) + off, y0 + 8, y1 - 8);
    const ends = [mark.side === "lower" ? 9 : -9].flatMap((off) => [
      [x1 - 9, at(off), "right"],
      [x0 + 9, at(off), "left"],
    ]);
    if (mark.side) return ends;
    const along = [0.25, 0.5, 0.75].map((share) => x0 + share * (x1 - x0 - width));
    return [...ends, ...along.flatMap((x) => [[x, at(-9), "left"], [x, at(9), "left"]])];
  }
  const x = plot.sx(mark.x);
  if (x < x0 || x > x1) return [];
  const sides = [
    [x + 8, "left"],
    [x - 8, "right"],
  ].filter(([at, align]) => (align === "left" ? at + width < x1 : at - width > x0));
  const rows = Array.from({ length: Math.floor((y1 - y0 - 22) / 17) + 1 }, (_, k) => y1 - 11 - 17 * k);
  return sides.flatMap(([at, align]) => rows.map((y) => [at, y, align]));
}

/** Draws the labels of marks: those of walls at an end of the wall, others where they hide least. */
function drawMarkLabels(ctx, plot) {
  const named = plot.marks.filter(({ label }) => label);
  const lines = named.some(({ side }) => !side) ? coveredByCurves(plot) : [];
  const taken = [];
  for (const mark of named.sort((a, b) => !a.side - !b.side)) {
    const width = ctx.measureText(mark.label).width + 8;
    const boxOf = ([x, y, align]) => [align === "right" ? x - width + 4 : x - 4, y - 8, width, 16];
    const places = markPlaces(plot, mark, width);
    const free = places.filter((place) => !taken.some((other) => overlap(boxOf(place), other)));
    const hidden = (place) => lines.filter((part) => overlap(boxOf(place), part)).length;
    const place = !mark.side && free.length ? leastBy(free, hidden) : free[0] || places[0];
    if (!place) continue;
    taken.push(boxOf(place));
    drawLabel(ctx, mark.label, ...place);
  }
}
