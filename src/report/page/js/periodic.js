// The page of one periodic orbit.

/** The instants of a motion as orbit.js draws them. */
const readMotion = ({ phase, q, v }) => ({ T: decode(phase), Q: decode(q), V: decode(v) });

/** The orbit of the data as orbit.js draws it. */
function readOrbit() {
  const data = DATA.orbit;
  const walls = data.walls.map((wall) => ({
    name: wall.wall,
    side: wall.side,
    position: wall.position_m ?? null,
    rigid: wall.rigid,
  }));
  const orbit = {
    forcing: data.forcing,
    periods: data.periods,
    walls,
    multipliers: data.multipliers,
  };
  Object.assign(orbit, { events: [], T: [], Q: [], V: [] });
  if (!data.motion) return orbit;
  Object.assign(orbit, readMotion(data.motion));
  // Marked in the drawing are the contacts of the free run: those of a mirror half are among them.
  const { columns, count } = tableOf(data.contacts);
  for (let i = 0; i < count; i++)
    orbit.events.push({
      wall: columns.wall[i],
      kind: Number.isFinite(columns.peak_force_N[i]) ? "contact" : "impact",
      phase: columns.start_s[i] / data.forcing,
    });
  return orbit;
}

const ORBIT = DATA.orbit && {
  orbit: readOrbit(),
  over: DATA.orbit.over && readMotion(DATA.orbit.over.motion),
};

/** The phase plane, or else the multipliers, beside what the program found of the orbit. */
function orbitHead() {
  const plots = DATA.orbit.motion && orbitPlots(ORBIT);
  const circle = multiplierPlot(ORBIT);
  if (plots) {
    plots.over.height = 280;
    plots.update();
  }
  ORBIT.plots = plots;
  ORBIT.circle = circle;
  page.append(el("div", { class: "hero" }, plots ? plots.portrait.box : circle.box, cardList()));
}

function orbitSections() {
  const { plots, circle } = ORBIT;
  if (plots) {
    section(
      "motion",
      "Over one period",
      "Marks are contacts with a wall: discs impacts, squares contacts that last.",
      DATA.orbit.over ? el("div", { class: "bar" }, overKey(DATA.orbit.over)) : null,
      plots.over.box,
      orbitForces(plots.over.view),
    );
    contactTable();
  }
  const events = DATA.orbit.events || [];
  if (events.length)
    section(
      "events",
      "Events",
      DATA.summary.symmetric
        ? "Those of the first half; the second half is its mirror image."
        : "What happens, in order; phases and speeds are what Newton's method has solved for.",
      eventTable({
        events: events.map((event) => ({
          ...event,
          phase: event.phase_cycles,
          speed: event.speed_m_per_s,
        })),
      }),
    );
  if (!plots && DATA.orbit.run) wallTable();
  const rows = DATA.orbit.multipliers.map((multiplier, i) => ({ multiplier, i }));
  const half = DATA.orbit.half || [];
  const modulus = ([re, im]) => Math.hypot(re, im);
  const columns = [
    { name: "multiplier", value: ({ i }) => i, show: ({ i }) => String(i + 1) },
    {
      name: "value",
      value: ({ multiplier }) => multiplier[0],
      show: ({ multiplier }) => complexText(multiplier, 8),
    },
    {
      name: "modulus",
      value: ({ multiplier }) => modulus(multiplier),
      show: ({ multiplier }) => digits(modulus(multiplier), 8),
    },
  ];
  if (half.length)
    columns.push({
      name: "of the half map",
      value: ({ i }) => half[i][0],
      show: ({ i }) => complexText(half[i], 8),
    });
  const table = sortable(columns, rows, { height: 330 });
  section(
    "multipliers",
    "Multipliers",
    "How a small change of the orbit has grown one period later; inside the unit circle it dies out.",
    plots ? el("div", { class: "two" }, el("div", {}, circle.box), el("div", {}, table)) : table,
  );
  if (!plots && DATA.orbit.state.q) stateTable();
}

