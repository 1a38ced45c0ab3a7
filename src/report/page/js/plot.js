// A plot: axes, curves, walls, a cursor. Several plots over one View zoom and move together. Drawn
// on canvas, since a run has up to 100 000 rows in each of several panels.

/** Numbers that differ by less than this share of themselves are one. */
const ROUNDING = 1e-12;

class Plot {
  /**
   * Options:
   *   x, y      labels of the axes; an x axis without a label has no numbers
   *   view      the View that x belongs to; without one, x spans the series
   *   range     function that gives [lo, hi] of y; without one, y spans the series
   *   log       [x, y], true for a logarithmic axis
   *   series    list of { kind, x, y, look, hidden() }; kind is line, marked, points, stems,
   *             orbit, bars or own (with draw(ctx, plot)); infinite: true shows −∞ and ∞ at the edges
   *   left      room for the labels of y; narrow the most of it in a narrow window
   *   marks     lines at x or y, with side (of a wall), floor (at x, for all curves) and label
   *   over      function (ctx, plot) that draws what follows the cursor
   *   hover     function (x, [px, py], plot), null when the pointer leaves
   *   click     function (x, [px, py], plot)
   */
  constructor(options) {
    const bottom = options.x ? 40 : 10;
    Object.assign(this, {
      height: 190,
      series: [],
      marks: [],
      log: [false, false],
      left: 66,
      narrow: 52,
      right: 14,
      top: 10,
      bottom,
    });
    Object.assign(this, options);
    this.under = el("canvas", { role: "img", "aria-label": options.alt || options.y || "plot" });
    this.overlay = el("canvas", { "aria-hidden": "true" });
    this.box = el("div", { class: "plot" }, this.under, this.overlay);
    this.dirty = true;
    drawings.push(this);
    const changed = () => this.redraw();
    if (this.view) this.view.listeners.push(changed);
    new ResizeObserver(changed).observe(this.box);
    listen(this);
  }

  redraw() {
    this.dirty = true;
    refresh();
  }

  get shown() {
    return this.series.filter((s) => !(s.hidden && s.hidden()));
  }

  limits() {
    const span = (axis, log) => {
      let [lo, hi] = [Infinity, -Infinity];
      for (const s of this.shown) {
        for (const value of s[axis]) {
          if (!Number.isFinite(value) || (log && value <= 0)) continue;
          if (value < lo) lo = value;
          if (value > hi) hi = value;
        }
      }
      if (!(lo <= hi)) return log ? [0.1, 1] : [-1, 1];
      if (log) return hi > lo ? [lo / (hi / lo) ** 0.04, hi * (hi / lo) ** 0.04] : [lo / 2, lo * 2];
      // A difference that rounding makes is none.
      return hi - lo > ROUNDING * Math.max(Math.abs(lo), Math.abs(hi))
        ? padded([lo, hi], 0.05)
        : [lo - (Math.abs(lo) || 1), lo + (Math.abs(lo) || 1)];
    };
    this.X = this.view ? [this.view.lo, this.view.hi] : span("x", this.log[0]);
    this.Y = this.range ? this.range() : span("y", this.log[1]);
    if (!(this.Y[1] > this.Y[0])) this.Y = [this.Y[0] - 1, this.Y[0] + 1];
  }

  sx(x) {
    const [a, b] = this.X;
    const share = this.log[0] ? Math.log(x / a) / Math.log(b / a) : (x - a) / (b - a);
    return this.x0 + (this.x1 - this.x0) * share;
  }

  sy(y) {
    const [a, b] = this.Y;
    const share = this.log[1] ? Math.log(y / a) / Math.log(b / a) : (y - a) / (b - a);
    return this.y1 - (this.y1 - this.y0) * share;
  }

  /** The x of a pixel. */
  tx(px) {
    const [a, b] = this.X;
    const share = (px - this.x0) / (this.x1 - this.x0);
    return this.log[0] ? a * (b / a) ** share : a + share * (b - a);
  }

