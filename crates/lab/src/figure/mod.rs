//! Figures as SVG: exact, small, and the same bytes for the same data.
//!
//! Each figure is a function from plain data to text. Colours are Okabe and Ito's, which colour-blind readers tell
//! apart, and never the only thing that tells: shape or a label says it too. A figure turns dark where the reader's
//! screen is, whether it is a file of its own or part of a page, and stays light on paper.

mod axis;
mod hierarchy;
mod scaling;
mod svg;
mod tree;
mod violin;

pub use hierarchy::{Edge, matrix};
pub use scaling::{Fit, LogLog, PowerPoint, PowerSeries, fit_power_law, log_log};
pub(crate) use svg::{STYLE, escape};
pub use tree::{Branch, tree};
pub use violin::{BANDWIDTH, Column, Violins, violin, violins};
