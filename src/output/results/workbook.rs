//! `tables.xlsx`: the tables of a folder as the sheets of one workbook.

use super::Results;
use crate::error::Result;
use crate::output::record::Record;
use crate::output::sheets::Sheets;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The name of a workbook.
const FILE: &str = "tables.xlsx";

/// The share of reading the tables in the time of a workbook; the rest compresses the sheets.
const READING: f64 = 0.3;

/// Bytes of a workbook for each byte of its tables, about.
const COMPRESSED: f64 = 0.75;

impl Results {
    /// Writes a workbook into each folder that has tables, with sheets in the order of their names.
    /// Returns a sentence for each table that no sheet can hold. `progress` is called with the
    /// share of the work that is done.
    pub(super) fn write_sheets(&mut self, progress: &mut (dyn FnMut(f64) + Send)) -> Result<Vec<String>> {
        self.record()?;
        let all = self.tables.values().map(|record| record.bytes).sum::<u64>().max(1) as f64;
        let mut folders: BTreeMap<PathBuf, Vec<(&String, &Record)>> = BTreeMap::new();
        for (name, record) in &self.tables {
            let folder = Path::new(name).parent().unwrap_or(Path::new("")).join(FILE);
            folders.entry(folder).or_default().push((name, record));
        }
        let (mut workbooks, mut left_out) = (Vec::new(), Vec::new());
        let mut before = 0;
        for (file, tables) in folders {
            let mut sheets = Sheets::new(&self.folder)?;
            for (name, record) in tables {
                let without = |why| format!("{} is without {name}, which has {why}", file.display());
                let mut read = |bytes: u64| progress(READING * (before + bytes) as f64 / all);
                left_out.extend(sheets.add(&self.written(name), record, &mut read)?.map(without));
                before += record.bytes;
            }
            if !sheets.is_empty() {
                workbooks.push((file.display().to_string(), sheets));
            }
        }
        before = 0;
        for (file, sheets) in workbooks {
            let mut last = before;
            let mut written = |bytes: u64| {
                last = before + bytes;
                progress(READING + (1.0 - READING) * (last as f64 / (COMPRESSED * all)).min(1.0));
            };
            sheets.write(&self.place(&file)?, &mut written)?;
            before = last;
        }
        Ok(left_out)
    }

    /// Where the file `name` of these results is now.
    fn written(&self, name: &str) -> PathBuf {
        let placed = self.files.iter().take(self.placed).any(|file| file == name);
        if placed { self.folder.join(name) } else { self.staged(name) }
    }
}
