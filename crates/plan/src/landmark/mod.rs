//! Landmarks: what every plan makes true on its way.

mod exclusive;
mod graph;
mod sequence;
mod sets;

pub(crate) use exclusive::exclusive_goals;
pub(crate) use graph::LandmarkGraph;
pub(crate) use sequence::sequences;
pub use sequence::{LandmarkSequence, landmark_sequences};
pub(crate) use sets::LandmarkSets;
