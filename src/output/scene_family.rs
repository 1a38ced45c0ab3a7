//! The scenes of a case over one key or two.

use super::varied::{KeyRange, Varied};
use crate::case::{Case, CaseFile, KeyValue};
use crate::error::{Error, Result};
use crate::orbit::Problem;
use crate::scene::Scene;

/// A case, the key whose value changes along the branches, and the second one of loci.
#[derive(Debug)]
pub struct SceneFamily {
    file: CaseFile,
    /// The case.
    pub case: Case,
    /// The key.
    pub key: Varied,
    /// The second key of loci.
    pub second: Option<Varied>,
    /// The scene of one degree of freedom; `None` for a structure.
    pub problem: Option<Problem>,
}

impl SceneFamily {
    /// The scenes of `file` over `key`, and over the key `second` of loci.
    ///
    /// # Errors
    /// A case or a key that makes no sense; a scene whose orbits cannot be followed.
    pub fn new(file: CaseFile, key: &KeyRange<'_>, second: Option<&KeyRange<'_>>) -> Result<Self> {
        let case = file.case()?;
        case.check_repeats()?;
        let key = Varied::new(&file, key)?;
        if case.truncated.is_some() && key.key.to_string().starts_with("system.") {
            let expected = "a key outside of [system], or a case without modes: the modes of one value are not those \
                            of another";
            return Err(Error::invalid(key.called, &key.key, expected));
        }
        let second = second.map(|second| Varied::new(&file, second)).transpose()?;
        if let Some(second) = &second {
            if second.key == key.key {
                let expected = format!("a key other than {}", key.called);
                return Err(Error::invalid(second.called, &second.key, expected));
            }
            if !case.scene.is_line() {
                let expected = "a case of one degree of freedom: the special points of structures are not followed \
                                over two keys";
                return Err(Error::invalid(second.called, &second.key, expected));
            }
        }
        // A scene that cannot be followed at all is refused before the folder of results is made.
        let problem = if case.scene.is_line() { Some(Problem::new(case.scene.clone())?) } else { None };
        Ok(Self { file, case, key, second, problem })
    }

    /// The scene at a value of the key.
    ///
    /// # Errors
    /// For a value that the case does not accept.
    pub fn scene(&self, value: f64) -> Result<Scene> {
        self.scene_with(&[(&self.key, value)])
    }

    /// The scene at these values of keys.
    ///
    /// # Errors
    /// As [`SceneFamily::scene`].
    pub fn scene_with(&self, values: &[(&Varied, f64)]) -> Result<Scene> {
        let mut file = self.file.clone();
        for (varied, value) in values {
            file.set(&varied.key, &KeyValue::from(*value))?;
        }
        Ok(file.case().map_err(Error::without_place)?.scene)
    }

    /// The title of pictures.
    #[must_use]
    pub fn title(&self) -> &str {
        self.case.heading()
    }
}
