//! One page with everything: the paper's claims held against our numbers, all tables and figures, and where they come
//! from. It needs no network and no file beside it.

mod claims;
mod environment;
mod html;
mod page;
mod results;
mod sections;

pub use claims::{Claim, Finding, Judged, claims, judge};
pub use environment::Environment;
pub use page::report_page;
pub use results::{EXPERIMENTS, Results};
