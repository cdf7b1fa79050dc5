//! Both devices are the same program: guards that run, instead of comments that ask to "keep in sync".
//!
//! Each guard is a function that returns what it found wrong. The tests ask that it finds nothing in the real
//! shaders, and that it finds the fault planted in a copy of them: a guard that cannot fail guards nothing.

#![allow(clippy::unwrap_used)]

mod constants;
mod decorations;
pub(crate) mod devices;
mod layout;
mod pictures;
pub(crate) mod planted;
mod probes;
mod scene;
mod strict;
mod twins;
mod variants;

use snellius::gpu;
