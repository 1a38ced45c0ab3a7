// The intervals of means over realisations of random loads, in the tables and curves of a sweep
// and of wear over the years.

/** What stands after the name of a measure in the column of the half widths of its intervals. */
const HALF_WIDTH = "_half_width_95";

const isHalfWidth = (name) =>
  Boolean((DATA.sweep || DATA.wear).seeds) && name.includes(HALF_WIDTH);

/** The half widths of the intervals of a measure; undefined without realisations. */
const halfWidthsOf = (columns, name) => {
  const found = Object.keys(columns).find(
    (column) => isHalfWidth(column) && column.replace(HALF_WIDTH, "") === name,
  );
  return columns[found];
};

/** A number of a row, with its interval where it has one. */
const withInterval = (columns, name, i) =>
  plusMinus(columns[name][i], (halfWidthsOf(columns, name) || [])[i]);

/** The band of the intervals about a curve; null where it has none. */
function bandOf(curve, half) {
  if (!half) return null;
  const halves = curve.rows.map((i) => half[i]);
  const edges = [-1, 1].map((sign) => curve.y.map((y, k) => y + sign * halves[k]));
  const draw = (ctx, plot) => {
    const at = (side, k) => [plot.sx(curve.x[k]), plot.sy(edges[side][k])];
    // Along the lower edge and back along the upper one, of each stretch without a gap.
    const fill = (ks) => {
      ctx.beginPath();
      for (const k of ks) ctx.lineTo(...at(0, k));
      for (const k of [...ks].reverse()) ctx.lineTo(...at(1, k));
      ctx.closePath();
      ctx.globalAlpha = 0.18;
      ctx.fill();
      ctx.globalAlpha = 1;
      if (ks.length === 1) ctx.stroke();
    };
    let stretch = [];
    for (let k = 0; k <= halves.length; k++) {
      if (Number.isFinite(edges[0][k])) stretch.push(k);
      else {
        if (stretch.length) fill(stretch);
        stretch = [];
      }
    }
  };
  const look = { ...curve.look, behind: true };
  return { ...curve, kind: "own", look, infinite: false, y: edges.flat(), draw };
}

/** What the numbers of rows with realisations are; only curves have bands. */
const seedsText = (seeds, bands) =>
  ` Of every row there are ${seeds}: shown are their means, and ` +
  (bands ? "as bands their" : "the half widths of their") +
  " 95 % intervals, by Student's t.";
