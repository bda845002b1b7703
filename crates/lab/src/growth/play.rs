//! Random legal play: an endless stream of transitions from the simulator.
//!
//! In a room of a random seed, with demonstrated or novel food, random actions are tried; those that the simulator
//! refuses change nothing and are no transitions. After so many steps comes the next room. Nothing is kept but the
//! state before and the state after.

use typelift::model::{GroundCall, ParseConfig, SplitMix64, State, Symbol};
use typelift::world::{Parser, Record, Scene};
use typelift_kitchen::{Filler, Room, Scenario, hierarchy};

/// Steps in one room.
const STEPS: u64 = 60;

/// A stream of transitions.
#[derive(Debug)]
pub(crate) struct Play {
    random: SplitMix64,
    parser: Parser,
    room: Room,
    /// What can be picked, placed in, and used.
    items: Vec<Symbol>,
    containers: Vec<Symbol>,
    tools: Vec<Symbol>,
    file: Symbol,
    rooms: u64,
    step: u64,
    before: State,
}

impl Play {
    /// The stream of a seed.
    pub(crate) fn new(seed: u64) -> Self {
        let mut play = Self {
            random: SplitMix64::new(seed),
            parser: Parser::new(hierarchy(), ParseConfig::default()),
            room: Room::build(&Scenario::default(), 0).expect("the default room"),
            items: Vec::new(),
            containers: Vec::new(),
            tools: Vec::new(),
            file: Symbol::new("-"),
            rooms: 0,
            step: 0,
            before: State::default(),
        };
        play.enter_next_room();
        play
    }

    fn enter_next_room(&mut self) {
        let filler = if self.rooms.is_multiple_of(2) { Filler::Demonstrated } else { Filler::Novel };
        let scenario = Scenario { filler: Some(filler), ..Scenario::default() };
        self.room = Room::build(&scenario, self.random.next_u64()).expect("a room with eight items");
        self.rooms += 1;
        (self.step, self.file) = (0, Symbol::from(format!("room_{}", self.rooms)));
        let snapshot = self.room.snapshot();
        let named = |wanted: fn(bool, bool, bool) -> bool| {
            let chosen = snapshot.entities.iter().filter(|e| {
                let has = |name: &str| e.attributes.contains_key(name);
                wanted(has("movable"), e.relations.contains_key("content"), has("status"))
            });
            chosen.map(|entity| entity.id.clone()).collect()
        };
        self.items = named(|movable, _, _| movable);
        self.containers = named(|_, content, _| content);
        self.tools = named(|_, _, status| status);
        self.before = self.observe();
    }

    fn observe(&mut self) -> State {
        self.parser.parse(&Scene::Snapshot(self.room.snapshot())).expect("a state of the kitchen's own types")
    }

    /// The next transition.
    pub(crate) fn next(&mut self) -> Record {
        if self.step == STEPS {
            self.enter_next_room();
        }
        let call = self.act();
        self.step += 1;
        let after = self.observe();
        let before = std::mem::replace(&mut self.before, after.clone());
        Record { source: Some(self.file.clone()), step: self.step, before, action: call.into(), after }
    }

    /// Performs a random action that is possible; the call names all that takes part, as in the demonstrations.
    fn act(&mut self) -> GroundCall {
        let agent = self.room.agent_name().clone();
        loop {
            let kind = self.random.below(3);
            let (name, chosen) = match kind {
                0 => ("PICK", &self.items),
                1 => ("PLACE", &self.containers),
                _ => ("USE", &self.tools),
            };
            let chosen = chosen[self.random.below(chosen.len())].clone();
            let relations = |room: &Room, id: &Symbol, relation: &str| -> Option<Symbol> {
                let entity = room.snapshot().entities.into_iter().find(|entity| entity.id == *id)?;
                entity.relations.get(relation)?.targets().last().cloned()
            };
            let call = GroundCall { name: name.into(), args: vec![agent.clone(), chosen.clone()] };
            // Trying costs less than describing, so the rest of the call is found out only if it works.
            let before = self.room.clone();
            if self.room.act(&call).is_err() {
                continue;
            }
            let third = match kind {
                0 => before.container_of(chosen.as_str()).cloned(),
                1 => relations(&before, &agent, "holding"),
                _ => relations(&before, &chosen, "content"),
            };
            let mut args = vec![agent];
            match kind {
                0 => args.extend(third.into_iter().chain([chosen])),
                _ => args.extend(std::iter::once(chosen).chain(third)),
            }
            return GroundCall { name: name.into(), args };
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn every_step_changes_something_and_repeats() {
        let (mut play, mut again) = (Play::new(7), Play::new(7));
        let mut names = BTreeSet::new();
        for _ in 0..300 {
            let observed = play.next();
            assert_ne!(observed.before.atoms, observed.after.atoms, "{}", observed.action.call);
            assert_eq!(observed.action.call.args.len(), 3, "{}", observed.action.call);
            assert_eq!(observed.action.call, again.next().action.call);
            names.insert(observed.action.call.name.clone());
        }
        assert_eq!(names.len(), 3, "{names:?}");
        assert_eq!(play.rooms, 5);
    }
}
