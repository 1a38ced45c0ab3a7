//! Every key of a case file, once: the reader, its messages, the keys of `--set` and the table in
//! `cases/README.md` come from here. The keys of a body are those of a system, under `body`.

use super::key_entry::Kind::{Any, Inline, Number, Numbers, Table, Tables, Truth, Word};
use super::key_entry::{KeyEntry, REQUIRED, entry};

const ABOVE_0: &str = "a number above 0";
const NOT_NEGATIVE: &str = "a number, 0 or more";
const NAME: &str = "letters, digits, - and _, in quotes";
const TOWARDS: &str = "a number: from +y towards +z";
const IN_ONE_PLANE: &str = "in one plane; beside `at = { row }`";
const PLACE_NEEDED: &str = "required above one degree of freedom";
const ENDS: &str = "\"clamped\", \"free\" or { stiffness = N/m }, a spring to ground";
const BEAM_ENDS: &str =
    "\"pinned\", \"clamped\", \"free\" or { stiffness = N/m, rotational = N m/rad }, springs to ground";
const CHAIN_ENDS: &str = "\"free\" or { stiffness = N/m }, a spring from the end mass to ground";
const MATRIX: &str = "a path in quotes, relative to the case file, of a Matrix Market (.mtx) or CSV (.csv) file";
const FILE: &str = "a path in quotes, relative to the case file";
const DELIMITER: &str = "what stands between columns: \",\", \";\", \"\\t\", \"|\" or \" \"";
const OTHER_WORDS: &str = "any other word";
const UNORDINARY: &str = "0, negative, nan, inf";
const INVALID: &str = "negative, nan, inf";

/// A key within a value of several types, which `--set` can name.
const fn inner(key: &'static str, unit: &'static str) -> KeyEntry {
    entry(key, Any, unit, [""; 3])
}

