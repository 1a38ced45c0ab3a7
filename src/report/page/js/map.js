// Maps: cells over two axes.

/** The distinct numbers of a column, sorted. */
const distinct = (values) => [...new Set(values)].filter(Number.isFinite).sort((a, b) => a - b);

/** True where values are spaced by a factor rather than by a distance. */
function isGeometric(values) {
  const [first, last] = [values[0], values[values.length - 1]];
  return (
    values.length > 2 &&
    first > 0 &&
    last / first > 30 &&
    values[1] - first < 0.2 * (last - values[values.length - 2])
  );
}

/** Edges of cells around values; halfway between neighbours, on the axis' own scale. */
function edgesOf(values, log) {
  const [to, from] = log ? [Math.log, Math.exp] : [(x) => x, (x) => x];
  const place = values.map(to);
  const half = place.length > 1 ? (place[1] - place[0]) / 2 : 0.5;
  const edges = place.map((x, i) => (i ? (x + place[i - 1]) / 2 : x - half));
  const n = place.length;
  edges.push(n > 1 ? place[n - 1] + (place[n - 1] - place[n - 2]) / 2 : place[0] + half);
  return edges.map(from);
}

/** Half the size of the square of a row that stands alone, in pixels. */
const POINT = 6;

/**
 * A map of cells, or of points where rows stand alone, as in a random design. Options: x, y
 * (labels), xs, ys (values of each row of the table), shows(i) whether a row is among those drawn,
 * toneOf(i) an RGB triple, tell(i) the text of a cell, pick(i), height, beside(ctx, plot). Its
 * `refill` draws the rows that are shown by then.
 */
function cellMap(options) {
  const axes = [distinct(options.xs), distinct(options.ys)];
  const logs = axes.map(isGeometric);
  const edges = axes.map((values, k) => edgesOf(values, logs[k]));
  const index = axes.map((values) => new Map(values.map((value, i) => [value, i])));
  const cells = new Map();
  const refill = () => {
    cells.clear();
    for (let i = 0; i < options.xs.length; i++)
      if (!options.shows || options.shows(i)) cells.set(`${index[0].get(options.xs[i])} ${index[1].get(options.ys[i])}`, i);
  };
  refill();
  const alone = axes[0].length * axes[1].length > 4 * options.xs.length;
  const rectangle = (plot, i) => {
    if (alone) return [plot.sx(options.xs[i]) - POINT, plot.sy(options.ys[i]) - POINT, 2 * POINT, 2 * POINT];
    const [a, b] = [index[0].get(options.xs[i]), index[1].get(options.ys[i])];
    const [x0, x1] = [plot.sx(edges[0][a]), plot.sx(edges[0][a + 1])];
    const [y0, y1] = [plot.sy(edges[1][b + 1]), plot.sy(edges[1][b])];
    return [x0, y0, x1 - x0, y1 - y0];
  };
  const draw = (ctx, plot) => {
    ctx.strokeStyle = ink.faint;
    ctx.lineWidth = 1;
    for (const i of cells.values()) {
      const [x, y, w, h] = rectangle(plot, i);
      ctx.fillStyle = `rgb(${options.toneOf(i)})`;
      // Half a pixel more, so that no seam shows between cells.
      ctx.fillRect(x, y, w + 0.5, h + 0.5);
      // The least tone is hardly one of the paper.
      if (alone) ctx.strokeRect(x, y, w, h);
    }
  };
  const plot = new Plot({
    x: options.x,
    y: options.y,
    height: options.height || 420,
    right: options.right || 14,
    alt: options.alt,
    log: logs,
    series: [{ kind: "own", look: lookOf(0), x: [], y: [], draw }],
    beside: options.beside,
  });
  plot.limits = () => {
    [plot.X, plot.Y] = edges.map((list, k) => {
      const ends = [list[0], list[list.length - 1]];
      return alone && !logs[k] ? padded(ends, 0.04) : ends;
    });
  };
  const tip = el("div", { class: "tip", hidden: true });
  plot.box.append(tip);
  const pointAt = ([x, y]) =>
    [...cells.values()].reverse().find((i) => {
      const [left, top, w, h] = rectangle(plot, i);
      return x >= left && x <= left + w && y >= top && y <= top + h;
    });
  const cellAt = (at) => {
    if (alone) return pointAt(at);
    const [x, y] = [plot.tx(at[0]), plot.ty(at[1])];
    return cells.get(`${before(edges[0], x)} ${before(edges[1], y)}`);
  };
  let found;
  plot.refill = () => {
    found = undefined;
    refill();
    plot.redraw();
  };
  plot.hover = (x, at) => {
    found = x === null ? undefined : cellAt(at);
    showTip(plot, tip, found === undefined ? "" : options.tell(found), at);
  };
  plot.click = (_, at) => {
    const i = cellAt(at);
    if (i !== undefined && options.pick) options.pick(i);
  };
  plot.over = (ctx) => {
    if (found === undefined) return;
    ctx.strokeStyle = ink.c2;
    ctx.lineWidth = 2;
    ctx.strokeRect(...rectangle(plot, found));
  };
  return plot;
}

/** A column's name in words, with its unit. */
function columnLabel(name) {
  const units = {
    kg_per_m3: "kg/m³",
    N_s_per_m: "N s/m",
    rad_per_s: "rad/s",
    m3_per_N: "m³/N",
    N_per_m: "N/m",
    m_per_s: "m/s",
    per_s: "1/s",
    N_s: "N s",
    rad: "rad",
    kg: "kg",
    Hz: "Hz",
    Pa: "Pa",
    m3: "m³",
    m2: "m²",
    mm: "mm",
    m: "m",
    s: "s",
    N: "N",
    W: "W",
  };
  const end = Object.keys(units).find((unit) => name.endsWith(`_${unit}`));
  const words = (end ? name.slice(0, -end.length - 1) : name).replace(/_/g, " ");
  return words.charAt(0).toUpperCase() + words.slice(1) + (end ? ` (${units[end]})` : "");
}
