//! Only the effects that a scene calls for are simulated, and that changes no bit.

#![allow(clippy::unwrap_used)]

pub(crate) mod covering;
