// One periodic orbit: phase plane, displacement over one period, multipliers, events. The page of an
// orbit shows its own, that of branches the one that was chosen.
//
// An orbit is { T (cycles of the load), Q, V, forcing (period of the load, s), periods, walls,
// events: [{ wall, kind, phase, speed }], multipliers: [[re, im], …] }; walls are { name, side,
// position (m; null where it is not known), rigid }.

/** A complex number; of a pair of conjugates both at once. */
function complexText([re, im], n = 4) {
  return im ? `${digits(re, n)} ${im < 0 ? "−" : "+"} ${digits(Math.abs(im), n)} i` : digits(re, n);
}

function multipliersText(list) {
  const [a, b] = list;
  if (list.length === 2 && a[1] && a[0] === b[0] && a[1] === -b[1])
    return `${digits(a[0])} ± ${digits(Math.abs(a[1]))} i`;
  return list.map((m) => complexText(m)).join(", ");
}

/** Letters of a signature that are shown. */
const SIGNATURE = 40;

/** A signature in words; of a long one its beginning. */
function signatureText(signature, symmetric, events) {
  if (!signature) return "no contact";
  const cut = signature.length > SIGNATURE;
  const text = cut ? `${signature.slice(0, SIGNATURE)}… (${events} events)` : signature;
  return text + (symmetric ? " and mirror" : "");
}

const largestModulus = (list) =>
  list.reduce((most, [re, im]) => Math.max(most, Math.hypot(re, im)), 0);

/** Intervals that a cubic is drawn in. */
const PARTS = 5;

/** The motion with intermediate points: the cubic through both ends with the velocities of both. */
function refined(T, Q, V, forcing) {
  const out = { T: [], Q: [], V: [] };
  const add = (t, q, v) => {
    out.T.push(t);
    out.Q.push(q);
    out.V.push(v);
  };
  for (let i = 0; i < T.length; i++) {
    add(T[i], Q[i], V[i]);
    const h = (T[i + 1] - T[i]) * forcing;
    if (!(h > 0)) continue;
    const [a, b, c, d] = [Q[i], Q[i + 1], h * V[i], h * V[i + 1]];
    for (let k = 1; k < PARTS; k++) {
      const s = k / PARTS;
      const r = 1 - s;
      const q = cubic(a, b, c, d, s);
      const v = (6 * s * r * (b - a) + c * r * (1 - 3 * s) + d * s * (3 * s - 2)) / h;
      add(T[i] + s * (T[i + 1] - T[i]), q, v);
    }
  }
  return out;
}

/**
 * Phase plane and displacement over one period of `shown.orbit`, and a dot at the instant under the
 * pointer in both. Gives the two plots and update(), for another orbit.
 */