  /** The y of a pixel. */
  ty(py) {
    const [a, b] = this.Y;
    const share = (this.y1 - py) / (this.y1 - this.y0);
    return this.log[1] ? a * (b / a) ** share : a + share * (b - a);
  }

  /** The plots that have one axis with this one, and it itself: their frames begin at one x. */
  get beneath() {
    const group = this.group || this.view;
    const shares = (one) => group && (one.group || one.view) === group && !one.box.hidden;
    return drawings.filter((one) => one === this || shares(one));
  }

  ticksOf(range, log, room) {
    return (log ? logTicks : linearTicks)(range[0], range[1], room);
  }

  /** Makes room for the numbers of y beside its label; where that takes more, other plots follow. */
  makeRoom(ctx) {
    this.yMarks = this.yTicks || this.ticksOf(this.Y, this.log[1], (this.y1 - this.y0) / 34);
    const widest = Math.max(0, ...this.yMarks.map(([, text]) => ctx.measureText(text).width));
    const needed = Math.ceil((widest + 8 + (this.y ? 24 : 4)) / 6) * 6;
    if (needed === this.numbers) return;
    this.numbers = needed;
    for (const plot of this.beneath) plot.dirty = plot.dirty || plot !== this;
    this.frame();
    this.limits();
  }

  frame() {
    this.w = widthOf(this.box);
    this.h = Math.round(this.height * (printing ? 0.8 : 1));
    const least = this.w < 480 ? Math.min(this.left, this.narrow) : this.left;
    const left = Math.max(least, ...this.beneath.map((plot) => plot.numbers || 0));
    [this.x0, this.x1, this.y0, this.y1] = [
      left,
      this.w - this.right,
      this.top,
      this.h - this.bottom,
    ];
  }

  draw() {
    this.dirty = false;
    this.frame();
    this.limits();
    const ctx = fit(this.under, this.w, this.h);
    if (!this.bare) this.makeRoom(ctx);
    const { x0, x1, y0, y1 } = this;
    if (!this.bare) this.drawGrid(ctx);
    ctx.save();
    ctx.beginPath();
    ctx.rect(x0, y0, x1 - x0, y1 - y0);
    ctx.clip();
    for (const mark of this.marks) this.drawMark(ctx, mark);
    const behind = (s) => (s.look && s.look.behind ? 0 : 1);
    for (const s of [...this.shown].sort((a, b) => behind(a) - behind(b))) this.drawSeries(ctx, s);
    drawMarkLabels(ctx, this);
    ctx.restore();
    ctx.strokeStyle = ink.faint;
    ctx.lineWidth = 1;
    ctx.strokeRect(x0 + 0.5, y0 + 0.5, x1 - x0, y1 - y0);
    if (this.beside) this.beside(ctx, this);
    if (this.heading) this.drawHeading(ctx);
  }

  drawGrid(ctx) {
    const { x0, x1, y0, y1 } = this;
    ctx.lineWidth = 1;
    ctx.textBaseline = "middle";
    ctx.strokeStyle = ink.grid;
    ctx.fillStyle = ink.soft;
    const line = (a, b, c, d) => {
      ctx.beginPath();
      ctx.moveTo(a, b);
      ctx.lineTo(c, d);
      ctx.stroke();
    };
    ctx.textAlign = "right";
    for (const [value, text] of this.yMarks) {
      const y = Math.round(this.sy(value)) + 0.5;
      line(x0, y, x1, y);
      ctx.fillText(text, x0 - 8, y, x0 - 16);
    }
    ctx.textAlign = "center";
    for (const [value, text] of this.ticksOf(this.X, this.log[0], (x1 - x0) / 88)) {
      const x = Math.round(this.sx(value)) + 0.5;
      line(x, y0, x, y1);
      // The last number ends where the drawing does.
      const most = this.w - ctx.measureText(text).width / 2 - 1;
      if (this.x) ctx.fillText(text, Math.min(x, most), y1 + 13);
    }
    ctx.fillStyle = ink.ink;
    if (this.x) ctx.fillText(this.x, (x0 + x1) / 2, y1 + 31, x1 - x0);
    if (this.y) {
      ctx.save();
      ctx.translate(x0 < 60 ? 8 : 14, (y0 + y1) / 2);
      ctx.rotate(-Math.PI / 2);
      ctx.fillText(this.y, 0, 0, this.h - 8);
      ctx.restore();
    }
  }

