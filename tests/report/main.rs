//! The report, its text and in a browser.

#[cfg(all(feature = "cli", unix))]
#[path = "../support/chromium.rs"]
mod chromium;
#[cfg(feature = "cli")]
#[path = "../support/command.rs"]
mod command;

#[cfg(all(feature = "cli", unix))]
mod bodies;
#[cfg(all(feature = "cli", unix))]
mod browser;
#[cfg(all(feature = "cli", unix))]
mod drawings;
#[cfg(all(feature = "cli", unix))]
mod draws;
#[cfg(all(feature = "cli", unix))]
mod flow;
#[cfg(all(feature = "cli", unix))]
mod narrow;
#[cfg(feature = "cli")]
mod older;
#[cfg(all(feature = "cli", unix))]
mod realisations;
#[cfg(all(feature = "cli", unix))]
mod shown;
#[cfg(all(feature = "cli", unix))]
mod tables;
#[cfg(feature = "cli")]
mod text;
