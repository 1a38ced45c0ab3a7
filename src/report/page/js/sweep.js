// Sweeps: curves over one axis, maps over two, bifurcation diagrams.

function sweepSection() {
  const { axes, effects, shares, samples, scheme, seeds, seeds_asked: asked } = DATA.sweep;
  const { unjudged, unstable, window } = DATA.sweep;
  const table = tableOf(DATA.sweep.table);
  const { columns } = table;
  const numeric = (name) => columns[name] && !Array.isArray(columns[name]);
  const axisColumns = axes.map((axis) => axis.column).filter(numeric);
  const otherAxes = axes.map((axis) => axis.column).filter((name) => !axisColumns.slice(0, 2).includes(name));
  const directed = bothDirections(columns.direction);
  if (directed) otherAxes.push("direction");
  const attractors = readAttractors();
  const over = readOver();
  const measures = table.names
    .slice(table.names.indexOf("error") + 1)
    .filter((name) => !isHalfWidth(name) && !(attractors && name === "attractor") && numeric(name));
  const kept = new Set(DATA.sweep.kept);
  const command = el("pre", { class: "command", hidden: true });
  const tell = (i) =>
    [
      ...axes.map(
        (axis) =>
          `${columnLabel(axis.column)}: ${Array.isArray(columns[axis.column]) ? columns[axis.column][i] : digits(columns[axis.column][i], 6)}`,
      ),
      directed ? `along ${columns.direction[i] === "up" ? "rising" : "falling"} values` : null,
      attractors && columns.attractor ? attractorText(attractors, columns.attractor[i]) : null,
      ...measures.slice(0, 14).map((name) => `${columnLabel(name)}: ${withInterval(columns, name, i)}`),
      columns.status && (columns.status[i] !== "ok" || columns.error[i])
        ? [columns.status[i], columns.error[i]].filter((word) => word).join(": ")
        : null,
    ]
      .filter((line) => line)
      .join("\n");
  /**
   * The command that runs this row alone, on the case as the sweep has it: the name of a built-in
   * case would stand for that case without what the sweep has set.
   */
  const pick = (i) => {
    const set = axes.flatMap((axis) =>
      axis.keys.map(({ key, factor }) => {
        const value = columns[axis.column][i];
        return `--set ${shellWord(`${key}=${typeof value === "number" ? value * factor : value}`)}`;
      }),
    );
    const by = [scheme ? `--scheme ${shellWord(scheme)}` : null, asked, windowAsked(window)];
    const file = shellWord(`${DATA.name}.toml`);
    const row = columns.row[i];
    const follows = axes.some((axis) => axis.follow !== "No");
    command.textContent =
      `# In the folder of this page, where ${DATA.name}.toml is what "Save the case" below gives:\n` +
      (follows
        ? "# the row began where the one before it ended, this run at the start of the case.\n"
        : "") +
      `signorini run ${[file, ...set, ...by].filter(Boolean).join(" ")} --out rows/${row}\n` +
      "# A click opens that run, once this page was made anew:\nsignorini report .";
    command.hidden = false;
    if (kept.has(row)) open(`rows/${row}/report.html`);
  };
  // Over one axis, curves say where something happens.
  const curves = axisColumns.length === 1 ? measures : [];
  const view = axisColumns.length ? firstView(columns, axisColumns[0], curves, over) : undefined;
  // First the measures, which are there only where they were asked for.
  const content = [];
  const basins = attractors && numeric("attractor") && axisColumns.length > 1;
  if (basins) content.push(basinMap(columns, axisColumns, otherAxes, attractors, tell, pick));
  const bands = curves.length > 0 && !effects;
  if (measures.length && axisColumns.length && !basins && !effects) {
    content.push(
      axisColumns.length > 1
        ? measureMap(columns, axisColumns, otherAxes, measures, tell, pick)
        : measureCurves(columns, axisColumns[0], measures, tell, pick, { over, view }),
    );
  }
  if (samples) content.push(samplesPlot(table, tableOf(samples), axisColumns[0], pick, { over, view }));
  if (effects) effectsSection(tableOf(effects), seeds);
  if (shares) sharesSection(tableOf(shares), seeds, DATA.sweep.caution);
  const lead =
    unstable.map((text) => `${text}. `).join("") +
    (effects
      ? "Click a row for the command that runs it alone"
      : "Point at a row for its numbers; click it for the command that runs it alone") +
      (kept.size
        ? `, or for its own report (there ${kept.size === 1 ? "is" : "are"} ${kept.size}).`
        : ".") +
      (seeds ? seedsText(seeds, bands) : "") +
      (unjudged ? ` ${unjudged} of ${table.count} rows are unjudged: nothing checked their steps.` : "");
  section(
    "sweep",
    "Sweep",
    null,
    conclusionOf(sweptInWords(table, measures, attractors, samples && tableOf(samples), axisColumns)),
    el("p", { class: "lead" }, lead),
    ...content,
    command,
  );
  if (attractors) attractorSection(attractors);
  const ok = columns.status && columns.status.every((status) => status === "ok") && !columns.error.some(Boolean);
  section(
    "rows",
    "Rows",
    ok ? `All ${table.count} are ok.` : null,
    sortable(
      columnsOf(
        table,
        table.names
          .filter((name) => !ok || !["status", "error"].includes(name))
          .map((name) => [name, columnLabel(name)]),
        axisColumns,
      ),
      table.rows,
      { height: 400, pick },
    ),
    saveBar("sweep.csv", () => linesOf(table)),
  );
}

