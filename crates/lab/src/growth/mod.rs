//! How planning and learning grow: with the number of objects, of goal foods, of transitions.
//!
//! | series | what grows | what stays |
//! |---|---|---|
//! | storeroom | objects, 32 to 10,000 | the goal (three foods), one plate, one of each tool |
//! | kitchens | objects, 32 to 10,000 | the goal; tools and plates grow with the rest |
//! | goals | goal foods, 1 to 20 | 96 objects |
//! | transitions | transitions learned from, 100 to 1,000,000 | rooms of the paper's size |
//!
//! Each point is measured in a process of its own, so that its peak memory is its own. Who starts that process is
//! handed in; [`measure`] is what it does.

mod learning;
mod measurement;
mod memory;
mod planning;
mod play;
mod plots;
mod processor_time;
mod room;

use std::fmt;

use serde_json::{Value, json};
use typelift::model::MemoryProbe;

use crate::error::LabError;
use crate::learned::kitchen_model;
use crate::limits::Stopper;
use crate::runner::Experiment;

pub use measurement::{End, Measurement, Point, Series, UnknownPoint};
pub use planning::Allowance;
pub use plots::{GrowthResult, SeriesFit};

use room::Stock;

/// The objects in the kitchen of the series of goals.
const OBJECTS_OF_GOALS: usize = 96;
/// The foods of the goal where something else grows.
const DISHES: usize = 3;

/// Measures one point in this process; `memory` tells how many bytes it has come to hold.
///
/// # Panics
/// If the kitchen's own demonstrations cannot be learned from.
pub fn measure(point: Point, allowance: Allowance, memory: &MemoryProbe) -> Measurement {
    let size = usize::try_from(point.size).unwrap_or(usize::MAX);
    let (stock, dishes) = match point.series {
        Series::Transitions => return learning::measure(point.size, allowance.seconds),
        Series::Storeroom => (Stock::storeroom(size.max(32)), DISHES),
        Series::Kitchens => (Stock::kitchens(size.max(32)), DISHES),
        Series::Goals => (Stock::storeroom(OBJECTS_OF_GOALS), size.min(20)),
    };
    planning::measure(&kitchen_model(false), &room::task(stock, dishes), allowance, memory)
}

/// Measures a point in a process of its own.
pub type Measure<'a> = dyn Fn(Point, Allowance, &Stopper) -> Result<Option<Measurement>, LabError> + Sync + 'a;

/// The experiment.
pub struct Growth<'a> {
    /// Small sizes only.
    pub quick: bool,
    /// What each point may spend.
    pub allowance: Allowance,
    /// Who measures.
    pub measure: &'a Measure<'a>,
}

impl fmt::Debug for Growth<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { quick, allowance, .. } = self;
        f.debug_struct("Growth").field("quick", quick).field("allowance", allowance).finish_non_exhaustive()
    }
}

impl Experiment for Growth<'_> {
    const NAME: &'static str = "growth";
    type Run = Point;
    type Record = Measurement;

    fn settings(&self) -> Value {
        json!({ "quick": self.quick, "seconds": self.allowance.seconds, "bytes": self.allowance.bytes })
    }

    fn runs(&self) -> Vec<Point> {
        let objects: &[u64] = if self.quick { &[32, 64, 100] } else { &[32, 64, 100, 320, 1000, 3200, 10_000] };
        let kitchens: &[u64] = if self.quick { &[32] } else { &[32, 64, 100, 320, 1000, 3200, 10_000] };
        let goals: &[u64] = if self.quick { &[1, 2, 3] } else { &[1, 2, 3, 4, 5, 6, 8, 10, 12, 14, 16, 18, 20] };
        let transitions: &[u64] = if self.quick {
            &[100, 200, 400]
        } else {
            &[100, 320, 1000, 3200, 10_000, 32_000, 100_000, 320_000, 1_000_000]
        };
        let sizes = |series: Series| match series {
            Series::Storeroom => objects,
            Series::Kitchens => kitchens,
            Series::Goals => goals,
            Series::Transitions => transitions,
        };
        Series::ALL
            .into_iter()
            .flat_map(|series| sizes(series).iter().map(move |&size| Point { series, size }))
            .collect()
    }

    fn weight(&self, point: &Point) -> u64 {
        match point.series {
            Series::Storeroom | Series::Kitchens => point.size,
            Series::Goals => point.size * 20,
            Series::Transitions => point.size / 100,
        }
    }

    fn run(&self, point: &Point, stopper: &Stopper) -> Result<Option<Measurement>, LabError> {
        (self.measure)(*point, self.allowance, stopper)
    }
}

#[cfg(test)]
mod tests {
    use typelift::model::Stop;

    use super::*;

    /// Always one mebibyte.
    fn little() -> MemoryProbe {
        std::sync::Arc::new(|| 1 << 20)
    }

    const ALLOWANCE: Allowance = Allowance { seconds: 60.0, bytes: 1 << 30 };

    #[test]
    fn small_points_are_solved() {
        for (point, steps) in [("storeroom 32", 15), ("kitchens 32", 15), ("goals 1", 5)] {
            let measured = measure(point.parse().expect(point), ALLOWANCE, &little());
            assert_eq!((measured.end, measured.steps), (End::Finished, Some(steps)), "{point}");
            assert!(measured.ground_actions > Some(50) && measured.seconds > 0.0, "{point}");
        }
    }

    /// With all objects of two kitchens the search would expand hundreds of thousands of states.
    #[test]
    fn a_few_kitchens_are_no_harder_than_one() {
        for point in ["kitchens 64", "kitchens 100", "kitchens 150"] {
            let measured = measure(point.parse().expect(point), ALLOWANCE, &little());
            assert!(measured.end == End::Finished && measured.expansions < Some(100), "{point}: {measured:?}");
        }
    }

    #[test]
    fn what_is_not_allowed_cuts_a_point() {
        let point = "storeroom 100".parse().expect("a point");
        assert_eq!(measure(point, Allowance { seconds: 0.0, ..ALLOWANCE }, &little()).end, End::Stopped(Stop::Time));
        assert_eq!(measure(point, Allowance { bytes: 1, ..ALLOWANCE }, &little()).end, End::Stopped(Stop::Memory));
    }

    #[test]
    fn the_sizes() {
        let all = |quick| Growth { quick, allowance: ALLOWANCE, measure: &|_, _, _| Ok(None) }.runs();
        assert_eq!((all(true).len(), all(false).len()), (10, 36));
        assert!(all(false).contains(&Point { series: Series::Transitions, size: 1_000_000 }));
    }
}
