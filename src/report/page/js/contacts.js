// The contacts as a table with the histogram of the column sorted by, and the statistics per wall.

function contactSection() {
  const one = runs.length === 1;
  const rows = runs.flatMap((run) =>
    Array.from({ length: run.contacts.count }, (_, k) => [run, k]),
  );
  const of =
    (key) =>
    ([run, k]) =>
      run.contacts[key][k];
  const places = meetingPlaces();
  const wallOf = ([run, k]) => places[run.contacts.wall[k]] || "–";
  const lasts = (row) => of("end")(row) - of("start")(row);
  const lasting = rows.some((row) => !Number.isNaN(of("peak")(row)));
  const [unit, factor] = lengthUnit(
    Math.max(...runs.map((run) => (extent(run.contacts.approach) || [0, 0])[1])),
  );
  const number = (name, label, value) => ({
    name,
    label,
    value,
    show: (row) => digits(value(row), 5),
  });
  const columns = [
    one ? null : wordColumn("method", ([run]) => run.label),
    wordColumn("wall", wallOf),
    { name: "from (s)", up: true, value: of("start"), show: (row) => of("start")(row).toFixed(6) },
    lasting
      ? {
          name: "lasts (ms)",
          label: "Duration (ms)",
          value: (row) => 1e3 * lasts(row),
          show: (row) =>
            Number.isNaN(lasts(row)) ? "open" : lasts(row) === 0 ? "–" : digits(1e3 * lasts(row)),
        }
      : null,
    {
      ...number("impulse (N s)", "Impulse (N s)", (row) => Math.abs(of("impulse")(row))),
      show: (row) => digits(of("impulse")(row), 5),
    },
    lasting ? number("peak force (N)", "Peak force (N)", of("peak")) : null,
    number(
      `approach (${unit}/s)`,
      `Approach speed (${unit}/s)`,
      (row) => of("approach")(row) * factor,
    ),
    number(
      `departure (${unit}/s)`,
      `Departure speed (${unit}/s)`,
      (row) => of("departure")(row) * factor,
    ),
    {
      ...number(
        "e",
        "Departure over approach",
        // One that begins at no speed has none.
        (row) => (of("approach")(row) > 0 ? of("departure")(row) / of("approach")(row) : NaN),
      ),
      title: "Departure speed over approach speed",
    },
  ].filter((column) => column);
  const histogram = histogramOf(columns, rows, wallOf);
  const table = sortable(columns, rows, {
    height: 400,
    by: columns.findIndex((column) => column.name === "from (s)"),
    pick: ([run, k]) => {
      const t = run.contacts.start[k];
      view.set(t - 0.6 * glance(), t + 0.6 * glance());
      seek(t);
      document.getElementById("motion").scrollIntoView({ behavior: "smooth" });
    },
    sorted: (i) => columns[i].label && histogram.show(columns[i]),
  });
  const lines = () => {
    const header = [
      "wall",
      "start_s",
      "end_s",
      "impulse_N_s",
      "peak_force_N",
      "approach_speed_m_per_s",
      "departure_speed_m_per_s",
    ];
    const line = (row) => [
      wallOf(row),
      ...["start", "end", "impulse", "peak", "approach", "departure"].map((key) => of(key)(row)),
    ];
    return [header, ...rows.filter(([run]) => run === lead).map(line)];
  };
  section(
    "contacts",
    "Contacts",
    `${counted(rows.length)} ${rows.length === 1 ? "contact" : "contacts"} over the whole run. Sort by a column to see how it is distributed; click a row to go there.`,
    el("div", { class: "two long" }, table, histogram.box),
    saveBar("contacts.csv", lines, "All digits"),
  );
}

/** Bins of a histogram. */
const BINS = 28;
/** Most groups that it tells apart. */
const GROUPS = 8;