/// All keys, in the order of `cases/README.md`: path, type, unit; what holds where it is left out,
/// what is accepted, what is refused. Messages quote what is accepted, so it is ASCII.
#[rustfmt::skip]
pub(super) const LISTED: &[KeyEntry] = &[
    entry("title", Word, "", ["none", "one line of text", ""]),
    entry("source", Word, "", ["none", "one line of text", ""]),
    entry("system", Table, "", ["required unless there are bodies", "exactly one of the tables \
        `oscillator`, `chain`, `bar`, `beam`, `matrices`, `modal`; beside bodies none of them",
        "none, two"]),
    entry("system.planes", Number, "", ["1", "1, or 2: the same chain, oscillator or beam in the \
        planes y and z, see below; matrices and modes hold both planes", "beside `bar`; other \
        numbers"]),
    entry("system.modes", Number, "", ["all of them", "how many modes to keep, a whole number from \
        1: in two planes of each, slowest first", "beside `oscillator`; more than the degrees of \
        freedom; fewer than the rigid-body motions; so few that the start lies behind a wall"]),
    entry("system.static_correction", Truth, "", ["`false`", "true or false: whether walls get the \
        compliance of the modes left out", "without `modes`"]),
    entry("system.oscillator", Table, "", ["", "one degree of freedom", ""]),
    entry("system.oscillator.mass", Number, "kg", [REQUIRED, ABOVE_0, UNORDINARY]),
    entry("system.oscillator.damping", Number, "N_s_per_m", [REQUIRED, NOT_NEGATIVE, INVALID]),
    entry("system.oscillator.stiffness", Number, "N_per_m", [REQUIRED, "a number, 0 (a free body) \
        or more", INVALID]),
    entry("system.chain", Table, "", ["", "masses in a line; degree of freedom i is the \
        displacement of mass i", ""]),
    entry("system.chain.masses", Any, "kg", [REQUIRED, "how many there are, a whole number from 1, \
        or a list of numbers above 0", "an empty list; above 1e6"]),
    entry("system.chain.mass", Number, "kg", ["required beside a number of masses", "a number \
        above 0: that of each, where masses says how many", "beside a list"]),
    entry("system.chain.springs", Any, "N_per_m", [REQUIRED, "a number, 0 or more, or a list of \
        them: one between each two neighbours", "another length, negative"]),
    entry("system.chain.left", Any, "", ["`\"free\"`", CHAIN_ENDS, OTHER_WORDS]),
    entry("system.chain.right", Any, "", ["`\"free\"`", CHAIN_ENDS, OTHER_WORDS]),
    entry("system.bar", Table, "", ["", "axial motion, linear elements; degrees of freedom are the \
        nodes from left to right without clamped ends", ""]),
    entry("system.bar.length", Number, "m", [REQUIRED, ABOVE_0, UNORDINARY]),
    entry("system.bar.youngs_modulus", Number, "Pa", [REQUIRED, ABOVE_0, UNORDINARY]),
    entry("system.bar.density", Number, "kg_per_m3", [REQUIRED, ABOVE_0, UNORDINARY]),
    entry("system.bar.area", Number, "m2", [REQUIRED, ABOVE_0, UNORDINARY]),
    entry("system.bar.elements", Number, "", [REQUIRED, "a whole number from 1 to 1e5", "two \
        clamped ends with one element between"]),
    entry("system.bar.mass_matrix", Word, "", ["`\"consistent\"`", "\"consistent\" or \"lumped\"",
        OTHER_WORDS]),
    entry("system.bar.left", Any, "", [REQUIRED, ENDS, OTHER_WORDS]),
    entry("system.bar.right", Any, "", [REQUIRED, ENDS, OTHER_WORDS]),
    entry("system.beam", Table, "", ["", "a tube or a rectangular beam in bending, Euler–Bernoulli, Hermite elements; \
        degrees of freedom are deflection (m) and rotation (rad) of each node from left to right, \
        without those that ends hold", ""]),
    entry("system.beam.length", Number, "m", ["required unless spans are given", ABOVE_0,
        UNORDINARY]),
    entry("system.beam.spans", Numbers, "m", ["no joints", "a list of numbers above 0, in place of \
        length: what lies between supports, each ends in a joint", "beside `length`"]),
    entry("system.beam.youngs_modulus", Number, "Pa", [REQUIRED, ABOVE_0, UNORDINARY]),
    entry("system.beam.density", Number, "kg_per_m3", [REQUIRED, ABOVE_0, UNORDINARY]),
    entry("system.beam.outer_diameter", Number, "m", ["required unless width and height are given",
        ABOVE_0, "0, negative, nan, inf; beside `width`, `height`"]),
    entry("system.beam.inner_diameter", Number, "m", ["0, a rod", "a number, 0 (solid) or more and \
        below outer_diameter", "negative, not below `outer_diameter`; beside `width`, `height`"]),
    entry("system.beam.width", Number, "m", ["a tube", "a number above 0: of a solid rectangle in \
        place of the diameters, across the vibration", "0, negative, nan, inf; without `height`; \
        beside `planes = 2`"]),
    entry("system.beam.height", Number, "m", ["a tube", "a number above 0: of the rectangle in the \
        direction of the vibration, I = width height^3/12", "0, negative, nan, inf; without \
        `width`"]),
    entry("system.beam.added_mass", Number, "kg_per_m", ["0", "a number, 0 or more: fluid inside, \
        fluid moved outside, pellets", "negative"]),
    entry("system.beam.elements", Number, "", ["20 of each span, at least two and a half for each \
        of `modes`", "a whole number from 1 to 1e5: of the whole beam, of equal length", "two clamped \
        ends with one element between"]),
    entry("system.beam.left", Any, "", [REQUIRED, BEAM_ENDS, OTHER_WORDS]),
    entry("system.beam.right", Any, "", [REQUIRED, BEAM_ENDS, OTHER_WORDS]),
    entry("system.matrices", Table, "", ["", "M q̈ + C q̇ + K q = f from files, in kg, N s/m and \
        N/m; M is positive definite except for degrees of freedom without mass, K and C are \
        positive semidefinite, see below", "see below"]),
    entry("system.matrices.mass", Word, "", [REQUIRED, MATRIX, ""]),
    entry("system.matrices.stiffness", Word, "", [REQUIRED, MATRIX, ""]),
    entry("system.matrices.damping", Word, "", ["none", MATRIX, "beside `[system.damping]`"]),
    entry("system.matrices.line", Any, "m", ["not drawn", "pairs of a degree of freedom and its \
        position along the structure, which increases, [[0, 0.0], [2, 0.05]]; in two planes of the \
        degrees of freedom along y and z and their position, [[0, 1, 0.0], [2, 3, 0.05]]: where \
        pictures draw them", "fewer than two of them"]),
    entry("system.modal", Table, "", ["", "modes as finite-element programs export them; degree of \
        freedom i is the coordinate of mode i, see below", ""]),
    entry("system.modal.frequencies", Numbers, "Hz", ["`omega`", "a list of numbers, 0 (rigid-body \
        motion) or more: one for each mode", "beside `omega`; negative"]),
    entry("system.modal.omega", Numbers, "rad_per_s", ["`frequencies`", "a list of numbers, 0 or \
        more: one for each mode", "beside `frequencies`; negative"]),
    entry("system.modal.masses", Any, "kg", ["1, shapes normalised to the mass", "a number above \
        0, or a list of them, one for each mode: the generalised masses", "another length"]),
    entry("system.modal.damping_ratios", Any, "", ["0", "a number above -1, or a list of them, one \
        for each mode: shares of critical damping", "beside `[system.damping]`"]),
    entry("system.modal.shapes", Any, "", ["none", "{ tip = [a number for each mode], .. } for the \
        points that walls, loads and probes need, in two planes tip-y and tip-z; or the path of a \
        CSV file in quotes, a row for each point", "another length"]),
    entry("system.modal.line", Any, "m", ["that of a `[[turbulence]]`, else not drawn", "points of \
        `shapes` along the structure with their positions, which increase, { p0 = 0.0, p1 = 0.05 }, \
        or a CSV file with the columns point, position_m: where pictures draw them, and where \
        turbulence acts that has no line of its own", "fewer than two points, points without a \
        shape"]),
    entry("system.damping", Table, "", ["no damping", "beside `chain`, `bar`, `beam`, `matrices`, \
        `modal`; exactly one of the following", "beside `oscillator`"]),
    entry("system.damping.rayleigh", Inline, "", ["", "C = mass · M + stiffness · K", ""]),
    entry("system.damping.rayleigh.mass", Number, "per_s", ["0", NOT_NEGATIVE, "negative"]),
    entry("system.damping.rayleigh.stiffness", Number, "s", ["0", NOT_NEGATIVE, "negative"]),
    entry("system.damping.ratio", Number, "", ["", "a number, 0 or more: the share of critical \
        damping of every mode", "negative; above 600 degrees of freedom without `modes`"]),
    entry("system.damping.ratios", Numbers, "", ["", "a list of numbers above -1: from the slowest \
        mode on, the last for all further modes; below 0 beside modes only, as a flow makes modes \
        unstable", "an empty list"]),
    entry("system.damping.matrix", Word, "", ["", MATRIX, "another size than M"]),
    entry("body", Tables, "", ["one system", "several systems, which only walls and supports \
        couple: in each exactly one of the tables [body.oscillator], [body.chain], [body.bar], \
        [body.beam], [body.matrices], [body.modal], and [body.damping], with the keys of that table \
        in [system]; beside them [system] may hold planes, modes, static_correction and a damping \
        of all", "beside a system"]),
    entry("body.name", Word, "", [REQUIRED, NAME, "anything else; two bodies of one name"]),
    entry("wall", Tables, "", ["no walls", "up to 4096 walls", "one table in single brackets"]),
    entry("wall.name", Word, "", [REQUIRED, NAME, "anything else; two walls of one name"]),
    entry("wall.at", Any, "", [PLACE_NEEDED, "a place, see below, or \"each\": a wall at each", "a \
        place that is held"]),
    entry("wall.direction", Number, "deg", ["required in two planes", "a number: from +y towards \
        +z, that of the displacement which the wall bounds", IN_ONE_PLANE]),
    entry("wall.side", Word, "", [REQUIRED, "\"upper\" (the body may not go above position), \
        \"lower\" (not below) or \"both\" (two walls, NAME-upper and NAME-lower, with gap)",
        OTHER_WORDS]),
    entry("wall.position", Number, "m", ["required; with `\"both\"` 0", "a number", "nan, inf; a \
        rigid upper wall below a rigid lower one"]),
    entry("wall.gap", Number, "m", ["required with `\"both\"`", "a number, 0 or more: with side = \
        \"both\", how far each wall stands from position", "beside one side; negative"]),
    entry("wall.restitution", Number, "", ["1", "a number from 0 to 1: of a rigid wall", "beside \
        `stiffness`; at a rigid wall beside `static_correction`: a compliance without mass cannot \
        rebound"]),
    entry("wall.stiffness", Number, "N_per_m", ["a rigid wall", "a number above 0: an elastic \
        wall", "0, negative"]),
    entry("wall.damping", Number, "N_s_per_m", ["0", "a number, 0 or more: of an elastic wall, \
        which never pulls", "without `stiffness`"]),
    entry("wall.exponent", Number, "", ["1", "a number n from 1 to 10: the law of Hunt and Crossley, \
        k s^n (1 + dissipation ds/dt), with stiffness k in N/m^n", "without `stiffness`; beside \
        `restitution` or `damping`"]),
    entry("wall.dissipation", Number, "s_per_m", ["0", "a number, 0 or more: an impact at v m/s has \
        a restitution of about 1 - 2/3 dissipation v", "without `stiffness`; beside `restitution` or \
        `damping`"]),
    entry("support", Tables, "", ["no supports", "in two planes: flats or a round hole around a \
        place, see below", "in one plane"]),
    entry("support.name", Word, "", [REQUIRED, "letters, digits, - and _, in quotes: its walls are \
        NAME-flat-1, ..", "anything else; two supports of one name"]),
    entry("support.at", Any, "", [PLACE_NEEDED, "a place, see below", "`\"each\"`, `{ row }`"]),
    entry("support.shape", Word, "", [REQUIRED, "\"flats\" or \"round\"", OTHER_WORDS]),
    entry("support.directions", Numbers, "deg", ["`sides`", "a list of numbers: where the flats \
        stand, from +y towards +z", "beside `sides`, `\"round\"`; an empty list, a direction \
        twice"]),
    entry("support.sides", Number, "", ["`directions`", "a whole number from 1 to 360: that many \
        flats, evenly round", "beside `directions`, `\"round\"`"]),
    entry("support.turn", Number, "deg", ["0", "a number: beside sides, where the first flat \
        stands", "beside `directions`"]),
    entry("support.gap", Any, "m", [REQUIRED, "a number, 0 or more, or a list of them: from the \
        centre to each flat; above 0: the radius of a hole less that of the tube", "negative, nan; \
        a list of another length; of a hole 0 (a pin), a list"]),
    entry("support.centre", Numbers, "m", ["`[0, 0]`", "[y, z], two numbers", "other than two \
        numbers"]),
    entry("support.restitution", Number, "", ["1", "a number from 0 to 1: of rigid flats, or along \
        the radius of a rigid hole", "as for a wall; a hole beside `static_correction`, around \
        massless degrees of freedom"]),
    entry("support.stiffness", Number, "N_per_m", ["a rigid support", "a number above 0: elastic \
        flats or hole", "as for a wall; an elastic hole in other schemes than `moreau-jean`, \
        `located`, `implicit-euler` and `penalty`, with friction in others than `located`"]),
    entry("support.damping", Number, "N_s_per_m", ["0", "a number, 0 or more: of an elastic \
        support", "as for a wall"]),
    entry("support.friction", Any, "", ["0", "a number from 0 to 10, or { static = .., kinetic = .. } \
        of both: the coefficient of Coulomb friction, and that of a contact that sticks where it is \
        larger", "negative, nan, inf; one of both alone; `static` below `kinetic`"]),
    entry("support.width", Number, "m", ["no depth of wear is told", "a number above 0: along the \
        tube, for the depth of wear", "one of `width` and `radius` without the other"]),
    entry("support.radius", Number, "m", ["half the `outer_diameter` of a beam", "a number above \
        0: that of the tube, for the depth of wear", "on a beam"]),
    entry("support.wall", Number, "m", ["that of a beam that is a tube; else not known", "a number \
        above 0, at most `radius`: the thickness of the tube's wall, of which `limit` in `[wear]` is a \
        share, and which wear goes through", "on a beam; without `radius`"]),
    entry("support.coefficient", Number, "per_Pa", ["that of `[wear]`", "a number above 0: that of \
        [wear] for this support", ""]),
    entry("support.support_coefficient", Number, "per_Pa", ["that of `[wear]`", "a number above 0: \
        that of [wear] for this support", ""]),
    entry("support.material", Word, "", ["coefficients of the support, or of `[wear]`", "the name of a \
        `[[material]]`, whose coefficients hold for this support", "beside `coefficient`, \
        `support_coefficient`"]),
    entry("support.growth", Word, "", ["`\"even\"` of a hole; gaps of flats stay", "\"even\" or \
        \"shifted\" of a hole, \"flats\" of flats: what `signorini wear` does to the gaps",
        OTHER_WORDS]),
    entry("slider", Tables, "", ["no sliders", "any number of them: a place that rubs under a known \
        normal force, a dry-friction damper", "in two planes; beside `static_correction`"]),
    entry("slider.name", Word, "", [REQUIRED, NAME, "anything else; the name of a wall or of another \
        slider"]),
    entry("slider.at", Any, "", [PLACE_NEEDED, "a place, see below, or \"each\": a slider at each",
        "a place that is held, or without mass"]),
    entry("slider.normal_force", Number, "N", [REQUIRED, ABOVE_0, UNORDINARY]),
    entry("slider.friction", Any, "", [REQUIRED, "a number from 0 to 10, or { static = .., kinetic = .. } \
        of both: what sticks holds static times normal_force, what slides feels kinetic times it", "as \
        of a support"]),
    entry("material", Tables, "", ["no materials", "any number of them: wear coefficients of tube and \
        support, by the name of their pair of materials", ""]),
    entry("material.name", Word, "", [REQUIRED, NAME, "anything else; the name of another material"]),
    entry("material.coefficient", Number, "per_Pa", ["that of `[wear]`", "a number above 0: of the tube, \
        1/Pa = m^2/N", "neither of both"]),
    entry("material.support_coefficient", Number, "per_Pa", ["that of `[wear]`", "a number above 0: of \
        the support", "neither of both"]),
    entry("wear", Table, "", ["no worn volumes", "see below", "without `[[support]]` and \
        `[[slider]]`"]),
    entry("wear.coefficient", Number, "per_Pa", ["no volume of the tube", "a number above 0: the \
        wear coefficient of the tube, 1/Pa = m^2/N", ""]),
    entry("wear.support_coefficient", Number, "per_Pa", ["no volume of supports", "a number above \
        0: that of the supports", ""]),
    entry("wear.service", Number, "s", ["no worn volumes; `wear` needs `--years`", "a number above 0: the \
        time for which worn volumes and depths are told", "without a coefficient"]),
    entry("wear.limit", Number, "", ["no limit", "a number above 0 and at most 1: the depth up to \
        which the tube may wear, as a share of its wall", "where no wall is known: on other systems than \
        a beam without `wall` of each support with a radius; without a support that has a `width`; \
        without a coefficient of the tube; tubes of different walls"]),
    entry("wear.sectors", Number, "", ["12", "a whole number from 1 to 3600: equal parts of the \
        circle around each support", ""]),
    entry("load", Tables, "", ["no loads", "any number of them, which add up; exactly one kind in \
        each", "no kind, two kinds"]),
    entry("load.at", Any, "", [PLACE_NEEDED, "a place, see below, on a bar or beam also { spread = \
        [from, to] }", "`\"each\"`"]),
    entry("load.direction", Any, "deg", ["required in two planes", "a number, or \"both\" for a \
        random load: from +y towards +z, or independent signals along y and z", IN_ONE_PLANE]),
    entry("load.constant", Inline, "", ["", "a force that does not change", ""]),
    entry("load.constant.force", Number, "N", [REQUIRED, "a number", "nan, inf"]),
    entry("load.harmonic", Inline, "", ["", "amplitude sin(2π frequency t + phase)", ""]),
    entry("load.harmonic.amplitude", Number, "N", [REQUIRED, "a number", "nan, inf"]),
    entry("load.harmonic.frequency", Number, "Hz", [REQUIRED, NOT_NEGATIVE, INVALID]),
    entry("load.harmonic.phase", Number, "rad", ["0", "a number", "nan, inf"]),
    entry("load.impulse", Inline, "", ["", "the momentum jumps; a wall that the body touches then \
        responds with its restitution", ""]),
    entry("load.impulse.impulse", Number, "N_s", [REQUIRED, "a number", "nan, inf"]),
    entry("load.impulse.time", Number, "s", ["0", NOT_NEGATIVE, INVALID]),
    entry("load.table", Inline, "", ["", "the force over time, from a CSV file, see below", "see \
        below"]),
    entry("load.table.file", Word, "", [REQUIRED, FILE, ""]),
    entry("load.table.time", Word, "", ["`\"time_s\"`", "the header of the column of times, s, in \
        quotes", ""]),
    entry("load.table.force", Word, "", ["`\"force_N\"`", "the header of the column of forces, in \
        quotes", ""]),
    entry("load.table.delimiter", Word, "", ["`\",\"`", DELIMITER, ""]),
    entry("load.table.decimal", Word, "", ["`\".\"`", "\".\" or \",\"", "the delimiter"]),
    entry("load.table.scale", Number, "", ["1", "a number: how many N one unit of the column is \
        (1000 for kN, -1 to reverse the sign)", ""]),
    entry("load.table.time_scale", Number, "", ["1", "a number above 0: how many s one unit of the \
        column of times is (1e-3 for ms); it stretches a pulse", UNORDINARY]),
    entry("load.random", Inline, "", ["", "a random force, see below: either `rms`, `from` and \
        `to`, or `psd`, or `file`", "a band without a multiple of 1/end; more than 2^24 rows (16 a \
        period)"]),
    entry("load.random.rms", Number, "N", ["", "a number above 0: the root mean square of the \
        force", UNORDINARY]),
    entry("load.random.from", Number, "Hz", ["", "a number above 0: where the band begins",
        UNORDINARY]),
    entry("load.random.to", Number, "Hz", ["", "a number above from: where the band ends", "not \
        above `from`"]),
    entry("load.random.psd", Any, "", ["", "pairs of Hz and N^2/Hz, one-sided: [[1.0, 0.02], \
        [100.0, 0.02]]", ""]),
    entry("load.random.file", Word, "", ["", FILE, ""]),
    entry("load.random.seed", Number, "", ["0", "a whole number from 0 to 2^53", ""]),
    entry("load.base", Inline, "", ["", "motion of the ground, from a CSV file, see below",
        "beside `at`"]),
    entry("load.base.amplitude", Number, "m_per_s2", ["", "a number: of an acceleration that is a \
        sine, in place of a file", "beside `file`"]),
    entry("load.base.frequency", Number, "Hz", ["", NOT_NEGATIVE, "beside `file`"]),
    entry("load.base.phase", Number, "rad", ["0", "a number", "beside `file`"]),
    entry("load.base.rms", Number, "m_per_s2", ["", "a number above 0: of a random acceleration, \
        with `from` and `to`, in place of a file", UNORDINARY]),
    entry("load.base.from", Number, "Hz", ["", "as of `random`", UNORDINARY]),
    entry("load.base.to", Number, "Hz", ["", "as of `random`", "not above `from`"]),
    entry("load.base.psd", Any, "", ["", "pairs of Hz and (m/s^2)^2/Hz, one-sided, in place of \
        `rms`", ""]),
    entry("load.base.seed", Number, "", ["0", "a whole number from 0 to 2^53", ""]),
    entry("load.base.file", Word, "", ["", FILE, "beside `amplitude`"]),
    entry("load.base.time", Word, "", ["`\"time_s\"`", "the header of the column of times, s, in \
        quotes", ""]),
    entry("load.base.acceleration", Word, "", ["`\"acceleration_m_per_s2\"`", "the header of the \
        column of accelerations, in quotes", ""]),
    entry("load.base.delimiter", Word, "", ["`\",\"`", DELIMITER, ""]),
    entry("load.base.decimal", Word, "", ["`\".\"`", "\".\" or \",\"", "the delimiter"]),
    entry("load.base.scale", Number, "", ["1", "a number: how many m/s^2 one unit of the column is",
        ""]),
    entry("load.base.time_scale", Number, "", ["1", "a number above 0: how many s one unit of the \
        column of times is (1e-3 for ms); it stretches a pulse", UNORDINARY]),
    entry("load.base.walls", Word, "", ["`\"moving\"`", "\"moving\": walls move with the base, or \
        \"fixed\": they stay in space, and displacements are those in space", "`\"fixed\"` beside \
        `file`, `modes`; another word than the other bases"]),
    entry("load.base.influence", Any, "", ["required of `matrices` and `modal`", "{ row = [[0, \
        1.0], ..] }: how far each degree of freedom moves with the base", "beside other \
        systems"]),
    entry("turbulence", Tables, "", ["no turbulence", "any number of them, which add up: random \
        forces along a tube that are coherent over a length, as forces on its modes, see below",
        "without `modes` on a beam; on other systems than a beam and `modal`"]),
    entry("turbulence.body", Word, "", ["required beside bodies", "the name of the body on which \
        it acts: a tube, or modal data with a line", "beside one system"]),
    entry("turbulence.direction", Any, "deg", ["required in two planes", "a number, or \"both\": \
        from +y towards +z, or independent fields along y and z", IN_ONE_PLANE]),
    entry("turbulence.line", Any, "", ["that of `modal`", "as there; shapes are straight between \
        the points", "as there; beside a beam"]),
    entry("turbulence.diameter", Number, "m", ["that of the beam", "a number above 0: of the tube, \
        beside `modal` with `density`", "beside a beam; beside `spectrum`"]),
    entry("turbulence.density", Number, "kg_per_m3", ["", "a number above 0: of the fluid", "beside \
        `spectrum`"]),
    entry("turbulence.velocity", Any, "m_per_s", ["", "a number, 0 or more, or pairs of m and m/s, \
        straight between them: of the fluid in the gaps, [[0.0, 0.3], [3.0, 0.6]]", "pairs that do \
        not reach over the stretch; beside `spectrum`"]),
    entry("turbulence.reduced", Any, "", ["", "pairs of a reduced frequency fD/V and a reduced \
        density, straight in logarithms, zero outside: [[0.01, 0.05], [0.2, 0.0112]]", "beside \
        `spectrum`"]),
    entry("turbulence.spectrum", Any, "", ["", "pairs of Hz and (N/m)^2/Hz, one-sided, in place of \
        `density`, `velocity` and `reduced`: [[1.0, 0.02], [100.0, 0.02]]", "beside these"]),
    entry("turbulence.along", Numbers, "m", ["the whole tube", "[from, to], two numbers", "beyond \
        the tube or its `line`"]),
    entry("turbulence.from", Number, "Hz", [REQUIRED, "a number above 0: where the band begins",
        UNORDINARY]),
    entry("turbulence.to", Number, "Hz", [REQUIRED, "a number above from: where the band ends",
        "not above `from`"]),
    entry("turbulence.correlation_length", Number, "m", [REQUIRED, "a number above 0: the coherence \
        of two points falls by e over it", UNORDINARY]),
    entry("turbulence.seed", Number, "", ["0", "a whole number from 0 to 2^53", ""]),
    entry("flow", Table, "", ["no margins", "the fluid-elastic margins of tubes in the flow of \
        `[[turbulence]]`, see below", "without the `density`, `velocity` and `reduced` of a \
        turbulence; without damping; on other systems than a tube"]),
    entry("flow.connors", Number, "", [REQUIRED, "a number above 0: Connors' constant K of the \
        bundle, about 3", UNORDINARY]),
    entry("flow.mass_per_metre", Number, "kg_per_m", ["", "a number above 0: of a tube of modal data, \
        with the fluid in it and around it; velocities are told by it, margins do not depend on it",
        "beside beams alone; 0, negative, nan, inf"]),
    entry("load.gravity", Inline, "", ["", "the weight of all masses along `direction`, in one plane \
        along the positive displacements", "beside `at`"]),
    entry("load.gravity.acceleration", Number, "m_per_s2", [REQUIRED, "a number: 9.81 on Earth",
        "nan, inf"]),
    entry("load.gravity.influence", Any, "", ["required of `matrices` and `modal`", "as of `base`",
        "beside other systems"]),
    entry("initial", Table, "", ["at rest at 0", "", ""]),
    entry("initial.equilibrium", Truth, "", ["`false`", "true or false: at rest in static \
        equilibrium under the constant loads, between all walls and in all holes", "beside \
        `displacement`, `velocity`; where neither stiffness nor a wall holds the structure"]),
    entry("initial.displacement", Any, "m", ["0", "a number, or a field, see below", "behind a \
        rigid wall (inside an elastic one is preload); a number above one degree of freedom"]),
    entry("initial.velocity", Any, "m_per_s", ["0", "a number, or a field, see below: before any \
        impulse at t = 0", "a number above one degree of freedom"]),
    entry("initial.scatter", Inline, "", ["none", "normal deviates added to the velocities, one to \
        each degree of freedom: starts that nobody can tell apart, as realisations of a chaotic \
        motion", ""]),
    entry("initial.scatter.velocity", Number, "m_per_s", [REQUIRED, "a number above 0: their \
        standard deviation; with `modes` that of each modal velocity, in kg^(1/2) m/s", UNORDINARY]),
    entry("initial.scatter.seed", Number, "", ["0", "a whole number from 0 to 2^53", ""]),
    entry("probe", Tables, "", ["see below", "up to 4096 probes; the first is the one of figures \
        and errors", ""]),
    entry("probe.name", Word, "", [REQUIRED, NAME, "anything else; two probes of one name"]),
    entry("probe.at", Any, "", [PLACE_NEEDED, "a place, see below, or \"each\": a probe at each",
        "a place that is held"]),
    entry("probe.direction", Number, "deg", ["in two planes two probes, NAME`-y` and NAME`-z`",
        TOWARDS, IN_ONE_PLANE]),
    entry("time", Table, "", [REQUIRED, "", ""]),
    entry("time.end", Number, "s", [REQUIRED, ABOVE_0, UNORDINARY]),
    entry("time.step", Number, "s", ["one degree of freedom, or a structure in modes: the largest of \
        one digit that is at most 5e-5 and a tenth of the period of the fastest mode; else required", "a \
        number above 0 and below end: shortened to divide it", "left out where M or K couples degrees \
        of freedom; more than 1e10 steps"]),
    entry("time.sample", Number, "s", ["every step is recorded (`event`: end/1000)", "a number \
        above 0 and at most end: shortened to divide it, and said so; below step records every \
        step", "more than 1e7 rows, or 2e8 values in the table, also where it is left out"]),
    entry("time.output_times", Numbers, "s", ["none", "a list of increasing numbers, 0 or more: the \
        states of the probes at these times in `output.csv`, which need not be rows", "negative, \
        not increasing"]),
    entry("time.statistics_from", Number, "s", ["0", "a number, 0 or more and below end: the \
        window of every statistic, in tables and summary", "outside the run"]),
    entry("time.force_averaging", Number, "s", ["1e-3", "a number above 0: the stretch over which \
        the force of a rigid wall is averaged before its RMS is taken, since impulse/step has no \
        limit as steps shrink; shortened to divide a tenth of the window", "0, negative"]),
    entry("statistics", Table, "", ["no episodes, no spectra", "further statistics, see \
        `docs/statistics.md`; their window is `statistics_from` in `[time]`", ""]),
    entry("statistics.rest", Number, "s", ["0", "a number, 0 or more and below the window of the \
        statistics: contacts between which less than this lies are one episode", "negative; as \
        long as the window"]),
    entry("statistics.spectra", Truth, "", ["`false`", "true or false: spectra of all probes, \
        walls and supports", "fewer than 72 rows, or stretches of `force_averaging`, in the \
        window"]),
    entry("penalty", Table, "", ["no penalty runs", "see below", "beside `static_correction`"]),
    entry("penalty.epsilon", Numbers, "m3_per_N", ["", "a list of numbers above 0, each once: \
        [1e-12, 1e-9]", "empty; beside `stiffness`; no wall on the other side"]),
    entry("penalty.stiffness", Numbers, "N_per_m", ["", "a list of numbers above 0, each once: \
        [1e6, 1e8]", "empty; beside `epsilon`"]),
    entry("penalty.damping", Number, "N_s_per_m", ["0", "a number, 0 or more: of the linear \
        penalty", "without `stiffness`"]),
    entry("penalty.integrator", Word, "", ["`discrete-gradient`", "\"trapezoidal\", \
        \"implicit-euler\", \"central-difference\" or \"discrete-gradient\"", OTHER_WORDS]),
    inner("system.chain.left.stiffness", "N_per_m"),
    inner("system.chain.right.stiffness", "N_per_m"),
    inner("system.bar.left.stiffness", "N_per_m"),
    inner("system.bar.right.stiffness", "N_per_m"),
    inner("system.beam.left.stiffness", "N_per_m"),
    inner("system.beam.left.rotational", "N_m_per_rad"),
    inner("system.beam.right.stiffness", "N_per_m"),
    inner("system.beam.right.rotational", "N_m_per_rad"),
    inner("support.friction.static", ""),
    inner("support.friction.kinetic", ""),
    inner("slider.friction.static", ""),
    inner("slider.friction.kinetic", ""),
    inner("load.base.influence.row", ""),
    // Places, of walls, supports, loads and probes alike.
    inner("at.body", ""),
    inner("at.relative_to", ""),
    inner("at.dof", ""),
    inner("at.position", "m"),
    inner("at.joint", ""),
    inner("at.row", ""),
    inner("at.spread", "m"),
    inner("at.point", ""),
    inner("at.points", ""),
    inner("at.y", ""),
    inner("at.z", ""),
];
