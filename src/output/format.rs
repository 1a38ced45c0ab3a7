//! Pictures as files: SVG, which is what they are made as, and from it PDF and PNG.
//!
//! PDF and PNG come from `svg2pdf` and `resvg`, which a build has with the feature `pictures`. Their texts are set in a
//! cut of DejaVu Sans (Latin, Greek, Cyrillic) that the program brings along, so that files do not depend on the fonts of
//! the machine.

use super::atomic::write_whole;
use crate::error::{Error, Result};
use std::fmt;
use std::path::Path;
use std::str::FromStr;

/// What a picture is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Scalable, 160 mm wide, texts as texts.
    Svg,
    /// Scalable, 160 mm wide, texts as texts with their font.
    Pdf,
    /// 160 mm wide at 300 dots an inch: 1890 pixels.
    Png,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 3] = [Self::Svg, Self::Pdf, Self::Png];

    /// Its name, which is the ending of its files, too.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Pdf => "pdf",
            Self::Png => "png",
        }
    }

    /// Refuses what this build cannot write.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a format other than SVG without the feature `pictures`; it says how to install with it.
    pub fn check(self) -> Result<()> {
        if self == Self::Svg || cfg!(feature = "pictures") {
            return Ok(());
        }
        let expected = format!(
            "svg: this program was built without the feature `pictures`, which writes {self}\n\
             help: cargo install --path . --features pictures"
        );
        Err(Error::invalid("--format", self, expected))
    }

    /// Writes the picture `svg` to `path`, whole or not at all.
    ///
    /// # Errors
    /// As [`Format::check`] and [`write_whole`]; [`Error::Io`] for a text that is no SVG.
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

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Format {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self> {
        Self::ALL.into_iter().find(|format| format.name() == name).ok_or_else(|| Error::Unknown {
            kind: "format of pictures",
            name: name.to_owned(),
            known: Self::ALL.iter().map(ToString::to_string).collect(),
        })
    }
}

/// Without the feature: [`Format::check`] has refused before.
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

    /// Dots an inch of a PNG, and of the pixels that SVG lengths are told in.
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
            Pixmap::new(width, height).ok_or_else(|| format!("{width} by {height} pixels are no picture"))?;
        // On an opaque ground, so that colours are not multiplied by their opacity.
        picture.fill(Color::WHITE);
        resvg::render(&tree, Transform::from_scale(scale, scale), &mut picture.as_mut());
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        // So that a text processor sets it 160 mm wide.
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
