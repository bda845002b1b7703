//! More goals at once than the paper's tasks have: its search alone takes ten times the expansions with each.

use serde_json::json;
use typelift::agent::{Ending, Options};
use typelift::imagine;
use typelift::model::{Budget, GroundAtom};
use typelift_kitchen::KitchenTask;
use typelift_tests::{kitchen_model, solve};

/// Foods on one plate, each in a state.
fn dish(name: &str, foods: &[(&str, &str)]) -> KitchenTask {
    let kind = |food: &str| food.split('_').next().expect("a kind").to_owned();
    let items: Vec<String> = ["plate".to_owned()].into_iter().chain(foods.iter().map(|(food, _)| kind(food))).collect();
    let atoms =
        foods.iter().flat_map(|(food, state)| [format!("{state}({food})"), format!("content_holds(plate_1,{food})")]);
    KitchenTask {
        name: name.to_owned(),
        set: String::new(),
        title: String::new(),
        goal: atoms.map(|text| GroundAtom::parse(&text).expect("an atom")).collect(),
        scenario: json!({"filler": "demonstrated", "items": items}),
    }
}

#[test]
fn five_and_six_foods_on_one_plate_are_prepared_whatever_fails() {
    let (chopped, mashed, toasted) = ("chop_state_Chopped", "blend_state_Mashed", "toast_state_Toasted");
    let tasks = [
        dish(
            "five",
            &[
                ("coconut_1", chopped),
                ("cucumber_1", chopped),
                ("apple_1", mashed),
                ("carrot_1", mashed),
                ("bagel_1", toasted),
            ],
        ),
        dish(
            "six",
            &[
                ("hokkaido_1", chopped),
                ("cucumber_1", chopped),
                ("apple_1", mashed),
                ("lettuce_1", chopped),
                ("bagel_1", toasted),
                ("bagel_2", toasted),
            ],
        ),
    ];
    let model = kitchen_model(false);
    for task in tasks {
        for restart in [false, true] {
            let options = Options { imagine: Some(imagine::Options::default()), restart, ..Options::default() };
            let account = solve(&model, &task, 3, &options, &Budget::with_expansions(200_000));
            assert_eq!(account.ending, Ending::Solved, "{}, restart {restart}", task.name);
            // A cutboard does not cut a coconut, nor a hokkaido: each is found out by a failure.
            assert!(!account.failures.is_empty(), "{}", task.name);
        }
    }
}
