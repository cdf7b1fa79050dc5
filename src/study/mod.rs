//! What accuracy costs in time: one knob at a time from a stated baseline, each against its own reference.
//!
//! [`run`] plans rows ([`Knob`]), renders references in CPU f64 and says how uncertain they are
//! ([`Uncertainty`]), traces every row once for its errors ([`Errors`], [`Certificate`]) and then again and
//! again, interleaved, for its time ([`Timing`]). What is finished lies in the study's folder, so that a
//! stopped study goes on where it was. [`write_outputs`] makes tables, plots and pages of a [`Report`].
//!
//! Errors are those of linear RGB clamped to [0, 1]: what a display without tone mapping can show.

mod begin;
mod budget;
mod certificate;
mod config;
mod error;
mod figures;
mod first_runs;
mod knob;
mod lab;
mod metrics;
mod output;
mod pareto;
mod plan;
mod reference;
mod report;
mod run;
mod store;
mod timed_runs;
mod timing;

pub use budget::{Choice, Goal, MOST_SAMPLES, Request, choose};
pub use certificate::Certificate;
pub use config::{Config, Watch};
pub use error::StudyError;
pub use knob::{Knob, Truth};
pub use metrics::Errors;
pub use output::write_outputs;
pub use plan::{Baseline, Setup, Target};
pub use reference::Uncertainty;
pub use report::{LeftOut, Rays, ReferenceRecord, Report, RowRecord};
pub use run::run;
pub use timing::Timing;
