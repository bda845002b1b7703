//! What is believed of a call: whether it works, by which action, and what speaks against it.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use typelift_belief::{Culprit, Judgement, Suspect};
use typelift_model::{GroundCall, Symbol};
use typelift_world::Scene;

use crate::text::{Role, Text};

/// A call that a program asks about: a line of JSON.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct CallQuestion {
    /// The call.
    pub call: GroundCall,
    /// The types of its objects; not needed for those of the state.
    #[serde(default)]
    pub types: BTreeMap<Symbol, Symbol>,
    /// Where it is used; without a state every literal counts as true.
    #[serde(default)]
    pub state: Option<Scene>,
    /// The instance of the world, of which a model alone knows nothing.
    #[serde(default)]
    pub instance: Option<Symbol>,
}

/// What is believed of a call, for programs.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WhyView {
    /// The call.
    pub call: GroundCall,
    /// How likely it is, from 0 to 1, that what the action predicts happens.
    pub p: f64,
    /// The action that predicts it; none where nothing is known.
    pub action: Option<Symbol>,
    /// What speaks against it, the greatest share first.
    pub suspects: Vec<Suspect>,
    /// Why the model alone does not allow it: wrong types, or preconditions that do not hold in the state.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub unmet: Vec<String>,
    /// Whether nothing is known of such a call: of its name, its number of arguments, or the type of one of them.
    pub unknown: bool,
}

impl WhyView {
    /// The view of a judgement.
    pub fn new(call: GroundCall, judgement: Judgement) -> Self {
        let Judgement { p, action, suspects, unmet } = judgement;
        Self { call, p: rounded(p), unknown: action.is_none(), action, suspects, unmet }
    }
}

/// What is as likely reads as 1.00.
const ALMOST: f64 = 0.995;

/// Four digits are more than is known.
fn rounded(p: f64) -> f64 {
    (p * 10_000.0).round() / 10_000.0
}

/// The same for people: how likely it works, then a line for each thing that speaks against it.
pub fn why_lines(view: &WhyView) -> Vec<Text> {
    let Some(action) = &view.action else {
        return vec![Text::new().plain(format!("{}: no action is known for such a call", view.call))];
    };
    let role = if view.p < 0.5 { Role::Bad } else { Role::Good };
    let head = Text::new().plain(format!("{}: ", view.call));
    let is_almost_sure = view.p >= ALMOST && !view.suspects.is_empty();
    let works = match is_almost_sure {
        true => "works with more than 0.99".to_owned(),
        false => format!("works with {:.2}", view.p),
    };
    let mut lines = vec![head.with(role, works).plain(format!(", by {action}"))];
    let unmet = view.unmet.iter();
    lines.extend(
        unmet.map(|unmet| Text::new().with(Role::Warning, "  not as the model is").plain(format!(": {unmet}"))),
    );
    if !view.suspects.is_empty() {
        let little = if is_almost_sure { "the little that" } else { "what" };
        lines.push(Text::new().with(Role::Aside, format!("  of {little} speaks against it:")));
    }
    let against = view.suspects.iter().map(|suspect| {
        let what = match suspect.kind {
            Culprit::Type => format!("{} may not be accepted in its place", suspect.what),
            Culprit::Pair => format!("{} may not go together", suspect.what),
            Culprit::Object => format!("{} may be out of order", suspect.what),
            Culprit::Literal => match suspect.what.strip_prefix("not ") {
                Some(atom) => format!("{atom} holds, and may have to be false"),
                None => format!("{} does not hold, and may be needed", suspect.what),
            },
            Culprit::Chance => "chance".to_owned(),
        };
        Text::new().plain(format!("  {:>3.0} %  {what}", 100.0 * suspect.share))
    });
    lines.extend(against);
    lines
}
