//! `tables.xlsx`: the tables of a folder as the sheets of one workbook.

use super::Results;
use crate::error::Result;
use crate::output::record::Record;
use crate::output::sheets::Sheets;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The name of a workbook.
const FILE: &str = "tables.xlsx";

impl Results {
    /// Writes a workbook into each folder that has tables, with sheets in the order of their names.
    /// Returns a sentence for each table that no sheet can hold.
    pub(super) fn write_sheets(&mut self) -> Result<Vec<String>> {
        self.record()?;
        let mut folders: BTreeMap<PathBuf, Vec<(&String, &Record)>> = BTreeMap::new();
        for (name, record) in &self.tables {
            let folder = Path::new(name).parent().unwrap_or(Path::new("")).join(FILE);
            folders.entry(folder).or_default().push((name, record));
        }
        let (mut workbooks, mut left_out) = (Vec::new(), Vec::new());
        for (file, tables) in folders {
            let mut sheets = Sheets::new(&self.folder)?;
            for (name, record) in tables {
                let without = |why| format!("{} is without {name}, which has {why}", file.display());
                left_out.extend(sheets.add(&self.written(name), record)?.map(without));
            }
            if !sheets.is_empty() {
                workbooks.push((file.display().to_string(), sheets));
            }
        }
        for (file, sheets) in workbooks {
            sheets.write(&self.place(&file)?)?;
        }
        Ok(left_out)
    }

    /// Where the file `name` of these results is now.
    fn written(&self, name: &str) -> PathBuf {
        let placed = self.files.iter().take(self.placed).any(|file| file == name);
        if placed { self.folder.join(name) } else { self.staged(name) }
    }
}
