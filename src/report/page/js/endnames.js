// The names of curves at their ends, where neither a name nor a point stands.

/** Pixels between the places that are tried along a line, and between a marker and its name. */
const ALONG = 8;
const ASIDE = 8;
const NAME_HEIGHT = 15;

/** The parts of the frame that a curve through these pixels covers: rectangles [x, y, w, h]. */
function covered(spots) {
  return spots.flatMap(([x, y], k) => {
    const [a, b] = spots[k + 1] || [x, y];
    const parts = Math.max(1, Math.ceil(Math.hypot(a - x, b - y) / ALONG));
    return Array.from({ length: parts }, (_, part) => [
      x + ((a - x) * part) / parts - ALONG / 2,
      y + ((b - y) * part) / parts - ALONG / 2,
      ALONG,
      ALONG,
    ]);
  });
}

/** The first of those for which `of` is least. */
const leastBy = (list, of) => {
  const values = list.map(of);
  return list[values.indexOf(Math.min(...values))];
};

const overlap = ([x, y, w, h], [a, b, c, d]) => x < a + c && a < x + w && y < b + d && b < y + h;

/** Which edge of the plot all points of a curve lie beyond; "" where one lies between them. */
function beyondOf(plot, x) {
  if (x.some((value) => value >= plot.X[0] && value <= plot.X[1])) return "";
  return extent(x)[1] < plot.X[0] ? "left" : "right";
}

/** The names of curves as a list, for a plot too narrow for them. */
function namesBeside(plot, curves) {
  return curves.map(({ x, name, look }) => {
    const beyond = beyondOf(plot, x);
    const where = beyond ? `, beyond the ${beyond} edge` : "";
    const value = beyond === "left" ? `: ${digits(extent(x)[1], 1)}` : "";
    return el("li", {}, sampleOf(look, true), el("span", {}, `${name}${value}${where}`));
  });
}

/**
 * Draws the names of curves: `curves` is a list of { x, y, name, look }. A curve that lies beyond
 * the axis is named at its edge, with an arrow and, on the left, its value. `others` are curves
 * without names.
 */
function drawEndNames(ctx, plot, curves, others) {
  const spotsOf = (s) =>
    s.x
      .map((x, k) => [x, plot.sy(s.y[k])])
      .filter(([x]) => x >= plot.X[0] && x <= plot.X[1])
      .map(([x, y]) => [plot.sx(x), y]);
  const upright = plot.marks.filter(({ x }) => x !== undefined).map(({ x }) => plot.sx(x));
  const lines = [
    ...curves.map(spotsOf),
    ...others.map(({ x, y }) => x.map((at, k) => [plot.sx(clamp(at, ...plot.X)), plot.sy(y[k])])),
    ...upright.map((x) => [
      [x, plot.y0],
      [x, plot.y1],
    ]),
  ];
  const taken = lines.flatMap(covered);
  const [names, put] = [[], []];
  const inFrame = ([x, y, w, h]) =>
    x >= plot.x0 + 2 && x + w <= plot.x1 - 2 && y >= plot.y0 + 2 && y + h <= plot.y1 - 2;
  const apart = (parts) => (place) => !parts.some((part) => overlap(place, part));
  ctx.textBaseline = "middle";
  ctx.textAlign = "left";
  ctx.lineJoin = "round";
  for (const s of curves) {
    const own = spotsOf(s).sort(([, y], [, other]) => y - other);
    const most = extent(s.x)[1];
    const beyond = beyondOf(plot, s.x);
    const edge = beyond === "left" ? plot.x0 + ASIDE - 2 : plot.x1 - ASIDE + 2;
    const ends = own.length ? [own[0], own[own.length - 1]] : [[edge, plot.sy(Math.max(...s.y))]];
    const text = { "": s.name, left: `◂ ${s.name} (${digits(most, 1)})`, right: `${s.name} ▸` }[beyond];
    const [w, h] = [ctx.measureText(text).width, NAME_HEIGHT];
    const around = ([x, y], shift) => [
      [x + ASIDE, y - h / 2 + shift, w, h],
      [x - ASIDE - w, y - h / 2 + shift, w, h],
      [x - w / 2, y - ASIDE - h + shift, w, h],
      [x - w / 2, y + ASIDE + shift, w, h],
    ];
    // Farther and farther along the frame, where the ends are crowded.
    const places = Array.from({ length: 40 }, (_, k) => [10 * k, -10 * k])
      .flat()
      .flatMap((shift) => ends.flatMap((end) => around(end, shift).map((box) => ({ box, end, shift }))));
    // Over as little of lines as can be where there is no room beside all of them, over no name.
    const within = places.filter(({ box }) => inFrame(box)).filter(({ box }) => apart(names)(box));
    const hidden = ({ box }) => taken.filter((part) => overlap(box, part)).length;
    const place = within.find(({ box }) => apart(taken)(box)) || leastBy(within, hidden);
    if (!place) continue;
    names.push(place.box);
    put.push({ ...place, text, colour: s.look.colour(), apart: !beyond && Math.abs(place.shift) >= NAME_HEIGHT });
  }
  put.filter((name) => name.apart).forEach((name) => drawLeader(ctx, name));
  put.forEach((name) => drawName(ctx, name));
}

/** A thin line from a name that stands apart from its curve to the end that it names. */
function drawLeader(ctx, { box: [x, y, w, h], end, colour }) {
  ctx.save();
  ctx.strokeStyle = colour;
  ctx.lineWidth = 0.8;
  ctx.setLineDash([]);
  ctx.beginPath();
  ctx.moveTo(clamp(end[0], x, x + w), clamp(end[1], y + 1, y + h - 1));
  ctx.lineTo(...end);
  ctx.stroke();
  ctx.restore();
}

function drawName(ctx, { box, text, colour }) {
  const [x, y] = [box[0], box[1] + box[3] / 2];
  ctx.strokeStyle = ink.paper;
  ctx.lineWidth = 4;
  ctx.strokeText(text, x, y);
  ctx.fillStyle = colour;
  ctx.fillText(text, x, y);
}
