// Stability studies: where each scheme fails, one impact, contacts that last.

/** The tone of a class of stability, that of the maps among the pictures. */
const classTone = (word) => {
  const { classes, tones } = DATA.stability;
  const tone = tones[classes.indexOf(word)] || "#808080";
  return [1, 3, 5].map((at) => parseInt(tone.slice(at, at + 2), 16));
};

/** A class of stability in its tone. */
const classSwatch = (word) => swatch(word, () => `rgb(${classTone(word)})`);

/** A step to two digits, and no more than it is. */
function roundedDown(step) {
  const unit = 10 ** (Math.floor(Math.log10(step)) - 1);
  return Number((Math.floor(step / unit + 1e-9) * unit).toPrecision(2));
}

/** The largest stable step of each scheme, and what happens beyond it. */
function stableSteps() {
  const { steps, conclusion, criterion } = DATA.stability;
  if (!steps) return;
  const impact = "impact on a rigid wall";
  const rigid = steps.some((row) => row.restitution);
  const head = ["scheme", "largest stable step", "hω", impact, "beyond it", "reason"].filter((name) => rigid || name !== impact);
  const range = (e) =>
    !e ? "–" : e.largest - e.least < 1e-9 ? digits(e.least) : `${digits(e.least, 3)} to ${digits(e.largest, 3)}`;
  const line = (row) => {
    const { beyond, largest_stable_step_s: step } = row;
    const longest = step ? `${beyond ? "" : "at least "}${prefixed(roundedDown(step), "s")}` : "none";
    return el(
      "tr",
      {},
      el("td", { title: row.scheme }, row.label),
      el("td", { class: step ? null : "none" }, el("b", {}, longest)),
      el("td", { "data-name": head[2] }, digits(row.largest_stable_step_times_omega, 3)),
      rigid ? el("td", { "data-name": impact }, range(row.restitution)) : null,
      el("td", {}, beyond ? classSwatch(beyond.class) : "stable on the whole grid"),
      el("td", { class: beyond ? null : "none" }, beyond ? `${beyond.reason}, at ${prefixed(beyond.step_s, "s")}` : "–"),
    );
  };
  section(
    "steps",
    "The largest stable step",
    null,
    conclusionOf(conclusion),
    el(
      "div",
      { class: "scroll" },
      el(
        "table",
        { class: "plain told" },
        el("thead", {}, el("tr", {}, head.map((text) => el("th", { scope: "col" }, text)))),
        el("tbody", {}, steps.map(line)),
      ),
    ),
    el(
      "p",
      { class: "lead" },
      `With the walls and springs of the case; ${criterion}.` +
        (rigid
          ? " Impact on a rigid wall: the restitution that the scheme realises in one free impact, over all phases of a step; of a penalty at h²k/m = 1."
          : ""),
    ),
  );
}

function stabilitySection() {
  stableSteps();
  const maps = tableOf(DATA.stability.maps);
  const { scheme, parameter, value, step_s: step, reason } = maps.columns;
  const groups = new Map();
  for (let i = 0; i < maps.count; i++) {
    const name = `${scheme[i]} · ${parameter[i]}`;
    groups.set(name, [...(groups.get(name) || []), i]);
  }
  const row = (i) =>
    [
      scheme[i],
      `${parameter[i]} ${digits(value[i])}, step ${prefixed(step[i], "s")}`,
      maps.columns.class[i],
      reason && reason[i] ? reason[i] : null,
    ]
      .filter((line) => line)
      .join("\n");
  const plots = [...groups].map(([name, rows]) => {
    const numbers = rows.map((i) => (Number.isFinite(value[i]) ? value[i] : 0));
    const plot = cellMap({
      x: "Step (s)",
      y: columnLabel(parameter[rows[0]].replace(/_n_per_m$/, "_N_per_m")),
      height: 210,
      alt: `Classes of ${name}`,
      xs: rows.map((i) => step[i]),
      ys: numbers,
      toneOf: (k) => classTone(maps.columns.class[rows[k]]),
      tell: (k) => row(rows[k]),
    });
    // A map of one tone would be taken for an empty one.
    const classes = new Set(rows.map((i) => maps.columns.class[i]));
    const everywhere = classes.size === 1 ? `: ${[...classes][0]} everywhere asked` : "";
    // Above the map: over it, the name would hide its cells.
    return el("div", {}, el("h3", {}, scheme[rows[0]].replace(":integrator=", ", ") + everywhere), plot.box);
  });
  const legend = el("div", { class: "bar" }, DATA.stability.classes.map(classSwatch));
  section(
    "maps",
    "Where each scheme fails",
    "Every cell is a run against a fine one of the same scene; point at it for its class and the reason.",
    legend,
    el("div", { class: "two" }, plots),
  );
  impactSection();
  const lasting = tableOf(DATA.stability.lasting);
  section(
    "lasting",
    "Contacts that last",
    "Energy over that at the start, and the ripple of the contact force: its deviation from its mean, over the mean (0: constant, 1: on and off).",
    sortable(
      columnsOf(
        lasting,
        lasting.names.map((name) => [name, name.replace(/_/g, " ")]),
      ),
      lasting.rows,
      { height: 420 },
    ),
  );
}

/** The restitution of one free impact by its phase within the step. */
function impactSection() {
  const { groups, phases } = DATA.stability;
  const { phase, restitution } = tableOf(DATA.stability.impacts).columns;
  if (!groups) return;
  const kappas = [...new Set(groups.map(({ kappa }) => kappa))];
  const panel = (kappa) => {
    const own = groups.filter((group) => group.kappa === kappa);
    const series = own.map(({ first }, n) => ({
      look: { ...lookOf(n), width: 2 },
      x: phase.slice(first * phases, (first + 1) * phases),
      y: restitution.slice(first * phases, (first + 1) * phases),
    }));
    const all = series.flatMap(({ y }) => [...y]);
    const [least, largest] = extent(all.filter((e) => e > 0)) || [1, 1];
    const log = kappa !== null && largest > 100 * least;
    // From 0 on, unless all are far from it and differ.
    const near = Math.min(...all) > 0.5 * largest && least < 0.99 * largest;
    const span = near ? padded([least, largest], 0.12) : [-0.05 * largest, 1.12 * largest];
    const plot = new Plot({
      x: "Phase of the impact within the step",
      y: "Restitution",
      height: 240,
      alt: "Restitution of one impact",
      view: new View(0, 1),
      log: [false, log],
      range: log ? undefined : () => span,
      series,
    });
    const told = own.map(({ names, range }, n) =>
      el("li", {}, sampleOf(series[n].look), el("span", {}, `${names}: ${range ?? "no result"}`)),
    );
    const title = kappa === null ? "Walls as constraints" : `Penalty, h²k/m = ${digits(kappa, 2)}`;
    return el("div", {}, el("h3", {}, title), plot.box, el("ul", { class: "curves" }, told));
  };
  section(
    "impact",
    "One impact",
    "The restitution that one free impact realises, by when in a step it falls. Schemes that agree at every phase share a curve; h²k/m is that of the penalty spring.",
    el("div", { class: "two" }, kappas.map(panel)),
  );
}
