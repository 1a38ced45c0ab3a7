// What the words of a page mean, as in docs/statistics.md and docs/engineer.md.

/** Of runs with supports. */
const SUPPORT_WORDS = [
  ["work rate", "normal force times sliding speed at a support, in the mean over the time of the statistics, W; of impacts that slide as well"],
  ["mean force", "the mean over time of the size of the contact force, N"],
  ["RMS force", "the root of the mean square of the contact force; at rigid supports of its means over short stretches, N"],
  ["sector", "one of equal parts of the circle around a support, counted from +y towards +z"],
  ["depth in a sector", "the volume worn off the tube in a sector, by Archard's law V = k W T, over its part of the tube's surface; no deeper than one scar of all of it"],
];

/** Of depths. */
const DEPTH_WORDS = [
  ["deepest wear", "the depth of the deepest sector, or flat; over several realisations or histories the largest of the means of all sectors, with what taking the largest adds in its half width, by the jackknife; of one run or history alone, under random loads, an upper figure"],
  ["wear all round", "the same volume taken off evenly all round: the mean depth"],
  ["one scar", "the depth if all of the volume comes off one scar, in the first gap"],
];

/** Of several realisations. */
const DRAW_WORDS = [
  ["realisation", "a run with random loads, or a start, of its own: the same spectra, other seeds"],
  ["± and bands", "the 95 % interval of the mean, by Student's t: of the mean, and not of one realisation"],
];

/** Of wear over the years. */
const HISTORY_WORDS = [
  ["window", "a run of seconds in the gaps of that year, whose work rate stands for the years around it"],
  ["history", "a course of windows over the years, each with loads of its own and with the gaps that the ones before have made"],
  ["gap", "the radius of a hole less that of the tube; of flats the least distance; it grows by the wear of tube and support"],
  ["limit", "the depth up to which the tube may wear, a share of its wall"],
];

function definitionSection(words) {
  section(
    "definitions",
    "Definitions",
    null,
    el(
      "dl",
      { class: "words" },
      words.map(([word, meaning]) => [el("dt", {}, word), el("dd", {}, meaning)]).flat(),
    ),
  );
}
