//! Only the effects that a scene calls for are simulated, and that changes no bit.

#![allow(clippy::unwrap_used)]

mod assembly;
pub(crate) mod covering;
mod equality;
mod forced;
mod headers;
mod meeting;
mod neutral;
mod random;
mod recorded;
mod subject;
