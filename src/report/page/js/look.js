// Colours, dashes and markers: those of the SVG figures, and a second palette for dark ground whose
// eight colours differ under every kind of colour blindness.

const DASHES = [
  [],
  [7, 2.5],
  [2, 2],
  [7, 2, 1.5, 2],
  [12, 3],
  [4, 1.5],
  [9, 2, 1.5, 2, 1.5, 2],
  [1.2, 1.6],
];
const MARKERS = [
  "disc",
  "square",
  "triangle",
  "diamond",
  "cross",
  "ring",
  "open-square",
  "down",
  "open-diamond",
  "plus",
];

/** The colours of the theme, by their names in page.css. */
const ink = {};
let hatching = null;
let printing = false;

function readInks() {
  const style = getComputedStyle(root);
  const names =
    "paper sheet ink soft faint line grid accent wall hatch mind bad good reference mass " +
    "body tint text c0 c1 c2 c3 c4 c5 c6 c7";
  for (const name of names.split(" ")) ink[name] = style.getPropertyValue("--" + name).trim();
  hatching = null;
}

/** The look of the n-th curve; a reference is a broad pale band behind the others. */
function lookOf(n, reference = false) {
  if (reference)
    return { colour: () => ink.reference, dash: [], width: 4.2, marker: "ring", behind: true };
  return {
    colour: () => ink["c" + (n % 8)],
    dash: DASHES[(n + Math.floor(n / 8)) % 8],
    width: 1.5,
    marker: MARKERS[n % MARKERS.length],
  };
}

/** The support that the wall of that name is a flat of, or the wall itself. */
const placeOf = (wall) => wall.replace(/-flat-\d+$/, "");

/** The names of walls and supports, whose colours follow one another as in the SVG figures. */
const PLACES = (() => {
  const { walls = [], supports = [] } =
    DATA.scene || DATA.sweep || DATA.wear || DATA.orbit || DATA.continue || {};
  // The walls of one orbit have their names as `wall`; those of supports come with these.
  const [ofWalls, ofSupports] = [walls, supports].map((all) =>
    all.map(({ name, wall }) => placeOf(name ?? wall)),
  );
  const own = ofWalls.filter((name) => !ofSupports.includes(name));
  return [...new Set([...own, ...ofSupports])];
})();
const PLACE_COLOURS = [1, 2, 3, 5, 4, 6, 7, 0];

/** The colour of the wall or support of that name, one in all drawings; a flat's is its support's. */
const placeColour = (name) =>
  ink["c" + PLACE_COLOURS[Math.max(0, PLACES.indexOf(placeOf(name))) % PLACE_COLOURS.length]];

/** The colour of the rows of a sweep along rising (up) or falling (down) values. */
const directionColour = (direction) => (direction === "down" ? ink.c2 : ink.c1);

const isDark = () => root.dataset.theme === "dark";
const font = (share = 1) => `${share * (printing ? 10 : 12)}px ${ink.text}`;

/** A colour of the theme (#rrggbb) that lets the ground through. */
const clear = (hex, alpha) =>
  hex +
  Math.round(255 * alpha)
    .toString(16)
    .padStart(2, "0");

const OPEN_SHAPES = { ring: "disc", "open-square": "square", "open-diamond": "diamond" };

/** A marker of radius r in the current colours of the context. */
function drawMarker(ctx, kind, x, y, r) {
  const shape = OPEN_SHAPES[kind] || kind;
  const d = 1.3 * r;
  const outlines = {
    square: [
      [-r, -r],
      [r, -r],
      [r, r],
      [-r, r],
      [-r, -r],
    ],
    triangle: [
      [0, -d],
      [d, r],
      [-d, r],
      [0, -d],
    ],
    down: [
      [0, d],
      [d, -r],
      [-d, -r],
      [0, d],
    ],
    diamond: [
      [0, -d],
      [d, 0],
      [0, d],
      [-d, 0],
      [0, -d],
    ],
  };
  const strokes = {
    plus: [
      [-d, 0],
      [d, 0],
      [0, -d],
      [0, d],
    ],
    cross: [
      [-r, -r],
      [r, r],
      [-r, r],
      [r, -r],
    ],
  };
  ctx.beginPath();
  if (strokes[shape]) {
    strokes[shape].forEach(([a, b], i) =>
      i % 2 ? ctx.lineTo(x + a, y + b) : ctx.moveTo(x + a, y + b),
    );
    ctx.lineWidth = 1.5;
    ctx.stroke();
    return;
  }
  if (shape === "disc") ctx.arc(x, y, r, 0, TURN);
  else
    outlines[shape].forEach(([a, b], i) =>
      i ? ctx.lineTo(x + a, y + b) : ctx.moveTo(x + a, y + b),
    );
  if (OPEN_SHAPES[kind]) {
    ctx.save();
    ctx.fillStyle = ink.paper;
    ctx.fill();
    ctx.restore();
    ctx.lineWidth = 1.3;
    ctx.stroke();
  } else {
    ctx.fill();
  }
}

