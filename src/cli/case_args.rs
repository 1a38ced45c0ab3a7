//! The case of a command, and the changes of its values.

use super::command_line::quoted;
use super::ui::Ui;
use super::values;
use crate::case::{Case, CaseFile, Embedded, KeyValue};
use crate::error::{Error, Result};
use std::path::Path;

/// The case of a command.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct CaseArgs {
    /// Case file, summary.json of a run, or the name of a built-in case; a file is taken before a
    /// built-in case
    #[arg(value_hint = clap::ValueHint::FilePath)]
    case: String,
    #[command(flatten)]
    changes: Changes,
    /// Restitution of every rigid wall and support, 0 to 1
    #[arg(long, value_name = "E", allow_hyphen_values = true)]
    restitution: Option<f64>,
}

/// Finds the case `name`: the file [`CaseFile::found`] in the current folder, else the built-in
/// case of that name. Says which it took wherever there is a built-in case of that name.
///
/// # Errors
/// As [`CaseFile::read`].
pub fn case_file(name: &str, ui: &Ui) -> Result<CaseFile> {
    let (found, built_in) = (CaseFile::found(Path::new(""), name), Embedded::named(name));
    if let (None, Ok(embedded)) = (&found, &built_in) {
        ui.message(&format!("{name}: the built-in case"));
        return CaseFile::embedded(embedded.name);
    }
    let taken = found.unwrap_or_else(|| name.into());
    if built_in.is_ok() || taken != Path::new(name) {
        let other = if built_in.is_ok() { ", not the built-in case of that name" } else { "" };
        ui.message(&format!("{name}: the file {}{other}", taken.display()));
    }
    CaseFile::read(taken)
}

/// Values of the case that the command line changes by their keys.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct Changes {
    /// Set a value of the case by its key, such as wall.upper.position=6e-3,
    /// load.1.harmonic.frequency=4, wall.*.restitution=0.8; may be given several times
    #[arg(long, value_name = "KEY=VALUE", value_parser = values::settings(), hide_possible_values = true)]
    set: Vec<String>,
}

impl Changes {
    /// The keys and values as they were given.
    ///
    /// # Errors
    /// [`Error::Invalid`] for an argument that is not KEY=VALUE.
    pub fn pairs(&self) -> Result<Vec<(String, KeyValue)>> {
        let pair = |text: &String| {
            let expected = "KEY=VALUE, such as wall.upper.position=6e-3";
            let wrong = || Error::invalid("--set", format_args!("{text:?}"), expected);
            let (key, value) = text.split_once('=').ok_or_else(wrong)?;
            Ok((key.to_owned(), value.parse()?))
        };
        self.set.iter().map(pair).collect()
    }
}

impl CaseArgs {
    /// The file of the case, found by [`case_file`], with the values set.
    ///
    /// # Errors
    /// As [`case_file`] and [`CaseFile::set`]; [`Error::Invalid`] for an argument that is not
    /// KEY=VALUE, and for a restitution where no wall is rigid.
    pub fn file(&self, ui: &Ui) -> Result<CaseFile> {
        let mut file = case_file(&self.case, ui)?;
        for (key, value) in self.changes.pairs()? {
            file.set(&key.parse()?, &value)?;
        }
        if let Some(restitution) = self.restitution {
            set_restitution(&mut file, restitution)?;
        }
        Ok(file)
    }

    /// The command line that asks `command` of this case, without its other options.
    #[must_use]
    pub fn command_line(&self, command: &str) -> String {
        let sets = self.changes.set.iter().map(|pair| format!(" --set {}", quoted(pair)));
        let restitution = self.restitution.map(|e| format!(" --restitution {e:?}"));
        format!("signorini {command} {}{}", quoted(&self.case), sets.chain(restitution).collect::<String>())
    }

    /// The case of that file. Says the size of random forces that take time and memory.
    ///
    /// # Errors
    /// As [`CaseArgs::file`] and [`CaseFile::case`].
    pub fn read(&self, ui: &Ui) -> Result<Case> {
        built(&self.file(ui)?, ui)
    }
}

/// The case of a file. Says the size of random forces that take time and memory.
pub(super) fn built(file: &CaseFile, ui: &Ui) -> Result<Case> {
    let case = file.case()?;
    case.large_random_forces().for_each(|said| ui.message(&said));
    Ok(case)
}

/// Gives every rigid wall and support that restitution.
fn set_restitution(file: &mut CaseFile, restitution: f64) -> Result<()> {
    let keys = file.restitutions()?;
    if keys.is_empty() {
        file.case()?;
        return Err(Error::invalid("--restitution", restitution, "a case with a rigid wall; this one has none"));
    }
    keys.iter().try_for_each(|key| file.set(key, &restitution.into()))
}
