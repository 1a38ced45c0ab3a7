// The kinds of curves of a plot.

/** Rows of a block of the coarser copy of a long series. */
const BLOCK = 64;
const coarser = new WeakMap();

/** Least and largest finite value of every block of a series: what is drawn of it where it is dense. */
function blocksOf(values) {
  if (!coarser.has(values)) {
    const count = Math.ceil(values.length / BLOCK);
    const [least, most] = [
      new Float64Array(count).fill(Infinity),
      new Float64Array(count).fill(-Infinity),
    ];
    for (let i = 0; i < values.length; i++) {
      if (!Number.isFinite(values[i])) continue;
      const block = Math.floor(i / BLOCK);
      if (values[i] < least[block]) least[block] = values[i];
      if (values[i] > most[block]) most[block] = values[i];
    }
    coarser.set(values, { least, most });
  }
  return coarser.get(values);
}

/** A polyline; where points crowd, the first, least, largest and last of each column of pixels. */
function drawLine(ctx, plot, s) {
  const from = plot.view ? Math.max(0, before(s.x, plot.X[0])) : 0;
  const to = plot.view ? Math.min(s.x.length, before(s.x, plot.X[1]) + 2) : s.x.length;
  ctx.beginPath();
  let pen = false;
  const point = (x, y) => {
    if (pen) ctx.lineTo(x, y);
    else ctx.moveTo(x, y);
    pen = true;
  };
  if (to - from < 3 * (plot.x1 - plot.x0)) {
    for (let i = from; i < to; i++) {
      if (Number.isFinite(s.y[i])) point(plot.sx(s.x[i]), plot.sy(s.y[i]));
      else pen = false;
    }
    ctx.stroke();
    return;
  }
  ctx.setLineDash([]);
  const { least, most } = blocksOf(s.y);
  const scale = (plot.x1 - plot.x0) / (plot.X[1] - plot.X[0]);
  for (let column = 0, i = from; i < to; column++) {
    // The rows of this column of pixels.
    const edge = plot.X[0] + (column + 1) / scale;
    const next = s.x[i] >= edge ? i : Math.min(to, Math.max(i + 1, before(s.x, edge) + 1));
    if (next === i) continue;
    let [lo, hi] = [Infinity, -Infinity];
    for (let k = i; k < next;) {
      const block = k / BLOCK;
      const whole = Number.isInteger(block) && k + BLOCK <= next;
      const [a, b] = whole ? [least[block], most[block]] : [s.y[k], s.y[k]];
      if (a < lo && a !== -Infinity) lo = a;
      if (b > hi && b !== Infinity) hi = b;
      k += whole ? BLOCK : 1;
    }
    if (lo <= hi) {
      const x = plot.x0 + column + 0.5;
      for (const y of [s.y[i], lo, hi, s.y[next - 1]]) if (Number.isFinite(y)) point(x, plot.sy(y));
    }
    i = next;
  }
  ctx.stroke();
}

function drawStems(ctx, plot, s) {
  const from = Math.max(0, before(s.x, plot.X[0]));
  const to = before(s.x, plot.X[1]) + 1;
  const dense = (to - from) * plot.shown.length > (plot.x1 - plot.x0) / 5;
  const zero = plot.sy(0);
  ctx.lineWidth = dense ? 1 : 1.4;
  ctx.globalAlpha = dense ? 0.7 : 1;
  ctx.beginPath();
  for (let i = from; i < to; i++) {
    ctx.moveTo(plot.sx(s.x[i]), zero);
    ctx.lineTo(plot.sx(s.x[i]), plot.sy(s.y[i]));
  }
  ctx.stroke();
  if (dense) return;
  for (let i = from; i < to; i++)
    drawMarker(ctx, s.marker || "disc", plot.sx(s.x[i]), plot.sy(s.y[i]), 2.6);
}

function drawPoints(ctx, plot, s) {
  for (let i = 0; i < s.x.length; i++) {
    if (!Number.isFinite(s.y[i])) continue;
    drawMarker(ctx, s.marker || s.look.marker, plot.sx(s.x[i]), plot.sy(s.y[i]), s.size || 3);
  }
}

/** The height of a value; of −∞ and ∞ at the edge of the frame. */
const edgeOf = (plot, y) =>
  y === -Infinity ? plot.y1 - 8 : y === Infinity ? plot.y0 + 8 : plot.sy(y);

/** Values of −∞ and ∞, which no axis holds: a triangle and the sign at the edge of the frame. */
function drawInfinite(ctx, plot, s) {
  ctx.textAlign = "center";
  ctx.textBaseline = "middle";
  for (let i = 0; i < s.x.length; i++) {
    if (Math.abs(s.y[i]) !== Infinity) continue;
    const [x, y, below] = [plot.sx(s.x[i]), edgeOf(plot, s.y[i]), s.y[i] < 0];
    drawMarker(ctx, below ? "down" : "triangle", x, y, 3.4);
    ctx.fillText(digits(s.y[i]), clamp(x, plot.x0 + 12, plot.x1 - 12), y + (below ? -13 : 13));
  }
}

/** A curve in the phase plane, of the stretch of time in view. */
function drawOrbit(ctx, plot, s) {
  const from = Math.max(0, before(s.t, s.view.lo));
  const to = Math.min(s.t.length, before(s.t, s.view.hi) + 2);
  ctx.lineWidth = 1;
  ctx.beginPath();
  for (let i = from; i < to; i++) {
    if (i === from) ctx.moveTo(plot.sx(s.x[i]), plot.sy(s.y[i]));
    else ctx.lineTo(plot.sx(s.x[i]), plot.sy(s.y[i]));
  }
  ctx.stroke();
}

/** Bars of a histogram: several groups side by side in each bin. */
function drawBars(ctx, plot, s) {
  for (let i = 0; i < s.x.length; i++) {
    if (!(s.y[i] > 0)) continue;
    const left = plot.sx(s.x[i] + s.group[0] * s.bin);
    const right = plot.sx(s.x[i] + s.group[1] * s.bin);
    const top = plot.sy(s.y[i]);
    ctx.fillRect(left, top, Math.max(1, right - left - 0.5), plot.sy(0) - top);
  }
}