/** The arguments of `run` for the window of the rows; null for that of the case. */
function windowAsked(window) {
  if (window?.keep_periods) return `--settle ${window.settle_periods} --keep ${window.keep_periods}`;
  if (!window?.keep_s) return null;
  return `--end ${window.settle_s + window.keep_s} --set time.statistics_from=${window.settle_s}`;
}

/** Another sweep that is drawn in the same figures: its name, table and instants; null without. */
function readOver() {
  const { over } = DATA.sweep;
  if (!over) return null;
  const table = tableOf(over.table);
  return { name: over.name, columns: table.columns, samples: over.samples && tableOf(over.samples) };
}

/** What tells the curves of other results. */
const overKey = (over) => swatch(`pale: ${over.name}`, () => ink.faint);

/** True where rows of both directions are among those of a sweep. */
const bothDirections = (directions) =>
  Boolean(directions) && ["up", "down"].every((one) => directions.includes(one));

/** The key of the colours of directions. */
const directionKeys = () =>
  el(
    "span",
    {},
    ["up", "down"].map((one) => swatch(one, () => directionColour(one))),
  );

/** The columns of numbers of instants, and the one that is shown first. */
const sampledColumns = (samples) =>
  samples.names.filter(
    (name) => !["row", "realisation"].includes(name) && !Array.isArray(samples.columns[name]),
  );
const sampledColumn = (samples) => {
  const names = sampledColumns(samples);
  return names.find((name) => name.startsWith("displacement")) || names[names.length - 1];
};

/** Instants of every row over the axis: a bifurcation diagram. */
function samplesPlot(table, samples, axisColumn, pick, { over, view }) {
  const names = sampledColumns(samples);
  const wanted = sampledColumn(samples);
  const axis = table.columns[axisColumn];
  const rowAt = new Map(Array.from(table.columns.row, (row, i) => [row, i]));
  const at = Array.from(samples.columns.row, (row) => rowAt.get(row));
  const directions = table.columns.direction;
  const choice = { name: wanted };
  const others = over && over.samples;
  const rowOfOther = others && new Map(Array.from(over.columns.row, (row, i) => [row, i]));
  const drawOthers = (ctx, plot) => {
    const y = others && others.columns[choice.name];
    if (!y) return;
    ctx.fillStyle = clear(ink.faint, 0.6);
    for (let k = 0; k < y.length; k++) {
      const x = over.columns[axisColumn][rowOfOther.get(others.columns.row[k])];
      if (Number.isFinite(x) && Number.isFinite(y[k]))
        ctx.fillRect(plot.sx(x) - 1.2, plot.sy(y[k]) - 1.2, 2.4, 2.4);
    }
  };
  const dot = (ctx, plot) => {
    drawOthers(ctx, plot);
    const y = samples.columns[choice.name];
    const size = at.length > 2e4 ? 1 : 1.6;
    const shown = (i) => at[i] !== undefined && Number.isFinite(y[i]);
    const pixel = (i) => `${Math.round(plot.sx(axis[at[i]]))} ${Math.round(plot.sy(y[i]))}`;
    // Where instants of both directions meet, the one drawn last would hide the other.
    const pixels = { up: new Set(), down: new Set() };
    if (bothDirections(directions)) {
      for (let i = 0; i < at.length; i++) if (shown(i)) pixels[directions[at[i]]].add(pixel(i));
    }
    const colour = (i) => {
      const direction = directions && directions[at[i]];
      const meets = pixels.up.size && pixels[direction === "up" ? "down" : "up"].has(pixel(i));
      return meets ? ink.ink : directionColour(direction);
    };
    for (let i = 0; i < at.length; i++) {
      if (!shown(i)) continue;
      ctx.fillStyle = colour(i);
      ctx.fillRect(plot.sx(axis[at[i]]) - size / 2, plot.sy(y[i]) - size / 2, size, size);
    }
  };
  const plot = new Plot({
    x: columnLabel(axisColumn),
    log: [view?.log, false],
    y: " ",
    height: 460,
    alt: "Instants of every row",
    view,
    series: [{ kind: "own", look: lookOf(0), draw: dot }],
  });
  const fill = () => {
    plot.y = columnLabel(choice.name);
    const theirs = others && others.columns[choice.name];
    const both = [samples.columns[choice.name], theirs].filter((list) => list);
    const span = extent(both.flatMap((list) => extent(list) || [])) || [0, 1];
    plot.range = () => padded(span, 0.05);
    plot.redraw();
  };
  fill();
  plot.click = (x) => pick(nearestTo(axis, x));
  const keys = [
    bothDirections(directions) ? directionKeys() : null,
    bothDirections(directions) ? swatch("up and down", () => ink.ink) : null,
    others ? overKey(over) : null,
  ];
  return el(
    "div",
    {},
    el(
      "div",
      { class: "bar controls" },
      columnChoice("Quantity", names, choice, fill),
      button("All values", () => view.set(...view.full), "Whole range"),
      el("span", { class: "right help" }, "drag to zoom · double click for all"),
    ),
    keys.some((key) => key) ? el("div", { class: "bar" }, keys) : null,
    plot.box,
  );
}

