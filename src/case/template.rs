//! A case file with gaps for values, for cases that are built many times: the text is formatted
//! only once.

use super::case_file::CaseFile;
use super::key::Key;
use super::key_value::KeyValue;
use crate::error::Result;

/// The text of a case file in pieces, with a gap for a value between each two of them.
///
/// ```
/// use signorini::case::{CaseFile, Template};
///
/// let file = CaseFile::embedded("rigid-walls-sine")?;
/// let template = Template::new(&file, &["wall.*.restitution".parse()?, "time.end".parse()?])?;
/// let case = template.filled(&[0.8.into(), 2.0.into()]).case()?;
/// assert_eq!(case.scene.duration, 2.0);
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Template {
    file: CaseFile,
    keys: Vec<String>,
    first: String,
    /// The index of the key whose value fills the gap, and the text after the gap.
    pieces: Vec<(usize, String)>,
}

impl Template {
    /// `file` with gaps at `keys`.
    ///
    /// # Errors
    /// As [`CaseFile::set`].
    pub fn new(file: &CaseFile, keys: &[Key]) -> Result<Self> {
        let mut marked = file.clone();
        // A word that no file contains marks the gap.
        let mark = |index: usize| format!("\u{1f}{index}\u{1f}");
        for (index, key) in keys.iter().enumerate() {
            marked.set(key, &KeyValue::from(mark(index).as_str()))?;
        }
        let text = marked.text()?;
        // The TOML writer escapes the mark in this form.
        let shown = |index: usize| format!("\"\\u001F{index}\\u001F\"");
        let mut found: Vec<(usize, usize, usize)> = Vec::new();
        for index in 0..keys.len() {
            let word = shown(index);
            found.extend(text.match_indices(&word).map(|(at, _)| (at, at + word.len(), index)));
        }
        found.sort_unstable();
        let end = |next: Option<&(usize, usize, usize)>| next.map_or(text.len(), |(from, ..)| *from);
        let slice = |from: usize, to: usize| text.get(from..to).unwrap_or_default().to_owned();
        let first = slice(0, end(found.first()));
        let pieces = found.iter().enumerate().map(|(i, &(_, to, index))| (index, slice(to, end(found.get(i + 1)))));
        let pieces: Vec<(usize, String)> = pieces.collect();
        Ok(Self { file: file.clone(), keys: keys.iter().map(ToString::to_string).collect(), first, pieces })
    }

    /// The case file with `values`, one for each key.
    #[must_use]
    pub fn filled(&self, values: &[KeyValue]) -> CaseFile {
        let mut text = self.first.clone();
        for (index, piece) in &self.pieces {
            if let Some(value) = values.get(*index) {
                text.push_str(&value.0.to_string());
            }
            text.push_str(piece);
        }
        let changes = self.keys.iter().zip(values).map(|(key, value)| format!("{key} = {value}"));
        self.file.rewritten(text, changes.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_filled_template_is_the_case_with_its_values_set() {
        let file = CaseFile::embedded("rigid-walls-sine").unwrap();
        let keys: Vec<Key> = [
            "wall.*.restitution",
            "initial.velocity",
            "load.1.harmonic.frequency",
            "penalty.epsilon.1",
            "wall.upper.side",
        ]
        .map(|key| key.parse().unwrap())
        .to_vec();
        let template = Template::new(&file, &keys).unwrap();
        for x in [0.3, 1.0 / 3.0, 1e-7, 5e-324_f64.sqrt()] {
            let values: Vec<KeyValue> = vec![x.into(), (-x).into(), 3.into(), x.into(), "upper".into()];
            let mut set = file.clone();
            keys.iter().zip(&values).for_each(|(key, value)| set.set(key, value).unwrap());
            assert_eq!(template.filled(&values).case().unwrap(), set.case().unwrap());
        }
        let wrong =
            template.filled(&[2.0.into(), 0.0.into(), 3.into(), 1e-9.into(), "upper".into()]).case().unwrap_err();
        assert!(wrong.to_string().contains("changed by wall.*.restitution = 2.0"), "{wrong}");
    }
}
