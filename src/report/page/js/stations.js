// Where a structure is drawn, and what it does there.

/**
 * Where the structure is drawn: stations with their places x, at(t) which gives the displacement of
 * each, and the range of each over the run.
 */
function stationsOf() {
  const length = DATA.scene.length;
  if (lead.shape) {
    const { stations, u, unit } = lead.shape;
    const n = stations.length;
    const [low, high] = [new Float64Array(n), new Float64Array(n)];
    for (let i = 0; i < u.length; i++) {
      low[i % n] = Math.min(low[i % n], unit * u[i]);
      high[i % n] = Math.max(high[i % n], unit * u[i]);
    }
    const buffer = new Float64Array(n);
    return { x: stations, low, high, at: (t) => shapeAt(lead.shape, t, buffer), whole: true };
  }
  // Without a shape: the watched places, by where they are if they say so.
  const two = DATA.scene.kind === "planes";
  const place = (probe) => probe.at && (probe.at.position ?? probe.at.dof);
  const placed = lead.probes.every((probe) => Number.isFinite(place(probe)) && !two);
  const probes = placed ? [...lead.probes].sort((a, b) => place(a) - place(b)) : lead.probes;
  const x = probes.map((probe, i) => (placed ? place(probe) : i));
  return {
    x,
    names: placed ? null : probes.map((probe) => probe.name),
    low: probes.map((probe) => Math.min(0, probe.extents.Q[0])),
    high: probes.map((probe) => Math.max(0, probe.extents.Q[1])),
    at: (t) => probes.map((probe) => stateAt(probe, t)[0]),
    ats: probes.map((probe) => probe.at),
    whole: placed && !length,
  };
}
