//! The JSON Schemas of the files and messages that people and programs exchange.

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema};
use typelift_agent::{Episode, Input};
use typelift_model::LearnedModel;
use typelift_words::{
    AccountView, AnswerView, CallQuestion, InspectionView, ModelDifference, WhyView, WireCommand, WireEvent,
};
use typelift_world::{Answer, Request, Scene, TaskFile, TraceLine};

/// Each schema, by the name that its file has. A trace is described by the schema of one of its lines.
pub fn schemas() -> [(&'static str, serde_json::Value); 15] {
    [
        ("trace", schema::<TraceLine<'_>>("A line of a trace, format trace/1")),
        ("task", schema::<TaskFile>("A task, format task/1")),
        ("model", schema::<LearnedModel>("A model, format model/2")),
        ("answer", schema::<AnswerView>("The answer to a planning question, as `plan --json` prints it")),
        ("account", schema::<AccountView>("The account of a task, as `run --json` prints it")),
        ("difference", schema::<ModelDifference>("How two models differ, as `diff --json` prints it")),
        (
            "inspection",
            schema::<InspectionView>("What was found in trying an environment, as `check-env --json` prints it"),
        ),
        ("event", schema::<WireEvent>("Something that happens during an episode, a line of `run --events`")),
        ("env-request", schema::<Request>("A request to an environment, protocol env/1")),
        ("env-answer", schema::<Answer>("An environment's answer, protocol env/1")),
        ("call-question", schema::<CallQuestion>("A call that is asked about, a line of `why --calls`")),
        ("why", schema::<WhyView>("What is believed of a call, a line of `why --json`")),
        ("episode", schema::<Episode>("A saved episode, format episode/1")),
        ("episode-command", schema::<WireCommand>("What an episode tells its driver to do")),
        ("episode-input", schema::<Input<Scene>>("What a driver reports to its episode")),
    ]
}

fn schema<T: JsonSchema>(title: &str) -> serde_json::Value {
    let mut schema: Schema = SchemaSettings::draft2020_12().into_generator().into_root_schema_for::<T>();
    schema.insert("title".to_owned(), title.into());
    let mut value = schema.to_value();
    unlink(&mut value);
    value
}

/// Descriptions are documentation comments; their links mean nothing here.
fn unlink(value: &mut serde_json::Value) {
    match value {
        serde_json::Value::String(text) => *text = text.replace("[`", "`").replace("`]", "`"),
        serde_json::Value::Array(values) => values.iter_mut().for_each(unlink),
        serde_json::Value::Object(map) => map.values_mut().for_each(unlink),
        _ => {}
    }
}
