//! Holds the simulator against a recording: the same actions from the same first state, compared atom by atom.

use std::collections::BTreeSet;

use thiserror::Error;
use typelift_model::{GroundAtom, GroundCall, State};
use typelift_world::{ParseError, Parser, Scene, Snapshot};

use crate::refusal::Refusal;
use crate::room::Room;
use crate::snapshot_error::SnapshotError;
use crate::types::{hierarchy, parse_config};

/// What came of a replay.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReplayReport {
    /// How many actions were performed, the differing one included.
    pub steps: usize,
    /// The first difference; `None` if the simulator does what was recorded.
    pub difference: Option<Difference>,
}

/// The first state in which simulator and recording differ.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Difference {
    /// The number of the action after which it shows, from 1; 0 for the first state itself.
    pub step: usize,
    /// That action; `None` for the first state.
    pub call: Option<GroundCall>,
    /// Why the simulator did not perform it, if it did not.
    pub refusal: Option<Refusal>,
    /// Atoms that hold in the recording and not in the simulator.
    pub missing: Vec<GroundAtom>,
    /// Atoms that hold in the simulator and not in the recording.
    pub unexpected: Vec<GroundAtom>,
}

/// Why a recording cannot be replayed.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ReplayError {
    /// The simulator cannot be set to its first state.
    #[error("the first state is not a kitchen: {0}")]
    First(#[from] SnapshotError),
    /// One of its states cannot be read.
    #[error("the state after step {step} cannot be read: {error}")]
    State {
        /// The number of the action before it, 0 for the first state.
        step: usize,
        /// What is wrong.
        error: ParseError,
    },
}

/// Sets the simulator to the first state, performs the actions and compares what is observed after each with what
/// was recorded, up to the first difference. What is recorded as unknown is not compared.
///
/// # Errors
/// [`ReplayError`] if a recorded state is not one of a kitchen.
pub fn replay(
    first: &Snapshot,
    steps: impl IntoIterator<Item = (GroundCall, Scene)>,
) -> Result<ReplayReport, ReplayError> {
    let mut room = Room::from_snapshot(first)?;
    let mut parser = Parser::new(hierarchy(), parse_config());
    let recorded = Scene::Snapshot(first.clone());
    if let Some(difference) = compare(&mut parser, &room, 0, &recorded)? {
        return Ok(ReplayReport { steps: 0, difference: Some(difference) });
    }
    let mut performed = 0;
    for (call, recorded) in steps {
        performed += 1;
        let refusal = room.act(&call).err();
        if let Some(difference) = compare(&mut parser, &room, performed, &recorded)? {
            let difference = Difference { call: Some(call), refusal, ..difference };
            return Ok(ReplayReport { steps: performed, difference: Some(difference) });
        }
    }
    Ok(ReplayReport { steps: performed, difference: None })
}

fn compare(parser: &mut Parser, room: &Room, step: usize, recorded: &Scene) -> Result<Option<Difference>, ReplayError> {
    let mut read = |scene: &Scene| parser.parse(scene).map_err(|error| ReplayError::State { step, error });
    let expected = read(recorded)?;
    let observed = read(&Scene::Snapshot(room.snapshot()))?;
    let only = |a: &BTreeSet<GroundAtom>, b: &State| -> Vec<GroundAtom> {
        a.difference(&b.atoms).filter(|atom| !expected.is_unknown(atom)).cloned().collect()
    };
    let (missing, unexpected) = (only(&expected.atoms, &observed), only(&observed.atoms, &expected));
    let same = missing.is_empty() && unexpected.is_empty();
    Ok((!same).then_some(Difference { step, call: None, refusal: None, missing, unexpected }))
}
