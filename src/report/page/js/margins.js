// The fluid-elastic margins of tubes in a cross flow, by Connors' criterion.

/** The heading, what it means, and the table. */
function marginParts() {
  const { connors, inactive, active } = DATA.margins;
  const rows = [
    ...active.map((mode, i) => ({ ...mode, supports: "active", number: i + 1 })),
    ...inactive.map((mode, i) => ({ ...mode, supports: "inactive", number: i + 1 })),
  ];
  const least = (modes) => Math.min(...modes.map(({ margin }) => margin ?? Infinity));
  const verdict =
    least(active) < 1
      ? "Unstable with all supports active: work rates mean nothing."
      : least(inactive) < 1
        ? "Unstable with no support active" +
          (active.length ? "; stable with all of them active." : ".")
        : "Stable.";
  const column = (name, key, factor = 1) => ({
    name,
    value: (row) => (row[key] ?? Infinity) * factor,
    show: (row) => (row[key] === null ? "no flow" : digits(row[key] * factor, 4)),
  });
  const bodies = wordColumn("bodies", (row) => row.bodies.join(", "));
  const text =
    `${verdict} Connors' criterion with K = ${digits(connors)}: a mode is unstable where its margin, ` +
    "the critical velocity over the effective one, is below 1. The force of this instability is not " +
    "in the motion.";
  return [
    el("h3", {}, "Stability"),
    el("p", { class: "lead" }, text),
    sortable(
      [
        wordColumn("supports", (row) => row.supports),
        ...(rows.some(({ bodies }) => bodies?.length) ? [bodies] : []),
        { name: "mode", value: (row) => row.number, show: (row) => String(row.number) },
        column("frequency (Hz)", "frequency_hz"),
        column("damping (%)", "damping_ratio", 100),
        column("effective velocity (m/s)", "effective_velocity_m_per_s"),
        column("critical velocity (m/s)", "critical_velocity_m_per_s"),
        column("margin", "margin"),
      ],
      rows,
      { height: 60 + ROW * Math.min(rows.length, 16) },
    ),
  ];
}
