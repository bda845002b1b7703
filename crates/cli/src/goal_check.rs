//! Holds a task's goal against the first state that an environment shows.

use typelift::model::{ActionModel, GroundAtom, GroundCall, ParseConfig};
use typelift::world::{Acted, Parser, Reset, Scene, TaskError, World, WorldError, check_goal};

/// A world whose first state is held against the task's goal.
pub(crate) struct GoalCheck<'a> {
    pub(crate) world: &'a mut dyn World,
    pub(crate) model: &'a ActionModel,
    pub(crate) parse: &'a ParseConfig,
    pub(crate) goal: Vec<GroundAtom>,
    /// What is wrong with the goal, if the world was stopped for it.
    pub(crate) error: Option<TaskError>,
}

impl GoalCheck<'_> {
    fn checked(&mut self, scene: Scene) -> Result<Scene, WorldError> {
        let mut parser = Parser::new(self.model.hierarchy.clone(), self.parse.clone());
        // A scene that cannot be parsed is reported by whoever parses it next.
        if let Ok(state) = parser.parse(&scene)
            && let Err(error) = check_goal(&self.goal, &state, &self.model.predicates)
        {
            let account = error.to_string();
            self.error = Some(error);
            return Err(WorldError::CannotSetUp { account });
        }
        Ok(scene)
    }
}

impl World for GoalCheck<'_> {
    fn name(&self) -> String {
        self.world.name()
    }

    fn can_reset(&self) -> bool {
        self.world.can_reset()
    }

    fn reset(&mut self, reset: &Reset) -> Result<Scene, WorldError> {
        let scene = self.world.reset(reset)?;
        self.checked(scene)
    }

    fn observe(&mut self) -> Result<Scene, WorldError> {
        self.world.observe()
    }

    fn act(&mut self, call: &GroundCall) -> Result<Acted, WorldError> {
        self.world.act(call)
    }
}
