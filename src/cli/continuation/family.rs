//! The scenes of a case over one key or two.

use super::args::Args;
use super::varied::Varied;
use crate::case::{Case, CaseFile, KeyValue};
use crate::cli::case_args::set_restitution;
use crate::cli::ui::Ui;
use crate::error::{Error, Result};
use crate::orbit::Problem;
use crate::scene::Scene;

/// A case, the key whose value changes along the branches, and the second one of loci.
pub(super) struct SceneFamily {
    file: CaseFile,
    pub case: Case,
    pub key: Varied,
    pub second: Option<Varied>,
    /// The scene of one degree of freedom; `None` for a structure.
    pub problem: Option<Problem>,
}

impl SceneFamily {
    /// That of the command line.
    ///
    /// # Errors
    /// A case or a key that makes no sense; a scene whose orbits cannot be followed.
    pub(super) fn new(args: &Args, ui: &Ui) -> Result<Self> {
        let mut file = args.case.file(ui)?;
        set_restitution(&mut file, args.restitution)?;
        let case = file.case()?;
        case.check_repeats()?;
        let key = Varied::new(&file, ["--key", "--range"], &args.key, &args.range)?;
        if case.truncated.is_some() && key.key.to_string().starts_with("system.") {
            let expected = "a key outside of [system], or a case without modes: the modes of one value are not those \
                            of another";
            return Err(Error::invalid("--key", &key.key, expected));
        }
        let mut second = None;
        if let (Some(name), Some(range)) = (&args.second, &args.second_range) {
            if *name == args.key {
                return Err(Error::invalid("--second", name, "a key other than --key"));
            }
            second = Some(Varied::new(&file, ["--second", "--second-range"], name, range)?);
            if !case.scene.is_line() {
                let expected = "a case of one degree of freedom: the special points of structures are not followed \
                                over two keys";
                return Err(Error::invalid("--second", name, expected));
            }
        }
        // A scene that cannot be followed at all is refused before the folder of results is made.
        let problem = if case.scene.is_line() { Some(Problem::new(case.scene.clone())?) } else { None };
        Ok(Self { file, case, key, second, problem })
    }

    /// The scene at a value of the key.
    pub(super) fn scene(&self, value: f64) -> Result<Scene> {
        self.scene_with(&[(&self.key, value)])
    }

    /// The scene at these values of keys.
    pub(super) fn scene_with(&self, values: &[(&Varied, f64)]) -> Result<Scene> {
        let mut file = self.file.clone();
        for (varied, value) in values {
            file.set(&varied.key, &KeyValue::from(*value))?;
        }
        Ok(file.case().map_err(Error::without_place)?.scene)
    }

    /// The title of pictures.
    pub(super) fn title(&self) -> &str {
        self.case.heading()
    }
}
