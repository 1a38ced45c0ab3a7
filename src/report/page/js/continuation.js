// The page of branches: picture, the orbit that was chosen in it, special points, loci, all orbits.

function branchSection() {
  const points = readBranches(DATA.continue);
  const choice = { row: null, measure: null };
  const orbit = chosenOrbit(points, choice);
  const select = (i) => {
    choice.row = i;
    orbit.update();
    refresh();
  };
  const { plot, box } = branchPlot(points, choice, select);
  orbit.listeners.push(() => plot.drawOver());
  const columns = (list) =>
    list.map(([name, key, text]) => ({
      name,
      text,
      value: (row) => (row[key] === null || row[key] === undefined ? (text ? "" : NaN) : row[key]),
      show: (row) => (text ? String(row[key] ?? "") || "–" : digits(row[key], 9)),
    }));
  const branches = DATA.continue.branches.map((branch) => ({
    ...branch,
    signature: signatureText(branch.signature, branch.symmetric, branch.events.length),
    begins:
      branch.found_at_special && branch.begins === "special point"
        ? `special ${branch.found_at_special}`
        : branch.begins,
  }));
  section(
    "branches",
    "Branches",
    "Full where orbits are stable, dashed where they are not; of speeds and phases one curve for each impact. Click one to see its orbit below.",
    box,
    sortable(
      columns([
        ["branch", "branch"],
        ["signature", "signature", true],
        ["periods", "periods"],
        ["points", "points"],
        ["from", "from"],
        ["begins at", "begins", true],
        ["to", "to"],
        ["ends at", "ends", true],
      ]),
      branches,
      {
        height: 60 + ROW * Math.min(branches.length, 12),
        pick: (branch) => {
          const rows = points.rowsOf(branch.branch);
          if (rows.length) select(rows[rows.length >> 1]);
        },
      },
    ),
  );
  section("orbit", "One orbit", null, orbit.box);
  const specials = DATA.continue.specials.map((special) => ({
    ...special,
    leads: (special.leads_to || []).join(" "),
  }));
  const rowOf = (special) =>
    points
      .rowsOf(special.branch)
      .find((i) => points.label(i) === special.label && points.value[i] === special.value);
  if (specials.length)
    section(
      "specials",
      "Special points",
      "Located on the branch to rounding. Click one to see its orbit.",
      sortable(
        columns([
          ["special", "special"],
          ["what", "label", true],
          ["at", "wall", true],
          [columnLabel(DATA.continue.key), "value"],
          ["branch", "branch"],
          ["leads to", "leads", true],
          ["not followed because", "not_followed_because", true],
        ]),
        specials,
        {
          height: 60 + ROW * Math.min(specials.length, 14),
          pick: (special) => {
            const i = rowOf(special);
            if (i !== undefined) select(i);
          },
        },
      ),
    );
  if (DATA.continue.loci) locusSection();
  pointSection(points, select);
  // A stable orbit in the middle of what is in view of the first branch.
  const rows = points.rowsOf(1);
  const stable = rows.filter((i) => points.columns.stable[i] && !points.label(i));
  const inView = stable.filter((i) => points.value[i] >= plot.view.lo && points.value[i] <= plot.view.hi);
  const initial = [inView, stable, rows].find((list) => list.length) || [];
  if (initial.length) select(initial[initial.length >> 1]);
}

/** All orbits as a table. */
function pointSection(points, select) {
  const shown = points.names.filter((name) => name !== "admissible");
  section(
    "orbits",
    "All orbits",
    null,
    sortable(
      columnsOf(
        points,
        shown.map((name) => [name, columnLabel(name)]),
      ),
      points.rows,
      { height: 360, pick: select },
    ),
    saveBar("branches.csv", () => linesOf(points), "The table above", "Save the table"),
  );
}

/** Curves of special points over two keys. */
function locusSection() {
  const table = tableOf(DATA.continue.loci.table);
  const [first, second] = DATA.continue.loci.keys;
  const numbers = [...new Set(table.columns.locus)];
  const items = numbers.map((number, n) => {
    const rows = table.rows.filter((i) => table.columns.locus[i] === number);
    return {
      label: `${number} ${table.columns.label[rows[0]]}`,
      look: lookOf(n),
      shown: true,
      rows,
    };
  });
  const series = items.map((item) => ({
    kind: "line",
    look: item.look,
    x: item.rows.map((i) => table.columns[first][i]),
    y: item.rows.map((i) => table.columns[second][i]),
    hidden: () => !item.shown,
    item,
  }));
  const plot = new Plot({
    x: columnLabel(first),
    y: columnLabel(second),
    height: 420,
    alt: "Loci of special points",
    series,
  });
  const points = () =>
    series.filter((s) => !s.hidden()).flatMap((s) => s.x.map((x, k) => ({ x, y: s.y[k], s })));
  tellNearest(
    plot,
    points,
    ({ x, y, s }) =>
      `${s.item.label}\n${columnLabel(first)}: ${digits(x, 7)}\n${columnLabel(second)}: ${digits(y, 7)}`,
  );
  section(
    "loci",
    "Loci",
    "Where the special points of the branches move in the plane of two keys.",
    chips(items, () => plot.redraw()),
    plot.box,
  );
}
