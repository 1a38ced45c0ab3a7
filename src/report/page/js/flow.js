// Tubes in a cross flow: the turbulent force that was asked for against that of the run, and the
// margins of stability.

function flowSection() {
  section(
    "flow",
    "Flow",
    null,
    ...(DATA.turbulence ? turbulenceParts() : []),
    ...(DATA.margins ? marginParts() : []),
  );
}

/** Asked and recovered forces on the modes of the field and the mode that are chosen. */
function turbulenceParts() {
  const [spectra, pairs] = [DATA.turbulence.spectra, DATA.turbulence.pairs].map(tableOf);
  const looks = { asked: lookOf(0, true), recovered: lookOf(1) };
  const names = [...new Set([...(spectra.columns.turbulence || []), ...(pairs.columns.turbulence || [])])];
  let [field] = names;
  const spectrum = spectrumOfModes(spectra, looks);
  const pairing = correlationOfModes(pairs, looks);
  const fill = () => {
    spectrum.fill(field);
    pairing.fill(field);
  };
  fill();
  const choose = (name) => {
    field = names.find((one) => String(one) === name);
    fill();
  };
  const fields = names.map((name) => [String(name), `Turbulence ${name}`]);
  const keys = Object.entries(looks).map(([name, look]) =>
    el("span", { class: "key" }, sampleOf(look), name),
  );
  return [
    el(
      "div",
      { class: "bar controls" },
      fields.length > 1 ? segmented("Turbulence", fields, fields[0][0], choose) : null,
      keys,
    ),
    ...spectrum.parts,
    ...pairing.parts,
  ];
}

/** The spectrum of the force on one mode: asked with its scatter, and recovered. */
function spectrumOfModes({ columns, rows }, looks) {
  const shown = { field: null, mode: null, curves: [] };
  const plot = new Plot({
    x: "Frequency (Hz)",
    y: "Force on the mode (N²/Hz)",
    height: 300,
    narrow: 66,
    log: [true, true],
    alt: "Spectrum of the force on a mode, asked and recovered",
  });
  const told = el("p", { class: "lead" });
  const pick = el("div", { class: "bar controls" });
  const draw = () => {
    // Beyond the ends of the spectrum there is no force: what is recovered there is leakage.
    const own = rows.filter(
      (i) =>
        columns.turbulence[i] === shown.field &&
        columns.mode[i] === shown.mode &&
        columns.asked_N2_per_Hz[i] > 0,
    );
    const curve = (name) => ({
      kind: "line",
      look: looks[name],
      rows: own,
      x: own.map((i) => columns.frequency_Hz[i]),
      y: own.map((i) => columns[`${name}_N2_per_Hz`][i]),
    });
    shown.curves = [curve("asked"), curve("recovered")];
    plot.series = [bandOf(shown.curves[0], columns.scatter_N2_per_Hz), ...shown.curves];
    plot.redraw();
  };
  tellNearest(
    plot,
    () => shown.curves.flatMap(({ rows: own, x, y }) => own.map((i, k) => ({ i, x: x[k], y: y[k] }))),
    ({ i }) =>
      [
        `${digits(columns.frequency_Hz[i])} Hz`,
        `asked ${digits(columns.asked_N2_per_Hz[i])} N²/Hz, ± ${digits(columns.scatter_N2_per_Hz[i], 2)}`,
        `recovered ${digits(columns.recovered_N2_per_Hz[i])} N²/Hz`,
      ].join("\n"),
  );
  const fill = (field) => {
    const own = rows.filter((i) => columns.turbulence[i] === field);
    const modes = new Map(own.map((i) => [columns.mode[i], columns.mode_frequency_Hz[i]]));
    Object.assign(shown, { field, mode: [...modes.keys()][0] });
    const choices = [...modes].map(([mode, f]) => [String(mode), `Mode ${mode}, ${digits(f)} Hz`]);
    const choose = (mode) => {
      shown.mode = Number(mode);
      draw();
    };
    pick.replaceChildren(...printed(selection("Mode", choices, String(shown.mode), choose)));
    draw();
    const some = own.find((i) => columns.asked_N2_per_Hz[i] > 0);
    const share = columns.scatter_N2_per_Hz[some] / columns.asked_N2_per_Hz[some];
    // Hann's window smears over two frequencies on either side.
    const smeared = 2 * (columns.frequency_Hz[own[1]] - columns.frequency_Hz[own[0]]);
    told.textContent =
      "The random force on a mode, scaled to a largest displacement of 1 along the field's stretch: as asked for, and " +
      "recovered by Welch's method from the force that the run applied. The estimate at a frequency scatters " +
      `about what was asked by up to ${digits(100 * share, 2)} % (the band: one standard deviation), less where ` +
      `few random phases make the force${smeared > 0 ? `, and is smeared over ± ${digits(smeared, 3)} Hz` : ""}.`;
  };
  const short = el("p", { class: "lead" }, "The run is too short for a spectrum within the band of the turbulence.");
  return rows.length
    ? { fill, parts: [el("h3", {}, "Spectrum of the force"), told, pick, plot.box] }
    : { fill: () => {}, parts: [short] };
}

/** The correlation of the forces on two modes: a point a pair, asked against recovered. */
function correlationOfModes({ columns, rows }, looks) {
  const plot = new Plot({
    x: "Correlation of the forces on two modes, asked",
    y: "Recovered",
    height: 300,
    alt: "Correlation of the forces on two modes, asked and recovered",
  });
  const told = el("p", { class: "lead" });
  let points = [];
  tellNearest(
    plot,
    () => points,
    ({ i }) =>
      [
        `modes ${columns.mode[i]} and ${columns.other_mode[i]}`,
        `asked ${digits(columns.asked_correlation[i])}, ± ${digits(columns.scatter[i], 2)}`,
        `recovered ${digits(columns.recovered_correlation[i])}`,
      ].join("\n"),
  );
  const fill = (field) => {
    const own = rows.filter((i) => columns.turbulence[i] === field);
    points = own.map((i) => ({ i, x: columns.asked_correlation[i], y: columns.recovered_correlation[i] }));
    const ends = extent(points.flatMap(({ x, y }) => [x, y])) || [-1, 1];
    plot.series = [
      { kind: "line", look: looks.asked, x: ends, y: ends },
      { kind: "points", look: looks.recovered, x: points.map(({ x }) => x), y: points.map(({ y }) => y) },
    ];
    plot.redraw();
    const table = DATA.summary?.case_file?.turbulence?.[parseInt(field, 10) - 1];
    const length = table?.correlation_length;
    const scatter = Math.max(...own.map((i) => columns.scatter[i]));
    told.textContent =
      "The force is made on the modes and is no field along the tube. Its coherence over a distance Δx, e^(−|Δx|/λ)" +
      `${length ? ` with λ\u00a0=\u00a0${digits(length)}\u00a0m` : ""}, is seen in the correlation of the forces on two modes, over ` +
      `the whole band: a point for each pair, about the line with a standard deviation of up to ${digits(scatter, 2)}.`;
  };
  return rows.length
    ? { fill, parts: [el("h3", {}, "Coherence"), told, plot.box] }
    : { fill: () => {}, parts: [] };
}
