//! Reads the tables `[[slider]]`.

use super::Case;
use super::builder::Builder;
use super::place::{Located, MOST_PLACES, Site};
use super::supports::Owner;
use super::value::Section;
use super::walls::NewWall;
use super::written::{Support, SupportShape, WearData};
use crate::error::{Error, Result, Subject};
use crate::scene::{Condensation, Slider};
use crate::wear::Growth;

/// A slider that is read, and its location; the suffix there is its name.
pub(super) struct NewSlider {
    pub slider: Slider,
    pub site: Site,
}

impl Builder<'_> {
    /// All sliders of the file, in its order, which come after `walls`.
    pub fn sliders(&mut self, tables: &[Section<'_>], walls: &[NewWall]) -> Result<Vec<NewSlider>> {
        let mut all: Vec<NewSlider> = Vec::new();
        for (index, table) in tables.iter().enumerate() {
            for new in self.slider(index, table)? {
                let name = &new.slider.name;
                let mut names = walls.iter().map(|wall| &wall.wall.name).chain(all.iter().map(|one| &one.slider.name));
                if names.any(|other| other == name) {
                    let key = format!("slider {}: name", index + 1);
                    let at = table.required_word("name").span();
                    return Err(self.refuse(at, &key, "a name of its own for each wall and slider"));
                }
                all.push(new);
            }
            if walls.len() + all.len() > MOST_PLACES {
                let title = format!("{} walls and sliders", walls.len() + all.len());
                let help = format!("expected at most {MOST_PLACES} in all");
                return Err(self.source.error(table.span.clone(), &title, &help));
            }
        }
        for NewSlider { slider, site } in &all {
            self.written.supports.push(Support {
                name: slider.name.clone(),
                place: site.place.clone(),
                shape: SupportShape::Slider,
                wear: WearData::default(),
                growth: Growth::Kept,
            });
        }
        Ok(all)
    }

    /// The sliders in table `index`: one, or one at each place.
    fn slider(&mut self, index: usize, table: &Section<'_>) -> Result<Vec<NewSlider>> {
        let base = self.name_of(&format!("slider {}: name", index + 1), table)?;
        let name = format!("slider {base:?}");
        if self.planes.is_two() {
            let help = "expected a [[support]] with shape = \"flats\", directions = [90], gap = 0, restitution = 0 and \
                        friction, and a constant load that presses the structure on it";
            let title = format!("{name}, and the system moves in two planes");
            return Err(self.source.error(table.span.clone(), &title, help));
        }
        if self.static_correction {
            let help = "expected no static_correction beside a slider: the compliance that modes leave out makes a \
                        wall a spring, and what sticks at a slider has no spring";
            let title = format!("{name}, and static_correction is true");
            return Err(self.source.error(table.span.clone(), &title, help));
        }
        let mut sliders = Vec::new();
        for site in self.sites((&name, Subject::slider(&base)), table, Located::Other)? {
            let name = format!("{base}{}", site.suffix);
            let subject = Subject::slider(&name);
            let normal_force = self.required(subject.clone().part("normal_force"), table, "normal_force");
            self.note(subject.clone().part("at"), table.span_of("at"));
            let owner = Owner { name: format!("slider {name:?}"), table: "slider", subject, span: table.span.clone() };
            let friction = self.friction(&owner, table)?;
            let at = site.row.clone();
            let slider = Slider { name: name.clone(), at, normal_force, friction };
            sliders.push(NewSlider { slider, site: Site { suffix: name, ..site } });
        }
        Ok(sliders)
    }

    /// The sliders of the structure without the massless degrees of freedom of `condensation`.
    pub fn sliders_with_mass(&self, sliders: Vec<Slider>, condensation: Option<&Condensation>) -> Result<Vec<Slider>> {
        let Some(condensation) = condensation else { return Ok(sliders) };
        let with_mass = |slider: Slider| -> Result<Slider> {
            let at = condensation.row(&slider.at).ok_or_else(|| self.slides_without_mass(&slider))?;
            Ok(Slider { at, ..slider })
        };
        sliders.into_iter().map(with_mass).collect()
    }

    /// Adds the sliders of a case to its scene, which is not reduced to modes.
    pub fn add_sliders(&self, case: &mut Case) -> Result<()> {
        for slider in &case.sliders {
            case.scene = case.scene.clone().with_slider(slider).map_err(|error| self.at_key(error))?;
        }
        Ok(())
    }

    fn slides_without_mass(&self, slider: &Slider) -> Error {
        let span = self.nearest(&Subject::slider(&slider.name).part("at").part("row")).unwrap_or(0..0);
        let title = format!("slider {:?} rubs on degrees of freedom without mass", slider.name);
        self.source.error(span, &title, "expected a place with mass: what has none sticks and slides without time")
    }
}
