//! x
use super::ui::Ui;
use crate::error::Result;
/// X
#[derive(Debug, clap::Args)]
pub struct Args {}
pub fn execute(_: &Args, _: &Ui) -> Result<()> {
    Ok(())
}
