//! Reads the tables `[system.bar]` and `[system.beam]`: dimensions, section and ends.

use super::builder::Builder;
use super::schema::accepted;
use super::value::{Section, Value};
use crate::error::Result;
use crate::scene::{Bar, BarEnd, Beam, BeamEnd, BeamSection, MOST_ELEMENTS, MassMatrix, SectionFault};
use toml::Spanned;

/// All conditions at an end that the file can give; each system accepts some of them.
pub(super) enum End {
    Free,
    Pinned,
    Clamped,
    Sprung { stiffness: f64, rotational: f64 },
}

impl Builder<'_> {
    pub fn bar(&mut self, bar: &Section<'_>) -> Result<Bar> {
        let mass = match bar.word("mass_matrix") {
            None => MassMatrix::Consistent,
            Some(word) => match *word.get_ref() {
                "consistent" => MassMatrix::Consistent,
                "lumped" => MassMatrix::Lumped,
                _ => return Err(self.refuse_as(word.span(), &format!("{}.bar.mass_matrix", self.owner))),
            },
        };
        let [left, right] = self.ends("bar", bar, BarEnd::Free, |end| match end {
            End::Free => Some(BarEnd::Free),
            End::Clamped => Some(BarEnd::Fixed),
            End::Sprung { stiffness, .. } => Some(BarEnd::Sprung { stiffness }),
            End::Pinned => None,
        })?;
        let mut number = |key| self.required(("bar", key), bar, key);
        let [length, area] = ["length", "area"].map(&mut number);
        let [youngs_modulus, density] = ["youngs_modulus", "density"].map(&mut number);
        let elements = self.whole_number(("bar", "elements"), &bar.required("elements"), MOST_ELEMENTS)?;
        Ok(Bar { length, area, youngs_modulus, density, elements, left, right, mass })
    }

    pub fn beam(&mut self, beam: &Section<'_>) -> Result<Beam> {
        let [left, right] = self.ends("beam", beam, BeamEnd::Free, |end| match end {
            End::Free => Some(BeamEnd::Free),
            End::Pinned => Some(BeamEnd::Pinned),
            End::Clamped => Some(BeamEnd::Clamped),
            End::Sprung { stiffness, rotational } => Some(BeamEnd::Sprung { stiffness, rotational }),
        })?;
        let length = self.length(beam)?;
        let mut number = |key| self.required(("beam", key), beam, key);
        let youngs_modulus = number("youngs_modulus");
        let density = number("density");
        let section = self.cross_section(beam)?;
        let added_mass = self.optional(("beam", "added_mass"), beam, "added_mass").unwrap_or(0.0);
        let elements = match beam.number("elements") {
            Some(elements) => self.whole_number(("beam", "elements"), &elements, MOST_ELEMENTS)?,
            None => elements_for(self.joints.len(), self.modes),
        };
        Ok(Beam { length, youngs_modulus, density, section, added_mass, elements, left, right })
    }

    /// The section of a beam: the diameters of a tube, or the sides of a rectangle.
    fn cross_section(&mut self, beam: &Section<'_>) -> Result<BeamSection> {
        let mut number = |key| self.optional(("beam", key), beam, key);
        let (diameters, sides) =
            (["outer_diameter", "inner_diameter"].map(&mut number), ["width", "height"].map(number));
        BeamSection::of(diameters, sides).map_err(|fault| match fault {
            SectionFault::TwoSections => {
                let at = beam.span_of("outer_diameter").or(beam.span_of("inner_diameter"));
                let help = "expected one section: outer_diameter and inner_diameter of a tube, or width and height of \
                            a rectangle";
                let title = format!("`{}.beam` has a diameter and a side of a rectangle", self.owner);
                self.source.error(at.unwrap_or(beam.span.clone()), &title, help)
            }
            SectionFault::Missing(key) => {
                let help = match key {
                    "height" => {
                        "expected height = a number above 0, in m, in the direction of the vibration, beside width"
                    }
                    "width" => "expected width = a number above 0, in m, across the vibration, beside height",
                    _ => "expected outer_diameter = a number above 0, in m, or width and height of a rectangle",
                };
                self.source.error(beam.span.clone(), &format!("`{key}` is missing in `{}.beam`", self.owner), help)
            }
        })
    }

    /// The length of a beam, m; where it is the sum of spans, their joints are noted.
    fn length(&mut self, beam: &Section<'_>) -> Result<f64> {
        let (length, spans) = (beam.number("length"), beam.numbers("spans"));
        match (length, spans) {
            (Some(length), None) => Ok(self.number(("beam", "length"), &length)),
            (None, Some(spans)) => {
                let mut reached = 0.0;
                for span in spans.get_ref() {
                    if !(span.get_ref().is_finite() && *span.get_ref() > 0.0) {
                        let key = format!("{}.beam.spans", self.owner);
                        return Err(self.refuse(span.span(), &key, "numbers above 0, in m"));
                    }
                    reached = decimal(reached + span.get_ref());
                    self.joints.push(reached);
                }
                self.positions.push((("beam", "length").into(), spans.span()));
                Ok(reached)
            }
            (Some(_), Some(spans)) => {
                let help = "expected one of them: the length is the sum of the spans";
                Err(self.source.error(spans.span(), &format!("`{}.beam` has a length and spans", self.owner), help))
            }
            (None, None) => {
                let help = "expected length = a number above 0, in m, or spans = a list of them, whose sum it is";
                Err(self.source.error(
                    beam.span.clone(),
                    &format!("`length` is missing in `{}.beam`", self.owner),
                    help,
                ))
            }
        }
    }

    /// The ends of a system of this `kind`, as `of` takes them, which has no value for some; `free`
    /// where they are not given.
    pub fn ends<E: Copy>(
        &self,
        kind: &str,
        system: &Section<'_>,
        free: E,
        of: impl Fn(End) -> Option<E>,
    ) -> Result<[E; 2]> {
        let mut ends = [free; 2];
        for (side, made) in ["left", "right"].into_iter().zip(&mut ends) {
            let Some(end) = system.get(side) else { continue };
            let key = format!("{}.{kind}.{side}", self.owner);
            *made = of(self.end(kind, &key, end)?).ok_or_else(|| self.refuse_as(end.span(), &key))?;
        }
        Ok(ends)
    }

    /// The condition at the end that `key` names.
    fn end(&self, kind: &str, key: &str, end: &Spanned<Value<'_>>) -> Result<End> {
        match end.get_ref() {
            Value::Word(word) => match word.as_ref() {
                "free" => Ok(End::Free),
                "pinned" => Ok(End::Pinned),
                "clamped" => Ok(End::Clamped),
                _ => Err(self.refuse_as(end.span(), key)),
            },
            Value::Table(entries) => {
                let (mut stiffness, mut rotational) = (None, 0.0);
                for (name, value) in entries {
                    let part = format!("{key}.{}", name.get_ref());
                    let known = name.get_ref() == "stiffness" || (name.get_ref() == "rotational" && kind == "beam");
                    if !known {
                        let title = format!("unknown key `{}` in `{key}`", name.get_ref());
                        let help = format!("expected {}", accepted(key).unwrap_or_default());
                        return Err(self.source.error(name.span(), &title, &help));
                    }
                    let x = self.finite(&part, value, "a number, 0 or more")?;
                    if x < 0.0 {
                        return Err(self.refuse(value.span(), &part, "a number, 0 or more"));
                    }
                    if name.get_ref() == "stiffness" { stiffness = Some(x) } else { rotational = x }
                }
                let stiffness = stiffness.ok_or_else(|| self.refuse_as(end.span(), key))?;
                Ok(End::Sprung { stiffness, rotational })
            }
            _ => Err(self.refuse_as(end.span(), key)),
        }
    }
}

/// The elements of a beam with as many `joints` that is reduced to `modes`: 20 of each span, and as
/// many as the modes need.
fn elements_for(joints: usize, modes: Option<usize>) -> usize {
    (20 * joints.max(1)).max(elements_of_modes(modes.unwrap_or(0))).min(MOST_ELEMENTS)
}

/// The elements that so many modes of a beam need: two and a half in each half wave of the fastest,
/// which so is too fast by less than 1 %.
pub(super) fn elements_of_modes(modes: usize) -> usize {
    (5 * modes).div_ceil(2)
}

/// `x` to 12 digits: the sum of two numbers of few decimals as a person writes it, 1.7 for 0.8 +
/// 0.9 rather than 1.7000000000000002, so that places given by their distance from the start agree.
fn decimal(x: f64) -> f64 {
    format!("{x:.11e}").parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::decimal;

    #[test]
    fn sums_of_spans_are_those_of_a_person() {
        assert_eq!([decimal(0.8 + 0.9), decimal(0.1 + 0.2), decimal(3.0)], [1.7, 0.3, 3.0]);
        assert_eq!(decimal(f64::INFINITY), f64::INFINITY);
    }
}