function histogramOf(columns, rows, wallOf) {
  const one = runs.length === 1;
  const groups = one
    ? PLACES.slice(0, GROUPS).map((name) => ({
        name,
        has: (row) => placeOf(wallOf(row)) === name,
        colour: () => placeColour(name),
      }))
    : runs.slice(0, GROUPS).map((run) => ({
        name: run.label,
        has: ([other]) => other === run && run.shown,
        colour: run.look.colour,
      }));
  const plot = new Plot({ x: " ", y: "Contacts", height: 360, alt: "Histogram of the contacts" });
  const show = (column) => {
    const values = rows.map(column.value);
    const [lo, hi] = extent(values) || [0, 1];
    const bin = (hi - lo) / BINS || 1;
    plot.x = column.label;
    plot.series = groups.map((group, n) => {
      const y = new Float64Array(BINS);
      rows.forEach((row, i) => {
        if (Number.isFinite(values[i]) && group.has(row))
          y[clamp(Math.floor((values[i] - lo) / bin), 0, BINS - 1)]++;
      });
      return {
        kind: "bars",
        look: lookOf(0),
        colour: group.colour,
        alpha: 0.85,
        x: Array.from(y, (_, i) => lo + i * bin),
        y,
        bin,
        group: [n / groups.length, (n + 1) / groups.length],
      };
    });
    plot.limits = () => {
      plot.X = padded([lo, lo + BINS * bin], 0.02);
      plot.Y = [0, 1.08 * Math.max(1, ...plot.series.map((s) => Math.max(...s.y)))];
    };
    plot.redraw();
    shown = column;
  };
  let shown = columns.find((column) => column.name.startsWith("impulse"));
  show(shown);
  toggled.push(() => show(shown));
  const more = one && PLACES.length > GROUPS ? `and ${PLACES.length - GROUPS} places more` : null;
  return {
    show,
    box: el(
      "div",
      {},
      el(
        "div",
        { class: "bar" },
        groups.map((group) => swatch(group.name, group.colour)),
        more,
      ),
      plot.box,
    ),
  };
}

/** Statistics of each wall and round support over the window, with their 95 % intervals. */
function statisticsSection() {
  const { statistics } = DATA.summary;
  const { walls } = statistics;
  const number = (x) => (x === null || x === undefined ? NaN : x);
  const column = (name, value, half, factor = 1) => ({
    name,
    value: (wall) => number(value(wall)) * factor,
    show: (wall) =>
      plusMinus(number(value(wall)) * factor, half ? half(wall) * factor || null : null),
  });
  const columns = [
    wordColumn("wall", (wall) => wall.wall),
    column("contacts", (w) => w.contacts),
    column(
      "contacts a second",
      (w) => w.contact_rate_per_s,
      (w) => (w.half_width_95 || {}).contact_rate_per_s,
    ),
    column(
      "impulse (N s)",
      (w) => w.force && w.force.impulse_n_s,
      (w) => w.force && w.force.impulse_half_width_95_n_s,
    ),
    column(
      "mean force (N)",
      (w) => w.force && w.force.mean_n,
      (w) => w.force && w.force.mean_half_width_95_n,
    ),
    column(
      "RMS force (N)",
      (w) => w.force && w.force.rms_n,
      (w) => w.force && w.force.rms_half_width_95_n,
    ),
    column("largest force (N)", (w) => w.force_largest?.mean_n),
    column("at (s)", (w) => w.force_largest?.at_s),
    column(
      "impulse of a contact (N s)",
      (w) => w.episode_impulse_n_s.mean,
      (w) => (w.half_width_95 || {}).episode_impulse_n_s,
    ),
    column(
      "contact time (%)",
      (w) => w.contact_time_ratio,
      (w) => (w.half_width_95 || {}).contact_time_ratio,
      100,
    ),
    column(
      "impact power (mW)",
      (w) => w.impact_power_w,
      (w) => (w.half_width_95 || {}).impact_power_w,
      1e3,
    ),
  ];
  const lines = () => [
    columns.map((c) => c.name),
    ...walls.map((wall) => columns.map((c) => c.value(wall))),
  ];
  section(
    "statistics",
    "Walls",
    `From ${digits(statistics.from_s)} to ${digits(statistics.to_s)} s; ± is half the 95 % interval of the mean.`,
    sortable(columns, walls, { height: Math.min(420, 60 + ROW * walls.length) }),
    saveBar("walls.csv", lines),
  );
}
