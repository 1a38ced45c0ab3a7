//! The options that choose the formats of files.

use super::values;
use crate::error::Result;
use crate::output::format::{Format, Formats};

/// The file formats of a command that writes pictures and tables.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct FileFormats {
    #[command(flatten)]
    pictures: PictureFormats,
    #[command(flatten)]
    tables: TableFormats,
}

impl FileFormats {
    /// The formats asked for.
    ///
    /// # Errors
    /// As [`Formats::checked`].
    pub fn usable(&self) -> Result<Formats> {
        Formats { pictures: self.pictures.asked(), workbook: self.tables.workbook() }.checked()
    }
}

/// The file formats of pictures.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct PictureFormats {
    /// Write pictures as svg, pdf or png, or several of them [default: svg]
    #[arg(long, value_name = "A,B,…", value_delimiter = ',')]
    #[arg(value_parser = values::formats(), hide_possible_values = true)]
    format: Vec<Format>,
}

impl PictureFormats {
    /// The formats asked for, without repetition; SVG if none is given.
    fn asked(&self) -> Vec<Format> {
        let mut formats = Vec::new();
        for format in &self.format {
            if !formats.contains(format) {
                formats.push(*format);
            }
        }
        if formats.is_empty() { vec![Format::Svg] } else { formats }
    }

    /// The formats asked for of a command that writes pictures alone.
    ///
    /// # Errors
    /// As [`Formats::checked`].
    pub fn usable(&self) -> Result<Formats> {
        Formats { pictures: self.asked(), workbook: false }.checked()
    }
}

/// The file formats of tables.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct TableFormats {
    /// With xlsx also write the tables of a folder, which are csv files in any case, as the sheets
    /// of one workbook, tables.xlsx [default: csv]
    #[arg(long, value_name = "csv,xlsx", value_delimiter = ',', hide_possible_values = true)]
    tables: Vec<TableFormat>,
}

/// A file format of tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum TableFormat {
    Csv,
    Xlsx,
}

impl TableFormats {
    fn workbook(&self) -> bool {
        self.tables.contains(&TableFormat::Xlsx)
    }

    /// The formats asked for of a command that writes tables alone.
    ///
    /// # Errors
    /// As [`Formats::checked`].
    pub fn usable(&self) -> Result<Formats> {
        Formats { pictures: Vec::new(), workbook: self.workbook() }.checked()
    }
}