/** Chooses the column that a drawing shows, which `fill` draws anew. */
function columnChoice(label, names, choice, fill) {
  const options = names.map((name) => [name, columnLabel(name)]);
  const pick = selection(label, options, choice.name, (name) => {
    choice.name = name;
    fill();
  });
  return printed(pick);
}

/** The rows with one value of each of the axes `names`, which a map does not show: whether a row is
 *  among them, and the controls that choose the values. Of a random design, in which hardly two rows
 *  share a value, all are. */
function sliceOf(columns, names, onChange) {
  const several = names
    .map((name) => [name, [...new Set(columns[name])]])
    .filter(([name, values]) => values.length > 1 && values.length <= columns[name].length / 2);
  const chosen = new Map(several.map(([name, values]) => [name, values[0]]));
  const shown = (value) => (typeof value === "number" ? digits(value, 6) : `${value}`);
  const controls = several.flatMap(([name, values]) => {
    const choices = values.map((value, k) => [`${k}`, `${columnLabel(name)}: ${shown(value)}`]);
    const choose = (k) => {
      chosen.set(name, values[Number(k)]);
      onChange();
    };
    return printed(selection(columnLabel(name), choices, "0", choose));
  });
  const shows = (i) => several.every(([name]) => columns[name][i] === chosen.get(name));
  return { shows, controls };
}

/** The tones of the numbers of `range` beside a map, with the name of what it shows. */
function drawColourBar(ctx, plot, range, name) {
  const { y0, y1 } = plot;
  const left = plot.x1 + 22;
  const height = y1 - y0;
  for (let k = 0; k < 120; k++) {
    ctx.fillStyle = `rgb(${rampTone((k + 0.5) / 120)})`;
    ctx.fillRect(left, y1 - ((k + 1) * height) / 120, 14, height / 120 + 0.6);
  }
  ctx.strokeStyle = ink.faint;
  ctx.strokeRect(left, y0, 14, height);
  ctx.fillStyle = ink.soft;
  ctx.textAlign = "left";
  const most = range[1] > range[0] ? range[1] : range[0] + 1;
  for (const [value, text] of linearTicks(range[0], most, height / 50))
    ctx.fillText(text, left + 20, y1 - (height * (value - range[0])) / (range[1] - range[0] || 1));
  ctx.save();
  ctx.translate(plot.w - 8, (y0 + y1) / 2);
  ctx.rotate(-Math.PI / 2);
  ctx.textAlign = "center";
  ctx.fillStyle = ink.ink;
  ctx.fillText(name, 0, 0, plot.h - 8);
  ctx.restore();
}

/** A measure over two axes. */
function measureMap(columns, [first, second], others, measures, tell, pick) {
  const slice = sliceOf(columns, others, () => plot.refill());
  const choice = { name: measures[0] };
  let range = [0, 1];
  const unknown = el("div", { class: "bar" }, swatch("no number", () => "rgb(128 128 128)"));
  const fill = () => {
    const span = extent(columns[choice.name]) || [0, 1];
    unknown.hidden = !Array.from(columns[choice.name]).some(Number.isNaN);
    range = span[0] > 0 && span[0] < 0.5 * span[1] ? [0, span[1]] : span;
    plot.redraw();
  };
  const toneOf = (i) => {
    const value = columns[choice.name][i];
    // The tone of −∞ is that of the least number.
    return !Number.isNaN(value)
      ? rampTone((value - range[0]) / (range[1] - range[0] || 1))
      : [128, 128, 128];
  };
  const beside = (ctx, p) => drawColourBar(ctx, p, range, columnLabel(choice.name));
  const plot = cellMap({
    x: columnLabel(first),
    y: columnLabel(second),
    xs: columns[first],
    ys: columns[second],
    shows: slice.shows,
    toneOf,
    tell,
    pick,
    beside,
    right: 108,
    height: 470,
    alt: "Map of the sweep",
  });
  fill();
  return el(
    "div",
    {},
    el(
      "div",
      { class: "bar controls" },
      columnChoice("Measure", measures, choice, fill),
      slice.controls,
    ),
    unknown,
    plot.box,
  );
}
