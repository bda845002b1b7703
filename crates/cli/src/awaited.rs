//! An environment that somebody at a terminal waits for: what was asked of it stands there, if it takes its time.

use typelift::model::{GroundCall, Symbol};
use typelift::world::{Acted, Reset, Scene, UnreadKey, World, WorldError};

use crate::waiting::Waiting;

/// A world, and the line that says what it is asked for.
pub(crate) struct Awaited<W> {
    pub(crate) waiting: Waiting,
    pub(crate) world: W,
}

impl<W: World> World for Awaited<W> {
    fn name(&self) -> String {
        self.world.name()
    }

    fn can_reset(&self) -> bool {
        self.world.can_reset()
    }

    fn instance(&self) -> Option<Symbol> {
        self.world.instance()
    }

    fn reset(&mut self, reset: &Reset) -> Result<Scene, WorldError> {
        self.waiting.during("waiting for reset", || self.world.reset(reset))
    }

    fn observe(&mut self) -> Result<Scene, WorldError> {
        self.waiting.during("waiting for observe", || self.world.observe())
    }

    fn act(&mut self, call: &GroundCall) -> Result<Acted, WorldError> {
        self.waiting.during(&format!("waiting for {call}"), || self.world.act(call))
    }

    fn possible_calls(&self) -> Option<Vec<GroundCall>> {
        self.world.possible_calls()
    }

    fn unread_keys(&self) -> &[UnreadKey] {
        self.world.unread_keys()
    }

    fn close(&mut self) -> Result<(), WorldError> {
        self.waiting.during("waiting for close", || self.world.close())
    }
}
