// The means over realisations of random loads, with their errors in parts.

/** Under `title`, those of `realisations`, of which `runs` says which they are. */
function meansSection({ count, estimates: judgeable, worn, checks }, title, runs) {
  const estimates = [...judgeable, ...(worn || [])];
  const judged = estimates.some(({ error }) => error);
  /** A share of the mean, in per cent. */
  const share = (row, x) => digits((100 * x) / Math.abs(row.mean), 2);
  const part = (key) => ({
    name: `${key} (%)`,
    value: (row) => (row.error?.[key] ? Math.abs(row.error[key].mean / row.mean) : NaN),
    show: (row) => {
      const found = row.error?.[key];
      return found ? plusMinus(...[found.mean, found.half_width_95].map((x) => (100 * x) / Math.abs(row.mean))) : "–";
    },
  });
  const errors = [
    {
      name: "error (%)",
      value: (row) => (row.error ? Math.abs(row.error.total / row.mean) : NaN),
      show: (row) => (row.error ? share(row, row.error.total) : "–"),
    },
    ...["start", "step", "modes"].filter((key) => estimates.some(({ error }) => error?.[key])).map(part),
  ];
  /** What `check` makes of a quantity that need not converge. */
  const refined = (check) => ({
    name: check.refined.half_step ? "half the step" : `${check.refined.more_modes.modes[1]} modes`,
    value: (row) => told(row, check)?.then ?? NaN,
    show: (row) => {
      const one = told(row, check);
      return one ? `${digits(one.own, 3)} → ${digits(one.then, 3)}` : "–";
    },
  });
  const told = (row, check) =>
    row.refinements?.find(({ refined }) => JSON.stringify(refined) === JSON.stringify(check.refined));
  const again = checks.length ? `, step and modes from ${checks[0].count} of them run again` : "";
  section(
    "means",
    title,
    `Over ${runs(count)}, with 95 % intervals` +
      (judged
        ? `; the errors in per cent of the mean${again}. A part whose interval holds 0 is not seen, ` +
          "which is no proof that there is none. Impact shares, sliding, contacts and impact power need " +
          "not converge and are not judged: the means of those run again, and the same refined."
        : "."),
    sortable(
      [
        wordColumn("place", (row) => row.place),
        wordColumn("mean of", (row) => measureInWords(row.measure)),
        wordColumn("unit", (row) => row.unit),
        {
          name: "mean",
          value: (row) => row.mean,
          show: ({ mean, half_width_95: half }) => plusMinus(mean, half),
        },
        ...(judged ? errors : []),
        ...checks.filter(({ refuted }) => !refuted.length).map(refined),
      ],
      estimates,
      { height: 60 + ROW * Math.min(estimates.length, 16) },
    ),
  );
}
