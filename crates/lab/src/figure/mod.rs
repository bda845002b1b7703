//! The figures, as SVG.
