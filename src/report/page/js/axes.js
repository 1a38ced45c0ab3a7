// Ticks, the stretch of an axis that plots share, and when what is drawn.

/** Ticks of a linear axis: [value, text]. */
function linearTicks(lo, hi, room) {
  const rough = (hi - lo) / Math.max(room, 2.2);
  const power = 10 ** Math.floor(Math.log10(rough));
  const first = (step) => Math.ceil(lo / step - 1e-9);
  const count = (step) => Math.floor(hi / step + 1e-9) - first(step) + 1;
  const steps = [0.2, 0.5, 1, 2, 5, 10].map((k) => k * power);
  let i = steps.findIndex((step) => step >= rough * (1 - 1e-9));
  // One number on an axis is no scale.
  while (i > 0 && count(steps[i]) < 2) i--;
  const step = steps[Math.max(i, 0)];
  const places = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const values = [];
  for (let k = first(step), n = Math.min(count(step), 100); n > 0; k++, n--)
    values.push(Math.abs(k * step) < 1e-6 * step ? 0 : k * step);
  const long = places > 5 || values.some((x) => Math.abs(x) >= 1e6);
  const apart = long && digitsApart(values.map((x) => +x.toPrecision(12)));
  return values.map((x) => [x, long ? digits(+x.toPrecision(12), apart) : minus(x.toFixed(places))]);
}

/** Ticks of a logarithmic axis: [value, text]; decades, and 2 and 5 within where there are few. */
function logTicks(lo, hi, room) {
  const [a, b] = [Math.ceil(Math.log10(lo) - 1e-9), Math.floor(Math.log10(hi) + 1e-9)];
  if (b - a < 1) return linearTicks(lo, hi, room).filter(([x]) => x > 0);
  const every = Math.max(1, Math.ceil((b - a + 1) / Math.max(room, 2)));
  const ticks = [];
  for (let k = a; k <= b; k += every)
    ticks.push([
      10 ** k,
      Math.abs(k) < 4 ? String(+(10 ** k).toFixed(3)) : `10${raised(k)}`,
    ]);
  return ticks;
}

/** A stretch longer than this share of an axis is not worth hiding the rest for. */
const MOST_OF_ALL = 0.7;

/** A stretch of an axis, of a logarithmic one with `log`, that several plots share. */
class View {
  constructor(lo, hi, log = false) {
    this.full = [lo, hi];
    this.log = log;
    [this.lo, this.hi] = [lo, hi];
    this.listeners = [];
  }

  set(lo, hi) {
    const whole = this.full[1] - this.full[0];
    const width = clamp(hi - lo, 1e-6 * whole, whole);
    this.lo = clamp(lo, this.full[0], this.full[1] - width);
    this.hi = this.lo + width;
    this.listeners.forEach((listener) => listener());
  }

  /**
   * Begins on the stretch about these values, where it is much shorter than the whole: "all". With a
   * share, else on the shortest stretch that holds this share of them: "most". Else undefined.
   */
  beginAbout(values, share = 1) {
    const sorted = Array.from(values).sort((a, b) => a - b);
    const whole = this.full[1] - this.full[0];
    const about = ([lo, hi]) => {
      const width = Math.max(1.3 * (hi - lo), 0.1 * whole);
      if (!(width < MOST_OF_ALL * whole)) return false;
      this.set((lo + hi - width) / 2, (lo + hi + width) / 2);
      return true;
    };
    if (about(extent(sorted) || this.full)) return "all";
    const few = Math.ceil(share * sorted.length);
    const stretches = sorted.slice(few - 1).map((hi, i) => [sorted[i], hi]);
    stretches.sort((a, b) => a[1] - a[0] - (b[1] - b[0]));
    return share < 1 && few > 1 && about(stretches[0]) ? "most" : undefined;
  }

  zoom(about, factor) {
    const share = (about - this.lo) / (this.hi - this.lo);
    const width = (this.hi - this.lo) * factor;
    this.set(about - share * width, about + (1 - share) * width);
  }
}

/** What is shown at first, in words, until another stretch is. */
function firstShown(view, text) {
  const words = el("span", {}, `shown: ${text} · `);
  view.listeners.push(() => {
    words.hidden = true;
  });
  return words;
}

/** Everything that is drawn: has draw(), and drawOver() for what follows the cursor. */
const drawings = [];
let scheduled = false;

function drawNow() {
  // The room that one plot needs for its numbers moves those that share its axis.
  for (let pass = 0; pass < 3; pass++)
    for (const drawing of drawings) if (drawing.dirty) drawing.draw();
  for (const drawing of drawings) drawing.drawOver();
}

/** Draws at the next frame what has changed. */
function refresh() {
  if (scheduled) return;
  scheduled = true;
  requestAnimationFrame(() => {
    scheduled = false;
    drawNow();
  });
}

function refreshAll() {
  drawings.forEach((drawing) => {
    drawing.dirty = true;
  });
  refresh();
}

/** Width of an A4 sheet within its margins, CSS pixels. */
const SHEET = 688;

/** The width to draw for: on paper, the share that the box has of the sheet. */
function widthOf(box) {
  const width = box.clientWidth || 600;
  return printing ? Math.round((SHEET * width) / page.clientWidth) : width;
}

/** Makes a canvas as large as its box in device pixels, and gives its context in CSS pixels. */
function fit(canvas, width, height) {
  const ratio = printing ? 3 : window.devicePixelRatio || 1;
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) Object.assign(canvas, { width: w, height: h });
  canvas.style.height = `${height}px`;
  const ctx = canvas.getContext("2d");
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.clearRect(0, 0, width, height);
  ctx.font = font();
  return ctx;
}
