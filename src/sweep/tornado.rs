//! The picture of effects: a bar for each key.

use super::columns::{Source, short};
use super::effects::{Effect, effects};
use super::picture::{Drawn, MOST_PANELS, Picture};
use super::seeds::in_words;
use super::table::label;
use crate::error::Result;
use crate::output::figure::{Bar, Bars, Tornado};

/// Most bars of a frame: the largest effects.
const MOST_BARS: usize = 16;

impl Picture {
    /// The tornado diagram of the effects; `None` where there are none.
    pub(super) fn tornado(&self, source: &Source<'_>) -> Result<Option<Drawn>> {
        let wanted: Vec<String> = self.measures(self.y.as_ref(), source)?.into_iter().flat_map(|(_, c)| c).collect();
        let all = effects(source)?;
        let mut groups: Vec<&[Effect]> = all.chunk_by(|a, b| a.column == b.column).collect();
        groups.retain(|group| group.first().is_some_and(|one| wanted.contains(&one.column)));
        let left_out = groups.split_off(MOST_PANELS.min(groups.len()));
        let mut left_out: Vec<String> = left_out.iter().flat_map(|g| g.first()).map(|one| one.column.clone()).collect();
        let seeds = source.seeds.map(|count| format!(": means of {}", in_words(count))).unwrap_or_default();
        let mut tornado = Tornado::new(format!("{}{seeds}", source.title));
        let mut drawn = false;
        for group in groups {
            let Some((one, base)) = group.first().and_then(|one| Some((one, one.base?))) else { continue };
            let bars = group.iter().take(MOST_BARS).map(bar).collect();
            left_out.extend(group.iter().skip(MOST_BARS).map(|one| format!("{} of {}", one.key, one.column)));
            tornado = tornado.bars(Bars { label: label(&one.column), base, bars });
            drawn = true;
        }
        Ok(drawn.then(|| Drawn { svg: tornado.to_svg(), left_out }))
    }
}

fn bar(effect: &Effect) -> Bar {
    Bar {
        name: effect.key.clone(),
        bounds: effect.bounds.map(|bound| short(&bound.to_string())),
        at: effect.at.map(|x| x.unwrap_or(f64::NAN)),
        hollow: !effect.is_seen(),
    }
}