function orbitPlots(shown) {
  const look = { colour: () => ink.c1, dash: [], width: 1.7 };
  let [length, fast] = [1, 1];
  let at = null;
  /** In the phase plane x goes to and fro. */
  const closedCurve = (look) => {
    const curve = { kind: "own", look, x: [], y: [], alpha: look.alpha };
    curve.draw = (ctx, plot) => {
      ctx.beginPath();
      curve.x.forEach((x, i) => ctx.lineTo(plot.sx(x), plot.sy(curve.y[i])));
      ctx.stroke();
    };
    return curve;
  };
  const curve = closedCurve(look);
  const line = { kind: "line", look, x: [], y: [] };
  // Another orbit, `shown.over`: thick and pale, beneath.
  const pale = { ...look, width: 3, alpha: 0.4, behind: true };
  const [otherCurve, otherLine] = [closedCurve(pale), { ...line, look: pale, alpha: pale.alpha }];
  const met = {
    kind: "own",
    look,
    x: [],
    y: [],
    draw: (ctx, plot) => drawEvents(ctx, plot, shown, length),
  };
  const portrait = new Plot({
    x: "Displacement",
    y: "Velocity",
    height: 400,
    alt: "The orbit in the phase plane",
    series: [otherCurve, curve],
  });
  const over = new Plot({
    x: "Phase of the load (cycles)",
    y: "Displacement",
    height: 400,
    alt: "Displacement over one period of the orbit",
    view: new View(0, 1),
    series: [otherLine, line, met],
  });
  const plots = [portrait, over];
  const span = (values, axis) => {
    const [lo, hi] = extent(values) || [-1, 1];
    const room = hi - lo || 1;
    // A wall is in the picture unless the orbit stays far from it.
    const near = portrait.marks
      .map((mark) => mark.x)
      .filter((x) => x > lo - 3 * room && x < hi + 3 * room);
    return padded(extent(axis === "q" ? [lo, hi, ...near] : [lo, hi]), 0.08);
  };
  portrait.limits = () => {
    [portrait.X, portrait.Y] = [
      span([...curve.x, ...otherCurve.x], "q"),
      span([...curve.y, ...otherCurve.y], "v"),
    ];
    if (!(portrait.Y[1] > portrait.Y[0])) portrait.Y = [-1, 1];
    if (!(portrait.X[1] > portrait.X[0])) portrait.X = [-1, 1];
  };
  over.range = () => span([...line.y, ...otherLine.y], "q");
  const index = (t) => clamp(before(line.x, t), 0, line.x.length - 1);
  const dot = (ctx, plot, x, y) => drawDot(ctx, plot.sx(x), plot.sy(y), 5, ink.c2);
  const tip = el("div", { class: "tip", hidden: true });
  over.box.append(tip);
  over.hover = (x, place) => {
    const inside = x !== null && x >= line.x[0] && x <= line.x[line.x.length - 1];
    at = inside ? index(x) : null;
    const text =
      at === null
        ? ""
        : `phase ${digits(line.x[at])}\n${portrait.x.replace(/ \(.*/, "")} ${digits(curve.x[at])} ${over.unit}\nvelocity ${digits(curve.y[at])} ${portrait.unit}`;
    showTip(over, tip, text, place);
  };
  portrait.hover = (_, place) => {
    at = null;
    let nearest = 20 ** 2;
    for (let i = 0; place && i < curve.x.length; i++) {
      const distance =
        (portrait.sx(curve.x[i]) - place[0]) ** 2 + (portrait.sy(curve.y[i]) - place[1]) ** 2;
      if (distance < nearest) [nearest, at] = [distance, i % line.x.length];
    }
  };
  portrait.over = (ctx) => at !== null && dot(ctx, portrait, curve.x[at], curve.y[at]);
  over.over = (ctx) => at !== null && dot(ctx, over, line.x[at], line.y[at]);
  const update = () => {
    const { orbit } = shown;
    const largest = (values) => values.reduce((most, x) => Math.max(most, Math.abs(x) || 0), 0);
    const [unit, by] = lengthUnit(largest(orbit.Q));
    const [speed, times] = lengthUnit(largest(orbit.V));
    [length, fast, at] = [by, times, null];
    portrait.x = over.y = `Displacement${orbit.place ? ` at ${orbit.place}` : ""} (${unit})`;
    portrait.y = `Velocity (${speed}/s)`;
    [over.unit, portrait.unit] = [unit, `${speed}/s`];
    const closed = (values, by) =>
      Array.from(values, (x) => x * by).concat(values.length ? [values[0] * by] : []);
    const other = shown.over || { T: [], Q: [], V: [] };
    for (const [of, traced, along] of [
      [orbit, curve, line],
      [other, otherCurve, otherLine],
    ]) {
      [traced.x, traced.y] = [closed(of.Q, length), closed(of.V, fast)];
      [along.x, along.y] = [Array.from(of.T), Array.from(of.Q, (q) => q * length)];
    }
    const mark = (axis) => wallMark(axis, length, ({ rigid }) => !rigid);
    const known = orbit.walls.filter((wall) => wall.position !== null);
    portrait.marks = known.map(mark("x"));
    over.marks = known.map(mark("y"));
    if (line.x.length) {
      over.view.full = padded(extent([...line.x, ...otherLine.x]), 0.03);
      [over.view.lo, over.view.hi] = over.view.full;
    }
    for (const plot of plots) plot.redraw();
  };
  return { portrait, over, update };
}