  drawHeading(ctx) {
    ctx.font = "600 " + font();
    ctx.textAlign = "left";
    ctx.textBaseline = "middle";
    const width = ctx.measureText(this.heading).width;
    ctx.fillStyle = clear(ink.paper, 0.85);
    ctx.fillRect(this.x0 + 6, this.y0 + 5, width + 8, 18);
    ctx.fillStyle = ink.ink;
    ctx.fillText(this.heading, this.x0 + 10, this.y0 + 14.5);
  }

  /** A line at x or y; with a side, what lies beyond it is hatched (rigid) or tinted (elastic). */
  drawMark(ctx, mark) {
    const { x0, x1, y0, y1 } = this;
    const upright = mark.x !== undefined;
    const at = upright ? this.sx(mark.x) : this.sy(mark.y);
    ctx.save();
    ctx.fillStyle = mark.soft ? ink.tint : hatch(ctx);
    if (mark.side && upright) {
      if (mark.side === "upper") ctx.fillRect(at, y0, x1 - at, y1 - y0);
      else ctx.fillRect(x0, y0, at - x0, y1 - y0);
    } else if (mark.side) {
      if (mark.side === "upper") ctx.fillRect(x0, y0, x1 - x0, at - y0);
      else ctx.fillRect(x0, at, x1 - x0, y1 - at);
    }
    // A floor keeps curves from smaller values.
    if (mark.floor) ctx.fillRect(at - 7, y0, 7, y1 - y0);
    ctx.strokeStyle = mark.colour ? mark.colour() : ink.wall;
    ctx.lineWidth = mark.dash ? 1 : 2;
    ctx.setLineDash(mark.dash || []);
    ctx.beginPath();
    if (upright) {
      ctx.moveTo(at, y0);
      ctx.lineTo(at, y1);
    } else {
      ctx.moveTo(x0, at);
      ctx.lineTo(x1, at);
    }
    ctx.stroke();
    ctx.restore();
  }

  drawSeries(ctx, s) {
    ctx.save();
    ctx.strokeStyle = ctx.fillStyle = s.colour ? s.colour() : s.look.colour();
    ctx.lineWidth = s.width || s.look.width;
    ctx.lineJoin = "round";
    ctx.globalAlpha = s.alpha || 1;
    const kinds = { stems: drawStems, points: drawPoints, orbit: drawOrbit, bars: drawBars };
    if (s.kind === "own") {
      s.draw(ctx, this);
    } else if (kinds[s.kind]) {
      kinds[s.kind](ctx, this, s);
    } else {
      ctx.setLineDash(s.look.dash);
      drawLine(ctx, this, s);
      ctx.setLineDash([]);
      if (s.kind === "marked") drawPoints(ctx, this, { ...s, size: 3.4, marker: s.look.marker });
      if (s.infinite) drawInfinite(ctx, this, s);
    }
    ctx.restore();
  }

  drawOver() {
    if (this.dirty || !this.X) return;
    const ctx = fit(this.overlay, this.w, this.h);
    if (printing) return;
    if (this.selection) {
      const [p, q] = this.selection;
      ctx.fillStyle = clear(ink.accent, 0.16);
      ctx.fillRect(Math.min(p, q), this.y0, Math.abs(q - p), this.y1 - this.y0);
    }
    if (this.over) this.over(ctx, this);
  }
}
