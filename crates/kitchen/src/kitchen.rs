//! The kitchen as an environment.

use typelift_model::GroundCall;
use typelift_world::{Acted, Reset, Scene, World, WorldError};

use crate::room::Room;
use crate::scenario::Scenario;

/// A kitchen to act in. A reset sets up a room; its scenario has the form of [`Scenario`].
#[derive(Debug, Clone, Default)]
pub struct Kitchen {
    room: Option<Room>,
}

impl Kitchen {
    /// A kitchen in which nothing has been set up.
    pub fn new() -> Self {
        Self::default()
    }

    /// The room as it is now; `None` before the first reset.
    pub fn room(&self) -> Option<&Room> {
        self.room.as_ref()
    }
}

impl From<Room> for Kitchen {
    fn from(room: Room) -> Self {
        Self { room: Some(room) }
    }
}

fn not_set_up() -> WorldError {
    WorldError::NotSetUp { world: "kitchen".to_owned() }
}

impl World for Kitchen {
    fn name(&self) -> String {
        "kitchen".to_owned()
    }

    fn reset(&mut self, reset: &Reset) -> Result<Scene, WorldError> {
        let room = Scenario::from_json(reset.scenario.as_ref())
            .and_then(|scenario| Room::build(&scenario, reset.seed))
            .map_err(|error| WorldError::CannotSetUp { account: error.to_string() })?;
        Ok(Scene::Snapshot(self.room.insert(room).snapshot()))
    }

    fn observe(&mut self) -> Result<Scene, WorldError> {
        self.room.as_ref().map(|room| Scene::Snapshot(room.snapshot())).ok_or_else(not_set_up)
    }

    fn act(&mut self, call: &GroundCall) -> Result<Acted, WorldError> {
        let room = self.room.as_mut().ok_or_else(not_set_up)?;
        let reason = room.act(call).err().map(|refusal| refusal.to_string());
        Ok(Acted { scene: Scene::Snapshot(room.snapshot()), executed: reason.is_none(), reason })
    }

    /// All calls that [`Room::act`] would carry out, each in its long form. None before the first reset. Takes a look at
    /// each thing that can be picked or used, and at each place where what is held can be put.
    fn possible_calls(&self) -> Option<Vec<GroundCall>> {
        self.room.as_ref().map(Room::possible_calls)
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn a_world_to_act_in() {
        let mut world: Box<dyn World> = Box::new(Kitchen::new());
        assert!(world.observe().is_err());
        let call = GroundCall { name: "PICK".into(), args: vec!["agent_1".into(), "apple_1".into()] };
        assert_eq!(world.act(&call).expect_err("no room").to_string(), not_set_up().to_string());
        let reset = Reset { seed: 5, scenario: Some(json!({"items": ["apple"]})) };
        let first = world.reset(&reset).expect("a room");
        let acted = world.act(&call).expect("a world");
        assert!(acted.executed && acted.reason.is_none() && acted.scene != first);
        let again = world.act(&call).expect("a world");
        assert_eq!((again.executed, again.reason.as_deref()), (false, Some("the hand already holds apple_1")));
        assert_eq!(again.scene, acted.scene);
        assert_eq!(world.observe(), Ok(acted.scene.clone()));
        let bad = Reset { seed: 5, scenario: Some(json!({"items": ["pear"]})) };
        assert!(world.reset(&bad).is_err());
        assert_eq!(world.observe(), Ok(acted.scene), "a failed reset changes nothing");
        assert_eq!(world.reset(&reset), Ok(first));
    }
}
