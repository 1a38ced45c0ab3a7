// Stability studies: where each scheme fails, one impact, contacts that last.

/** Classes of stability, from harmless to worst, and the curve colours they are shown in. */
const CLASSES = ["stable", "dissipative", "frozen", "another-motion", "energy-gaining", "diverged"];
const CLASS_TONES = {
  light: [
    [214, 232, 224],
    [159, 199, 226],
    [120, 120, 160],
    [240, 200, 90],
    [226, 120, 40],
    [110, 20, 20],
  ],
  dark: [
    [38, 66, 58],
    [40, 90, 130],
    [120, 120, 170],
    [200, 160, 50],
    [226, 120, 40],
    [250, 210, 205],
  ],
};
const classTone = (word) =>
  CLASS_TONES[isDark() ? "dark" : "light"][CLASSES.indexOf(word)] || [128, 128, 128];

function stabilitySection() {
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
    return cellMap({
      x: "Step (s)",
      y: columnLabel(parameter[rows[0]].replace(/_n_per_m$/, "_N_per_m")),
      heading: scheme[rows[0]],
      height: 210,
      alt: `Classes of ${name}`,
      xs: rows.map((i) => step[i]),
      ys: numbers,
      toneOf: (k) => classTone(maps.columns.class[rows[k]]),
      tell: (k) => row(rows[k]),
    }).box;
  });
  const legend = el(
    "div",
    { class: "bar" },
    CLASSES.map((word) => swatch(word, () => `rgb(${classTone(word)})`)),
  );
  section(
    "maps",
    "Where each scheme fails",
    "Every cell is a run against a fine one of the same scene; point at it for its class and the reason.",
    legend,
    el("div", { class: "two" }, plots),
  );
  impactSection();
  const lasting = tableOf(DATA.stability.lasting);
  const rows = Array.from({ length: lasting.count }, (_, i) => i);
  section(
    "lasting",
    "Contacts that last",
    "Energy over that at the start, and the ripple of the contact force: its deviation from its mean, over the mean (0: constant, 1: on and off).",
    sortable(
      columnsOf(
        lasting,
        lasting.names.map((name) => [name, name.replace(/_/g, " ")]),
      ),
      rows,
      { height: 420 },
    ),
  );
}

/** The restitution of one free impact by its phase within the step. */
function impactSection() {
  const table = tableOf(DATA.stability.impacts);
  const { scheme, kappa, phase, restitution } = table.columns;
  const setting = table.columns.integrator_or_setting;
  const names = scheme.map((name, i) =>
    [
      name,
      setting && setting[i] !== "" && !Number.isNaN(setting[i]) ? setting[i] : "",
      kappa && Number.isFinite(kappa[i]) ? `κ = ${digits(kappa[i], 2)}` : "",
    ]
      .filter((part) => part !== "")
      .join(" "),
  );
  const items = [...new Set(names)].map((label, n) => ({
    label,
    look: lookOf(n),
    shown: !label.includes("κ"),
  }));
  const series = items.map((item) => {
    const rows = names.map((_, i) => i).filter((i) => names[i] === item.label);
    return {
      look: item.look,
      x: rows.map((i) => phase[i]),
      y: rows.map((i) => restitution[i]),
      hidden: () => !item.shown,
    };
  });
  const plot = new Plot({
    x: "Phase of the impact within the step",
    y: "Restitution",
    height: 340,
    alt: "Restitution of one impact",
    view: new View(0, 1),
    series,
  });
  section(
    "impact",
    "One impact",
    "The restitution that one free impact realises, by when in a step it falls; κ is h²k/m of the penalty spring.",
    plot.box,
    chips(items, () => {
      plot.dirty = true;
      refresh();
    }),
  );
}
