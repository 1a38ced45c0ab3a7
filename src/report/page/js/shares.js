// The shares of keys in the variance of each measure over the rows of a random design: bars, a table.

/** A bar for the share of each line, in per cent; what is no key is grey. */
function shareBars(columns, rows, name) {
  const share = (i) => 100 * columns.share[i];
  const half = (i) => 100 * (columns.half_width_95 || [])[i];
  const ends = (i) => (Number.isFinite(half(i)) ? [share(i) - half(i), share(i) + half(i)] : [share(i)]);
  const bar = (ctx, plot, i, y) => {
    const [none, end] = [plot.sx(0), plot.sx(share(i))];
    ctx.fillStyle = DATA.sweep.no_key.includes(columns.key[i]) ? ink.faint : lookOf(2).colour();
    ctx.fillRect(Math.min(none, end), y - 8, Math.abs(end - none), 16);
    if (!Number.isFinite(half(i))) return;
    // The interval.
    const [low, high] = [plot.sx(share(i) - half(i)), plot.sx(share(i) + half(i))];
    ctx.strokeStyle = ink.ink;
    ctx.lineWidth = 1.5;
    ctx.beginPath();
    for (const [x0, y0, x1, y1] of [[low, y, high, y], [low, y - 5, low, y + 5], [high, y - 5, high, y + 5]]) {
      ctx.moveTo(x0, y0);
      ctx.lineTo(x1, y1);
    }
    ctx.stroke();
  };
  return barPlot(columns, rows, {
    x: `Share of the variance of ${name} (%)`,
    alt: `Shares in the variance of ${name}`,
    values: [0, 100, ...rows.flatMap(ends)],
    base: 0,
    bar,
  });
}

function sharesSection(shares, seeds, caution) {
  const { columns } = shares;
  const share = {
    name: "share (%)",
    value: (i) => columns.share[i],
    show: (i) => (100 * columns.share[i]).toFixed(1),
  };
  const half = {
    name: "± (%)",
    value: (i) => (columns.half_width_95 || [])[i],
    show: (i) => (Number.isFinite((columns.half_width_95 || [])[i]) ? (100 * columns.half_width_95[i]).toFixed(1) : ""),
  };
  const rows = { name: "rows", value: (i) => columns.rows[i], show: (i) => String(columns.rows[i]) };
  section(
    "shares",
    "Shares",
    "The share of each key in the variance of the measure over the rows, by an additive fit of polynomials of the " +
      "third degree; interactions: what no sum of such polynomials gives" +
      (seeds ? "; realisations: what the means scatter by chance" : "") +
      `. ± is the half width of the 95 % interval, from shares without each thirteenth part of the rows.${caution ? ` ${sentence(caution)}` : ""}`,
    ...linesByMeasure(shares).map(([name, lines]) => shareBars(columns, lines, name)),
    sortable(
      [...namedColumns(columns), share, half, rows],
      shares.rows,
      { height: 60 + ROW * Math.min(shares.count, 16) },
    ),
  );
}