/** The forces of walls that push for a while. */
function orbitForces(over) {
  const { forces } = DATA.orbit.motion;
  if (!forces.length) return null;
  // The colour of a wall is that of its contacts.
  const items = forces.map(({ wall }) => ({
    label: ORBIT.orbit.walls[wall].name,
    look: { ...lookOf(wall), colour: () => placeColour(ORBIT.orbit.walls[wall].name) },
    shown: true,
  }));
  const plot = new Plot({
    x: "Phase of the load (cycles)",
    y: "Contact force (N)",
    height: 220,
    alt: "Contact forces over one period of the orbit",
    view: over,
    series: forces.map((force, n) => ({
      look: items[n].look,
      x: ORBIT.orbit.T,
      y: decode(force.force),
      hidden: () => !items[n].shown,
    })),
  });
  return el("div", {}, chips(items, () => plot.redraw()), plot.box);
}

/** The contacts of the free run over one period. */
function contactTable() {
  const table = tableOf(DATA.orbit.contacts);
  const { columns, rows } = table;
  if (!rows.length) return;
  // The run goes from an instant in the middle; phases begin at that of the first event.
  const { forcing, periods, events } = DATA.orbit;
  const phase = (i) => {
    const at = columns.start_s[i] / forcing;
    const first = events && events.length ? events[0].phase_cycles : 0;
    return at - periods * Math.floor((at - first) / periods + 1e-6);
  };
  const number = (name, text, n = 6) => ({
    name: text,
    value: (i) => columns[name][i],
    show: (i) => digits(columns[name][i], n),
  });
  const lasts = (i) => columns.end_s[i] - columns.start_s[i];
  section(
    "contacts",
    "Contacts",
    "Of the free run by the exact scheme over one period.",
    sortable(
      [
        wordColumn("wall", (i) => columns.wall[i]),
        { name: "phase (cycles)", value: phase, show: (i) => digits(phase(i), 7) },
        number("approach_speed_m_per_s", "approach (m/s)"),
        number("departure_speed_m_per_s", "departure (m/s)"),
        number("impulse_N_s", "impulse (N s)"),
        {
          name: "largest force (N)",
          value: (i) => columns.peak_force_N[i],
          show: (i) => (Number.isFinite(columns.peak_force_N[i]) ? digits(columns.peak_force_N[i], 6) : "–"),
        },
        { name: "lasts (s)", value: lasts, show: (i) => digits(lasts(i)) },
      ],
      rows,
      { height: 400 },
    ),
    saveBar("contacts.csv", () => linesOf(table)),
  );
}

/** The walls of an orbit without a motion in its folder. */
function wallTable() {
  const { walls } = DATA.orbit;
  if (!walls.length) return;
  const column = (name, key, text) => ({
    name,
    text,
    value: (wall) => wall[key] ?? NaN,
    show: (wall) => (text ? wall[key] : digits(wall[key], 6)),
  });
  section(
    "walls",
    "Walls",
    "Over one period.",
    sortable(
      [
        column("wall", "wall", true),
        column("contacts", "contacts"),
        column("impulse (N s)", "impulse_n_s"),
      ],
      walls,
      { height: 400 },
    ),
  );
}

/** A state on the orbit of a structure. */
function stateTable() {
  const { q, v, time, coordinates } = DATA.orbit.state;
  const rows = q.map((_, i) => i);
  section(
    "state",
    "A state on the orbit",
    `At t = ${digits(time, 9)} s, in ${coordinates === "modal" ? "modal coordinates" : "degrees of freedom"}.`,
    sortable(
      [
        { name: "coordinate", value: (i) => i, show: (i) => String(i + 1) },
        { name: "displacement (m)", value: (i) => q[i], show: (i) => digits(q[i], 9) },
        { name: "velocity (m/s)", value: (i) => v[i], show: (i) => digits(v[i], 9) },
      ],
      rows,
      { height: 330 },
    ),
  );
}
