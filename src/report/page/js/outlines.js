// The outlines of supports in the plane across a structure: circles, and flats up to their corners.

/** Flats that meet no other are drawn up to this multiple of the support's reach. */
const OPEN_END = 1.6;

/** The flats of a support from corner to corner: pairs of points [y, z] in m; none of a round one. */
function flatsOf({ round, centre, gaps, directions, reach }) {
  if (round) return [];
  const normals = directions
    .map((deg) => (deg * TURN) / 360)
    .map((a) => [Math.cos(a), Math.sin(a)]);
  return normals
    .map(([ny, nz], i) => {
      let [from, to] = [-OPEN_END * reach, OPEN_END * reach];
      // The part of the flat within every other: (gap n + s t) · m <= its gap, with t across n.
      normals.forEach(([my, mz], j) => {
        const room = gaps[j] - gaps[i] * (ny * my + nz * mz);
        const slope = ny * mz - nz * my;
        if (Math.abs(slope) < 1e-9) return;
        if (slope > 0) to = Math.min(to, room / slope);
        else from = Math.max(from, room / slope);
      });
      const point = (s) => [centre[0] + gaps[i] * ny - s * nz, centre[1] + gaps[i] * nz + s * ny];
      return from < to ? [point(from), point(to)] : null;
    })
    .filter(Boolean);
}

/**
 * Least and largest displacement (m) along y (axis 0) or z (1) that a support leaves; undefined
 * where it leaves any.
 */
function roomOf(support, axis) {
  const { round, centre, gaps, directions, reach } = support;
  if (round) return [centre[axis] - gaps[0], centre[axis] + gaps[0]];
  const ends = flatsOf(support).flat();
  const [least, most] = extent(ends.map((point) => point[axis])) || [];
  const open = (value) => !(Math.abs(value - centre[axis]) < (OPEN_END - 0.01) * reach);
  /** True where a flat stands on that side: of a lone one both ends are the flat itself. */
  const faces = (side) =>
    directions.some((deg) => side * [Math.cos, Math.sin][axis]((deg * TURN) / 360) > 1e-9);
  return [
    open(least) || !faces(-1) ? undefined : least,
    open(most) || !faces(1) ? undefined : most,
  ];
}

/** Draws the outline of a support: X(y) and Y(z) are pixels of a point in m, `scale` those of 1 m. */
function drawOutline(ctx, support, X, Y, scale, colour, width = 2) {
  const [cy, cz] = support.centre;
  ctx.strokeStyle = colour;
  ctx.lineWidth = width;
  ctx.beginPath();
  if (support.round) ctx.arc(X(cy), Y(cz), support.gaps[0] * scale, 0, TURN);
  for (const [[y0, z0], [y1, z1]] of flatsOf(support)) {
    ctx.moveTo(X(y0), Y(z0));
    ctx.lineTo(X(y1), Y(z1));
  }
  ctx.stroke();
}

/** The probes of a support along y and z, where a run has them. */
function watching(name) {
  const pair = ["y", "z"].map((axis) =>
    lead.probes.find((probe) => probe.name === `${name}-${axis}`),
  );
  return pair.every(Boolean) ? pair : null;
}
