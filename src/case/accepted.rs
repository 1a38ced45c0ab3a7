//! The accepted values of each key, for messages.

const SYSTEM: &str = "one of the tables [system.oscillator], [system.chain], [system.bar], [system.beam], \
                      [system.matrices], [system.modal]";
const OSCILLATOR: &str = "the table [system.oscillator] with mass (kg), damping (N s/m) and stiffness (N/m)";
const BAR_END: &str = "\"clamped\", \"free\" or { stiffness = N/m }, a spring to ground";
const BEAM_END: &str =
    "\"pinned\", \"clamped\", \"free\" or { stiffness = N/m, rotational = N m/rad }, springs to ground";
const CHAIN_END: &str = "\"free\" or { stiffness = N/m }, a spring to ground";
const PATH: &str = "a path in quotes, relative to the case file, of a Matrix Market (.mtx) or CSV (.csv) file";

/// Path of the key, then the accepted values.
const ACCEPTED: &[(&str, &str)] = &[
    ("title", "one line of text: title = \"Two rigid walls, 5 Hz sine\""),
    ("source", "one line of text: source = \"Fig. 4\""),
    ("system", SYSTEM),
    ("system.oscillator", OSCILLATOR),
    ("system.oscillator.mass", "mass = a number above 0, in kg"),
    ("system.oscillator.damping", "damping = a number, 0 or more, in N s/m"),
    ("system.oscillator.stiffness", "stiffness = a number, 0 or more, in N/m"),
    (
        "system.chain",
        "the table [system.chain] with masses, mass (kg), springs (N/m) and, where wanted, left and right",
    ),
    ("system.chain.masses", "masses = how many there are, a whole number from 1, or a list of numbers above 0, in kg"),
    ("system.chain.mass", "mass = a number above 0, in kg: that of each, where masses says how many"),
    (
        "system.chain.springs",
        "springs = a number, 0 or more, in N/m, or a list of them, one between each two neighbours",
    ),
    ("system.chain.left", CHAIN_END),
    ("system.chain.right", CHAIN_END),
    ("system.bar", "the table [system.bar] with length, youngs_modulus, density, area, elements, left and right"),
    ("system.bar.length", "length = a number above 0, in m"),
    ("system.bar.youngs_modulus", "youngs_modulus = a number above 0, in Pa"),
    ("system.bar.density", "density = a number above 0, in kg/m^3"),
    ("system.bar.area", "area = a number above 0, in m^2"),
    ("system.bar.elements", "elements = a whole number from 1"),
    ("system.bar.mass_matrix", "mass_matrix = \"consistent\" or \"lumped\""),
    ("system.bar.left", BAR_END),
    ("system.bar.right", BAR_END),
    (
        "system.beam",
        "the table [system.beam] with length, youngs_modulus, density, outer_diameter, elements, left, right \
         and, where wanted, \
         inner_diameter and added_mass",
    ),
    ("system.beam.length", "length = a number above 0, in m"),
    ("system.beam.youngs_modulus", "youngs_modulus = a number above 0, in Pa"),
    ("system.beam.density", "density = a number above 0, in kg/m^3"),
    ("system.beam.outer_diameter", "outer_diameter = a number above 0, in m"),
    ("system.beam.inner_diameter", "inner_diameter = a number, 0 (solid) or more and below outer_diameter, in m"),
    ("system.beam.added_mass", "added_mass = a number, 0 or more, in kg/m"),
    ("system.beam.elements", "elements = a whole number from 1"),
    ("system.beam.left", BEAM_END),
    ("system.beam.right", BEAM_END),
    ("system.matrices", "the table [system.matrices] with the files mass, stiffness and, where wanted, damping"),
    ("system.matrices.mass", PATH),
    ("system.matrices.damping", PATH),
    ("system.matrices.stiffness", PATH),
    (
        "system.modal",
        "the table [system.modal] with frequencies (Hz) or omega (rad/s) and, where wanted, masses (kg), \
         damping_ratios and shapes",
    ),
    ("system.modal.frequencies", "frequencies = a list of numbers, 0 or more, in Hz: one for each mode"),
    ("system.modal.omega", "omega = a list of numbers, 0 or more, in rad/s: one for each mode"),
    ("system.modal.masses", "masses = a number above 0, in kg, or a list of them, one for each mode"),
    ("system.modal.damping_ratios", "damping_ratios = a number above -1, or a list of them, one for each mode"),
    (
        "system.modal.shapes",
        "shapes = { tip = [a number for each mode], .. } or the path of a CSV file in quotes, a row for each point",
    ),
    ("system.damping", "the table [system.damping] with one of rayleigh, ratio, ratios, matrix"),
    ("system.damping.rayleigh", "rayleigh = { mass = 1/s, stiffness = s }: C = mass M + stiffness K"),
    ("system.damping.rayleigh.mass", "mass = a number, 0 or more, in 1/s"),
    ("system.damping.rayleigh.stiffness", "stiffness = a number, 0 or more, in s"),
    ("system.damping.ratio", "ratio = a number, 0 or more: the share of critical damping of every mode"),
    (
        "system.damping.ratios",
        "ratios = a list of numbers above -1, from the slowest mode on: [0.01, 0.02]; below 0 beside modes only",
    ),
    ("system.damping.matrix", PATH),
    ("system.planes", "planes = 1, or 2: the same chain, oscillator or beam in the planes y and z"),
    ("system.modes", "modes = how many modes to keep, a whole number from 1"),
    ("system.static_correction", "static_correction = true or false"),
    ("wall", "one [[wall]] table, in double brackets, for each wall"),
    ("wall.name", "name = letters, digits, - and _, in quotes"),
    (
        "wall.side",
        "side = \"upper\" (the body may not go above position), \"lower\" (not below) or \"both\" (with gap)",
    ),
    ("wall.direction", "direction = a number, in deg, from +y towards +z; in two planes only"),
    ("wall.position", "position = a number, in m"),
    ("wall.gap", "gap = a number, 0 or more, in m: with side = \"both\", how far each wall stands from position"),
    ("wall.restitution", "restitution = a number from 0 to 1; rigid walls only"),
    ("wall.stiffness", "stiffness = a number above 0, in N/m, which makes the wall elastic"),
    ("wall.damping", "damping = a number, 0 or more, in N s/m; elastic walls only"),
    ("support", "one [[support]] table, in double brackets, for each support"),
    ("support.name", "name = letters, digits, - and _, in quotes"),
    ("support.shape", "shape = \"flats\" or \"round\""),
    ("support.directions", "directions = a list of numbers, in deg: where the flats stand, from +y towards +z"),
    ("support.sides", "sides = a whole number from 1 to 360: that many flats, evenly round"),
    ("support.turn", "turn = a number, in deg: where the first of the sides stands"),
    (
        "support.gap",
        "gap = a number, in m: from the centre to each flat, 0 or more, or a list of them; the radius of a hole \
         less that of the tube, above 0",
    ),
    ("support.centre", "centre = [y, z], two numbers, in m"),
    ("support.restitution", "restitution = a number from 0 to 1; rigid supports only"),
    ("support.stiffness", "stiffness = a number above 0, in N/m, which makes the support elastic"),
    ("support.damping", "damping = a number, 0 or more, in N s/m; elastic supports only"),
    ("support.friction", "friction = a number from 0 to 10: the coefficient of Coulomb friction"),
    ("support.width", "width = a number above 0, in m: along the tube, for the depth of wear"),
    ("support.radius", "radius = a number above 0, in m: that of the tube, for the depth of wear"),
    ("support.coefficient", "coefficient = a number above 0, in 1/Pa: that of [wear] for this support"),
    ("support.support_coefficient", "support_coefficient = a number above 0, in 1/Pa: that of [wear] for this support"),
    ("wear", "the table [wear] with coefficient (1/Pa), service (s) and, where wanted, support_coefficient, sectors"),
    ("wear.coefficient", "coefficient = a number above 0, in 1/Pa: the wear coefficient of the tube"),
    ("wear.support_coefficient", "support_coefficient = a number above 0, in 1/Pa: that of the supports"),
    ("wear.service", "service = a number above 0, in s: the time for which the worn volume is computed"),
    ("wear.sectors", "sectors = a whole number from 1 to 3600: parts of the circle around each support"),
    ("load", "one [[load]] table, in double brackets, for each load"),
    (
        "load.direction",
        "direction = a number, in deg, from +y towards +z, in quotes \"both\" for a random load; in two planes only",
    ),
    ("load.constant", "constant = { force = a number, in N }"),
    ("load.constant.force", "force = a number, in N"),
    ("load.harmonic", "harmonic = { amplitude = N, frequency = Hz, phase = rad }"),
    ("load.harmonic.amplitude", "amplitude = a number, in N"),
    ("load.harmonic.frequency", "frequency = a number, 0 or more, in Hz"),
    ("load.harmonic.phase", "phase = a number, in rad"),
    ("load.impulse", "impulse = { impulse = N s, time = s }"),
    ("load.impulse.impulse", "impulse = a number, in N s"),
    ("load.impulse.time", "time = a number, 0 or more, in s"),
    (
        "load.table",
        "table = { file = \"force.csv\" } and, where wanted, time = \"t\", force = \"F2\", delimiter = \";\", \
         decimal = \",\", scale = 2.0",
    ),
    ("load.table.file", "file = a path in quotes, relative to the case file"),
    ("load.table.time", "time = the header of the column of times, in quotes"),
    ("load.table.force", "force = the header of the column of forces, in quotes"),
    ("load.table.delimiter", "delimiter = what stands between columns: \",\", \";\", \"\\t\", \"|\" or \" \""),
    ("load.table.decimal", "decimal = \".\" or \",\""),
    ("load.table.scale", "scale = a number other than 0: how many N one unit of the column is"),
    (
        "load.random",
        "random = { rms = N, from = Hz, to = Hz, seed = 1 }, or psd = [[Hz, N^2/Hz], ..] or file = \
         \"psd.csv\" in place of rms, from and to",
    ),
    ("load.random.rms", "rms = a number above 0, in N: the root mean square of the force"),
    ("load.random.from", "from = a number above 0, in Hz: where the band begins"),
    ("load.random.to", "to = a number above from, in Hz: where the band ends"),
    ("load.random.psd", "psd = pairs of Hz and N^2/Hz, one-sided: [[1.0, 0.02], [100.0, 0.02]]"),
    ("load.random.file", "file = a path in quotes, relative to the case file"),
    ("load.random.seed", "seed = a whole number from 0 to 2^53"),
    (
        "load.base",
        "base = { file = \"shake.csv\" } and, where wanted, time, acceleration, delimiter, decimal, scale, influence",
    ),
    ("load.base.file", "file = a path in quotes, relative to the case file"),
    ("load.base.time", "time = the header of the column of times, in quotes"),
    ("load.base.acceleration", "acceleration = the header of the column of accelerations, in quotes"),
    ("load.base.delimiter", "delimiter = what stands between columns: \",\", \";\", \"\\t\", \"|\" or \" \""),
    ("load.base.decimal", "decimal = \".\" or \",\""),
    ("load.base.scale", "scale = a number other than 0: how many m/s^2 one unit of the column is"),
    ("load.base.influence", "influence = { row = [[0, 1.0], ..] }: matrices and modal data only"),
    ("initial", "the table [initial] with displacement (m) and velocity (m/s), or equilibrium = true"),
    ("initial.equilibrium", "equilibrium = true or false"),
    ("initial.displacement", "displacement = a number, in m"),
    ("initial.velocity", "velocity = a number, in m/s"),
    ("probe", "one [[probe]] table, in double brackets, for each probe"),
    ("probe.name", "name = letters, digits, - and _, in quotes"),
    ("probe.direction", "direction = a number, in deg, from +y towards +z; left out: two probes, NAME-y and NAME-z"),
    (
        "time",
        "the table [time] with end (s), step (s) and, where wanted, sample (s), statistics_from (s) and \
         force_averaging (s)",
    ),
    ("time.end", "end = a number above 0, in s"),
    ("time.step", "step = a number above 0 and below end, in s"),
    ("time.sample", "sample = a number above 0 and at most end, in s"),
    ("time.statistics_from", "statistics_from = a number, 0 or more and below end, in s"),
    ("time.force_averaging", "force_averaging = a number above 0, in s"),
    ("statistics", "the table [statistics] with, where wanted, rest (s) and spectra"),
    ("statistics.rest", "rest = a number, 0 or more and below the window of the statistics, in s"),
    ("statistics.spectra", "spectra = true or false"),
    ("penalty", "the table [penalty] with a list epsilon (m^3/N) or a list stiffness (N/m)"),
    ("penalty.epsilon", "epsilon = a list of numbers above 0, in m^3/N: [1e-12, 1e-9]"),
    ("penalty.stiffness", "stiffness = a list of numbers above 0, in N/m: [1e6, 1e8]"),
    ("penalty.damping", "damping = a number, 0 or more, in N s/m; linear penalty only"),
    ("penalty.integrator", "integrator = a name in quotes, such as \"discrete-gradient\""),
];

/// Keys that users may write in the wrong table, with the right one.
const ELSEWHERE: &[(&str, &str)] = &[
    ("statistics.force_window", "`force_averaging` in [time]: the stretch over which forces are averaged"),
    ("statistics.force_averaging", "`force_averaging` in [time]"),
    ("statistics.statistics_from", "`statistics_from` in [time]"),
    ("time.rest", "`rest` in [statistics]"),
    ("time.spectra", "`spectra` in [statistics]"),
];

/// The key that was probably meant by a key in the wrong table.
pub(super) fn elsewhere(path: &str) -> Option<&'static str> {
    ELSEWHERE.iter().find(|(key, _)| *key == path).map(|(_, text)| *text)
}

/// The accepted values of the key with that path.
pub(super) fn accepted(path: &str) -> Option<&'static str> {
    ACCEPTED.iter().find(|(key, _)| *key == path).map(|(_, text)| *text)
}

/// The path of every key, without the names and numbers of walls, loads and probes.
pub(super) fn paths() -> impl Iterator<Item = &'static str> + Clone {
    ACCEPTED.iter().map(|(key, _)| *key)
}