/** A mark at each event, in the colour of its wall; those of the mirror half are pale. */
function drawEvents(ctx, plot, shown, length) {
  const { events, T, Q } = shown.orbit;
  if (!T.length) return;
  for (const event of events) {
    const turns = shown.orbit.periods;
    // An instant of the motion: it begins with an event, and repeats itself.
    const phase = T[0] + ((((event.phase - T[0]) % turns) + turns) % turns);
    const i = clamp(before(T, phase + 1e-6), 0, T.length - 1);
    ctx.fillStyle = ctx.strokeStyle = placeColour(event.wall);
    drawMarker(
      ctx,
      event.kind === "impact" ? "disc" : "open-square",
      plot.sx(phase),
      plot.sy(Q[i] * length),
      4,
    );
  }
}

/** Multipliers drawn farther out than this stand at the edge, with their number. */
const FAR = 3;

/** The multipliers of `shown.orbit` on the complex plane: inside the unit circle is stable. */
function multiplierPlot(shown) {
  const draw = (ctx, plot) => {
    const [x, y] = [plot.sx(0), plot.sy(0)];
    const radius = plot.sx(1) - x;
    ctx.fillStyle = ink.tint;
    ctx.strokeStyle = ink.wall;
    ctx.lineWidth = 1.5;
    ctx.beginPath();
    ctx.arc(x, y, radius, 0, TURN);
    ctx.fill();
    ctx.stroke();
    for (const [re, im] of shown.orbit.multipliers) {
      const modulus = Math.hypot(re, im);
      if (!Number.isFinite(modulus)) continue;
      const out = modulus > 1;
      ctx.fillStyle = ctx.strokeStyle = out ? ink.c2 : ink.c1;
      const beyond = modulus > FAR ? FAR / modulus : 1;
      const place = [plot.sx(re * beyond), plot.sy(im * beyond)];
      drawMarker(ctx, out ? "diamond" : "disc", ...place, 4.6);
      if (beyond < 1) {
        drawArrow(ctx, ...place, (18 * re) / modulus, (-18 * im) / modulus, ink.c2);
        drawLabel(ctx, complexText([re, im], 2), place[0], place[1] - 18, "center");
      }
    }
  };
  const plot = new Plot({
    x: "Real part",
    y: "Imaginary part",
    height: 330,
    alt: "Floquet multipliers and the unit circle",
    series: [{ kind: "own", look: lookOf(0), x: [], y: [], draw }],
  });
  plot.limits = () => {
    const [w, h] = [plot.x1 - plot.x0, plot.y1 - plot.y0];
    const reach = 1.22 * clamp(largestModulus(shown.orbit.multipliers) || 1, 1, FAR);
    const unit = (2 * reach) / Math.min(w, h);
    [plot.X, plot.Y] = [w, h].map((side) => [(-unit * side) / 2, (unit * side) / 2]);
  };
  return plot;
}

/** A table of few rows. */
const plainTable = (header, rows) =>
  el(
    "div",
    { class: "scroll", tabindex: 0 },
    el(
      "table",
      { class: "plain" },
      el(
        "thead",
        {},
        el(
          "tr",
          {},
          header.map((name) => el("th", { scope: "col" }, name)),
        ),
      ),
      el(
        "tbody",
        {},
        rows.map((cells) =>
          el(
            "tr",
            {},
            cells.map((cell) => el("td", {}, cell)),
          ),
        ),
      ),
    ),
  );

/** The events of an orbit as a table. */
function eventTable(orbit) {
  if (!orbit.events.length) return el("p", {}, "The motion meets no wall.");
  const rows = orbit.events.map((event, i) => [
    String(i + 1),
    event.wall,
    event.kind,
    digits(event.phase - Math.floor(event.phase), 7),
    event.kind === "release" ? "–" : digits(event.speed, 6),
  ]);
  return plainTable(["Event", "Wall", "Kind", "Phase (cycles)", "Speed (m/s)"], rows);
}