/** A dot with a rim in the colour of the ground. */
function drawDot(ctx, x, y, r, colour, rim = 1.5) {
  ctx.fillStyle = colour;
  ctx.strokeStyle = ink.paper;
  ctx.lineWidth = rim;
  ctx.beginPath();
  ctx.arc(x, y, r, 0, TURN);
  ctx.fill();
  ctx.stroke();
}

/** A ring about a point that is pointed at. */
function drawRing(ctx, x, y, r, colour) {
  ctx.strokeStyle = colour;
  ctx.lineWidth = 2;
  ctx.beginPath();
  ctx.arc(x, y, r, 0, TURN);
  ctx.stroke();
}

/** The pattern of what a wall keeps the body out of. */
function hatch(ctx) {
  if (hatching) return hatching;
  const tile = el("canvas", { width: 14, height: 14 });
  const pen = tile.getContext("2d");
  pen.strokeStyle = ink.hatch;
  pen.lineWidth = 1.5;
  pen.beginPath();
  for (const k of [-14, 0, 14]) {
    pen.moveTo(k - 1, 15);
    pen.lineTo(k + 15, -1);
  }
  pen.stroke();
  hatching = ctx.createPattern(tile, "repeat");
  hatching.setTransform(new DOMMatrix().scale(0.5));
  return hatching;
}

/** An arrow from (x, y) by (dx, dy). */
function drawArrow(ctx, x, y, dx, dy, colour, width = 2) {
  const length = Math.hypot(dx, dy);
  if (!(length >= 2)) return;
  const [ux, uy] = [dx / length, dy / length];
  const head = Math.min(8, 0.6 * length);
  const [tx, ty] = [x + dx, y + dy];
  ctx.save();
  ctx.strokeStyle = ctx.fillStyle = colour;
  ctx.lineWidth = width;
  ctx.beginPath();
  ctx.moveTo(x, y);
  ctx.lineTo(tx - 0.8 * head * ux, ty - 0.8 * head * uy);
  ctx.stroke();
  ctx.beginPath();
  ctx.moveTo(tx, ty);
  ctx.lineTo(tx - head * (ux + 0.5 * uy), ty - head * (uy - 0.5 * ux));
  ctx.lineTo(tx - head * (ux - 0.5 * uy), ty - head * (uy + 0.5 * ux));
  ctx.fill();
  ctx.restore();
}

/** Text on a ground of its own, so that curves do not cross it. */
function drawLabel(ctx, text, x, y, align = "left") {
  const width = ctx.measureText(text).width;
  const left = align === "right" ? x - width : align === "center" ? x - width / 2 : x;
  ctx.save();
  ctx.fillStyle = clear(ink.paper, 0.86);
  ctx.beginPath();
  ctx.roundRect(left - 4, y - 8, width + 8, 16, 3);
  ctx.fill();
  ctx.fillStyle = ink.soft;
  ctx.textAlign = "left";
  ctx.textBaseline = "middle";
  ctx.fillText(text, left, y + 0.5);
  ctx.restore();
}

const mixed = (a, b, t) => a.map((x, i) => Math.round(x + t * (b[i] - x)));

/** The tone of a share from −1 to 1: blue below, orange above, the ground between. */
function divergingTone(share) {
  const zero = isDark() ? [28, 31, 35] : [250, 250, 248];
  const ends = isDark()
    ? [
        [88, 176, 232],
        [255, 150, 80],
      ]
    : [
        [0, 98, 160],
        [205, 88, 0],
      ];
  return mixed(zero, ends[share < 0 ? 0 : 1], Math.min(1, Math.abs(share)) ** 0.8);
}

const RAMPS = {
  light: [
    [247, 247, 235],
    [190, 215, 190],
    [100, 165, 185],
    [45, 90, 150],
    [20, 20, 70],
  ],
  dark: [
    [26, 30, 46],
    [38, 66, 110],
    [62, 122, 156],
    [140, 190, 170],
    [246, 246, 220],
  ],
};

/** The tone of a share from 0 to 1. */
function rampTone(share) {
  const ramp = RAMPS[isDark() ? "dark" : "light"];
  const place = clamp(share, 0, 1) * (ramp.length - 1);
  const i = Math.min(ramp.length - 2, Math.floor(place));
  return mixed(ramp[i], ramp[i + 1], place - i);
}
