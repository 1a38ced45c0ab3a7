//! File formats of pictures and tables. Pictures are SVG, which this crate writes itself, and PDF
//! and PNG made from it; tables are CSV, and the sheets of a workbook beside it.
//!
//! PDF and PNG are made by `svg2pdf` and `resvg`, with the feature `pictures`. Text is set in a
//! subset of DejaVu Sans (Latin, Greek, Cyrillic) that is built into the program, so that files do
//! not depend on the fonts of the machine.

use super::atomic::write_whole;
use crate::error::{Error, Result, names};
use std::path::Path;

/// The formats in which the results of a request are written.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Formats {
    /// File formats of pictures.
    pub pictures: Vec<Format>,
    /// True where the tables of a folder, which are CSV files, are also the sheets of a workbook.
    pub workbook: bool,
}

impl Formats {
    /// The same, where this build can write them.
    ///
    /// # Errors
    /// As [`Format::check`]; [`Error::Invalid`] for a workbook without the feature `xlsx`.
    pub fn checked(self) -> Result<Self> {
        self.pictures.iter().try_for_each(|format| format.check())?;
        match self.workbook && !cfg!(feature = "xlsx") {
            true => Err(not_built("--tables", "xlsx", "csv", "xlsx")),
            false => Ok(self),
        }
    }
}

/// The refusal of the format `asked` of `option` by a build without `feature`, which writes
/// `accepted`.
fn not_built(option: &'static str, asked: &str, accepted: &str, feature: &str) -> Error {
    let expected = format!(
        "{accepted}: this program was built without the feature `{feature}`, which writes {asked}\n\
         help: cargo install --path . --features {feature}"
    );
    Error::invalid(option, asked, expected)
}

/// The file format of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Scalable, 160 mm wide; text remains text.
    Svg,
    /// Scalable, 160 mm wide; text remains text, and the font is embedded.
    Pdf,
    /// 160 mm wide at 300 dots an inch: 1890 pixels.
    Png,
}

// The name is also the extension of its files.
names!(Format: "format of pictures", Svg => "svg", Pdf => "pdf", Png => "png");

impl Format {
    /// Refuses a format that this build cannot write.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a format other than SVG without the feature `pictures`; the message
    /// says how to install with it.
    pub fn check(self) -> Result<()> {
        if self == Self::Svg || cfg!(feature = "pictures") {
            return Ok(());
        }
        Err(not_built("--format", self.name(), "svg", "pictures"))
    }

    /// Writes the picture `svg` to `path`, whole or not at all.
    ///
    /// # Errors
    /// As [`Format::check`] and [`write_whole`]; [`Error::Io`] for a text that is not valid SVG.
    pub fn write(self, path: &Path, svg: &str) -> Result<()> {
        self.check()?;
        let failed = |reason: String| Error::io(path.display(), reason, false);
        match self {
            Self::Svg => write_whole(path, svg.as_bytes()),
            Self::Pdf => write_whole(path, &convert::pdf(svg).map_err(failed)?),
            Self::Png => write_whole(path, &convert::png(svg).map_err(failed)?),
        }
    }
}

/// Without the feature this is not reached: [`Format::check`] has refused before.
#[cfg(not(feature = "pictures"))]
mod convert {
    pub fn pdf(_: &str) -> Result<Vec<u8>, String> {
        Err("built without the feature `pictures`".to_owned())
    }

    pub use pdf as png;
}

#[cfg(feature = "pictures")]
mod convert {
    use resvg::tiny_skia::{Color, Pixmap, Transform};
    use std::sync::Arc;
    use svg2pdf::usvg::{Options, Tree, fontdb::Database};
    use svg2pdf::{ConversionOptions, PageOptions};

    /// Dots per inch of a PNG; the SVG lengths are converted to pixels at the same resolution.
    const DOTS: f32 = 300.0;
    const SVG_DOTS: f32 = 96.0;
    const INCHES_A_METRE: f32 = 1.0 / 0.0254;
    const FONTS: [&[u8]; 2] =
        [include_bytes!("../../assets/fonts/DejaVuSans.ttf"), include_bytes!("../../assets/fonts/DejaVuSans-Bold.ttf")];

    fn tree(svg: &str) -> Result<Tree, String> {
        let mut fonts = Database::new();
        for font in FONTS {
            fonts.load_font_data(font.to_vec());
        }
        fonts.set_sans_serif_family("DejaVu Sans");
        let options = Options { fontdb: Arc::new(fonts), ..Options::default() };
        Tree::from_str(svg, &options).map_err(|error| error.to_string())
    }

    pub fn pdf(svg: &str) -> Result<Vec<u8>, String> {
        let page = PageOptions { dpi: SVG_DOTS };
        svg2pdf::to_pdf(&tree(svg)?, ConversionOptions::default(), page).map_err(|error| format!("{error:?}"))
    }

    pub fn png(svg: &str) -> Result<Vec<u8>, String> {
        let tree = tree(svg)?;
        let scale = DOTS / SVG_DOTS;
        let pixels = |length: f32| (length * scale).ceil() as u32;
        let (width, height) = (pixels(tree.size().width()), pixels(tree.size().height()));
        let mut picture =
            Pixmap::new(width, height).ok_or_else(|| format!("cannot make a picture of {width} by {height} pixels"))?;
        // Painted on an opaque background, so that colours stay as they are and no alpha channel is
        // written.
        picture.fill(Color::WHITE);
        resvg::render(&tree, Transform::from_scale(scale, scale), &mut picture.as_mut());
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        // The resolution is stored in the file, so that a text processor shows it 160 mm wide.
        let dots = (DOTS * INCHES_A_METRE).round() as u32;
        encoder.set_pixel_dims(Some(png::PixelDimensions { xppu: dots, yppu: dots, unit: png::Unit::Meter }));
        let written = encoder.write_header().and_then(|mut image| {
            image.write_image_data(picture.data())?;
            image.finish()
        });
        written.map_err(|error| error.to_string())?;
        Ok(bytes)
    }
}
